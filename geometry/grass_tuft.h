// Grass tuft: a handful of bent blades, and the picture that all of them are coloured by.
//
// Model     a blade is a strip of three triangles: from its foot it rises to a bend past the middle and hangs over outward.
//           A meadow's tufts have stalks with seed heads or flowers among them, as the season has it
// Units     a tuft is 1 high: to be scaled to the grass's height, with the widths
// Frame     the foot's middle is the origin, +y up; all normals are up, so that grass is lit as the ground it grows on
// Colour    the picture has a column for each part, foot at the bottom. Blades and seed heads hold their colour as a share of
//           1 / kTuftTone of the ground's (a tuft's own factor is kTuftTone times the ground's albedo: then tufts and ground
//           have one tone); flowers and their stalks hold albedos, their factor is 1
// Holds     at most kTuftVertices vertices, of which the first triangle has the first and the last, so that
//           exchange/gltf_instances.h sees one piece; the same bits anywhere
#pragma once

#include <cstdint>

#include "core/image.h"
#include "core/triangle_mesh.h"
#include "geometry/season.h"

namespace bosquet::geometry {

/// Shapes by number: those of lawns, of meadow grass, of meadow grass with seed heads, of flowers.
inline constexpr int kLawnShapes = 3, kMeadowShapes = 3, kSeedShapes = 2, kFlowerShapes = 3;
inline constexpr int kFirstMeadow = kLawnShapes, kFirstSeed = kFirstMeadow + kMeadowShapes,
                     kFirstFlower = kFirstSeed + kSeedShapes, kTuftShapes = kFirstFlower + kFlowerShapes;

inline constexpr std::size_t kTuftVertices = 64;
inline constexpr float kTuftTone = 2.0f;

/// `shape` from 0 to kTuftShapes - 1.
TriangleMesh grass_tuft(int shape);

Image grass_picture(Season season);

}  // namespace bosquet::geometry
