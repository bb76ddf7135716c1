// Kernels: the factor a standing tree puts on the probability of planting another at a distance from it.
//
// Source    Longay 2014, 6.4.1, eq. 6.1 and 6.2, after Lane and Prusinkiewicz 2002
// Model     r = radius where nothing is planted, a = active radius, s >= 1 = effect, S(x) = 6x^5 - 15x^4 + 10x^3,
//             clustering   K(d) = 1 + (s - 1) * S(1 - (d - r)/(a - r))         for r < d <= a
//             inhibition   K(d) = 1/s + (1 - 1/s) * S((d - r)/(a - r))         for r < d <= a
//             both, none   0 for d <= r, 1 for d > a (none: for d > r)
// Erratum   eq. 6.2 prints 1 - 1/s + S/s, by which s = 1 inhibits totally and a large s not at all, against the text
//           and against eq. 6.1. A value of the printed form: s_printed = s / (s - 1)
// Decision  where kernels overlap they multiply, clustering up to the largest s acting on the species (the source
//           multiplies without end, by which one cluster soon takes every tree), inhibition without such a limit
// Holds     at the edge of the trunk K is s (clustering) and 1/s (inhibition); s = 1 is no effect
// Units     metres; K and s dimensionless
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/parameter.h"

namespace bosquet::distribution {

enum class KernelKind { none, clustering, inhibition };

inline constexpr std::array<std::string_view, 3> kKernelKindNames{"none", "clustering", "inhibition"};

/// What trees of one species do to the planting of another (or of their own).
struct Interaction {
  std::string of, on;  ///< species names: of the standing trees, and of those to be planted
  KernelKind kind = KernelKind::none;
  float active_radius_m = 5.0f;
  float effect = 4.0f;

  bool operator==(const Interaction&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, Interaction>
void describe(P& p, Visitor& visit) {
  visit(Text{"of", "Species of the standing trees"}, p.of);
  visit(Text{"on", "Species of the trees that are planted near them"}, p.on);
  visit(Choice{"kind", kKernelKindNames, "Whether they draw those near or keep them away"}, p.kind);
  visit(Real{"active_radius_m", "m", 0.1, 1000, "Distance from a trunk's centre at which the effect ends"},
        p.active_radius_m);
  visit(
      Real{"effect", "", 1, 1000, "How many times likelier, or less likely, planting is at the trunk; 1 is no effect"},
      p.effect);
}

/// K(distance); 1 beyond the active radius. An active radius not above `trunk_radius_m` acts as `none`.
float kernel(KernelKind kind, float trunk_radius_m, float active_radius_m, float effect, float distance_m);

/// |log2 K| over x = (d - r)/(a - r), as probability fields store it: in steps of 2^-kLogBits, entry n for
/// x = (n + 1/2) / kKernelSteps and the last entry 0, for everything beyond. Fields count clustering and inhibition
/// apart, so that neither hides the other.
inline constexpr int kKernelSteps = 512;
inline constexpr int kLogBits = 10;
struct KernelTable {
  bool clustering = false;
  std::array<std::uint32_t, kKernelSteps + 1> steps{};
};
KernelTable log2_kernel_table(KernelKind kind, float effect);

}  // namespace bosquet::distribution
