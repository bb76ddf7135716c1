#include "geometry/prism.h"

#include <algorithm>
#include <limits>

namespace bosquet::geometry {
namespace {

double area2(DVec2 a, DVec2 b, DVec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

double area2(const std::vector<Vec2>& ring) {
  double sum = 0;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    sum += static_cast<double>(ring[j].x) * ring[i].y - static_cast<double>(ring[i].x) * ring[j].y;
  return sum;
}

// Indices of a ring in the order asked for.
std::vector<std::uint32_t> turned(const std::vector<Vec2>& ring, std::uint32_t first, bool counter_clockwise) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t n = 0; n < ring.size(); ++n) out.push_back(first + n);
  if ((area2(ring) > 0) != counter_clockwise) std::reverse(out.begin(), out.end());
  return out;
}

bool crosses(DVec2 a, DVec2 b, DVec2 c, DVec2 d) {
  return area2(a, b, c) * area2(a, b, d) < 0 && area2(c, d, a) * area2(c, d, b) < 0;
}

// Cuts from the hole's easternmost point to the nearest point of the loop that it sees.
void join_hole(std::vector<std::uint32_t>& loop, const std::vector<std::uint32_t>& hole, const std::vector<DVec2>& p) {
  const auto start = static_cast<std::size_t>(
      std::max_element(hole.begin(), hole.end(), [&](auto a, auto b) { return p[a].x < p[b].x; }) - hole.begin());
  const DVec2 from = p[hole[start]];
  std::size_t best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const DVec2 to = p[loop[n]], off = to - from;
    const double distance = off.x * off.x + off.y * off.y;
    if (distance >= nearest) continue;
    bool seen = true;
    for (std::size_t i = 0, j = loop.size() - 1; seen && i < loop.size(); j = i++)
      seen = !crosses(from, to, p[loop[j]], p[loop[i]]);
    for (std::size_t i = 0, j = hole.size() - 1; seen && i < hole.size(); j = i++)
      seen = !crosses(from, to, p[hole[j]], p[hole[i]]);
    if (seen) nearest = distance, best = n;
  }
  std::vector<std::uint32_t> cut;
  for (std::size_t n = 0; n <= hole.size(); ++n) cut.push_back(hole[(start + n) % hole.size()]);
  cut.push_back(loop[best]);
  loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(best) + 1, cut.begin(), cut.end());
}

bool is_ear(const std::vector<std::uint32_t>& loop, std::size_t at, const std::vector<DVec2>& p) {
  const std::size_t n = loop.size();
  const std::uint32_t ia = loop[(at + n - 1) % n], ib = loop[at], ic = loop[(at + 1) % n];
  const DVec2 a = p[ia], b = p[ib], c = p[ic];
  if (area2(a, b, c) <= 0) return false;
  for (std::uint32_t i : loop) {
    const DVec2 q = p[i];
    if (q == a || q == b || q == c) continue;
    if (area2(a, b, q) >= 0 && area2(b, c, q) >= 0 && area2(c, a, q) >= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const Polygon& outline) {
  if (outline.ring.size() < 3) return {};
  std::vector<DVec2> p(outline.ring.begin(), outline.ring.end());
  std::vector<std::uint32_t> loop = turned(outline.ring, 0, true);
  std::vector<std::vector<std::uint32_t>> holes;
  for (const auto& hole : outline.holes) {
    const auto first = static_cast<std::uint32_t>(p.size());
    p.insert(p.end(), hole.begin(), hole.end());
    if (hole.size() >= 3) holes.push_back(turned(hole, first, false));
  }
  // From the east, so that a cut never has to pass a hole that is not yet joined.
  const auto east = [&](const std::vector<std::uint32_t>& hole) {
    double most = std::numeric_limits<double>::lowest();
    for (std::uint32_t i : hole) most = std::max(most, p[i].x);
    return most;
  };
  std::stable_sort(holes.begin(), holes.end(), [&](const auto& a, const auto& b) { return east(a) > east(b); });
  for (const auto& hole : holes) join_hole(loop, hole, p);

  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (loop.size() >= 3) {
    std::size_t at = 0;
    while (at < loop.size() && !is_ear(loop, at, p)) ++at;
    if (at == loop.size()) at = 0;  // only when the outline crosses itself
    const std::size_t n = loop.size();
    const std::array<std::uint32_t, 3> t{loop[(at + n - 1) % n], loop[at], loop[(at + 1) % n]};
    if (area2(p[t[0]], p[t[1]], p[t[2]]) > 0) triangles.push_back(t);
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return triangles;
}

TriangleMesh prism(const Polygon& outline, float low_y, float high_y) {
  TriangleMesh mesh;
  const auto vertex = [&](Vec2 plan, float y, const Vec3& normal) {
    mesh.positions.push_back(to_world(plan, y));
    mesh.normals.push_back(normal);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };

  std::vector<Vec2> points = outline.ring;
  for (const auto& hole : outline.holes) points.insert(points.end(), hole.begin(), hole.end());
  const auto triangles = triangulate(outline);
  if (triangles.empty()) return mesh;
  for (const bool roof : {true, false}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (Vec2 p : points) vertex(p, roof ? high_y : low_y, roof ? kUp : -kUp);
    for (const auto& t : triangles)
      mesh.indices.insert(mesh.indices.end(), {first + t[0], first + t[roof ? 1 : 2], first + t[roof ? 2 : 1]});
  }
  const auto walls = [&](const std::vector<Vec2>& ring, bool counter_clockwise) {
    const std::vector<std::uint32_t> order = turned(ring, 0, counter_clockwise);
    for (std::size_t n = 0; n < order.size(); ++n) {
      const Vec2 a = ring[order[n]], b = ring[order[(n + 1) % order.size()]], along = b - a;
      const float length = glm::length(along);
      if (length == 0.0f) continue;
      const Vec3 out = to_world(Vec2{along.y, -along.x} / length, 0.0f);
      const std::uint32_t i = vertex(a, low_y, out);
      vertex(b, low_y, out), vertex(b, high_y, out), vertex(a, high_y, out);
      mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + 2, i, i + 2, i + 3});
    }
  };
  walls(outline.ring, true);
  for (const auto& hole : outline.holes) walls(hole, false);
  return mesh;
}

}  // namespace bosquet::geometry
