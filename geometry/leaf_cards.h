// Leaf cards: textured quads, flat or folded along their middle, written into one mesh.
//
// Decision  cards are wound so that their front looks out of the crown, and normals are bent outward likewise:
//           renderers that turn normals on back faces (glTF, double sided) then shade a crown as a soft volume
// Decision  a card seen edge-on from outside shows both its sides there: its normals stay its own, or one side would be
//           black
// Units     metres, tree frame
#pragma once

#include <cstdint>
#include <span>

#include "core/triangle_mesh.h"
#include "geometry/foliage.h"
#include "geometry/leaf_atlas.h"
#include "geometry/vec_lanes.h"

namespace bosquet::geometry {

/// The open side of the crown: the gradient of an ellipsoid as wide and high as the foliage, and a little upward, where
/// the light is.
class Crown {
 public:
  Crown(const growth::Skeleton& skeleton, std::span<const LeafSite> sites);
  Vec3 outward(const Vec3& p) const { return unit(unit((p - centre_) * curvature_, kUp) + 0.35f * kUp, kUp); }

 private:
  Vec3 centre_, curvature_;
};

/// One card: its foot's middle at `foot`, `length` along `heading`.
struct LeafCard {
  Vec3 foot, heading, up;
  Vec3 left, right;  ///< from the midline to the edges; opposite on a flat card
  float length = 0, half_width = 0;
  AtlasCell uv;
  Rgba8 colour;
};

/// Up to four flat cards over which the crown's outward direction `out` does not change.
struct SmallCards {
  Vec3x4 foot, heading, left, up;
  Float4 length, half_width;
  AtlasCell uv[4];
  Rgba8 colour[4];
  int count = 0;
  bool still[4]{};  ///< does not flutter; read only where there is wind
};

class CardWriter {
 public:
  /// For so many triangles and vertices in all. `soft`: how far normals are bent outward. `windy`: cards get weights.
  CardWriter(const Crown& crown, float soft, std::size_t triangles, std::size_t vertices, bool windy);

  /// Weights of the foot of all cards that follow (wind.h); their far ends flutter.
  void set_wind(Rgba8 at_foot) { wind_ = at_foot; }

  void add_flat(const LeafCard& card);    ///< 4 vertices
  void add_folded(const LeafCard& card);  ///< 6 vertices
  void add(const SmallCards& cards, const Vec3& out);

  /// The mesh; everything announced must have been added.
  TriangleMesh take();

 private:
  struct Spread {
    Vec3 to_top, left, right;  ///< from the foot's middle
    bool front;                ///< its upper side looks out of the crown
    float soft;                ///< how much of its normals is the crown's
  };
  Spread spread(const LeafCard& card) const;
  void corner(const Vec3& position, const Vec3& normal, float u, float v, Rgba8 colour);
  void strip(std::uint32_t first, std::uint32_t row, bool front);
  void weigh(std::uint32_t first, std::uint32_t row, bool flutters);

  const Crown& crown_;
  float soft_;
  bool windy_;
  Rgba8 wind_{0};
  TriangleMesh mesh_;
  std::size_t vertex_ = 0, index_ = 0;
};

}  // namespace bosquet::geometry
