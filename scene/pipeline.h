// Pipeline: from snapshots of a document to its grown trees and their meshes, in the background.
//
// Model     one worker takes the newest snapshot, brings the surroundings of its trees up to date (surroundings.h), and
//           grows and meshes the trees that this touched, in parallel, the edited ones first, then those nearest to the
//           view; whoever draws takes what is finished whenever it likes and never waits
// Decision  a newer snapshot does not break off a tree that is growing, since its growth may be wanted still and would be
//           lost again and again while somebody drags; beyond the first few no more trees are begun, and the newer
//           snapshot takes over. A snapshot that never gets its turn is skipped
// Decision  everything derived is found again by a hash of what it was made from: skeletons in a SkeletonCache, meshes in
//           a cache of their own. Both keep to their share of memory; what was used longest ago goes first
// Decision  a mesh has as many triangles as the view needs, in levels: kNearestTriangles for a tree that is as high as
//           its distance, a third of that for each doubling of the distance, three times as many for one nearer than half
//           its height, more where `fineness` asks for it; never more than kMostTriangles
// Decision  trees to be removed are not grown, and take no room
// Holds     the scene that grow_scene() makes of the last snapshot, bit for bit, once idle() is true, whatever came before
// Threads   all members may be called from any thread; the work runs at nice 10 (core/background.h)
// Errors    a crown space too large, obstacles that cannot be voxelised: in status(), and the snapshot's scene is not made
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "geometry/foliage.h"
#include "geometry/season.h"
#include "scene/document.h"
#include "scene/surroundings.h"
#include "scene/tree_growth.h"

namespace bosquet::scene {

inline constexpr std::size_t kNearestTriangles = 60'000, kFarthestTriangles = 240, kMostTriangles = 150'000;

struct PipelineOptions {
  SpaceStages stages;
  float detail = 1.0f;
  std::optional<float> year;  ///< show every tree at this age
  bool meshes = true;
  geometry::Season season = geometry::Season::summer;
  geometry::FoliageLevel foliage = geometry::FoliageLevel::clusters;
  int threads = 0;  ///< 0: one per core
  std::size_t skeleton_bytes = SkeletonCache::kDefaultBytes;
  std::size_t mesh_bytes = std::size_t{512} << 20;
  float fineness = 1.0f;  ///< times the usual triangles, up to kMostTriangles a tree
};

/// From where the scene is looked at.
struct View {
  Vec3 eye{0.0f};  ///< world

  bool operator==(const View&) const = default;
};

/// Bark and leaves of one tree, in tree frame.
struct TreeMeshes {
  TriangleMesh branches, leaves;
  geometry::FoliageLevel foliage = geometry::FoliageLevel::clusters;  ///< what the leaves became

  std::size_t bytes() const;
};

/// One tree as it is now. A tree that only rises or sinks with the ground, or comes nearer, is told again too.
struct FinishedTree {
  std::int32_t id = 0;
  bool gone = false;           ///< it is no more (or to be removed); then there is nothing else
  std::uint64_t snapshot = 0;  ///< of which it is
  Tree tree;
  Vec3 base{0.0f};  ///< world
  GrownTree grown;
  std::shared_ptr<const TreeMeshes> meshes;  ///< null when meshes are off
};

struct PipelineStatus {
  std::uint64_t snapshot = 0;  ///< the newest that was given
  bool busy = false;
  const char* stage = "";             ///< "crown regions" or "trees"
  std::size_t done = 0, total = 0;    ///< trees of this snapshot
  std::optional<Error> error;         ///< of the newest snapshot
  std::vector<std::string> warnings;  ///< likewise
};

class Pipeline {
 public:
  explicit Pipeline(const PipelineOptions& options = {});
  /// Breaks off what is growing.
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// The document as it is from now on; returns the snapshot's number. Does not wait.
  std::uint64_t set_document(std::shared_ptr<const Document> document, const View& view);
  /// Another view of the same document: meshes get other levels, and what is left to grow another order.
  void set_view(const View& view);
  /// Other options: what they concern is made anew.
  void set_options(const PipelineOptions& options);

  /// What was finished since it was last asked for, at most `most` trees. Does not wait.
  std::vector<FinishedTree> take_finished(std::size_t most = static_cast<std::size_t>(-1));

  PipelineStatus status() const;
  bool idle() const;
  /// Waits until everything of the newest snapshot is finished, or it failed.
  void wait() const;

  /// What the trees of the last finished snapshot are to each other: for views of regions and arrows. Null before.
  std::shared_ptr<const Surroundings> surroundings() const;
  /// Of all skeletons of the last finished snapshot, as GrownScene::skeleton_digest.
  std::uint64_t skeleton_digest() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Triangles for a tree of `height_m` seen from `distance_m`.
std::size_t triangles_seen(float height_m, float distance_m, float fineness = 1.0f);

}  // namespace bosquet::scene
