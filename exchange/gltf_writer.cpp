#include "exchange/gltf_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "exchange/file_output.h"
#include "exchange/gltf_compress.h"
#include "exchange/gltf_document.h"
#include "exchange/gltf_format.h"
#include "exchange/gltf_images.h"
#include "exchange/gltf_meshes.h"
#include "exchange/gltf_stock.h"

namespace bosquet::exchange {
namespace {

Result<void> check_numbers(const scene::Model& model) {
  for (const scene::Node& node : model.nodes)
    if (!finite(node.translation))
      return cannot_finish(fmt::format("glTF: the place of node {} is not finite", node.name));
  for (const scene::Camera& camera : model.cameras) {
    if (!finite(camera.eye) || !finite(camera.target))
      return cannot_finish(fmt::format("glTF: the place of camera {} is not finite", camera.name));
    if (!(camera.vertical_fov_deg > 0.0f && camera.vertical_fov_deg < 180.0f))
      return Error{fmt::format("camera {}: a field of view of {} degrees; it lies between 0 and 180", camera.name,
                               camera.vertical_fov_deg)};
  }
  return {};
}

std::string in_gigabytes(std::uint64_t bytes) {
  return bytes < 1'000'000'000 ? fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6)
                               : fmt::format("{:.2f} GB", static_cast<double>(bytes) / 1e9);
}

bool has_wind(const GltfStock& stock) {
  return std::any_of(stock.meshes.begin(), stock.meshes.end(),
                     [](const MeshFacts& m) { return m.mesh && !m.mesh->wind.empty(); });
}

const Error kCancelled = cannot_finish("cancelled while writing glTF");

// Room for the largest group, so that no larger one has to be copied.
std::vector<std::byte> group_buffer(const MeshLayout& layout) {
  std::uint64_t most = 0;
  for (const MeshGroup& group : layout.groups) most = std::max(most, group.end - group.begin);
  std::vector<std::byte> buffer;
  buffer.reserve(most);
  return buffer;
}

// The vertex data, group by group; false when cancelled.
bool stream_meshes(FileOutput& file, const GltfContent& content, const GltfOptions& options) {
  std::vector<std::byte> bytes = group_buffer(*content.layout);
  for (const MeshGroup& group : content.layout->groups) {
    if (options.progress && options.progress->cancelled()) return false;
    if (file.failed()) return true;  // commit() will say why
    encode_group(content.stock->meshes, *content.layout, group, options.reorder, bytes);
    file.write(bytes);
    if (options.progress) options.progress->advance(group.last - group.first);
  }
  return true;
}

void pad(FileOutput& file, std::uint64_t bytes, char with) { file.write(std::string(padded(bytes) - bytes, with)); }

void write_packed(FileOutput& file, const PackedViews& packed) {
  for (const auto& views : packed.views)
    for (const PackedViews::View& view : views) {
      file.write(view.data);
      pad(file, view.data.size(), '\0');
    }
}

// Everything packed, or cancelled.
Result<PackedViews> pack(const GltfContent& content, const GltfOptions& options) {
  PackedViews packed;
  std::vector<std::byte> bytes = group_buffer(*content.layout);
  for (const MeshGroup& group : content.layout->groups) {
    if (options.progress && options.progress->cancelled()) return kCancelled;
    encode_group(content.stock->meshes, *content.layout, group, options.reorder, bytes);
    pack_group(group, bytes, packed);
    if (options.progress) options.progress->advance(group.last - group.first);
  }
  return packed;
}

template <class... Words>
void write_words(FileOutput& file, Words... words) {
  const std::uint32_t all[] = {static_cast<std::uint32_t>(words)...};
  file.write(std::as_bytes(std::span(all)));
}

Result<std::uint64_t> write_glb(const std::filesystem::path& path, const GltfContent& content,
                                const GltfOptions& options) {
  std::uint64_t bin_bytes = content.packed ? content.packed->bytes : content.layout->bytes;
  for (const GltfImage& image : *content.images) bin_bytes += padded(image.bytes.size());
  const std::vector<std::string> json = gltf_json(content, {}, options);
  std::uint64_t json_bytes = 0;
  for (const std::string& piece : json) json_bytes += piece.size();

  const std::uint64_t total = 12 + 8 + padded(json_bytes) + (bin_bytes > 0 ? 8 + bin_bytes : 0);
  if (total > options.max_glb_bytes)
    return Error{fmt::format(
        "{} would have {} ({} triangles), but a .glb ends at {}: set a smaller --max-triangles or --detail{}, export "
        "parts of the site one by one, or write a .gltf, whose .bin may be larger",
        path.string(), in_gigabytes(total), count(*content.model).triangles, in_gigabytes(options.max_glb_bytes),
        options.compression == Compression::meshopt ? "" : ", compress (--compress meshopt)")};

  auto file = FileOutput::create(path);
  if (!file) return file.error();
  write_words(*file, kGlbMagic, kGlbVersion, total);
  write_words(*file, padded(json_bytes), kJsonChunk);
  for (const std::string& piece : json) file->write(piece);
  pad(*file, json_bytes, ' ');
  if (bin_bytes > 0) {
    write_words(*file, bin_bytes, kBinChunk);
    if (content.packed)
      write_packed(*file, *content.packed);
    else if (!stream_meshes(*file, content, options))
      return kCancelled;
    for (const GltfImage& image : *content.images) {
      file->write(image.bytes);
      pad(*file, image.bytes.size(), '\0');
    }
  }
  assert(file->failed() || file->bytes() == total);
  return file->commit();
}

Result<std::uint64_t> write_separate(const std::filesystem::path& path, const GltfContent& content,
                                     const GltfFiles& names, const GltfOptions& options) {
  // All files are written before the first appears, and the .gltf that names the others appears last.
  std::vector<FileOutput> files;
  const auto open = [&](const std::filesystem::path& target) -> Result<void> {
    auto file = FileOutput::create(target);
    if (!file) return file.error();
    files.push_back(*std::move(file));
    return {};
  };
  for (std::size_t i = 0; i < names.images.size(); ++i) {
    if (auto opened = open(path.parent_path() / names.images[i]); !opened) return opened.error();
    files.back().write((*content.images)[i].bytes);
  }
  if (content.layout->bytes > 0) {
    if (auto opened = open(path.parent_path() / names.data); !opened) return opened.error();
    if (content.packed) {
      write_packed(files.back(), *content.packed);
      if (auto opened = open(path.parent_path() / names.fallback); !opened) return opened.error();
    }
    if (!stream_meshes(files.back(), content, options)) return kCancelled;
  }
  if (auto opened = open(path); !opened) return opened.error();
  for (const std::string& piece : gltf_json(content, names, options)) files.back().write(piece);

  std::uint64_t total = 0;
  for (FileOutput& file : files) {
    const auto written = file.commit();
    if (!written) return written.error();
    total += *written;
  }
  return total;
}

}  // namespace

ModelCount count(const scene::Model& model) {
  ModelCount out;
  std::unordered_map<const TriangleMesh*, bool> seen;
  for (const scene::Node& node : model.nodes)
    for (const scene::Part& part : node.parts) {
      if (!drawable(part)) continue;
      out.triangles += part.mesh->triangles();
      if (seen.try_emplace(part.mesh.get(), true).second) out.vertices += part.mesh->positions.size();
    }
  return out;
}

Result<WrittenGltf> write_gltf(const scene::Model& model, const std::filesystem::path& path,
                               const GltfOptions& options) {
  const std::string ending = lower_ending(path);
  if (ending != ".glb" && ending != ".gltf")
    return Error{fmt::format("{}: a glTF file ends in .glb or .gltf", path.string())};
  if (auto checked = check_numbers(model); !checked) return checked.error();
  auto stock = take_stock(model, options);
  if (!stock) return stock.error();
  if (options.instancing && has_wind(*stock)) return Error{std::string(kNoWindOfInstances)};
  const bool separate = ending == ".gltf", packs = options.compression == Compression::meshopt;
  // With separate files the data is encoded twice, packed and as it is.
  if (options.progress) options.progress->begin("export", stock->meshes.size() * (separate && packs ? 2 : 1));
  const MeshLayout layout = lay_out(stock->meshes);
  const auto images = encode_images(model.materials, stock->materials, options.leaf_normal_maps, options.textures);
  if (options.progress && options.progress->cancelled()) return kCancelled;

  GltfContent content{&model, &*stock, &layout, &images, nullptr};
  PackedViews packed;
  if (packs) {
    auto done = pack(content, options);
    if (!done) return done.error();
    packed = *std::move(done);
    content.packed = &packed;
  }
  GltfFiles names;
  if (separate) {
    const std::string stem = path.stem().string();
    names.separate = true;
    names.data = stem + ".bin";
    if (packs) names.fallback = stem + "-fallback.bin";
    for (const GltfImage& image : images) names.images.push_back(stem + "-" + image.name + image.ending());
  }
  const auto bytes = separate ? write_separate(path, content, names, options) : write_glb(path, content, options);
  if (!bytes) return bytes.error();
  return WrittenGltf{*bytes, required_extensions(used_extensions(*stock, model, options), names)};
}

}  // namespace bosquet::exchange
