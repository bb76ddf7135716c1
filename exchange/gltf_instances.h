// glTF instances: leaves that are copies of a few cards, found again in a baked mesh.
//
// Model     a mesh of foliage is a run of small pieces that share no vertices. Each piece is put into a frame of its own
//           (origin at its first vertex, x toward the farthest, in units of their distance); pieces with the same
//           triangles, texture coordinates and vertices there are instances of one card
//             p = place + size * turn(card's p)
// Decision  a card's normals are the mean over the instances of the mesh that shows it first, turned into its frame: an
//           instance has none of its own, so the softness that a baked crown's normals have is lost in part
// Decision  pieces are found, not handed over by the stage that makes leaves, so whatever it makes of similar cards is
//           instanced; a mesh whose pieces are of too many kinds stays as it is
// Units     metres; turn a unit quaternion (x, y, z, w); colour multiplies, as the vertices'
// Holds     the vertices come back within 2 kSameShape of a piece's length; each piece is one instance; the same bits for
//           any number of threads
// Cost      one pass over a mesh; 36 bytes an instance
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/triangle_mesh.h"

namespace bosquet::exchange {

inline constexpr float kSameShape = 1e-3f;

struct Instance {
  Vec3 place{0.0f};
  Vec4 turn{0.0f, 0.0f, 0.0f, 1.0f};
  float size = 1.0f;
  Rgba8 colour{255};
};

/// Copies of one card.
struct InstancedCard {
  std::shared_ptr<const TriangleMesh> card;  ///< without colours, 1 m long
  std::vector<Instance> instances;           ///< in the order of the mesh
};

/// The cards of a mesh, or nothing when it is no mesh of a few similar pieces.
std::optional<std::vector<InstancedCard>> find_instances(const TriangleMesh& mesh);

/// Lets lists share the cards that are alike: of each kind the first one stays. Call it in a fixed order.
class CardStock {
 public:
  void share(std::vector<InstancedCard>& found);

 private:
  std::vector<std::shared_ptr<const TriangleMesh>> cards_;
};

}  // namespace bosquet::exchange
