// Shoots: which buds grow, how long, and where to.
//
// Source    Longay 2014, 4.3.2 (fate, eq. 4.3), 4.4 (direction, eq. 4.5; deflection), 6.6 (asymmetry, eq. 6.5)
// Model     n = floor(v / v_max * n_max); H' = normalize(alpha*H + beta*F + gamma*E), F the direction of
//           S + (1 - sqrt(h/h_max)) * V, S the world's up turned by the set-point angle in the vertical plane through H
// Decision  wood once grown stays, so a limb that sags under its length is one whose set-point sinks as its tip reaches out
//           from the tree's foot; the tips of later phases may rise again
// Decision  deflection turns last season's wood only: for each growing lateral bud on it, the part of the shoot above
//           the bud's node turns rigidly about the node, away from the bud, base first
// Decision  V leans a trunk only where its region goes on that way: pressed against its border it grows by S alone
// Decision  a bud that has been without space or light for bud_life_seasons dies
// Decision  space is competed for again before each metamer; a bud without a marker ends its shoot, and so does one
//           that would grow into the ground, or out of its region when it already stands outside (the trunk may)
// Decision  a metamer that would leave the region grows straight to its free space instead; a trunk rises along the
//           border, or back to its base's column; deflection turns no wood out of the region
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/scalar.h"
#include "growth/directions.h"
#include "growth/gravimorphism.h"
#include "growth/region_test.h"
#include "growth/tree.h"

namespace bosquet::growth {
namespace {

constexpr float kShortestShoot = 2.0f;    ///< n_max of a seedling's trunk
constexpr float kNearlyVertical = 0.01f;  ///< level part of H below which its vertical plane is drawn at random

/// n_max of an axis at the tree's present height.
float longest_shoot(const Tree& tree, std::uint8_t order) {
  const auto grown_up = static_cast<float>(tree.habit(order).max_shoot);
  const float youth = tree.parameters->youth * tree.input->max_height_m;
  if (order > 0 || tree.height_m >= youth) return grown_up;
  return kShortestShoot + (grown_up - kShortestShoot) * tree.height_m / youth;
}

/// S for an axis with heading h whose tip is at `at`.
Vec3 set_point(Tree& tree, const Habit& habit, const Vec3& h, const Vec3& at) {
  Vec3 level{h.x, 0.0f, h.z};
  const float length = std::sqrt(h.x * h.x + h.z * h.z);
  if (length > kNearlyVertical) {
    level /= length;
  } else if (tree.parameters->planar) {
    level = {tree.random.bits() & 1 ? 1.0f : -1.0f, 0.0f, 0.0f};
  } else {
    const SinCos azimuth = sin_cos(2.0f * kPi * tree.random.uniform());
    level = {azimuth.cos, 0.0f, azimuth.sin};
  }
  if (habit.sag != 0.0f) {
    const float reach = std::sqrt(at.x * at.x + at.z * at.z);
    const SinCos angle = sin_cos(std::clamp(habit.set_point + habit.sag * reach, 0.0f, kPi));
    return angle.cos * kUp + angle.sin * level;
  }
  return habit.set_point_cos * kUp + habit.set_point_sin * level;
}

/// F, the tropism S with the press of the neighbours.
Vec3 pressed(Tree& tree, const Vec3& s) {
  if (!tree.leans) return s;
  if (tree.height_m != tree.pressed_at_m) {
    tree.pressed_at_m = tree.height_m;
    tree.press = 1.0f - std::sqrt(std::min(1.0f, tree.height_m / tree.input->max_height_m));
  }
  return normalised_or(s + tree.press * tree.input->asymmetry, s);
}

/// Chance of a lateral bud that stands on `side` of an axis with this heading, at place x of its shoot.
float bud_factor(const Habit& habit, const Vec3& heading, const Vec3& side, float x) {
  float factor = 1.0f;
  if (!habit.neutral_ellipse) {
    const Vec3 v = most_vertical(heading);
    const float along_v = glm::dot(side, v), along_p = glm::dot(side, glm::cross(v, heading));
    factor = v == Vec3{0.0f} ? 1.0f : propensity(habit.s_v, habit.s_p, habit.e_v, heading.y, along_v, along_p);
  }
  if (habit.acrotony != 0.0f) factor *= exp(2.0f * habit.acrotony * (2.0f * x - 1.0f));
  return factor;
}

/// Lateral buds at the base of internode `carrier`, the metamer `place` of its season's shoot.
void set_lateral_buds(Tree& tree, std::int32_t carrier, std::size_t tip, const GrowingBud& g) {
  const Parameters& p = *tree.parameters;
  Buds& buds = tree.buds;
  const auto c = static_cast<std::size_t>(carrier);
  const Vec3 heading = tree.internodes.parts[c].heading;

  // How many stand here.
  int count = p.phyllotaxis == Phyllotaxis::whorled ? p.whorl : p.phyllotaxis == Phyllotaxis::decussate ? 2 : 1;
  const bool shoot_end = p.buds_at == BudsAt::shoot_end;
  if (shoot_end) {
    if (g.made == 0) {
      count = p.whorl;
    } else if (tree.random.uniform() >= p.scattered) {
      count = 0;
    } else {
      count = 1;
    }
  }
  const float bole_m = std::max(p.bole * tree.input->max_height_m, tree.input->clear_stem_m);
  if (tree.wood.order[c] == 0 && buds[tip].at.y < bole_m) count = 0;
  if (p.planar) count = std::min(count, 2);  // a plane has two sides
  tree.internodes.parts[c].first_bud = static_cast<std::int32_t>(buds.size());
  tree.internodes.parts[c].buds = static_cast<std::uint8_t>(count);
  tree.internodes.parts[static_cast<std::size_t>(buds[tip].node)].laterals = static_cast<std::uint8_t>(count);

  const float x = shoot_end && g.made == 0
                      ? 1.0f
                      : (static_cast<float>(g.made) + 0.5f) / static_cast<float>(std::max(1, g.planned));
  const auto order = static_cast<std::uint8_t>(std::min(255, tree.wood.order[c] + 1));
  const Habit& habit = tree.habit(order);
  Vec3 side = normalised_or(buds.origin[tip].side - glm::dot(buds.origin[tip].side, heading) * heading,
                            basis_around(heading).x);
  if (count > 0) {
    const SinCos between = tree.between_buds[static_cast<std::size_t>(count)];
    Vec3 azimuth = side;
    for (int i = 0; i < count; ++i) {
      const Vec3 direction = heading * habit.branching_cos + azimuth * habit.branching_sin;
      const std::int32_t bud = buds.push_back(buds[tip].at, direction, buds[tip].node, order, BudState::lateral);
      const auto b = static_cast<std::size_t>(bud);
      buds.origin[b].carrier = carrier;
      buds[b].factor = bud_factor(habit, heading, azimuth, x);
      buds[b].sky = buds[tip].sky, buds[b].place = buds[tip].place;
      tree.living.push_back(bud);
      azimuth = p.planar ? -azimuth : turned(azimuth, heading, between.sin, between.cos);
    }
  }

  // Where the next node's first bud stands.
  if (p.planar || (count <= 1 && p.phyllotaxis == Phyllotaxis::distichous)) {
    side = -side;
  } else if (count > 1) {
    const SinCos half = tree.between_buds[2 * static_cast<std::size_t>(count)];
    side = turned(side, heading, half.sin, half.cos);
  } else if (count == 1 || !shoot_end) {
    const SinCos turn = tree.phyllotactic;
    side = turned(side, heading, turn.sin, turn.cos);
  }
  buds.origin[tip].side = side;
}

/// A lateral bud becomes the tip of a new axis.
void start_axis(Tree& tree, std::size_t bud) {
  Buds& buds = tree.buds;
  buds[bud].state = BudState::terminal;
  buds.origin[bud].axis = tree.axes++;
  tree.tip_of.push_back(static_cast<std::int32_t>(bud));
  // The first bud stands to a side, level, so that two-ranked branches are flat sprays.
  const Vec3 h = buds[bud].direction;
  const Vec3 level = normalised_or(glm::cross(h, kUp), basis_around(h).x);
  buds.origin[bud].side = tree.parameters->planar  ? normalised_or(Vec3{h.y, -h.x, 0.0f}, Vec3{1.0f, 0.0f, 0.0f})
                          : tree.random.bits() & 1 ? level
                                                   : -level;
}

/// One metamer; false when it may not stand where it would.
bool add_metamer(Tree& tree, const RegionTest& in_its_region, const GrowingBud& g) {
  Buds& buds = tree.buds;
  Skeleton& wood = tree.wood;
  const auto b = static_cast<std::size_t>(g.bud);
  const Habit& habit = tree.habit(buds[b].order);

  const Vec3 h = buds[b].direction;
  const Vec3 space = normalised_or(buds.claimed[b], h);
  const Vec3 s = set_point(tree, habit, h, buds[b].at);
  const auto toward = [&](const Vec3& tropism) {
    Vec3 heading = habit.alpha * h + habit.beta * tropism + habit.gamma * space;
    if (tree.parameters->planar) heading.z = 0.0f;
    return normalised_or(heading, h);
  };
  const Vec3 at = buds[b].at;
  Vec3 heading = toward(pressed(tree, s));
  if (buds[b].order == 0 && tree.leans && !in_its_region(at + tree.occupied_m * heading)) heading = toward(s);
  const float ground = buds[b].order == 0 ? 0.0f : tree.input->clear_stem_m;
  if (at.y + tree.length_m * heading.y < ground) return false;
  // A metamer that would leave the region turns to the free space in it; a trunk rises along the border, or back to it.
  bool inside = true;
  const auto stays = [&](const Vec3& way) {
    heading = way;
    return inside = in_its_region(at + tree.length_m * way);
  };
  if (!stays(heading) && !stays(space) && buds[b].order == 0 &&
      !stays(normalised_or(habit.alpha * h + (1.0f - habit.alpha) * kUp, kUp)) && !stays(kUp)) {
    stays(normalised_or(kUp + normalised_or({-at.x, 0.0f, -at.z}, kUp), kUp));
  }
  const Vec3 end = at + tree.length_m * heading;

  if (end.y < ground) return false;
  if (buds[b].order > 0 && !inside && !in_its_region(at)) return false;

  const bool new_axis = buds[b].state == BudState::lateral;
  if (new_axis) start_axis(tree, b);
  const auto internode = static_cast<std::int32_t>(wood.size());
  const std::int32_t below = buds[b].node;
  wood.parent.push_back(below);
  wood.axis.push_back(buds.origin[b].axis);
  wood.order.push_back(buds[b].order);
  wood.distal.push_back(end);
  wood.born.push_back(static_cast<std::uint16_t>(tree.season));
  wood.shed.push_back(kNever);
  wood.light.push_back(1.0f);
  wood.vigor.push_back(tree.vigor_of(buds[b]));
  tree.internodes.push_back(heading, below, buds[b].order, new_axis ? kLateral : kMain);
  if (!new_axis && below >= 0) {
    tree.internodes.parts[static_cast<std::size_t>(below)].next = internode;
    tree.internodes.parts[static_cast<std::size_t>(below)].above = internode;
    set_lateral_buds(tree, internode, b, g);
  } else {
    tree.internodes.parts.back().first_bud = static_cast<std::int32_t>(buds.size());
  }

  buds[b].node = internode;
  buds[b].at = end;
  buds[b].direction = heading;
  buds.origin[b].side =
      normalised_or(buds.origin[b].side - glm::dot(buds.origin[b].side, heading) * heading, basis_around(heading).x);
  buds[b].factor = 1.0f;
  if (tree.input->light) buds[b].sky = tree.input->light->at(end);
  buds[b].place = tree.shadow.cast(end);
  tree.occupancy.add(end);
  ++tree.work.shadow_updates;
  tree.height_m = std::max(tree.height_m, end.y);
  return true;
}

/// Would such a turn carry wood out of the region?
bool turns_out(const Tree& tree, const RegionTest& in_its_region, std::int32_t first, const Vec3& axis, float sin,
               float cos) {
  if (!tree.input->region) return false;
  const Skeleton& wood = tree.wood;
  const Vec3 pivot = wood.proximal(static_cast<std::size_t>(first));
  for (std::int32_t i = first; i >= 0; i = tree.internodes.parts[static_cast<std::size_t>(i)].next) {
    const Vec3& end = wood.distal[static_cast<std::size_t>(i)];
    if (in_its_region(end) && !in_its_region(pivot + turned(end - pivot, axis, sin, cos))) return true;
  }
  return false;
}

/// The wood above internode `first`'s base on its axis, its buds and its tip, turn about the base.
void turn_shoot(Tree& tree, std::int32_t first, const Vec3& axis, float sin, float cos) {
  Skeleton& wood = tree.wood;
  Internodes& in = tree.internodes;
  Buds& buds = tree.buds;
  const auto f = static_cast<std::size_t>(first);
  const Vec3 pivot = wood.proximal(f);
  std::int32_t place = 0;  // of the wood turned last
  const auto move_bud = [&](std::size_t b, const Vec3& at) {
    buds[b].at = at, buds[b].place = place;
    buds[b].direction = turned(buds[b].direction, axis, sin, cos);
    buds.origin[b].side = turned(buds.origin[b].side, axis, sin, cos);
    if (tree.input->light) buds[b].sky = tree.input->light->at(at);
  };
  for (std::int32_t i = first; i >= 0; i = in.parts[static_cast<std::size_t>(i)].next) {
    const auto n = static_cast<std::size_t>(i);
    if (i != first) {
      for (int k = 0; k < in.parts[n].buds; ++k) {
        move_bud(static_cast<std::size_t>(in.parts[n].first_bud + k), wood.proximal(n));
      }
    }
    const Vec3 before = wood.distal[n];
    tree.shadow.take_back(before);
    wood.distal[n] = pivot + turned(before - pivot, axis, sin, cos);
    in.parts[n].heading = turned(in.parts[n].heading, axis, sin, cos);
    place = tree.shadow.cast(wood.distal[n]);
    tree.occupancy.move(before, wood.distal[n]);
    ++tree.work.shadow_updates;
    tree.height_m = std::max(tree.height_m, wood.distal[n].y);
    if (in.parts[n].next < 0) move_bud(static_cast<std::size_t>(tree.tip_of[wood.axis[n]]), wood.distal[n]);
  }
}

}  // namespace

bool choose_growing(Tree& tree) {
  Buds& buds = tree.buds;
  const bool painted = !tree.input->markers.empty();  // then buds wait for the next stroke
  const int life = painted ? std::numeric_limits<int>::max() : tree.parameters->bud_life_seasons;
  const auto starve = [&](Bud& b) {
    if (b.state == BudState::lateral) lose_lateral(tree, b.node);
    b.state = BudState::dead;
  };

  // No branch on a bud's state or space, which could not be guessed.
  std::int32_t* const list = tree.enabled.make_room(tree.living.size());
  std::size_t enabled = 0;
  float greatest = 0.0f;
  for (const std::int32_t bud : tree.living) {
    Bud& b = buds[static_cast<std::size_t>(bud)];
    b.flow = b.signal;
    if (b.node >= 0) {
      const Internode& node = tree.internodes[static_cast<std::size_t>(b.node)];
      const std::array<float, 2> share{1.0f, b.signal};
      const Way way = b.state == BudState::terminal ? kMain : kLateral;
      b.flow = node.rate[way] * share[way];
    }
    // The foot of a stem needs no marker: a tree begins even where its region leaves it hardly any room.
    const bool may_grow = (b.claims > 0) | (b.node < 0);
    greatest = larger(greatest, where(may_grow, b.flow));
    list[enabled] = bud, enabled += may_grow;
    b.idle = static_cast<std::uint16_t>(b.idle + !may_grow);
    if (b.idle >= life) starve(b);
  }
  tree.enabled.keep(enabled), tree.greatest_vigor = greatest;

  tree.growing.clear();
  for (const std::int32_t bud : tree.enabled) {
    Bud& b = buds[static_cast<std::size_t>(bud)];
    if (b.claims == 0) claim(tree, bud, b.direction);
    if (const int n = static_cast<int>(tree.vigor_of(b) * longest_shoot(tree, b.order)); n > 0) {
      b.idle = 0;
      tree.growing.push_back({bud, n, 0, b.state == BudState::terminal});
    } else if (++b.idle >= life) {
      starve(b);
    }
  }
  return !tree.growing.empty();
}

void deflect(Tree& tree) {
  const RegionTest in_its_region(tree);
  Buds& buds = tree.buds;
  for (const GrowingBud& g : tree.growing) {
    const auto b = static_cast<std::size_t>(g.bud);
    if (buds[b].state != BudState::lateral) continue;
    const auto carrier = static_cast<std::size_t>(buds.origin[b].carrier);
    const Habit& habit = tree.habit(buds[b].order);
    if (habit.deflection_sin == 0.0f || tree.wood.born[carrier] + 1 != tree.season) continue;
    const Vec3 axis = glm::cross(buds[b].direction, tree.internodes.parts[carrier].heading);
    const float length = std::sqrt(glm::dot(axis, axis));
    if (length < 1e-4f) continue;
    const Vec3 about = axis / length;
    if (turns_out(tree, in_its_region, buds.origin[b].carrier, about, habit.deflection_sin, habit.deflection_cos))
      continue;
    turn_shoot(tree, buds.origin[b].carrier, about, habit.deflection_sin, habit.deflection_cos);
  }
}

bool extend(Tree& tree) {
  const RegionTest in_its_region(tree);
  for (bool first = true; !tree.growing.empty(); first = false) {
    if (!first) compete_again(tree);
    std::size_t kept = 0;
    for (GrowingBud g : tree.growing) {
      if (tree.buds[static_cast<std::size_t>(g.bud)].claims == 0 || !add_metamer(tree, in_its_region, g)) continue;
      ++g.made;
      tree.growing[kept] = g, kept += g.made < g.planned;
    }
    tree.growing.resize(kept);
    if (tree.height_m >= tree.input->max_height_m) return true;
  }
  return false;
}

}  // namespace bosquet::growth
