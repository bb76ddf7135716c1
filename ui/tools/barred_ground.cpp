#include "ui/tools/barred_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "ui/tools/tool.h"

namespace bosquet::ui {
namespace {

std::string name_of(const terrain::Area& area) {
  const std::string_view kind = terrain::kAreaKindNames[static_cast<std::size_t>(area.kind)];
  if (!area.name.empty() && area.name != kind) return fmt::format("'{}'", area.name);
  return area.kind == terrain::AreaKind::other ? "this ground" : fmt::format("the {}", kind);
}

}  // namespace

std::string with_what_bars(std::string message, const scene::Document& document, std::span<const Vec2> places) {
  const terrain::Terrain& ground = *document.terrain;
  std::size_t on_site = 0, barred = 0;
  std::map<std::string, std::size_t> by;
  for (const Vec2 at : places) {
    if (!terrain::on_site(ground, at)) continue;
    ++on_site;
    // What stands or flows there is not freed by letting plant.
    const terrain::Area* area = ground.excluded(at) ? ground.area_at(at) : nullptr;
    if (!area || area->kind == terrain::AreaKind::water || area->kind == terrain::AreaKind::building) continue;
    ++barred, ++by[name_of(*area)];
  }
  if (barred == 0 || 2 * barred < on_site) return message;
  const auto most =
      std::max_element(by.begin(), by.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const ToolInfo& cure = tool_info(ToolKind::include);
  return fmt::format("{}; {} is kept free of trees, the tool {} ({}) frees it", message, most->first, cure.name,
                     static_cast<char>(cure.key));
}

}  // namespace bosquet::ui
