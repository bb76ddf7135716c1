#include "cli/gallery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

#include "cli/sheet.h"
#include "core/parallel.h"
#include "geometry/human_figure.h"
#include "growth/age.h"
#include "growth/grow.h"
#include "growth/radii.h"
#include "render/headless_context.h"
#include "render/renderer.h"
#include "scene/model_builder.h"

namespace bosquet::cli {
namespace {

constexpr std::size_t kRowTriangles = 6'000'000;
constexpr float kLeafMargin_m = 0.4f;  // beyond the wood, on each side
constexpr float kMiddle_m = 10.0f;     // of the strip of ground that a row stands on
constexpr float kFigureRoom_m = 1.4f;  // beside the first tree
// In hundredths of the sheet's width.
constexpr double kMostRow = 40.0, kLeastRow = 6.0;  // height of rows
constexpr double kLeastGap = 0.8, kMostGap = 6.0;   // between ages
constexpr double kLeastPairGap = 0.4;               // between a tree with leaves and without
constexpr double kLeastPair = 5.0;                  // room of an age, for its label
constexpr Vec3 kInk{0.13f}, kGrey{0.42f}, kGridColour{0.87f}, kGroundColour{0.35f};
constexpr Vec4 kFigureColour{0.035f, 0.035f, 0.04f, 1.0f};

// A species grown and measured at its ages.
struct Portrait {
  const scene::Species* species = nullptr;
  std::shared_ptr<const growth::Skeleton> skeleton;
  struct Stage {
    float age_years = 0;
    int season = 0;
    growth::Measures measures;
    float west_m = 0, east_m = 0;  ///< extent beside the foot
  };
  std::vector<Stage> stages;
  float height_m = 0;
};

// Ten years, about half way, and the last age the species' own table knows.
std::vector<float> ages_of(const scene::Species& species, const GalleryOptions& options) {
  if (!options.ages.empty()) return options.ages;
  const float last = species.sizes.empty() ? 100.0f : species.sizes.back().age_years;
  return {10.0f, last > 75.0f ? 50.0f : 30.0f, last};
}

Portrait grow_portrait(const scene::Species& species, const GalleryOptions& options, const Progress* progress) {
  Portrait portrait;
  portrait.species = &species;
  growth::GrowthInput input;
  input.parameters = &species.growth;
  input.max_height_m = species.shape.mature_height_m;
  input.detail = options.detail;
  input.seed = options.seed;
  input.key = kGalleryKey;
  auto skeleton = std::make_shared<const growth::Skeleton>(growth::grow(input, progress));
  for (float age : ages_of(species, options)) {
    Portrait::Stage stage;
    stage.age_years = age;
    const float height = growth::height_share_at_age(species.growth, age) * species.shape.mature_height_m;
    stage.season = growth::season_at_height(*skeleton, height);
    stage.measures = growth::measure(*skeleton, stage.season);
    for (std::size_t i = 0; i < skeleton->size(); ++i) {
      if (!skeleton->alive_at(i, stage.season)) continue;
      stage.west_m = std::min(stage.west_m, skeleton->distal[i].x);
      stage.east_m = std::max(stage.east_m, skeleton->distal[i].x);
    }
    stage.west_m -= kLeafMargin_m, stage.east_m += kLeafMargin_m;
    portrait.height_m = std::max(portrait.height_m, stage.measures.height_m + kLeafMargin_m);
    portrait.stages.push_back(stage);
  }
  portrait.skeleton = std::move(skeleton);
  return portrait;
}

struct Row {
  std::vector<const Portrait*> portraits;
  float height_m = 0;
  double scale = 0;  ///< pixels a metre
};

// Sizes of the sheet's parts, all by its width.
struct Page {
  explicit Page(int width_pixels) : width(width_pixels) {}
  double width;
  double unit() const { return width / 100.0; }
  double margin() const { return 2.2 * unit(); }
  double axis() const { return 2.6 * unit(); }  // room for the heights' numbers
  double inner() const { return width - 2.0 * margin() - axis(); }
  double name_size() const { return 1.15 * unit(); }
  double label_size() const { return 0.80 * unit(); }
  double small_size() const { return 0.66 * unit(); }
  double above() const { return 2.4 * unit(); }  // name over a row
  double below() const { return 3.4 * unit(); }  // ages under it
  double top() const { return 3.6 * unit(); }    // of the sheet
};

// Where one tree stands on the sheet.
struct Place {
  const Portrait* portrait;
  const Portrait::Stage* stage;
  bool leafed;
  double x;         ///< of its foot, pixels from the sheet's left
  double figure_x;  ///< where its species begins
};

// Room in pixels of the two pictures of an age, with a gap between; never less than their label needs.
double pair_width(const Portrait::Stage& s, double scale, const Page& page) {
  const double trees = 2.0 * scale * static_cast<double>(s.east_m - s.west_m) + kLeastPairGap * page.unit();
  return std::max(trees, kLeastPair * page.unit());
}

double figure_width(double scale) { return scale * static_cast<double>(kFigureRoom_m); }

// Gaps of a row, counted in gaps between two ages: a person and the pictures of one age stand nearer, species farther.
constexpr double kFigureGap = 0.3, kPairGap = 0.25, kSpeciesGap = 3.0;

double gaps_in(const Row& row) {
  double gaps = kSpeciesGap * static_cast<double>(row.portraits.size() - 1);
  for (const Portrait* p : row.portraits)
    gaps += kFigureGap - 1.0 + (1.0 + kPairGap) * static_cast<double>(p->stages.size());
  return gaps;
}

// Without the gaps.
double row_width(const Row& row, const Page& page) {
  double width = 0.0;
  for (const Portrait* p : row.portraits) {
    width += figure_width(row.scale);
    for (const Portrait::Stage& s : p->stages) width += pair_width(s, row.scale, page);
  }
  return width;
}

bool fits(const Row& row, const Page& page) {
  return row_width(row, page) + kLeastGap * page.unit() * gaps_in(row) <= page.inner();
}

// The tallest species first; rows `most_pixels` high, or less where one species alone would be too wide.
std::vector<Row> rows_of(const std::vector<const Portrait*>& order, const Page& page, double most_pixels) {
  std::vector<Row> rows;
  for (const Portrait* p : order) {
    if (!rows.empty()) {
      rows.back().portraits.push_back(p);
      if (fits(rows.back(), page)) continue;
      rows.back().portraits.pop_back();
    }
    rows.push_back({{p}, p->height_m, most_pixels / static_cast<double>(p->height_m)});
    while (!fits(rows.back(), page) && rows.back().scale > 0.1) rows.back().scale *= 0.99;
  }
  return rows;
}

double sheet_height(const std::vector<Row>& rows, const Page& page) {
  double height = page.top() + page.margin();
  for (const Row& row : rows) height += row.scale * static_cast<double>(row.height_m) + page.above() + page.below();
  return height;
}

// The highest rows that the sheet has room for; none when even the lowest are too many.
std::vector<Row> lay_out(const std::vector<Portrait>& portraits, const Page& page, double most_height) {
  std::vector<const Portrait*> order;
  for (const Portrait& p : portraits) order.push_back(&p);
  std::stable_sort(order.begin(), order.end(),
                   [](const Portrait* a, const Portrait* b) { return a->height_m > b->height_m; });
  for (double most = kMostRow; most >= kLeastRow; most -= 0.25) {
    std::vector<Row> rows = rows_of(order, page, most * page.unit());
    if (sheet_height(rows, page) <= most_height) return rows;
  }
  return {};
}

std::vector<Place> places_in(const Row& row, const Page& page) {
  // What the trees leave of the row goes between them.
  const double gap = std::min(kMostGap * page.unit(), (page.inner() - row_width(row, page)) / gaps_in(row));
  std::vector<Place> places;
  double x = page.margin() + page.axis();
  for (const Portrait* p : row.portraits) {
    const double figure_x = x;
    x += figure_width(row.scale) + kFigureGap * gap;
    for (const Portrait::Stage& s : p->stages) {
      const double pair = pair_width(s, row.scale, page) + kPairGap * gap;
      const double tree = row.scale * static_cast<double>(s.east_m - s.west_m);
      const double between = std::min(pair - 2.0 * tree, kLeastPairGap * page.unit() + kPairGap * gap);
      const double west = x + 0.5 * (pair - 2.0 * tree - between), foot = -row.scale * static_cast<double>(s.west_m);
      places.push_back({p, &s, true, west + foot, figure_x});
      places.push_back({p, &s, false, west + tree + between + foot, figure_x});
      x += pair + gap;
    }
    x += (kSpeciesGap - 1.0) * gap;
  }
  return places;
}

// A flat site with the row's trees along its middle, of one half: those with leaves or those without.
scene::GrownScene row_scene(const Row& row, const std::vector<Place>& places, bool leafed,
                            const GalleryOptions& options) {
  scene::GrownScene scene;
  scene::Document& document = scene.document;
  document.seed = options.seed;
  const auto width_m = static_cast<float>(options.width / row.scale);
  const auto lattice = terrain::make_lattice(Vec2(width_m, 2.0f * kMiddle_m), 2.0f);
  document.terrain = std::make_shared<const terrain::Terrain>(
      terrain::make_terrain(terrain::Heightfield(lattice ? *lattice : terrain::Lattice{})));
  std::vector<scene::Tree> trees;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    if (place.leafed != leafed) continue;
    const auto at = std::find(row.portraits.begin(), row.portraits.end(), place.portrait) - row.portraits.begin();
    while (document.species.size() <= static_cast<std::size_t>(at))
      document.species.push_back(
          std::make_shared<const scene::Species>(*row.portraits[document.species.size()]->species));
    scene::Tree tree;
    tree.id = static_cast<std::int32_t>(i + 1);
    tree.key = kGalleryKey;
    tree.species = static_cast<std::size_t>(at);
    tree.at = {static_cast<float>(place.x / row.scale), kMiddle_m};
    trees.push_back(tree);
    scene::GrownTree grown;
    grown.skeleton = place.portrait->skeleton;
    grown.season = place.stage->season;
    grown.measures = place.stage->measures;
    grown.age_years = place.stage->age_years;
    scene.trees.push_back(std::move(grown));
  }
  document.trees = std::make_shared<const scene::Trees>(std::move(trees));
  return scene;
}

// Both halves as one model, with a person before each species.
Result<scene::Model> row_model(const Row& row, const std::vector<Place>& places, const GalleryOptions& options,
                               const Progress* progress) {
  scene::Model model;
  for (const bool leafed : {true, false}) {
    const scene::ModelOptions how{leafed ? options.season : geometry::Season::bare, geometry::FoliageLevel::clusters,
                                  kRowTriangles / 2};
    if (progress && progress->cancelled()) return cannot_finish("cancelled; nothing was written");
    auto built = scene::build_model(row_scene(row, places, leafed, options), how, nullptr);
    if (!built) return built.error();
    const std::size_t first = model.materials.size();
    model.materials.insert(model.materials.end(), built->model.materials.begin(), built->model.materials.end());
    for (scene::Node& node : built->model.nodes) {
      if (!leafed) {
        // The ground is there already; leaves that winter leaves on are taken off.
        if (node.name.starts_with("ground")) continue;
        const auto species = static_cast<std::size_t>(
            std::find_if(row.portraits.begin(), row.portraits.end(),
                         [&](const Portrait* p) { return node.name.starts_with(p->species->name + "-"); }) -
            row.portraits.begin());
        if (species < row.portraits.size() && row.portraits[species]->species->look.leaf.evergreen)
          std::erase_if(node.parts, [&](const scene::Part& part) {
            return built->model.materials[part.material].surface == scene::Surface::leaf;
          });
      }
      for (scene::Part& part : node.parts) part.material += first;
      model.nodes.push_back(std::move(node));
    }
  }
  scene::Material ink;
  ink.name = "figure";
  ink.surface = scene::Surface::obstacle;
  ink.base_factor = kFigureColour;
  model.materials.push_back(std::move(ink));
  const auto figure = std::make_shared<const TriangleMesh>(geometry::human_figure());
  for (const Place& place : places) {
    if (!place.leafed || place.stage != &place.portrait->stages.front()) continue;
    scene::Node node;
    node.name = "figure";
    node.translation =
        to_world(Vec2(static_cast<float>(place.figure_x / row.scale) + 0.5f * kFigureRoom_m, kMiddle_m), 0.0f);
    node.parts.push_back({figure, model.materials.size() - 1});
    model.nodes.push_back(std::move(node));
  }
  // High from the front, a little from the left: modelled crowns, and no tree shades its neighbour.
  model.sun = {205.0f, 42.0f};
  return model;
}

// The row's elevation; the ground is the picture's lower edge.
render::View elevation(const Row& row, int width) {
  render::View view;
  view.width = width;
  view.height = static_cast<int>(std::ceil(row.scale * static_cast<double>(row.height_m)));
  view.orthographic_height_m = static_cast<float>(view.height / row.scale);
  const float x = static_cast<float>(0.5 * width / row.scale);
  const Vec3 target = Vec3(x, 0.5f * view.orthographic_height_m, -10.0f);
  view.camera.target = target;
  view.camera.eye = target + Vec3(0.0f, 0.0f, 300.0f);
  view.sky = false;
  view.background = Vec3(0.0f);
  view.supersample = 2;
  view.look.haze_distance_m = 1e6f;
  view.look.surroundings = false;
  return view;
}

std::string metres(float value) { return fmt::format("{:.{}f}", value, value < 9.95f ? 1 : 0); }

void draw_scale(Sheet& sheet, const Page& page, const Row& row, double ground_y) {
  const int step = row.height_m > 12.0f ? 5 : row.height_m > 6.0f ? 2 : 1;
  const double left = page.margin() + page.axis(), right = page.width - page.margin();
  for (int h = step; static_cast<float>(h) <= row.height_m; h += step) {
    const double y = ground_y - row.scale * h;
    sheet.line(left, y, right, y, 0.04 * page.unit(), kGridColour);
    sheet.text(left - 0.5 * page.unit(), y + 0.35 * page.small_size(), fmt::format("{} m", h),
               {page.small_size(), Align::right, false, false, kGrey});
  }
}

void draw_labels(Sheet& sheet, const Page& page, const Row& row, const std::vector<Place>& places, double ground_y) {
  const auto side = [&](const Place& place, float x_m) { return place.x + row.scale * static_cast<double>(x_m); };
  // The line's upper edge is the ground.
  sheet.box(page.margin() + page.axis(), ground_y, page.inner(), std::max(1.0, 0.10 * page.unit()), kGroundColour);
  const double name_y = ground_y - row.scale * static_cast<double>(row.height_m) - 0.9 * page.unit();
  double free_from = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    const scene::Species& species = *place.portrait->species;
    if (place.leafed && place.stage == &place.portrait->stages.front()) {
      const double x = std::max(free_from, place.figure_x);
      std::string name = species.common_names.empty() ? species.name : species.common_names.front();
      name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
      const double width = sheet.text(x, name_y, name, {page.name_size(), Align::left, true, false, kInk});
      const double botanical = sheet.text(x + width + 0.6 * page.unit(), name_y, species.botanical_name,
                                          {page.name_size(), Align::left, false, true, kGrey});
      free_from = x + width + botanical + 2.0 * page.unit();
    }
    if (!place.leafed) continue;
    // One label for both pictures of an age.
    const Portrait::Stage& s = *place.stage;
    const double west = side(place, s.west_m), east = side(places[i + 1], s.east_m);
    const double middle = 0.5 * (west + east), y = ground_y + 1.35 * page.unit();
    sheet.line(west, ground_y + 0.45 * page.unit(), east, ground_y + 0.45 * page.unit(), 0.05 * page.unit(), kGrey);
    sheet.text(middle, y, fmt::format("{:.0f} years", s.age_years),
               {page.label_size(), Align::centre, false, false, kInk});
    sheet.text(middle, y + 1.0 * page.unit(),
               fmt::format("{} \u00d7 {} m", metres(s.measures.height_m), metres(s.measures.crown_diameter_m)),
               {page.small_size(), Align::centre, false, false, kGrey});
  }
}

}  // namespace

Result<Image> draw_gallery(const std::vector<scene::Species>& species, const GalleryOptions& options,
                           Progress* progress) {
  if (progress) progress->begin("trees", species.size());
  std::vector<Portrait> portraits(species.size());
  parallel_for(species.size(), [&](std::size_t i) {
    portraits[i] = grow_portrait(species[i], options, progress);
    if (progress) progress->advance();
  });
  const auto cancelled = [&] { return progress && progress->cancelled(); };
  if (cancelled()) return cannot_finish("cancelled; nothing was written");

  const Page page(options.width);
  const std::vector<Row> rows = lay_out(portraits, page, options.height);
  if (rows.empty())
    return Error{fmt::format("{} species do not fit on {} x {} pixels; give --size a larger height", species.size(),
                             options.width, options.height)};
  auto sheet = Sheet::create(options.width, static_cast<int>(std::ceil(sheet_height(rows, page))));
  if (!sheet) return sheet.error();
  sheet->text(
      page.margin(), 2.0 * page.unit(),
      "Free-standing trees with and without leaves, height \u00d7 crown. Each row has its own scale: lines tell "
      "heights, the person is 1.75 m tall.",
      {page.label_size(), Align::left, false, false, kGrey});

  auto context = render::HeadlessContext::create();
  if (!context) return context.error();
  auto renderer = render::Renderer::create();
  if (!renderer) return renderer.error();

  if (progress) progress->begin("pictures", rows.size());
  double y = page.top();
  for (const Row& row : rows) {
    const std::vector<Place> places = places_in(row, page);
    auto model = row_model(row, places, options, progress);
    if (!model) return model.error();
    if (auto uploaded = renderer->upload(*model); !uploaded) return uploaded.error();
    auto drawn = renderer->draw(elevation(row, options.width));
    if (!drawn) return drawn.error();
    if (cancelled()) return cannot_finish("cancelled; nothing was written");
    const double ground_y = std::round(y + page.above() + row.scale * static_cast<double>(row.height_m));
    draw_scale(*sheet, page, row, ground_y);
    sheet->picture(0, ground_y - drawn->height, *drawn);
    draw_labels(*sheet, page, row, places, ground_y);
    y = ground_y + page.below();
    if (progress) progress->advance();
  }
  return sheet->image();
}

}  // namespace bosquet::cli
