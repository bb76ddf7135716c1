#include "exchange/gltf_images.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/hash.h"
#include "core/parallel.h"

namespace bosquet::exchange {
namespace {

// Part of every key: raise it when encoding changes.
constexpr std::uint64_t kEncoderVersion = 1;

std::string plain_name(const std::string& name) {
  std::string plain;
  for (char c : name) {
    const bool safe = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    plain += safe ? c : '_';
  }
  return plain.empty() ? "material" : plain;
}

void add(std::vector<GltfImage>& images, const Image* image, ImageUse use, const std::string& material) {
  if (!image || image->empty()) return;
  for (const GltfImage& known : images)
    if (known.image == image && known.use == use) return;
  GltfImage entry;
  entry.image = image;
  entry.use = use;
  entry.format = use == ImageUse::cut_out && image->channels == 4 ? ImageFormat::png : ImageFormat::jpeg;
  const std::string base = plain_name(material) + (use == ImageUse::normal ? "-normal" : "-colour");
  entry.name = base;
  const auto taken = [&] {
    return std::any_of(images.begin(), images.end(), [&](const GltfImage& i) { return i.name == entry.name; });
  };
  for (int k = 2; taken(); ++k) entry.name = fmt::format("{}-{}", base, k);
  images.push_back(std::move(entry));
}

// Grey becomes colour: some readers take a grey JPEG for an alpha or data texture.
Image as_colour(const Image& grey) {
  Image out(grey.width, grey.height, 3);
  for (std::size_t i = 0; i < grey.pixels.size(); ++i)
    std::fill_n(out.pixels.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, grey.pixels[i]);
  return out;
}

Bytes encode(const GltfImage& entry) {
  if (entry.format == ImageFormat::png) return encode_png(*entry.image);
  const Chroma chroma = entry.use == ImageUse::normal ? Chroma::full : Chroma::half;
  return entry.image->channels == 1 ? encode_jpeg(as_colour(*entry.image), chroma) : encode_jpeg(*entry.image, chroma);
}

}  // namespace

std::vector<GltfImage> encode_images(const std::vector<scene::Material>& materials, std::span<const std::size_t> used,
                                     bool leaf_normal_maps, const TextureCache* cache) {
  std::vector<GltfImage> images;
  for (std::size_t m : used) {
    const scene::Material& material = materials[m];
    add(images, material.base_colour.get(), colour_use(material), material.name);
    if (uses_normal_map(material, leaf_normal_maps))
      add(images, material.normal.get(), ImageUse::normal, material.name);
  }
  parallel_for(images.size(), [&](std::size_t i) {
    GltfImage& entry = images[i];
    std::uint64_t key = 0;
    if (cache) {
      key = Hasher().add(content_key(*entry.image)).add(kEncoderVersion).add(static_cast<int>(entry.use)).digest();
      if (auto found = cache->find(key, entry.format)) {
        entry.bytes = *std::move(found);
        return;
      }
    }
    entry.bytes = encode(entry);
    if (cache) cache->store(key, entry.format, entry.bytes);
  });
  return images;
}

}  // namespace bosquet::exchange
