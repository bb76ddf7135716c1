#include "scene/crown_cover.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace bosquet::scene {
namespace {

// Grass thins out under a crown, but a single tree does not bare the ground; where crowns overlap their shade adds up.
constexpr float kMostShade = 0.5f;

}  // namespace

std::function<float(Vec2)> crown_cover(const GrownScene& scene) {
  const Vec2 size = scene.document.terrain->size_m();
  const float cell = std::max(1.0f, std::max(size.x, size.y) / 2048.0f);
  const IVec2 cells(static_cast<int>(size.x / cell) + 1, static_cast<int>(size.y / cell) + 1);
  auto cover =
      std::make_shared<std::vector<float>>(static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y), 0.0f);
  for (std::size_t t = 0; t < scene.trees.size(); ++t) {
    const Vec2 at = (*scene.document.trees)[t].at;
    const float radius = std::max(0.5f, 0.55f * scene.trees[t].measures.crown_diameter_m);
    const IVec2 low = glm::max(IVec2((at - radius) / cell), IVec2(0)),
                high = glm::min(IVec2((at + radius) / cell), cells - 1);
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i) {
        const float d = glm::length((Vec2(i, j) + 0.5f) * cell - at) / radius;
        float& c =
            (*cover)[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells.x) + static_cast<std::size_t>(i)];
        c = std::min(1.0f, c + kMostShade * std::max(0.0f, 1.0f - d * d));
      }
  }
  return [cover, cells, cell](Vec2 plan) {
    // Even between the cells' middles.
    const Vec2 place = glm::clamp(plan / cell - 0.5f, Vec2(0.0f), Vec2(cells - 1));
    const IVec2 low(place), high = glm::min(low + 1, cells - 1);
    const Vec2 f = place - Vec2(low);
    const auto at = [&](int i, int j) {
      return (*cover)[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells.x) + static_cast<std::size_t>(i)];
    };
    return glm::mix(glm::mix(at(low.x, low.y), at(high.x, low.y), f.x),
                    glm::mix(at(low.x, high.y), at(high.x, high.y), f.x), f.y);
  };
}

}  // namespace bosquet::scene
