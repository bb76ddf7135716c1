#include "crowns/hero_claim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace bosquet::crowns {
namespace {

// World to the lattice's axes: east, up, north.
DVec3 lattice_axes(const Vec3& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), -static_cast<double>(p.z)};
}

// Walks from voxel face to voxel face (Amanatides and Woo 1987).
void walk(const DVec3& from, const DVec3& to, std::vector<IVec3>& out) {
  IVec3 cell(glm::floor(from));
  const IVec3 last(glm::floor(to));
  const DVec3 along = to - from;
  DVec3 next(std::numeric_limits<double>::infinity()), step(std::numeric_limits<double>::infinity());
  IVec3 turn(0);
  for (int a = 0; a < 3; ++a) {
    if (along[a] == 0.0) continue;
    turn[a] = along[a] > 0.0 ? 1 : -1;
    step[a] = std::fabs(1.0 / along[a]);
    next[a] = ((cell[a] + (turn[a] > 0 ? 1 : 0)) - from[a]) / along[a];
  }
  out.push_back(cell);
  // As many steps as faces lie between, so rounding can neither stop early nor run on.
  const IVec3 faces = glm::abs(last - cell);
  for (int left = faces.x + faces.y + faces.z; left > 0; --left) {
    int a = -1;
    for (int b = 0; b < 3; ++b)
      if (cell[b] != last[b] && (a < 0 || next[b] < next[a])) a = b;
    cell[a] += turn[a];
    next[a] += step[a];
    out.push_back(cell);
  }
}

}  // namespace

std::vector<IVec3> voxels_of(const std::vector<Segment>& segments, VoxelSize size) {
  const double voxel = static_cast<double>(size.voxel_m), layer = static_cast<double>(size.layer_m);
  const DVec3 edge(voxel, layer, voxel);
  std::vector<IVec3> out;
  for (const Segment& s : segments) {
    const DVec3 from = lattice_axes(s.from), to = lattice_axes(s.to), along = to - from;
    walk(from / edge, to / edge, out);

    // Centres within the radius.
    const double radius = static_cast<double>(s.radius), length = glm::dot(along, along);
    const IVec3 low(glm::floor((glm::min(from, to) - radius) / edge)),
        high(glm::floor((glm::max(from, to) + radius) / edge));
    for (int j = low.z; j <= high.z; ++j)
      for (int k = low.y; k <= high.y; ++k)
        for (int i = low.x; i <= high.x; ++i) {
          const DVec3 centre = (DVec3(i, k, j) + 0.5) * edge;
          const double share = length > 0 ? std::clamp(glm::dot(centre - from, along) / length, 0.0, 1.0) : 0.0;
          const DVec3 off = centre - from - share * along;
          if (glm::dot(off, off) <= radius * radius) out.push_back({i, k, j});
        }
  }
  std::sort(out.begin(), out.end(),
            [](const IVec3& a, const IVec3& b) { return std::tie(a.z, a.x, a.y) < std::tie(b.z, b.x, b.y); });
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace bosquet::crowns
