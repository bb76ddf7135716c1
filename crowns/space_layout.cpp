#include "crowns/space_layout.h"

#include <fmt/format.h>

#include <numeric>
#include <set>
#include <string>

#include "terrain/terrain.h"

namespace bosquet::crowns {
namespace {

// Beyond every lattice, within 32 bits, and such that sums of two do not overflow.
constexpr std::int32_t kEndless = 1 << 28;

// Checks that a field lies in its described range.
struct RangeCheck {
  std::string problem;
  void operator()(const Real& r, float value) {
    const double v = static_cast<double>(value);
    if (problem.empty() && !(v >= static_cast<float>(r.low) && v <= static_cast<float>(r.high)))
      problem = fmt::format("{} = {} is out of range: {} to {} {}", r.name, value, r.low, r.high, r.unit);
  }
};

std::string unusable(const Claimant& t) {
  const auto wrong = [](float v) { return !std::isfinite(v); };
  if (wrong(t.base.x) || wrong(t.base.y) || wrong(t.ground_y)) return "its base is not a number";
  const float sizes[] = {t.scale_height, t.scale_width, t.shape.crown_width_m, t.shape.mature_height_m};
  for (float v : sizes)
    if (wrong(v) || v <= 0.0f) return fmt::format("its size {} must be above 0", v);
  if (wrong(t.shape.trunk_width_m) || t.shape.trunk_width_m < 0.0f) return "its trunk is not a number";
  return {};
}

std::int32_t floor_layer(double y, double layer_m) {
  return static_cast<std::int32_t>(std::clamp(std::floor(y / layer_m), -1.0 * kEndless, 1.0 * kEndless));
}

// First layer from `from` up in which an obstacle stands in this column; kNoGround when none does.
std::int32_t first_obstructed(const Standing& standing, IVec2 column, std::int32_t from) {
  std::int32_t first = kNoGround;
  for (const Obstacle& o : standing.obstacles) {
    const ObstacleVolume& v = *o.volume;
    if (column.x < v.low.x || column.y < v.low.y || column.x > v.high.x || column.y > v.high.y) continue;
    for (const ColumnSpan& s : row(v, column.y))
      if (s.column == column && s.high > from) first = std::min(first, std::max(s.low, from));
  }
  return first;
}

// The columns whose centres lie on the site or its overhang.
Domain domain_of(Vec2 site_m, const SpaceOptions& o) {
  if (o.overhang_m < 0 && std::isfinite(o.reach_factor)) return {IVec2{-kEndless}, IVec2{kEndless}};
  const double voxel = static_cast<double>(o.voxel_m);
  const double overhang = std::max(0.0, static_cast<double>(o.overhang_m)) / voxel;
  constexpr double kSlack = 1e-4;  // a site of 128 x 0.2344 m holds 128 columns
  const auto first = static_cast<std::int32_t>(std::ceil(-overhang - 0.5 - kSlack));
  const auto last = [&](float metres) {
    return std::max(
        first, static_cast<std::int32_t>(std::floor(static_cast<double>(metres) / voxel + overhang - 0.5 + kSlack)));
  };
  return {IVec2{first}, {last(site_m.x), last(site_m.y)}};
}

// The nearest column without a root, or `own` when there is none near.
IVec2 nearest_free(const Placed& p, const Domain& domain, const std::unordered_map<std::uint64_t, std::size_t>& taken,
                   const Standing& standing) {
  // Rings of growing radius; one more ring than the first hit, as corners are farther than edges.
  IVec2 best = p.root;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::int32_t ring = 1; ring <= nearest + 1.0; ++ring)
    for (std::int32_t j = p.root.y - ring; j <= p.root.y + ring; ++j)
      for (std::int32_t i = p.root.x - ring; i <= p.root.x + ring; ++i) {
        const bool on_ring = std::max(std::abs(i - p.root.x), std::abs(j - p.root.y)) == ring;
        if (!on_ring || !domain.contains({i, j}) || taken.contains(packed({i, j}))) continue;
        const double x = i + 0.5 - p.east, y = j + 0.5 - p.north;
        // A column in an obstacle is taken only when nothing else is near.
        const bool blocked = first_obstructed(standing, {i, j}, p.base) == p.base;
        const double distance = std::sqrt(x * x + y * y) + (blocked ? 16.0 : 0.0);
        if (distance < nearest) nearest = distance, best = {i, j};
      }
  return best;
}

}  // namespace

Result<void> check_input(std::span<const Claimant> trees, const Standing& standing, const SpaceOptions& options) {
  RangeCheck range;
  describe(options, range);
  if (!range.problem.empty()) return Error{"crown space: " + range.problem};
  for (const Claimant& t : trees)
    if (const std::string why = unusable(t); !why.empty())
      return Error{fmt::format("crown space: tree {} cannot take part, {}", t.id, why)};
  std::set<std::int32_t> ids;
  const auto fits = [&](std::int32_t id) { return id < 0 && ids.insert(id).second; };
  for (const Obstacle& o : standing.obstacles)
    if (!fits(o.id)) return Error{fmt::format("crown space: obstacle id {} must be below 0 and unique", o.id)};
  for (const HeroClaim& h : standing.heroes)
    if (!fits(h.id)) return Error{fmt::format("crown space: hero tree id {} must be below 0 and unique", h.id)};
  return {};
}

Standing sorted(Standing standing) {
  const auto by_falling_id = [](const auto& a, const auto& b) { return a.id > b.id; };
  std::sort(standing.obstacles.begin(), standing.obstacles.end(), by_falling_id);
  std::sort(standing.heroes.begin(), standing.heroes.end(), by_falling_id);
  return standing;
}

Result<SpaceLayout> lay_out(std::span<const Claimant> trees, const Standing& standing, Vec2 site_m,
                            const SpaceOptions& options) {
  SpaceLayout out;
  out.domain = domain_of(site_m, options);
  const double columns = (out.domain.high.x - out.domain.low.x + 1.0) * (out.domain.high.y - out.domain.low.y + 1.0);
  if (static_cast<double>(trees.size()) > columns)
    return Error{
        fmt::format("crown space: {} trees do not fit the site's {} columns of voxel_m = {}; use a smaller voxel_m",
                    trees.size(), columns, options.voxel_m)};

  const double voxel = static_cast<double>(options.voxel_m), layer = static_cast<double>(options.layer_m);
  out.placed.reserve(trees.size());
  for (const Claimant& t : trees) {
    Placed p;
    p.east = static_cast<double>(t.base.x) / voxel;
    p.north = static_cast<double>(t.base.y) / voxel;
    p.reach = static_cast<double>(options.reach_factor) * static_cast<double>(t.crown_radius_m()) / voxel;
    p.trunk = static_cast<double>(t.trunk_radius_m()) / voxel;
    p.slowness = front_slowness(t.projected_area_m2(), options.speed_exponent, options.voxel_m);
    p.base = floor_layer(static_cast<double>(t.ground_y), layer);
    p.top = std::max(p.base + 1, -floor_layer(-static_cast<double>(t.top_y()), layer));
    const auto column = [&](double v, int axis) {
      return static_cast<std::int32_t>(std::clamp(std::floor(v), static_cast<double>(out.domain.low[axis]),
                                                  static_cast<double>(out.domain.high[axis])));
    };
    p.root = {column(p.east, 0), column(p.north, 1)};
    out.placed.push_back(p);
  }

  // Places of the keys settle ties.
  std::vector<std::uint32_t> by_key(trees.size());
  std::iota(by_key.begin(), by_key.end(), 0u);
  std::sort(by_key.begin(), by_key.end(), [&](std::uint32_t a, std::uint32_t b) {
    return trees[a].key != trees[b].key ? trees[a].key < trees[b].key : trees[a].id < trees[b].id;
  });
  out.rank.resize(trees.size());
  for (std::size_t r = 0; r < by_key.size(); ++r) out.rank[by_key[r]] = static_cast<std::int32_t>(r);

  // The voxel under a base is its tree's; of several in one, the lowest key has it and the others take the nearest
  // free.
  std::unordered_map<std::uint64_t, std::size_t> taken(2 * trees.size());
  std::vector<std::size_t> displaced;
  for (std::size_t t : by_key)
    if (!taken.emplace(packed(out.placed[t].root), t).second) displaced.push_back(t);
  for (std::size_t t : displaced) {
    Placed& p = out.placed[t];
    p.root = nearest_free(p, out.domain, taken, standing);
    taken.emplace(packed(p.root), t);
  }

  // A trunk grows up to what stands over it; in an obstacle it gets no further than its own column.
  if (!standing.obstacles.empty())
    for (Placed& p : out.placed) {
      const std::int32_t first = first_obstructed(standing, p.root, p.base);
      if (first == p.base)
        p.reach = -1.0;
      else
        p.top = std::min(p.top, first);
    }

  for (const HeroClaim& h : standing.heroes)
    for (const IVec3& v : voxels_of(*h.segments, options.voxel())) {
      const IVec2 at{v.x, v.z};
      if (out.domain.contains(at))
        out.heroes[packed(tile_of(at))].push_back({v.y, static_cast<std::uint16_t>(inside(at)), owner_of_id(h.id)});
    }
  return out;
}

bool reaches_everything(const Placed& p, const Domain& domain) {
  const double x = std::max(p.east - domain.low.x, domain.high.x + 1 - p.east),
               y = std::max(p.north - domain.low.y, domain.high.y + 1 - p.north);
  return p.reach > 0 && x * x + y * y <= p.reach * p.reach;
}

std::shared_ptr<const std::vector<std::int32_t>> ground_layers(IVec2 tile, const terrain::Terrain& terrain,
                                                               const Domain& domain, const SpaceOptions& options) {
  auto layers = std::make_shared<std::vector<std::int32_t>>(static_cast<std::size_t>(kTileColumns), kNoGround);
  for (std::int32_t j = 0; j < kTileEdge; ++j)
    for (std::int32_t i = 0; i < kTileEdge; ++i) {
      const IVec2 column = tile * kTileEdge + IVec2{i, j};
      if (!domain.contains(column)) continue;
      const Vec2 centre = (Vec2(column) + 0.5f) * options.voxel_m;
      (*layers)[static_cast<std::size_t>(j * kTileEdge + i)] =
          static_cast<std::int32_t>(std::floor(terrain.ground(centre) / options.layer_m));
    }
  return layers;
}

Front front_of(const Placed& p, std::int32_t rank) {
  Front f;
  f.east = p.east, f.north = p.north;
  f.trunk = p.trunk;
  f.slowness = p.slowness;
  f.reach_squared = p.reach < 0 ? -1.0 : p.reach * p.reach;
  f.rank = rank;
  return f;
}

void claim_for_obstacles(SpaceTile& tile, const Standing& standing) {
  for (const Obstacle& o : standing.obstacles)
    for_each_span(*o.volume, tile.tile, [&](const ColumnSpan& s) {
      const std::size_t c = inside(s.column);
      const std::int32_t ground = (*tile.ground)[c];
      const std::int32_t low = std::max({s.low, tile.first_layer, ground}),
                         high = std::min(s.high, tile.first_layer + tile.layers);
      for (std::int32_t k = low; k < high; ++k)
        if (std::int32_t& owner = tile.owner[tile.offset(k) + c]; owner == kFree) owner = owner_of_id(o.id);
    });
}

void hang_below_bases(SpaceTile& tile, const std::function<std::int32_t(std::int32_t)>& base) {
  constexpr auto kColumns = static_cast<std::size_t>(kTileColumns);
  if (tile.highest_base <= tile.first_layer) return;
  for (std::int32_t k = std::min(tile.highest_base, tile.first_layer + tile.layers - 1) - 1; k >= tile.first_layer;
       --k) {
    std::int32_t* here = tile.owner.data() + tile.offset(k);
    const std::int32_t* above = here + kColumns;
    for (std::size_t c = 0; c < kColumns; ++c) {
      if (here[c] != kFree || above[c] < 0 || k < (*tile.ground)[c] || base(above[c]) <= k) continue;
      here[c] = above[c];
      if (!tile.ticks.empty()) tile.ticks[tile.offset(k) + c] = tile.ticks[tile.offset(k + 1) + c];
    }
  }
}

void claim_for_heroes(SpaceTile& tile, const SpaceLayout& layout) {
  const auto found = layout.heroes.find(packed(tile.tile));
  if (found == layout.heroes.end()) return;
  for (const HeroVoxel& v : found->second) {
    if (!tile.has(v.layer) || v.layer < (*tile.ground)[v.column]) continue;
    const std::size_t place = tile.offset(v.layer) + v.column;
    std::int32_t& owner = tile.owner[place];
    if (owner < kFree) continue;
    tile.under_heroes.push_back({static_cast<std::uint32_t>(place), owner});
    owner = v.owner;
  }
  std::sort(tile.under_heroes.begin(), tile.under_heroes.end(),
            [](const SpaceTile::Under& a, const SpaceTile::Under& b) { return a.place < b.place; });
}

void add_run(LayerShare& share, IVec2 first, std::int32_t n) {
  const IVec2 last = first + IVec2{n - 1, 0};
  share.low = share.voxels == 0 ? first : glm::min(share.low, first);
  share.high = share.voxels == 0 ? last : glm::max(share.high, last);
  share.voxels += n;
  share.east_sum += (std::int64_t{first.x} + last.x) * n / 2;
  share.north_sum += std::int64_t{first.y} * n;
}

}  // namespace bosquet::crowns
