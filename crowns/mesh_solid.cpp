#include "crowns/mesh_solid.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace bosquet::crowns {
namespace {

using Corners = std::array<std::uint32_t, 3>;

// Triangles over welded vertices, without those that have no area by their corners.
std::vector<Corners> welded(const TriangleMesh& mesh) {
  const auto& p = mesh.positions;
  std::vector<std::uint32_t> order(p.size()), name(p.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(p[a].x, p[a].y, p[a].z, a) < std::tie(p[b].x, p[b].y, p[b].z, b);
  });
  for (std::size_t n = 0; n < order.size(); ++n)
    name[order[n]] = n > 0 && p[order[n]] == p[order[n - 1]] ? name[order[n - 1]] : order[n];

  std::vector<Corners> triangles;
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const Corners c{name[mesh.indices[t]], name[mesh.indices[t + 1]], name[mesh.indices[t + 2]]};
    if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) triangles.push_back(c);
  }
  return triangles;
}

// Six times the signed volume of a tetrahedron.
double volume(const DVec3& a, const DVec3& b, const DVec3& c, const DVec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

bool pierces(const DVec3& from, const DVec3& to, const DVec3& a, const DVec3& b, const DVec3& c) {
  if (volume(a, b, c, from) * volume(a, b, c, to) >= 0.0) return false;
  const double u = volume(from, to, a, b), v = volume(from, to, b, c), w = volume(from, to, c, a);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

}  // namespace

bool is_closed(const TriangleMesh& mesh) {
  const std::vector<Corners> triangles = welded(mesh);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Corners& c : triangles)
    for (int e = 0; e < 3; ++e)
      edges.push_back(std::minmax(c[static_cast<std::size_t>(e)], c[static_cast<std::size_t>((e + 1) % 3)]));
  std::sort(edges.begin(), edges.end());
  for (std::size_t n = 0; n < edges.size();) {
    std::size_t end = n;
    while (end < edges.size() && edges[end] == edges[n]) ++end;
    if ((end - n) % 2 != 0) return false;
    n = end;
  }
  return !triangles.empty();
}

bool crosses_itself(const TriangleMesh& mesh) {
  const std::vector<Corners> triangles = welded(mesh);
  const Vec3 size = mesh.bounds().size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.z >= size.y ? 2 : 1);
  struct Boxed {
    Box3 box;
    Corners corners;
  };
  std::vector<Boxed> sorted;
  for (const Corners& c : triangles) {
    Boxed b{{}, c};
    for (std::uint32_t v : c) b.box.add(mesh.positions[v]);
    sorted.push_back(b);
  }
  std::sort(sorted.begin(), sorted.end(), [&](const Boxed& a, const Boxed& b) {
    return std::tie(a.box.low[axis], a.corners) < std::tie(b.box.low[axis], b.corners);
  });

  const auto apart = [](const Box3& a, const Box3& b) {
    return a.high.x < b.low.x || b.high.x < a.low.x || a.high.y < b.low.y || b.high.y < a.low.y || a.high.z < b.low.z ||
           b.high.z < a.low.z;
  };
  const auto at = [&](std::uint32_t v) { return DVec3(mesh.positions[v]); };
  const auto cross = [&](const Corners& a, const Corners& b) {
    for (std::size_t e = 0; e < 3; ++e)
      if (pierces(at(a[e]), at(a[(e + 1) % 3]), at(b[0]), at(b[1]), at(b[2]))) return true;
    return false;
  };
  for (std::size_t n = 0; n < sorted.size(); ++n)
    for (std::size_t m = n + 1; m < sorted.size() && sorted[m].box.low[axis] <= sorted[n].box.high[axis]; ++m) {
      const Corners &a = sorted[n].corners, &b = sorted[m].corners;
      if (apart(sorted[n].box, sorted[m].box)) continue;
      if (std::any_of(a.begin(), a.end(), [&](std::uint32_t v) { return v == b[0] || v == b[1] || v == b[2]; }))
        continue;
      if (cross(a, b) || cross(b, a)) return true;
    }
  return false;
}

}  // namespace bosquet::crowns
