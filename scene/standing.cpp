#include "scene/standing.h"

#include <fmt/format.h>

#include <map>

namespace bosquet::scene {
namespace {

// What stands farther from the site cannot touch a crown of it.
constexpr float kMargin_m = 64.0f;
// A list this long says as much as a longer one.
constexpr std::size_t kListed = 8;

std::string name_of(const Document& document, std::int32_t id) {
  for (const Obstacle& o : document.obstacles)
    if (o.id == id) return fmt::format("obstacle '{}'", o.name);
  for (const HeroTree& h : document.heroes)
    if (h.id == id) return fmt::format("hero tree '{}'", h.name);
  return fmt::format("id {}", id);
}

}  // namespace

Result<crowns::Standing> standing(const Document& document, std::vector<std::string>& warnings) {
  return StandingKeeper().of(document, warnings);
}

Result<crowns::Standing> StandingKeeper::of(const Document& document, std::vector<std::string>& warnings) {
  crowns::Standing out;
  const crowns::VoxelSize size = document.space.voxel();
  const Vec2 site = document.terrain->size_m();
  const Box2 near{Vec2(-kMargin_m), site + kMargin_m};
  decltype(obstacles_) obstacles;
  for (const Obstacle& o : document.obstacles) {
    const ObstacleKey key{o.mesh.get(), o.outline.get(), o.low_y, o.high_y, size.voxel_m, size.layer_m, site.x, site.y};
    std::shared_ptr<const crowns::ObstacleVolume> volume;
    if (const auto kept = obstacles_.find(key); kept != obstacles_.end()) volume = kept->second.volume;
    if (!volume) {
      crowns::ObstacleVolume made;
      if (o.outline) {
        made = crowns::extrude(*o.outline, o.low_y, o.high_y, size, near);
      } else {
        auto voxels = crowns::voxelise(*o.mesh, size, near);
        if (!voxels)
          return Error{fmt::format("obstacle '{}': {}", o.name, voxels.error().message), voxels.error().kind};
        made = std::move(*voxels);
      }
      volume = std::make_shared<const crowns::ObstacleVolume>(std::move(made));
    }
    if (!volume->warning.empty()) warnings.push_back(fmt::format("obstacle '{}': {}", o.name, volume->warning));
    obstacles[key] = {o, volume};
    out.obstacles.push_back({o.id, o.name, std::move(volume)});
  }
  obstacles_ = std::move(obstacles);

  decltype(heroes_) heroes;
  for (const HeroTree& h : document.heroes) {
    const Vec3 foot = to_world(h.at, document.terrain->ground(h.at));
    const HeroKey key{h.skeleton.get(), foot.x, foot.y, foot.z};
    std::shared_ptr<const std::vector<Segment>> wood;
    if (const auto kept = heroes_.find(key); kept != heroes_.end()) wood = kept->second.wood;
    if (!wood) {
      auto made = std::make_shared<std::vector<Segment>>();
      for (std::size_t i = 0; i < h.skeleton->size(); ++i)
        if (h.skeleton->alive(i))
          made->push_back({foot + h.skeleton->proximal(i), foot + h.skeleton->distal[i], h.skeleton->radius[i]});
      wood = std::move(made);
    }
    heroes[key] = {h.skeleton, wood};
    out.heroes.push_back({h.id, h.name, std::move(wood)});
  }
  heroes_ = std::move(heroes);
  return out;
}

std::vector<std::string> space_warnings(const crowns::CrownSpace& space, const Document& document) {
  using Kind = crowns::SpaceProblem::Kind;
  std::vector<std::string> out;
  std::map<std::int32_t, std::vector<std::int32_t>> in_obstacle;
  std::size_t in_trunk = 0;
  for (const crowns::SpaceProblem& p : crowns::problems(space, document.terrain->size_m())) {
    if (p.kind == Kind::base_in_obstacle) {
      in_obstacle[p.other].push_back(p.id);
    } else if (p.kind == Kind::base_in_trunk) {
      if (++in_trunk <= kListed) out.push_back(fmt::format("tree {} stands in the trunk of tree {}", p.id, p.other));
    } else {
      out.push_back(fmt::format("{} lies off the site", name_of(document, p.id)));
    }
  }
  if (in_trunk > kListed) out.push_back(fmt::format("and {} more trees stand in others' trunks", in_trunk - kListed));
  for (const auto& [obstacle, trees] : in_obstacle) {
    std::string ids;
    for (std::size_t n = 0; n < std::min(kListed, trees.size()); ++n)
      ids += fmt::format("{}{}", n ? ", " : "", trees[n]);
    if (trees.size() > kListed) ids += fmt::format(" and {} more", trees.size() - kListed);
    out.push_back(fmt::format("{} {} in {}: no room but the column over the base", trees.size() == 1 ? "tree" : "trees",
                              ids, name_of(document, obstacle)));
  }
  return out;
}

}  // namespace bosquet::scene
