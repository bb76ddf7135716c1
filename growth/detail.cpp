#include "growth/detail.h"

#include <algorithm>
#include <cassert>

#include "growth/radii.h"

namespace bosquet::growth {
namespace {

constexpr std::int32_t kNobody = -1;

/// What runs along axes: the internode after each, and the place of each, from 0.
struct Along {
  std::vector<std::int32_t> next;
  std::vector<int> place;
};

bool continues(const Skeleton& s, std::size_t i) {
  return s.parent[i] >= 0 && s.axis[static_cast<std::size_t>(s.parent[i])] == s.axis[i];
}

Along along_axes(const Skeleton& s) {
  Along a{std::vector<std::int32_t>(s.size(), kNobody), std::vector<int>(s.size(), 0)};
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (!continues(s, i)) continue;
    const auto p = static_cast<std::size_t>(s.parent[i]);
    a.next[p] = static_cast<std::int32_t>(i);
    a.place[i] = a.place[p] + 1;
  }
  return a;
}

int step(int place, float detail) { return static_cast<int>(static_cast<float>(place) * detail); }

/// Takes internode i over, with its upper end, its parent in the new skeleton and the pipes of its own.
void push_back(Skeleton& out, const Skeleton& s, std::size_t i, const Vec3& end, std::int32_t parent, int pipes) {
  out.parent.push_back(parent), out.axis.push_back(s.axis[i]), out.order.push_back(s.order[i]);
  out.distal.push_back(end);
  out.born.push_back(s.born[i]), out.shed.push_back(s.shed[i]);
  out.light.push_back(s.light[i]), out.vigor.push_back(s.vigor[i]);
  out.pipes.push_back(static_cast<std::uint8_t>(std::min(255, pipes)));
}

void subdivide(const Skeleton& s, float detail, Skeleton& out) {
  const Along along = along_axes(s);
  std::vector<std::int32_t> new_index(s.size());
  const auto run = [&](std::size_t i) { return s.distal[i] - s.proximal(i); };
  for (std::size_t i = 0; i < s.size(); ++i) {
    // Cubic Hermite between the ends, tangents as the mean of the internodes that meet there.
    const Vec3 from = s.proximal(i), to = s.distal[i], own = to - from;
    const Vec3 leaving = continues(s, i) ? 0.5f * (run(static_cast<std::size_t>(s.parent[i])) + own) : own;
    const Vec3 arriving = along.next[i] >= 0 ? 0.5f * (own + run(static_cast<std::size_t>(along.next[i]))) : own;
    const float ground = std::min(0.0f, std::min(from.y, to.y));
    const int pieces = step(along.place[i] + 1, detail) - step(along.place[i], detail);
    std::int32_t parent = s.parent[i] < 0 ? kNobody : new_index[static_cast<std::size_t>(s.parent[i])];
    for (int k = 1; k < pieces; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(pieces), u = 1.0f - t;
      Vec3 end = from + (t * t * (3.0f - 2.0f * t)) * own + (t * u) * (u * leaving - t * arriving);
      end.y = std::max(end.y, ground);
      push_back(out, s, i, end, parent, 0);
      parent = static_cast<std::int32_t>(out.size() - 1);
    }
    push_back(out, s, i, to, parent, 1);
    new_index[i] = static_cast<std::int32_t>(out.size() - 1);
  }
}

/// For every node the one that stays for its run.
std::vector<std::int32_t> who_stays(const Skeleton& s, const Along& along, float detail) {
  // Wood on the branches of each node.
  std::vector<int> carried(s.size(), 0), branches(s.size(), 0);
  for (std::size_t i = s.size(); i-- > 0;) {
    ++carried[i];
    if (s.parent[i] < 0) continue;
    const auto p = static_cast<std::size_t>(s.parent[i]);
    carried[p] += carried[i];
    if (!continues(s, i)) branches[p] += carried[i];
  }
  std::vector<std::int32_t> stays(s.size());
  for (std::size_t first = 0; first < s.size(); ++first) {
    const int run = step(along.place[first], detail);
    if (continues(s, first) && step(along.place[first] - 1, detail) == run) continue;
    auto best = static_cast<std::int32_t>(first), i = best;
    for (; i >= 0 && step(along.place[static_cast<std::size_t>(i)], detail) == run;
         i = along.next[static_cast<std::size_t>(i)]) {
      const auto n = static_cast<std::size_t>(i), b = static_cast<std::size_t>(best);
      if (along.next[n] < 0 || branches[n] >= branches[b]) best = i;
    }
    for (auto j = static_cast<std::int32_t>(first); j != i; j = along.next[static_cast<std::size_t>(j)]) {
      stays[static_cast<std::size_t>(j)] = best;
    }
  }
  return stays;
}

void merge(const Skeleton& s, float detail, Skeleton& out) {
  const Along along = along_axes(s);
  const std::vector<std::int32_t> stays = who_stays(s, along, detail);
  const auto kept = [&](std::int32_t i) { return stays[static_cast<std::size_t>(i)] == i; };
  std::vector<std::int32_t> new_index(s.size(), kNobody);
  std::vector<int> waiting(s.size(), 0);  ///< internodes below on the axis that the next node to stay stands for
  for (std::size_t i = 0; i < s.size(); ++i) {
    const int own = 1 + (continues(s, i) ? waiting[static_cast<std::size_t>(s.parent[i])] : 0);
    if (stays[i] != static_cast<std::int32_t>(i)) {
      waiting[i] = own;
      continue;
    }
    // Down to a node that stays. A branch may also have moved up, where that is nearer.
    std::int32_t below = s.parent[i];
    while (below >= 0 && !kept(below)) {
      const auto b = static_cast<std::size_t>(below);
      const std::int32_t above = stays[b];
      const bool leaves_axis = s.axis[b] != s.axis[i] && s.axis[b] == s.axis[static_cast<std::size_t>(above)];
      if (leaves_axis && new_index[static_cast<std::size_t>(above)] >= 0 &&
          along.place[static_cast<std::size_t>(above)] > along.place[b]) {
        const int up = along.place[static_cast<std::size_t>(above)] - along.place[b];
        int down = 1;
        for (std::int32_t j = s.parent[b]; j >= 0 && !kept(j); j = s.parent[static_cast<std::size_t>(j)]) ++down;
        if (up <= down) {
          below = above;
          break;
        }
      }
      below = s.parent[b];
    }
    push_back(out, s, i, s.distal[i], below < 0 ? kNobody : new_index[static_cast<std::size_t>(below)], own);
    new_index[i] = static_cast<std::int32_t>(out.size() - 1);
  }
}

}  // namespace

Skeleton at_detail(const Skeleton& s, float detail) {
  assert(detail > 0.0f && s.pipes.empty());
  if (detail == 1.0f) return s;
  Skeleton out;
  (detail > 1.0f ? subdivide : merge)(s, detail, out);
  out.seasons = s.seasons;
  out.internode_length_m = s.internode_length_m / detail, out.detail = detail;
  out.tip_diameter_m = s.tip_diameter_m, out.pipe_exponent = s.pipe_exponent;
  out.radius = radii(out);
  return out;
}

}  // namespace bosquet::growth
