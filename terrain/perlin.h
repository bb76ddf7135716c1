// Perlin noise: the slight unevenness of ground that starts flat.
//
// Source    Perlin 2002, "Improving noise" (gradient noise, fade 6t^5 - 15t^4 + 10t^3); Longay 2014, 6.3
// Model     sum over octaves o of 2^-o * noise(plan * 2^o / scale_m), gradients hashed from (seed, octave, corner),
//           scaled so that |height| <= amplitude_m
// Units     metres
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "core/parameter.h"
#include "core/vec.h"
#include "terrain/heightfield.h"

namespace bosquet::terrain {

struct PerlinNoise {
  float amplitude_m = 0.3f;
  float scale_m = 20.0f;
  int octaves = 4;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, PerlinNoise>
void describe(P& p, Visitor& visit) {
  visit(Real{"amplitude_m", "m", 0, 1000, "Largest height the noise adds or takes away"}, p.amplitude_m);
  visit(Real{"scale_m", "m", 0.5, 100000, "Distance between its largest bumps"}, p.scale_m);
  visit(Whole{"octaves", 1, 12, "Number of layers, each half as high and half as wide as the one before"}, p.octaves);
}

/// Height of the noise at a plan position.
float perlin_height(const PerlinNoise& noise, std::uint64_t seed, Vec2 plan);

/// The field with noise added to every sample.
Heightfield with_noise(const Heightfield& field, const PerlinNoise& noise, std::uint64_t seed);

}  // namespace bosquet::terrain
