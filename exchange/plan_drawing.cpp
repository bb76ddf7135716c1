#include "exchange/plan_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "exchange/image_file.h"
#include "exchange/plan_ground.h"
#include "exchange/plan_sheet.h"
#include "exchange/plan_symbols.h"
#include "exchange/substitutes.h"
#include "growth/measure.h"

namespace bosquet::exchange {
namespace {

using scene::TreeStatus;

// A crown may overhang the site so far and still be drawn whole.
constexpr double kOverhang_m = 4.0;
// A trunk's dot is at least so wide, and a crown below this radius has no code beside its trunk.
constexpr double kLeastDot_mm = 0.6, kLabelledRadius_mm = 3.5;
constexpr float kCode_mm = 1.8f;
// BS 5837:2012, 4.6.1.
constexpr double kRootDiameters = 12.0, kMostRoots_m = 15.0;

constexpr Vec3 kInk(0.10f, 0.16f, 0.10f), kRemoved(0.75f, 0.20f, 0.15f), kProtected(0.80f, 0.45f, 0.05f);

/// One tree as the plan shows it.
struct Crown {
  const scene::Tree* tree = nullptr;
  std::size_t species = 0;
  std::string stands_for;  ///< the inventory's name, when it is drawn as another kind
  TreeStatus status = TreeStatus::proposed;
  DVec2 base{0.0};
  double trunk_m = 0;
  CrownOutline outline;
  bool clipped() const { return tree && tree->form.clipped(); }
};

struct Style {
  PlanPen pen;
  float fill = 0.0f;
};

Style style_of(TreeStatus status) {
  switch (status) {
    case TreeStatus::existing:
      return {{0.35f, kInk, Dashes::none}, 0.75f};
    case TreeStatus::to_remove:
      return {{0.25f, kRemoved, Dashes::dashed}, 0.0f};
    case TreeStatus::to_protect:
      return {{0.45f, kInk, Dashes::none}, 0.75f};
    case TreeStatus::proposed:
      break;
  }
  return {{0.18f, kInk, Dashes::none}, 0.40f};
}

constexpr std::string_view kStatusLabels[] = {"Proposed", "Existing", "To be removed", "Protected, with its roots"};
constexpr std::string_view kStatusLayers[] = {"PROPOSED", "EXISTING", "REMOVE", "PROTECTED"};
constexpr int kStatusColours[] = {3, 94, 1, 30};
constexpr TreeStatus kDrawn[] = {TreeStatus::to_remove, TreeStatus::existing, TreeStatus::to_protect,
                                 TreeStatus::proposed};

std::vector<Crown> crowns_of(const scene::GrownScene& grown) {
  std::vector<Crown> all;
  Substitutes substitutes(grown.given);
  const scene::Trees& trees = *grown.document.trees;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const scene::Tree& tree = trees[i];
    const scene::GrownTree& made = grown.trees[i];
    all.push_back({&tree, tree.species, substitutes.stands_for(tree), tree.status, DVec2(tree.at),
                   static_cast<double>(made.measures.trunk_diameter_m), crown_outline(*made.skeleton, made.season)});
  }
  for (const scene::Tree& tree : *grown.given.trees) {
    if (tree.status != TreeStatus::to_remove) continue;
    const crowns::RepresentativeShape& shape = grown.given.species_of(tree).shape;
    all.push_back({&tree, tree.species, substitutes.stands_for(tree), tree.status, DVec2(tree.at),
                   static_cast<double>(tree.trunk_diameter_m.value_or(tree.scale_width * shape.trunk_width_m)),
                   round_outline(static_cast<double>(tree.scale_width * shape.crown_width_m))});
  }
  for (const scene::HeroTree& hero : grown.document.heroes)
    all.push_back({nullptr,
                   hero.species,
                   {},
                   TreeStatus::existing,
                   DVec2(hero.at),
                   static_cast<double>(growth::measure(*hero.skeleton).trunk_diameter_m),
                   crown_outline(*hero.skeleton, -1)});
  return all;
}

/// The site, and crowns that overhang it.
std::pair<DVec2, DVec2> extent(const std::vector<Crown>& crowns, DVec2 size_m) {
  DVec2 low(0.0), high(size_m);
  for (const Crown& crown : crowns) {
    const double reach = *std::max_element(crown.outline.radius.begin(), crown.outline.radius.end());
    low = glm::min(low, crown.base + crown.outline.middle - reach);
    high = glm::max(high, crown.base + crown.outline.middle + reach);
  }
  return {glm::max(low, DVec2(-kOverhang_m)), glm::min(high, size_m + kOverhang_m)};
}

/// Letters, digits and hyphens alone.
std::string layer_word(const std::string& name) {
  std::string word;
  for (const char c : name)
    word += (c >= 'a' && c <= 'z')                             ? static_cast<char>(c - 'a' + 'A')
            : (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c
                                                               : '-';
  return word;
}

void draw_cross(PlanDrawing& plan, std::size_t layer, const Crown& crown, const PlanPen& pen) {
  const double half = 0.7 * crown.outline.mean();
  PlanPath cross;
  cross.closed = false;
  cross.pen = {pen.width_mm, pen.colour, Dashes::none};
  const DVec2 at = crown.base + crown.outline.middle;
  cross.lines = {{at + DVec2(-half, -half), at + DVec2(half, half)},
                 {at + DVec2(-half, half), at + DVec2(half, -half)}};
  plan.items.push_back({layer, std::move(cross)});
}

/// Crowns of one species and status: clipped ones joined, free ones each with its symbol.
void draw_crowns(PlanDrawing& plan, std::size_t layer, const std::vector<const Crown*>& crowns, const Style& style,
                 const SpeciesSymbol& symbol, double finest_mm = 1.0) {
  std::vector<std::vector<DVec2>> bodies;
  for (const Crown* crown : crowns) {
    if (!crown->clipped()) continue;
    bodies.push_back(form_outline(crown->tree->form));
    for (DVec2& p : bodies.back()) p += crown->base;
  }
  if (!bodies.empty()) {
    PlanPath path;
    path.lines = joined(bodies);
    path.pen = style.pen;
    path.fill = {style.fill, symbol.tint};
    plan.items.push_back({layer, std::move(path)});
  }
  for (const Crown* crown : crowns) {
    if (!crown->clipped()) {
      std::vector<std::vector<DVec2>> lines = symbol_lines(crown->outline, symbol, crown->base, plan.metres(finest_mm));
      PlanPath outline;
      outline.lines = {std::move(lines[0])};
      outline.pen = style.pen;
      outline.fill = {style.fill, symbol.tint};
      plan.items.push_back({layer, std::move(outline)});
      if (lines.size() > 1) {
        PlanPath inner;
        inner.closed = false;
        inner.lines.assign(std::make_move_iterator(lines.begin() + 1), std::make_move_iterator(lines.end()));
        inner.pen = {0.6f * style.pen.width_mm, style.pen.colour, style.pen.dashes};
        plan.items.push_back({layer, std::move(inner)});
      }
    }
    if (crown->status == TreeStatus::to_remove) draw_cross(plan, layer, *crown, style.pen);
    PlanCircle trunk;
    trunk.centre = crown->base;
    // Plants of a hedge stand so close that full dots would cover it.
    const double least = plan.metres(crown->clipped() && crown->tree->form.width_m < 1.5f ? 0.3 : kLeastDot_mm);
    trunk.radius_m = 0.5 * std::max(least, crown->trunk_m);
    trunk.pen.width_mm = 0.0f;
    trunk.fill = {1.0f, style.pen.colour};
    plan.items.push_back({layer, trunk});
  }
}

void draw_roots(PlanDrawing& plan, const std::vector<Crown>& crowns) {
  std::size_t layer = 0;
  for (const Crown& crown : crowns) {
    if (crown.status != TreeStatus::to_protect) continue;
    if (layer == 0) layer = add_layer(plan, "ROOT-PROTECTION", 30);
    PlanCircle roots;
    roots.centre = crown.base;
    roots.radius_m = std::min(kMostRoots_m, kRootDiameters * crown.trunk_m);
    roots.pen = {0.3f, kProtected, Dashes::dash_dot};
    plan.items.push_back({layer, roots});
  }
}

Result<void> draw_underlay(PlanDrawing& plan, const scene::Underlay& underlay) {
  if (underlay.file.empty()) return {};
  auto image = read_image(underlay.file);
  if (!image) return Error{fmt::format("[underlay]: {}", image.error().message)};
  PlanPicture picture;
  const double width = static_cast<double>(underlay.width_m);
  picture.low = underlay.south_west;
  picture.high = picture.low + DVec2(width, width * image->height / image->width);
  picture.image = std::make_shared<const Image>(std::move(*image));
  picture.opacity = underlay.opacity;
  plan.items.push_back({add_layer(plan, "UNDERLAY", 8), std::move(picture)});
  return {};
}

void draw_site_edge(PlanDrawing& plan, DVec2 size_m) {
  PlanPath edge;
  edge.lines = {{DVec2(0.0), {size_m.x, 0.0}, size_m, {0.0, size_m.y}}};
  edge.pen = {0.35f, Vec3(0.2f), Dashes::dash_dot};
  plan.items.push_back({add_layer(plan, "SITE-EDGE", 7), std::move(edge)});
}

/// A crown of 2.4 mm radius on paper, for the key.
std::vector<PlanItem> key_sample(const Style& style, const SpeciesSymbol& symbol, bool crossed) {
  PlanDrawing paper;
  paper.scale = 1000;  // a metre stands for a millimetre
  Crown crown;
  crown.outline = round_outline(5.4);
  crown.trunk_m = 0.6;
  crown.status = crossed ? TreeStatus::to_remove : TreeStatus::proposed;
  draw_crowns(paper, 0, {&crown}, style, symbol, 0.35);  // finer than on the plan: the pattern must be seen
  return paper.items;
}

std::vector<PlanItem> swatch(const PlanFill& fill) {
  PlanPath box;
  box.lines = {{{-2.5, -1.5}, {2.5, -1.5}, {2.5, 1.5}, {-2.5, 1.5}}};
  box.pen.width_mm = 0.13f;
  box.fill = fill;
  return {{0, box}};
}

std::vector<PlanItem> line_sample(const PlanPen& pen) {
  PlanPath line;
  line.closed = false;
  line.lines = {{{-2.5, 0.0}, {2.5, 0.0}}};
  line.pen = pen;
  return {{0, line}};
}

}  // namespace

Result<PlanDrawing> draw_plan(const scene::GrownScene& grown, const std::string& name) {
  const scene::Document& document = grown.document;
  const std::vector<Crown> crowns = crowns_of(grown);
  const DVec2 size_m(document.terrain->size_m());
  const auto [low, high] = extent(crowns, size_m);
  auto laid_out = lay_out(document.plan, low, high);
  if (!laid_out) return laid_out.error();
  PlanDrawing& plan = *laid_out;
  plan.south_west = document.place.south_west;
  plan.title = document.plan.title.empty() ? name : document.plan.title;

  const GroundKinds ground = draw_ground(plan, document);
  if (auto done = draw_underlay(plan, document.underlay); !done) return done.error();
  draw_site_edge(plan, size_m);
  draw_roots(plan, crowns);

  // Kinds in the order of their names: species by the botanical one, and what only is drawn as a species by its own.
  using Kind = std::tuple<std::string, std::size_t, bool>;  // name, species, whether it stands for another
  std::map<Kind, std::map<TreeStatus, std::vector<const Crown*>>> by_kind;
  std::vector<std::string> names;
  for (const Crown& crown : crowns) {
    const scene::Species& species = *document.species[crown.species];
    const std::string& own = species.botanical_name.empty() ? species.name : species.botanical_name;
    const bool other = !crown.stands_for.empty();
    by_kind[{other ? crown.stands_for : own, crown.species, other}][crown.status].push_back(&crown);
  }
  for (const auto& [kind, standing] : by_kind) names.push_back(std::get<0>(kind));
  const std::vector<std::string> codes = species_codes(names);

  std::vector<SpeciesSymbol> symbols;
  for (const auto& [kind, standing] : by_kind)
    symbols.push_back(species_symbol(*document.species[std::get<1>(kind)], symbols.size()));
  std::map<TreeStatus, std::size_t> totals;
  for (const TreeStatus status : kDrawn) {
    std::size_t place = 0;
    for (const auto& [kind, standing] : by_kind) {
      const std::size_t n = place++;
      const auto found = standing.find(status);
      if (found == standing.end()) continue;
      totals[status] += found->second.size();
      const auto s = static_cast<std::size_t>(status);
      const std::size_t layer =
          add_layer(plan, fmt::format("TREES-{}-{}", kStatusLayers[s], layer_word(names[n])), kStatusColours[s]);
      draw_crowns(plan, layer, found->second, style_of(status), symbols[n]);
    }
  }

  if (document.plan.labels) {
    const std::size_t layer = add_layer(plan, "TREES-CODES", 7);
    std::size_t place = 0;
    for (const auto& [kind, standing] : by_kind) {
      const std::string& code = codes[place++];
      for (const auto& [status, all] : standing)
        for (const Crown* crown : all) {
          if (crown->outline.mean() < plan.metres(kLabelledRadius_mm)) continue;
          const double beside = 0.5 * std::max(plan.metres(kLeastDot_mm), crown->trunk_m) + plan.metres(0.5);
          PlanText text{crown->base + DVec2(beside, 0.0), kCode_mm, code, PlanAlign::left, false, false, kInk};
          plan.items.push_back({layer, std::move(text)});
        }
    }
  }

  // The key.
  KeyPart trees{"Trees", {}}, status_part{"Status", {}}, site{"Site", {}};
  std::size_t place = 0;
  for (const auto& [kind, standing] : by_kind) {
    std::size_t count = 0;
    for (const auto& [status, all] : standing) count += all.size();
    const scene::Species& species = *document.species[std::get<1>(kind)];
    const std::string common = species.common_names.empty() ? std::string() : species.common_names.front();
    const std::string own = species.botanical_name.empty() ? species.name : species.botanical_name;
    trees.rows.push_back({key_sample(style_of(TreeStatus::proposed), symbols[place], false), codes[place], names[place],
                          std::get<2>(kind) ? "drawn as " + own : common, fmt::format("{}", count),
                          !std::get<2>(kind)});
    ++place;
  }
  for (const auto& [status, count] : totals) {
    const SpeciesSymbol plain{CrownPattern::plain, false, false, {0.6f, 0.72f, 0.5f}};
    std::vector<PlanItem> sample = key_sample(style_of(status), plain, status == TreeStatus::to_remove);
    if (status == TreeStatus::to_protect) {
      PlanCircle roots;
      roots.radius_m = 3.2;
      roots.pen = {0.3f, kProtected, Dashes::dash_dot};
      sample.push_back({0, roots});
    }
    status_part.rows.push_back({std::move(sample),
                                {},
                                std::string(kStatusLabels[static_cast<std::size_t>(status)]),
                                {},
                                fmt::format("{}", count)});
  }
  for (const terrain::AreaKind kind : ground.areas)
    site.rows.push_back({swatch(area_fill(kind)), {}, std::string(area_words(kind)), {}, {}});
  if (ground.water) site.rows.push_back({swatch(water_fill()), {}, "Water", {}, {}});
  const bool built = std::count(ground.areas.begin(), ground.areas.end(), terrain::AreaKind::building) > 0;
  if (ground.buildings && !built) site.rows.push_back({swatch(building_fill()), {}, "Building", {}, {}});
  if (ground.contours_m > 0)
    site.rows.push_back({line_sample({0.25f, {0.62f, 0.50f, 0.38f}, Dashes::none}),
                         {},
                         fmt::format("Contour lines, {:g} m", ground.contours_m),
                         {},
                         {}});
  site.rows.push_back({line_sample({0.35f, Vec3(0.2f), Dashes::dash_dot}), {}, "Edge of the site", {}, {}});

  std::vector<std::string> notes{fmt::format("Site {:g} x {:g} m", size_m.x, size_m.y)};
  if (plan.south_west != DVec2(0.0))
    notes.push_back(fmt::format("South-west corner {:.2f}, {:.2f}", plan.south_west.x, plan.south_west.y));
  furnish(plan, add_layer(plan, "SHEET", 7), document.plan, {trees, status_part, site}, notes);
  std::stable_sort(plan.items.begin(), plan.items.end(),
                   [](const PlanItem& a, const PlanItem& b) { return a.layer < b.layer; });
  return laid_out;
}

}  // namespace bosquet::exchange
