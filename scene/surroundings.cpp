#include "scene/surroundings.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/stopwatch.h"
#include "crowns/asymmetry.h"
#include "crowns/update_space.h"
#include "terrain/difference.h"

namespace bosquet::scene {
namespace {

// However high the clear stem is ordered, some crown is left above it.
constexpr float kHighestCrownBase = 0.9f;

// When most of the ground was reshaped, and it is more than this, all is divided at once.
constexpr std::size_t kFewTiles = 9;

bool shaded(const Document& document, const SpaceStages& stages) {
  return stages.light && stages.regions && document.light.canopy_light;
}

}  // namespace

TreeSurroundings Surroundings::of(std::size_t i) const {
  return {stages.regions ? &space : nullptr, light.size() > 0 ? &light : nullptr, i, asymmetry[i]};
}

std::vector<crowns::Claimant> claimants(const Document& document) {
  std::vector<crowns::Claimant> claims;
  claims.reserve(document.trees->size());
  for (const Tree& tree : *document.trees) {
    crowns::RepresentativeShape shape = document.species_of(tree).shape;
    // The crown, and with it the foliage that shades others, begins at the clear stem.
    if (tree.clear_stem_m > 0.0f || tree.form.clipped())
      shape.trunk_height_m =
          std::min(std::max(tree.form.clipped() ? 0.0f : shape.trunk_height_m, tree.clear_stem_m / tree.scale_height),
                   kHighestCrownBase * shape.mature_height_m);
    claims.push_back({tree.key, tree.id, tree.at, document.terrain->ground(tree.at), shape, tree.scale_height,
                      tree.scale_width, !tree.form.clipped()});
  }
  return claims;
}

Result<Surroundings> surround(const Document& document, const SpaceStages& stages, StandingKeeper& standing,
                              std::vector<std::string>& warnings, Seconds* seconds, Progress* progress) {
  const Error cancelled = cannot_finish("cancelled; nothing was written");
  Surroundings out;
  out.stages = stages;
  out.asymmetry.assign(document.trees->size(), Vec3(0.0f));
  Stopwatch watch;
  if (stages.regions || stages.asymmetry) {
    if (progress) progress->begin("crown regions", 0);
    auto there = standing.of(document, warnings);
    if (!there) return there.error();
    auto space = crowns::divide_space(claimants(document), *there, *document.terrain, document.space, progress);
    if (!space) return space.error();
    out.space = std::move(*space);
    if (stages.asymmetry)
      out.asymmetry = crowns::neighbourhood_asymmetry(out.space, document.asymmetry, document.terrain.get());
    for (std::string& warning : space_warnings(out.space, document)) warnings.push_back(std::move(warning));
  }
  if (seconds) (*seconds)["crowns"] = watch.restart();
  if (progress && progress->cancelled()) return cancelled;
  if (shaded(document, stages)) out.light = crowns::canopy_light(out.space, document.light, progress);
  if (seconds) (*seconds)["light"] = watch.restart();
  if (progress && progress->cancelled()) return cancelled;
  return out;
}

Result<SurroundingsUpdate> update_surroundings(const Surroundings& around, const Document& before,
                                               const Document& document, StandingKeeper& standing,
                                               std::vector<std::string>& warnings, Progress* progress) {
  const SpaceStages& stages = around.stages;
  SurroundingsUpdate out;
  const auto all = [&] {
    out.touched.resize(document.trees->size());
    std::iota(out.touched.begin(), out.touched.end(), std::size_t{0});
  };
  crowns::Reshaped ground;
  const bool same_site = before.terrain->height.lattice() == document.terrain->height.lattice();
  if (same_site && before.terrain != document.terrain)
    ground.where = terrain::reshaped(before.terrain->height, document.terrain->height);
  if (!ground.where.empty()) ground.before = before.terrain.get();
  const IVec2 tiles = document.terrain->height.grid().tiles();
  const bool most =
      2 * ground.where.size() > static_cast<std::size_t>(tiles.x * tiles.y) && ground.where.size() > kFewTiles;
  if (!same_site || most || !stages.regions) {
    auto whole = surround(document, stages, standing, warnings, nullptr, progress);
    if (!whole) return whole.error();
    out.now = std::move(*whole);
    all();
    return out;
  }

  auto there = standing.of(document, warnings);
  if (!there) return there.error();
  auto update =
      crowns::update_space(around.space, claimants(document), *there, *document.terrain, document.space, ground);
  if (!update) return update.error();
  if (progress && progress->cancelled()) return cannot_finish("cancelled");
  const terrain::Terrain* terrain = document.terrain.get();
  out.now.stages = stages;
  std::vector<std::size_t> pressed, shaded_anew;
  if (!stages.asymmetry) {
    out.now.asymmetry.assign(document.trees->size(), Vec3(0.0f));
  } else if (update->whole || before.asymmetry != document.asymmetry) {
    out.now.asymmetry = crowns::neighbourhood_asymmetry(update->space, document.asymmetry, terrain);
    all();
  } else {
    out.now.asymmetry =
        crowns::update_asymmetry(around.space, around.asymmetry, *update, document.asymmetry, terrain, &pressed);
  }
  if (shaded(document, stages)) {
    if (update->whole || !shaded(before, stages) || before.light != document.light) {
      out.now.light = crowns::canopy_light(update->space, document.light, progress);
      all();
    } else {
      crowns::LightUpdate light = crowns::update_canopy_light(around.light, update->space, update->changed);
      out.now.light = std::move(light.light);
      shaded_anew = std::move(light.changed);
    }
  } else if (shaded(before, stages)) {
    all();
  }
  for (std::string& warning : space_warnings(update->space, document)) warnings.push_back(std::move(warning));
  out.now.space = std::move(update->space);
  for (const std::vector<std::size_t>* more :
       {&std::as_const(update->changed), &std::as_const(pressed), &std::as_const(shaded_anew)})
    out.touched.insert(out.touched.end(), more->begin(), more->end());
  std::sort(out.touched.begin(), out.touched.end());
  out.touched.erase(std::unique(out.touched.begin(), out.touched.end()), out.touched.end());
  return out;
}

}  // namespace bosquet::scene
