// Region test: may something stand here, for all that a tree's crown region says?
//
// Frame     tree frame, metres
// Holds     the region's numbers, ready for many places; the tree's input must outlive the use. All is open without a region
// Decision  a region has no lid: above the tree's height its last layer counts, for growth ends there anyway, and a tip that
//           sees no room just below would only be late
#pragma once

#include <limits>

#include "crowns/crown_region.h"
#include "growth/lanes.h"
#include "growth/tree.h"

namespace bosquet::growth {

class RegionTest {
 public:
  explicit RegionTest(const Tree& tree) : region_(tree.input->region) {
    if (!region_) return;
    low_ = lanes(region_->low);
    edge_ = Float4{region_->voxel_m, region_->layer_m, region_->voxel_m, 1.0f};
    end_ = Float4{static_cast<float>(region_->cells.x), static_cast<float>(region_->cells.y),
                  static_cast<float>(region_->cells.z), 1.0f};
    lid_ = all4(std::numeric_limits<float>::max());
    lid_[1] = tree.input->max_height_m - region_->layer_m;
  }
  bool operator()(Float4 p) const {
    if (!region_) return true;
    p = lid_ < p ? lid_ : p;
    const Float4 q = (p - low_) / edge_;
    const bool inside = all((q >= all4(0.0f)) & (q < end_));
    const Int4 c = whole(inside ? q : all4(0.0f));
    return inside & region_->voxel({c[0], c[1], c[2]});
  }
  bool operator()(const Vec3& p) const { return (*this)(lanes(p)); }

 private:
  const crowns::CrownRegion* region_;
  Float4 low_{}, edge_{}, end_{}, lid_{};
};

}  // namespace bosquet::growth
