#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/grown.h"
#include "exchange/file_output.h"
#include "exchange/gltf_check.h"
#include "exchange/gltf_info.h"

namespace bosquet::cli {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const scene::Extras& extras) {
  Json json = Json::object();
  for (const auto& [name, value] : extras) std::visit([&, key = name](const auto& v) { json[key] = v; }, value);
  return json;
}

std::optional<double> number(const scene::Extras& extras, std::string_view name) {
  for (const auto& [key, value] : extras)
    if (key == name && std::holds_alternative<double>(value)) return std::get<double>(value);
  return {};
}

std::string text(const scene::Extras& extras, std::string_view name) {
  for (const auto& [key, value] : extras)
    if (key == name && std::holds_alternative<std::string>(value)) return std::get<std::string>(value);
  return {};
}

Json gltf_json(const exchange::GltfInfo& info) {
  Json json;
  json["generator"] = info.generator;
  json["bytes"] = info.file_bytes;
  json["triangles"] = info.triangles;
  json["vertices"] = info.vertices;
  json["meshes"] = info.meshes;
  json["wind_meshes"] = info.wind_meshes;
  json["materials"] = info.materials;
  json["images"] = info.images;
  json["cameras"] = info.cameras;
  json["extensions_used"] = info.extensions_used;
  json["extensions_required"] = info.extensions_required;
  json["scene"] = json_of(info.extras);
  json["nodes"] = Json::array();
  for (const exchange::GltfNode& node : info.nodes)
    json["nodes"].push_back({{"name", node.name}, {"triangles", node.triangles}, {"extras", json_of(node.extras)}});
  return json;
}

void print_gltf(const exchange::GltfInfo& info, const std::string& file) {
  fmt::print("{}: glTF 2.0 by {}, {:.1f} MB\n", file, info.generator.empty() ? "unknown" : info.generator,
             static_cast<double>(info.file_bytes) / 1e6);
  fmt::print("{} triangles, {} vertices, {} meshes, {} materials, {} images, {} camera{}\n", info.triangles,
             info.vertices, info.meshes, info.materials, info.images, info.cameras, info.cameras == 1 ? "" : "s");
  if (info.wind_meshes > 0) fmt::print("wind weights (_WIND) on {} of the meshes\n", info.wind_meshes);
  if (auto east = number(info.extras, "site_east_m"), north = number(info.extras, "site_north_m"); east && north)
    fmt::print("site {:g} x {:g} m\n", *east, *north);

  std::map<std::string, std::size_t> count;
  for (const exchange::GltfNode& node : info.nodes)
    if (number(node.extras, "height_m")) ++count[text(node.extras, "species")];
  for (const auto& [species, n] : count) fmt::print("{} {}\n", n, species);
  if (count.empty()) return;
  fmt::print("\n{:<24} {:<22} {:>9} {:>9} {:>9} {:>9} {:>10}\n", "name", "species", "height m", "trunk cm", "crown m",
             "age", "triangles");
  for (const exchange::GltfNode& node : info.nodes) {
    const auto height = number(node.extras, "height_m");
    if (!height) continue;
    fmt::print("{:<24} {:<22} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.0f} {:>10}\n", node.name,
               text(node.extras, "botanical_name"), *height,
               100.0 * number(node.extras, "trunk_diameter_m").value_or(0.0),
               number(node.extras, "crown_diameter_m").value_or(0.0), number(node.extras, "age_years").value_or(0.0),
               node.triangles);
  }
}

std::string faults_text(const exchange::GltfCheck& check, const std::string& file) {
  const std::size_t n = check.faults.size() + check.more_faults;
  std::string text = fmt::format("{}: {} fault{}", file, n, n == 1 ? "" : "s");
  for (const std::string& fault : check.faults) text += "\n  " + fault;
  if (check.more_faults > 0) text += fmt::format("\n  and {} more", check.more_faults);
  return text;
}

// A recipe or a project, without growing it.
Result<void> document_info(const Options& options) {
  const bool project = exchange::lower_ending(options.file) == ".bosquet";
  Report report;
  Progress progress;
  auto document = load_document(options, report, progress);
  if (!document) return document.error();
  std::map<std::string, std::size_t> count;
  for (const scene::Tree& tree : *document->trees) ++count[document->species_of(tree).name];
  const Vec2 size = document->terrain->size_m();
  if (options.json) {
    Json json;
    json["site_m"] = {size.x, size.y};
    json["seed"] = document->seed;
    json["trees"] = document->trees->size();
    json["species"] = count;
    json["obstacles"] = document->obstacles.size();
    json["hero_trees"] = document->heroes.size();
    json["warnings"] = report.warnings;
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
    return {};
  }
  fmt::print("{}: {}, site {:g} x {:g} m, {}\n", options.file.string(), project ? "project" : "recipe", size.x, size.y,
             count_of(document->trees->size(), "tree"));
  for (const auto& [name, n] : count) fmt::print("{} {}\n", n, name);
  for (const std::string& warning : report.warnings) fmt::print(stderr, "warning: {}\n", warning);
  return {};
}

}  // namespace

Result<void> run_info(const Options& options) {
  const std::string ending = exchange::lower_ending(options.file);
  if (ending == ".toml" || ending == ".bosquet") {
    if (options.check) return Error{fmt::format("{}: --check judges .glb and .gltf", options.file.string())};
    return document_info(options);
  }
  if (ending != ".glb" && ending != ".gltf")
    return Error{
        fmt::format("{}: info reads .glb, .gltf, projects (.bosquet) and recipes (.toml)", options.file.string())};
  auto info = exchange::read_gltf_info(options.file);
  if (!info) return info.error();
  exchange::GltfCheck check;
  if (options.check) {
    auto checked = exchange::check_gltf(options.file);
    if (!checked) return checked.error();
    check = *std::move(checked);
  }
  if (options.json) {
    Json json = gltf_json(*info);
    if (options.check) json["faults"] = check.faults;
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    print_gltf(*info, options.file.string());
  }
  if (!options.check) return {};
  if (!check.good()) return Error{faults_text(check, options.file.string())};
  if (!options.json)
    fmt::print("\nchecked: {} accessors, {} packed views, {} instances, {} nodes with MSFT_lod; no faults\n",
               check.accessors, check.packed_views, check.instances, check.nodes_with_levels);
  return {};
}

}  // namespace bosquet::cli
