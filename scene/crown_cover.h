// Crown cover: how much of the ground lies under crowns.
//
// Frame     plan (east, north) metres, in cells of a metre or more
#pragma once

#include <functional>

#include "scene/grown_scene.h"

namespace bosquet::scene {

/// Share 0..1 of forest floor at a plan position. The function keeps all it needs.
std::function<float(Vec2)> crown_cover(const GrownScene& scene);

}  // namespace bosquet::scene
