#include "exchange/plan_symbols.h"

#include <ogr_geometry.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>

namespace bosquet::exchange {
namespace {

constexpr double kTurn = 6.283185307179586;

/// Greens, olives and ochres that stay apart in print.
constexpr std::array<Vec3, 10> kTints{{{0.55f, 0.71f, 0.42f},
                                       {0.36f, 0.58f, 0.47f},
                                       {0.78f, 0.76f, 0.40f},
                                       {0.45f, 0.62f, 0.66f},
                                       {0.66f, 0.55f, 0.36f},
                                       {0.72f, 0.83f, 0.58f},
                                       {0.82f, 0.62f, 0.47f},
                                       {0.47f, 0.52f, 0.33f},
                                       {0.68f, 0.60f, 0.72f},
                                       {0.60f, 0.78f, 0.72f}}};

bool needles(const scene::Species& species) { return geometry::is_needle(species.look.leaf.outline); }

/// Factor of a pattern at `turn` (0 to 1 around the crown) with `lobes` of them around.
double pattern_factor(CrownPattern pattern, double turn, int lobes) {
  const double phase = turn * lobes - std::floor(turn * lobes);  // 0 at one cusp to 1 at the next
  const double arch = 4.0 * phase * (1.0 - phase);               // 0 at cusps, 1 between
  switch (pattern) {
    case CrownPattern::plain:
      return 1.0;
    case CrownPattern::scalloped:
      return 0.93 + 0.07 * std::sqrt(arch);
    case CrownPattern::lobed:
      return 0.88 + 0.12 * std::sqrt(arch);
    case CrownPattern::wavy:
      return 0.96 + 0.04 * std::sin(kTurn * phase);
    case CrownPattern::spiny:
      return phase < 0.5 ? 1.0 - 0.36 * phase : 0.64 + 0.36 * phase;
  }
  return 1.0;
}

}  // namespace

double CrownOutline::mean() const {
  return std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(kDirections);
}

CrownOutline round_outline(double diameter_m) {
  CrownOutline crown;
  crown.radius.fill(0.5 * diameter_m);
  return crown;
}

CrownOutline crown_outline(const growth::Skeleton& wood, int season) {
  const int last = season < 0 ? wood.seasons : season;
  std::vector<DVec2> ends;
  DVec2 low(1e30), high(-1e30);
  for (std::size_t i = 0; i < wood.size(); ++i) {
    if (!wood.alive_at(i, last)) continue;
    ends.emplace_back(to_plan(wood.distal[i]));
    low = glm::min(low, ends.back()), high = glm::max(high, ends.back());
  }
  CrownOutline crown;
  if (ends.empty()) return crown;
  crown.middle = 0.5 * (low + high);
  for (const DVec2& end : ends) {
    const DVec2 out = end - crown.middle;
    const double turn = std::atan2(out.y, out.x) / kTurn + 1.0;
    const auto k = static_cast<std::size_t>(turn * CrownOutline::kDirections + 0.5) % CrownOutline::kDirections;
    crown.radius[k] = std::max(crown.radius[k], std::sqrt(glm::dot(out, out)));
  }
  // A crown is leafy between its longest branches: gaps are filled up to their neighbours, then all is smoothed.
  const std::size_t n = CrownOutline::kDirections;
  const double least = 0.35 * *std::max_element(crown.radius.begin(), crown.radius.end());
  std::array<double, CrownOutline::kDirections> full{};
  for (std::size_t k = 0; k < n; ++k)
    full[k] = std::max({least, crown.radius[k], 0.5 * (crown.radius[(k + 1) % n] + crown.radius[(k + n - 1) % n])});
  for (std::size_t k = 0; k < n; ++k)
    crown.radius[k] = 0.5 * full[k] + 0.25 * (full[(k + 1) % n] + full[(k + n - 1) % n]);
  return crown;
}

std::vector<DVec2> form_outline(const crowns::ClippedForm& form) {
  const double turn = static_cast<double>(form.rotation_deg) * kTurn / 360.0;
  const DVec2 along(std::cos(turn), std::sin(turn)), across(-along.y, along.x);
  const double a = 0.5 * static_cast<double>(form.width_m), b = 0.5 * static_cast<double>(form.depth_m);
  std::vector<DVec2> ring;
  if (form.kind == crowns::FormKind::box || form.kind == crowns::FormKind::panel) {
    for (const auto& [u, v] : {std::pair{-a, -b}, {a, -b}, {a, b}, {-a, b}})
      ring.push_back(DVec2(form.centre) + u * along + v * across);
  } else {
    constexpr int kPoints = 48;
    for (int k = 0; k < kPoints; ++k) {
      const double at = kTurn * k / kPoints;
      ring.push_back(DVec2(form.centre) + a * std::cos(at) * along + b * std::sin(at) * across);
    }
  }
  return ring;
}

SpeciesSymbol species_symbol(const scene::Species& species, std::size_t place) {
  constexpr CrownPattern kLeafy[] = {CrownPattern::plain, CrownPattern::scalloped, CrownPattern::wavy,
                                     CrownPattern::lobed};
  SpeciesSymbol symbol;
  symbol.pattern = needles(species) ? CrownPattern::spiny : kLeafy[place % 4];
  symbol.ring = place / 4 % 3 == 1;
  symbol.spokes = place / 4 % 3 == 2;
  symbol.tint = kTints[place % kTints.size()];
  return symbol;
}

std::vector<std::vector<DVec2>> symbol_lines(const CrownOutline& crown, const SpeciesSymbol& symbol, DVec2 base,
                                             double finest_m) {
  const double mean = crown.mean();
  // Features of about the same size on crowns of every size, and none too small to be seen.
  const double feature_m = std::max({2.5 * finest_m, 0.3 * mean});
  const int lobes = std::clamp(static_cast<int>(kTurn * mean / feature_m + 0.5), 6, 28);
  const int points = lobes * 8;
  const auto radius = [&](double turn) {
    const double at = turn * CrownOutline::kDirections;
    const auto k = static_cast<std::size_t>(at) % CrownOutline::kDirections;
    return glm::mix(crown.radius[k], crown.radius[(k + 1) % CrownOutline::kDirections], at - std::floor(at));
  };
  const auto at = [&](double turn, double share) {
    return base + crown.middle + share * radius(turn) * DVec2(std::cos(kTurn * turn), std::sin(kTurn * turn));
  };
  std::vector<std::vector<DVec2>> lines(1);
  for (int k = 0; k < points; ++k) {
    const double turn = static_cast<double>(k) / points;
    lines[0].push_back(at(turn, pattern_factor(symbol.pattern, turn, lobes)));
  }
  if (mean < 4.0 * finest_m) return lines;
  if (symbol.ring) {
    auto& ring = lines.emplace_back();
    for (int k = 0; k <= 48; ++k) ring.push_back(at(static_cast<double>(k % 48) / 48.0, 0.72));
  }
  if (symbol.spokes)
    for (int k = 0; k < 12; ++k) {
      const double turn = static_cast<double>(k) / 12.0;
      lines.push_back({at(turn, 0.55), at(turn, pattern_factor(symbol.pattern, turn, lobes))});
    }
  return lines;
}

std::vector<std::vector<DVec2>> joined(const std::vector<std::vector<DVec2>>& outlines) {
  OGRMultiPolygon all;
  for (const auto& outline : outlines) {
    OGRLinearRing ring;
    for (const DVec2& p : outline) ring.addPoint(p.x, p.y);
    ring.closeRings();
    OGRPolygon polygon;
    polygon.addRing(&ring);
    all.addGeometry(&polygon);
  }
  const std::unique_ptr<OGRGeometry> merged(all.UnionCascaded());
  std::vector<std::vector<DVec2>> rings;
  const auto take = [&](const OGRPolygon& polygon) {
    for (const OGRLinearRing* ring : polygon) {
      auto& out = rings.emplace_back();
      for (int k = 0; k + 1 < ring->getNumPoints(); ++k) out.emplace_back(ring->getX(k), ring->getY(k));
    }
  };
  if (!merged) return outlines;  // a GDAL without GEOS
  if (const auto type = wkbFlatten(merged->getGeometryType()); type == wkbPolygon) {
    take(*merged->toPolygon());
  } else if (type == wkbMultiPolygon) {
    for (const OGRPolygon* polygon : *merged->toMultiPolygon()) take(*polygon);
  }
  return rings;
}

std::vector<std::string> species_codes(const std::vector<std::string>& botanical_names) {
  std::vector<std::string> codes;
  std::set<std::string> taken;
  for (const std::string& name : botanical_names) {
    std::size_t space = name.find(' ');
    // A cross between them tells a hybrid: "Platanus x hispanica".
    for (const std::string_view cross : {" x ", " × "})
      if (space != std::string::npos && name.compare(space, cross.size(), cross) == 0) space += cross.size() - 1;
    const std::string second =
        space == std::string::npos ? name.substr(std::min<std::size_t>(1, name.size())) : name.substr(space + 1);
    std::string letters;
    for (const char c : second)
      if (std::isalpha(static_cast<unsigned char>(c))) letters += c;
    std::string code(1, name.empty() ? '?' : static_cast<char>(std::toupper(static_cast<unsigned char>(name[0]))));
    for (std::size_t n = 1; n <= letters.size(); ++n) {
      code += static_cast<char>(std::toupper(static_cast<unsigned char>(letters[n - 1])));
      if (!taken.count(code)) break;
    }
    for (int number = 2; taken.count(code); ++number) code = code.substr(0, 2) + std::to_string(number);
    taken.insert(code);
    codes.push_back(code);
  }
  return codes;
}

}  // namespace bosquet::exchange
