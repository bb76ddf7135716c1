#include "cli/gallery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

#include "cli/human_figure.h"
#include "cli/sheet.h"
#include "core/parallel.h"
#include "growth/age.h"
#include "growth/grow.h"
#include "growth/radii.h"
#include "render/headless_context.h"
#include "render/renderer.h"
#include "scene/model_builder.h"

namespace bosquet::cli {
namespace {

constexpr std::size_t kRowTriangles = 6'000'000;
constexpr float kLeafMargin_m = 0.4f;                             // beyond the wood, on each side
constexpr float kGapOfHeight = 0.04f;                             // between trees, of the row's tallest
constexpr float kFigureRoom_m = 1.4f;                             // beside the first tree
constexpr double kMostRowOfWidth = 0.4, kLeastRowOfWidth = 0.06;  // height of rows, of the sheet's width
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

  float width_m() const {
    float sum = 0.0f;
    for (const Stage& s : stages) sum += 2.0f * (s.east_m - s.west_m);
    return sum + kFigureRoom_m;
  }
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

// Where one tree stands in a row.
struct Place {
  const Portrait* portrait;
  const Portrait::Stage* stage;
  bool leafed;
  float x_m;  ///< of its foot
};

struct Row {
  std::vector<const Portrait*> portraits;
  float height_m = 0, width_m = 0;  ///< width with the gaps
  double scale = 0;                 ///< pixels a metre

  float gap_m() const { return kGapOfHeight * height_m; }
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

void measure_row(Row& row, const Page& page, double most_pixels) {
  row.height_m = row.width_m = 0.0f;
  for (const Portrait* p : row.portraits) row.height_m = std::max(row.height_m, p->height_m);
  std::size_t gaps = 0;
  for (const Portrait* p : row.portraits) row.width_m += p->width_m(), gaps += 2 * p->stages.size() + 1;
  row.width_m += row.gap_m() * static_cast<float>(gaps - 1);
  row.scale =
      std::min(page.inner() / static_cast<double>(row.width_m), most_pixels / static_cast<double>(row.height_m));
}

double sheet_height(const std::vector<Row>& rows, const Page& page) {
  double height = page.top() + page.margin();
  for (const Row& row : rows) height += row.scale * static_cast<double>(row.height_m) + page.above() + page.below();
  return height;
}

// The tallest species first, `together` in a row, rows at most `most_pixels` high.
std::vector<Row> rows_of(const std::vector<const Portrait*>& order, const Page& page, std::size_t together,
                         double most_pixels) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < order.size(); i += together) {
    Row row;
    for (std::size_t k = i; k < std::min(i + together, order.size()); ++k) row.portraits.push_back(order[k]);
    measure_row(row, page, most_pixels);
    rows.push_back(std::move(row));
  }
  return rows;
}

// Of all layouts that fit, the one whose smallest trees are drawn largest; none when nothing fits.
std::vector<Row> lay_out(const std::vector<Portrait>& portraits, const Page& page, double most_height) {
  std::vector<const Portrait*> order;
  for (const Portrait& p : portraits) order.push_back(&p);
  std::stable_sort(order.begin(), order.end(),
                   [](const Portrait* a, const Portrait* b) { return a->height_m > b->height_m; });
  std::vector<Row> best;
  double best_pixels = 0.0;
  for (std::size_t together = 1; together <= order.size(); ++together)
    for (double most = kMostRowOfWidth; most >= kLeastRowOfWidth; most -= 0.005) {
      std::vector<Row> rows = rows_of(order, page, together, most * page.width);
      if (sheet_height(rows, page) > most_height) continue;
      double least = most_height;
      for (const Row& row : rows) least = std::min(least, row.scale * static_cast<double>(row.height_m));
      if (least > best_pixels) best_pixels = least, best = std::move(rows);
      break;
    }
  return best;
}

std::vector<Place> places_in(const Row& row) {
  std::vector<Place> places;
  float x = 0.0f;
  for (const Portrait* p : row.portraits) {
    x += kFigureRoom_m + row.gap_m();
    for (const Portrait::Stage& s : p->stages)
      for (const bool leafed : {true, false}) {
        places.push_back({p, &s, leafed, x - s.west_m});
        x += s.east_m - s.west_m + row.gap_m();
      }
  }
  return places;
}

// A flat site with the row's trees along its middle, of one half: those with leaves or those without.
scene::GrownScene row_scene(const Row& row, const std::vector<Place>& places, bool leafed, std::uint64_t seed) {
  scene::GrownScene scene;
  scene::Document& document = scene.document;
  document.seed = seed;
  const auto lattice = terrain::make_lattice(Vec2(row.width_m + 4.0f, 20.0f), 2.0f);
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
    tree.at = {place.x_m, 10.0f};
    trees.push_back(tree);
    scene::GrownTree grown;
    grown.skeleton = place.portrait->skeleton;
    grown.season = place.stage->season;
    grown.measures = place.stage->measures;
    grown.age_years = place.stage->age_years;
    scene.trees.push_back(std::move(grown));
  }
  document.trees = std::make_shared<const std::vector<scene::Tree>>(std::move(trees));
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
    auto built = scene::build_model(row_scene(row, places, leafed, options.seed), how, nullptr);
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
  const auto figure = std::make_shared<const TriangleMesh>(human_figure());
  for (const Place& place : places) {
    if (!place.leafed || place.stage != &place.portrait->stages.front()) continue;
    scene::Node node;
    node.name = "figure";
    const float west = place.x_m + place.stage->west_m - 0.5f * row.gap_m();
    node.translation = to_world(Vec2(west - 0.5f * kFigureRoom_m, 10.0f), 0.0f);
    node.parts.push_back({figure, model.materials.size() - 1});
    model.nodes.push_back(std::move(node));
  }
  // High from the front, a little from the left: modelled crowns, and no tree shades its neighbour.
  model.sun = {205.0f, 42.0f};
  return model;
}

// The row's elevation; the ground is the picture's lower edge.
render::View elevation(const Row& row, double scale, double left_pixels, int width) {
  render::View view;
  view.width = width;
  view.height = static_cast<int>(std::ceil(scale * static_cast<double>(row.height_m)));
  view.orthographic_height_m = static_cast<float>(view.height / scale);
  const float x = static_cast<float>((0.5 * width - left_pixels) / scale);
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

std::string metres(double value) { return fmt::format("{:.{}f} m", value, value < 9.95 ? 1 : 0); }

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

void draw_labels(Sheet& sheet, const Page& page, const Row& row, const std::vector<Place>& places, double left,
                 double ground_y) {
  const auto x_of = [&](float x_m) { return left + row.scale * static_cast<double>(x_m); };
  // The line's upper edge is the ground.
  sheet.box(page.margin() + page.axis(), ground_y, page.inner(), std::max(1.0, 0.10 * page.unit()), kGroundColour);
  const double name_y = ground_y - row.scale * static_cast<double>(row.height_m) - 0.9 * page.unit();
  double free_from = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    const scene::Species& species = *place.portrait->species;
    if (place.leafed && place.stage == &place.portrait->stages.front()) {
      const double x = std::max(free_from, x_of(place.x_m + place.stage->west_m - row.gap_m() - kFigureRoom_m));
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
    const double west = x_of(place.x_m + s.west_m), east = x_of(places[i + 1].x_m + s.east_m);
    const double middle = 0.5 * (west + east), y = ground_y + 1.35 * page.unit();
    sheet.line(west, ground_y + 0.45 * page.unit(), east, ground_y + 0.45 * page.unit(), 0.05 * page.unit(), kGrey);
    sheet.text(middle, y, fmt::format("{:.0f} years", s.age_years),
               {page.label_size(), Align::centre, false, false, kInk});
    const std::string sizes = fmt::format("{}, crown {}", metres(static_cast<double>(s.measures.height_m)),
                                          metres(static_cast<double>(s.measures.crown_diameter_m)));
    const Lettering small{page.small_size(), Align::centre, false, false, kGrey};
    if (sheet.text_width(sizes, small) < east - west + 1.5 * page.unit())
      sheet.text(middle, y + 1.0 * page.unit(), sizes, small);
    else
      sheet.text(middle, y + 1.0 * page.unit(), metres(static_cast<double>(s.measures.height_m)), small);
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
  sheet->text(page.margin(), 2.0 * page.unit(),
              "Free-standing trees, with and without leaves. Each row has its own scale: lines tell heights, the "
              "person is 1.75 m tall.",
              {page.label_size(), Align::left, false, false, kGrey});

  auto context = render::HeadlessContext::create();
  if (!context) return context.error();
  auto renderer = render::Renderer::create();
  if (!renderer) return renderer.error();

  if (progress) progress->begin("pictures", rows.size());
  double y = page.top();
  for (const Row& row : rows) {
    const std::vector<Place> places = places_in(row);
    auto model = row_model(row, places, options, progress);
    if (!model) return model.error();
    if (auto uploaded = renderer->upload(*model); !uploaded) return uploaded.error();
    const double left =
        page.margin() + page.axis() + 0.5 * (page.inner() - row.scale * static_cast<double>(row.width_m));
    auto drawn = renderer->draw(elevation(row, row.scale, left, options.width));
    if (!drawn) return drawn.error();
    if (cancelled()) return cannot_finish("cancelled; nothing was written");
    const double ground_y = std::round(y + page.above() + row.scale * static_cast<double>(row.height_m));
    draw_scale(*sheet, page, row, ground_y);
    sheet->picture(0, ground_y - drawn->height, *drawn);
    draw_labels(*sheet, page, row, places, left, ground_y);
    y = ground_y + page.below();
    if (progress) progress->advance();
  }
  return sheet->image();
}

}  // namespace bosquet::cli
