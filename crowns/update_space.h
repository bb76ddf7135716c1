// Space update: the division after an edit, from the one before it, with only what the edit can affect divided anew.
//
// Model     a voxel's time rests on voxels of the same tree alone (propagation.h). So in one layer let S be a set of
//           trees that holds all that were edited, and divide their voxels and the free ones among S, with every other
//           tree held. If no tree outside S touches what an edited tree, or one of S whose region changed, had or has
//           now, then trees outside S offer no voxel anything new and are offered nothing: together with theirs it is a
//           solution, and there is but one. Else the touching trees join S and the layer is divided again. S starts as
//           the edited trees with two rings of neighbours, which is mostly enough
// Holds     equal to divide_space() of the same input, owner and tick for every voxel, for any sequence of edits
// Ground    where its heights are others, columns begin at other layers: what they lose is as if an obstacle came there,
//           what they gain as if one went
// Condition beyond `reshaped` the ground is the one that `previous` was divided over, and trees keep their ids
// Cost      follows the edited trees and their neighbours (3-20 ms for a tree of 7 m), plus a sort over all trees. Arrival
//           times need not be kept
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/result.h"
#include "crowns/asymmetry.h"
#include "crowns/crown_space.h"

namespace bosquet::crowns {

struct SpaceUpdate {
  CrownSpace space;
  std::vector<std::size_t> changed;  ///< claimants, rising, that were added or edited or whose voxels are others now
  bool whole = false;                ///< all was divided anew, as the lattice or the options are others
  /// Claimants that came, went or changed in more than the height they stand at, as they were and as they are.
  std::vector<Claimant> edits;
  std::vector<Box2> obstacle_edits;  ///< plan bounds of obstacles that came, went or changed
  std::vector<Box2> reshaped;        ///< where heights and slopes of the ground may be others
};

/// Ground that is another than the one `previous` was divided over.
struct Reshaped {
  const terrain::Terrain* before = nullptr;  ///< that one; null when the ground is the same
  std::vector<Box2> where;                   ///< as terrain::reshaped
};

/// `trees` and `standing` are all there are after the edit; what differs from `previous` is found here.
Result<SpaceUpdate> update_space(const CrownSpace& previous, std::span<const Claimant> trees, const Standing& standing,
                                 const terrain::Terrain& terrain, const SpaceOptions& options,
                                 const Reshaped& reshaped = {});

/// V of every claimant after an update, from those of `previous`: equal to neighbourhood_asymmetry(). `changed` gets the
/// claimants, rising, whose V is another now or that were not there before.
std::vector<Vec3> update_asymmetry(const CrownSpace& previous, std::span<const Vec3> before, const SpaceUpdate& update,
                                   const AsymmetryOptions& options, const terrain::Terrain* terrain,
                                   std::vector<std::size_t>* changed = nullptr);

}  // namespace bosquet::crowns
