#include "render/overhead.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/parallel.h"
#include "render/srgb.h"

namespace bosquet::render {
namespace {

constexpr float kSmallDiscM = 1.0f, kLargeDiscM = 4.5f;
/// Water that comes this near to the ground's edge goes on beyond it.
constexpr float kWaterEdgeM = 0.5f;
constexpr float kSmallestCellM = 0.1f;

/// The ground this near to its edge colours the land around.
constexpr float kEdgeShare = 0.02f;

/// Ground less than this above the water is shore.
constexpr float kDryM = 0.5f;

/// Calls put(cell index, height) for the cells whose centre lies under a triangle, and for the cell of its centroid.
template <class Put>
void rasterise(const Overhead& map, const Vec3& a, const Vec3& b, const Vec3& c, const Put& put) {
  const auto column = [&](float x) { return static_cast<int>(std::floor((x - map.low.x) / map.cell)); };
  const auto row = [&](float z) { return static_cast<int>(std::floor((z - map.low.y) / map.cell)); };
  const auto index = [&](int i, int j) { return static_cast<std::size_t>(j * map.columns + i); };
  const int i0 = std::max(0, column(std::min({a.x, b.x, c.x}))), j0 = std::max(0, row(std::min({a.z, b.z, c.z})));
  const int i1 = std::min(map.columns - 1, column(std::max({a.x, b.x, c.x})));
  const int j1 = std::min(map.rows - 1, row(std::max({a.z, b.z, c.z})));
  const Vec3 middle = (a + b + c) / 3.0f;
  const int im = column(middle.x), jm = row(middle.z);
  if (im >= 0 && jm >= 0 && im < map.columns && jm < map.rows) put(index(im, jm), middle.y);
  if (i0 == i1 && j0 == j1) return;

  const float area = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
  if (std::abs(area) < 1e-9f) return;
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      const Vec2 p = map.low + map.cell * Vec2(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f);
      const float v = ((p.x - a.x) * (c.z - a.z) - (c.x - a.x) * (p.y - a.z)) / area;
      const float w = ((b.x - a.x) * (p.y - a.z) - (p.x - a.x) * (b.z - a.z)) / area;
      if (v >= 0 && w >= 0 && v + w <= 1) put(index(i, j), a.y + v * (b.y - a.y) + w * (c.y - a.y));
    }
}

/// Mean over 2 r + 1 cells along rows or columns, ends repeated.
void box_blur(std::vector<Vec2>& field, int columns, int rows, int r, bool along_rows) {
  const int lines = along_rows ? rows : columns, length = along_rows ? columns : rows;
  parallel_for(static_cast<std::size_t>(lines), [&](std::size_t line) {
    const auto at = [&](int i) -> Vec2& {
      i = std::clamp(i, 0, length - 1);
      const int k = along_rows ? static_cast<int>(line) * columns + i : i * columns + static_cast<int>(line);
      return field[static_cast<std::size_t>(k)];
    };
    std::vector<Vec2> out(static_cast<std::size_t>(length));
    glm::dvec2 sum(0.0);
    for (int i = -r; i <= r; ++i) sum += glm::dvec2(at(i));
    for (int i = 0; i < length; ++i) {
      out[static_cast<std::size_t>(i)] = Vec2(sum / static_cast<double>(2 * r + 1));
      sum += glm::dvec2(at(i + r + 1)) - glm::dvec2(at(i - r));
    }
    for (int i = 0; i < length; ++i) at(i) = out[static_cast<std::size_t>(i)];
  });
}

/// Gives cells beyond the ground's rectangle the height of its nearest edge, so that a river flows on.
void extend_ground(Overhead& map, float nothing) {
  const auto at = [&](int i, int j) -> float& { return map.ground[static_cast<std::size_t>(j * map.columns + i)]; };
  IVec2 low(map.columns, map.rows), high(-1);
  for (int j = 0; j < map.rows; ++j)
    for (int i = 0; i < map.columns; ++i)
      if (at(i, j) > nothing) low = glm::min(low, IVec2(i, j)), high = glm::max(high, IVec2(i, j));
  for (int j = 0; j < map.rows; ++j)
    for (int i = 0; i < map.columns; ++i) {
      if (at(i, j) > nothing) continue;
      IVec2 nearest = high.x < 0 ? IVec2(0) : glm::clamp(IVec2(i, j), low, high);
      // Cells at the rim lie partly beyond the ground and may have no height of their own.
      for (int inward = 1; high.x >= 0 && inward <= 2 && at(nearest.x, nearest.y) <= nothing; ++inward)
        nearest = glm::clamp(nearest, glm::min(low + inward, high), glm::max(high - inward, low));
      const float height = high.x < 0 ? map.base : at(nearest.x, nearest.y);
      at(i, j) = height > nothing ? height : map.base;
    }
}

/// Mean base colour of a material's texture, linear.
Vec3 mean_colour(const scene::Material& material) {
  Vec3 factor(material.base_factor);
  if (!material.base_colour || material.base_colour->empty()) return factor;
  const Image& image = *material.base_colour;
  Vec3 sum(0.0f);
  int count = 0;
  const int step = std::max(1, image.width / 64);
  for (int y = 0; y < image.height; y += step)
    for (int x = 0; x < image.width; x += step, ++count) {
      const std::uint8_t* p = image.at(x, y);
      const int n = image.channels;
      sum += Vec3(linear_of_srgb(p[0]), linear_of_srgb(p[n >= 3 ? 1 : 0]), linear_of_srgb(p[n >= 3 ? 2 : 0]));
    }
  return factor * sum / static_cast<float>(std::max(1, count));
}

}  // namespace

Overhead make_overhead(const scene::Model& model, const Box3& bounds, int side) {
  Overhead map;
  if (bounds.empty()) {
    map.columns = map.rows = 1;
    map.cover.assign(1, Vec4(0.0f));
    map.ground.assign(1, 0.0f);
    return map;
  }
  // A border wide enough that the large disc fades out inside the map.
  const Vec2 low(bounds.low.x, bounds.low.z), high(bounds.high.x, bounds.high.z);
  const float border = 2 * kLargeDiscM;
  const Vec2 extent = high - low + Vec2(2 * border);
  map.cell = std::max(kSmallestCellM, std::max(extent.x, extent.y) / static_cast<float>(side));
  map.low = low - Vec2(border);
  map.columns = std::max(1, static_cast<int>(std::ceil(extent.x / map.cell)));
  map.rows = std::max(1, static_cast<int>(std::ceil(extent.y / map.cell)));
  map.base = bounds.low.y;
  map.scale = std::max(1.0f, bounds.size().y);
  const std::size_t cells = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);

  // Heights of ground and water first, then everything else on top.
  constexpr float kNothing = -1e30f;
  map.ground.assign(cells, kNothing);
  std::vector<float> top(cells, kNothing);
  std::map<float, WaterSurface> waters;
  glm::dvec4 albedo(0.0), edge_tint(0.0);
  for (const scene::Node& node : model.nodes)
    for (const scene::Part& part : node.parts) {
      if (!part.mesh) continue;
      const TriangleMesh& mesh = *part.mesh;
      const scene::Material& material = model.materials[part.material];
      const bool ground = material.surface == scene::Surface::ground;
      if (material.surface == scene::Surface::water) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
          const auto corner = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]] + node.translation; };
          const Vec3 a = corner(0), across = glm::cross(corner(1) - a, corner(2) - a);
          WaterSurface& water = waters[a.y];
          water.level_m = a.y;
          water.area_m2 += 0.5f * std::abs(across.y);
          for (std::size_t k = 0; k < 3; ++k) water.box.add(Vec2(corner(k).x, corner(k).z));
        }
        continue;
      }
      std::vector<float>& heights = ground ? map.ground : top;
      for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        rasterise(map, mesh.positions[mesh.indices[i]] + node.translation,
                  mesh.positions[mesh.indices[i + 1]] + node.translation,
                  mesh.positions[mesh.indices[i + 2]] + node.translation,
                  [&](std::size_t cell, float height) { heights[cell] = std::max(heights[cell], height); });
    }
  for (const auto& [level, water] : waters) map.waters.push_back(water);
  std::stable_sort(map.waters.begin(), map.waters.end(),
                   [](const WaterSurface& a, const WaterSurface& b) { return a.area_m2 > b.area_m2; });
  if (!map.waters.empty()) map.water_level_m = map.waters.front().level_m;
  Box3 ground_box;
  for (const scene::Node& node : model.nodes)
    for (const scene::Part& part : node.parts)
      if (part.mesh && model.materials[part.material].surface == scene::Surface::ground) {
        const Box3 own = part.mesh->bounds();
        ground_box.add(own.low + node.translation), ground_box.add(own.high + node.translation);
      }
  if (!ground_box.empty())
    map.ground_box = {{ground_box.low.x, ground_box.low.z}, {ground_box.high.x, ground_box.high.z}};
  const Vec3 rim = kEdgeShare * ground_box.size();
  // Colours of the ground, and of its dry edge.
  for (const scene::Node& node : model.nodes)
    for (const scene::Part& part : node.parts) {
      if (!part.mesh || model.materials[part.material].surface != scene::Surface::ground) continue;
      const TriangleMesh& mesh = *part.mesh;
      const scene::Material& material = model.materials[part.material];
      const Vec3 texture = mean_colour(material), factor(material.base_factor);
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 tint = mesh.colours.empty() ? Vec3(1.0f) : Vec3(mesh.colours[i]) / 255.0f;
        albedo += glm::dvec4(glm::dvec3(texture) * tint, 1.0);
        const Vec3 at = mesh.positions[i] + node.translation;
        const Vec3 from_low = at - ground_box.low, from_high = ground_box.high - at;
        const float above_water = at.y - map.water_level_m.value_or(-1e30f);
        if (std::min({from_low.x, from_high.x}) <= rim.x || std::min(from_low.z, from_high.z) <= rim.z)
          if (above_water > kDryM) {
            // Meadow goes on around the site; soil and woodland floor only where nothing green reaches the edge.
            const double weight = tint.g > tint.r && tint.g > tint.b ? 1.0 : 1e-3;
            edge_tint += weight * glm::dvec4(glm::dvec3(factor) * tint, 1.0);
          }
      }
    }
  if (map.water_level_m && !map.ground_box.empty()) {
    const Box2& water_box = map.waters.front().box;
    const Vec2 inside_low = water_box.low - map.ground_box.low, inside_high = map.ground_box.high - water_box.high;
    map.water_flows_on = std::min({inside_low.x, inside_low.y, inside_high.x, inside_high.y}) < kWaterEdgeM;
  }
  if (edge_tint.w > 0) map.land_tint = Vec3(glm::dvec3(edge_tint) / edge_tint.w);
  if (albedo.w > 0) map.ground_albedo = Vec3(glm::dvec3(albedo) / albedo.w);

  // The land around lies as high as the ground's edge in the middle.
  std::vector<float> edge;
  const auto has_ground = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < map.columns && j < map.rows &&
           map.ground[static_cast<std::size_t>(j * map.columns + i)] > kNothing;
  };
  for (int j = 0; j < map.rows; ++j)
    for (int i = 0; i < map.columns; ++i)
      if (has_ground(i, j) &&
          !(has_ground(i - 1, j) && has_ground(i + 1, j) && has_ground(i, j - 1) && has_ground(i, j + 1)))
        edge.push_back(map.ground[static_cast<std::size_t>(j * map.columns + i)]);
  map.land_height = bounds.low.y;
  if (!edge.empty()) {
    std::nth_element(edge.begin(), edge.begin() + static_cast<std::ptrdiff_t>(edge.size() / 2), edge.end());
    map.land_height = edge[edge.size() / 2];
  }
  for (std::size_t c = 0; c < cells; ++c) {
    const float floor = map.ground[c] > kNothing ? map.ground[c] : map.land_height;
    top[c] = std::max(top[c], floor);
  }

  extend_ground(map, kNothing);

  // Means over the discs: three box means after one another are close to a round bell.
  std::vector<Vec2> moments(cells);
  map.cover.resize(cells);
  for (int disc = 0; disc < 2; ++disc) {
    for (std::size_t c = 0; c < cells; ++c) {
      const float h = (top[c] - map.base) / map.scale;
      moments[c] = {h, h * h};
    }
    const float radius = disc == 0 ? kSmallDiscM : kLargeDiscM;
    const int r = std::max(1, static_cast<int>(std::lround(radius / map.cell / 1.7f)));
    for (int pass = 0; pass < 3; ++pass) {
      box_blur(moments, map.columns, map.rows, r, true);
      box_blur(moments, map.columns, map.rows, r, false);
    }
    for (std::size_t c = 0; c < cells; ++c) {
      map.cover[c][2 * disc] = moments[c].x;
      map.cover[c][2 * disc + 1] = moments[c].y;
    }
  }
  return map;
}

}  // namespace bosquet::render
