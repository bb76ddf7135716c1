#include "scene/pipeline.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <list>
#include <map>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>

#include "core/background.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "geometry/tree_mesh.h"
#include "growth/digest.h"
#include "growth/radii.h"
#include "scene/changes.h"
#include "scene/grown_scene.h"
#include "scene/hash_cache.h"

namespace bosquet::scene {
namespace {

/// Hash of described values.
struct ValueHash {
  Hasher& hasher;
  template <class Info, class Value>
  void operator()(const Info&, const Value& v) {
    if constexpr (std::is_enum_v<Value>)
      hasher.add(static_cast<int>(v));
    else if constexpr (std::is_same_v<Value, std::string>)
      hasher.add(std::string_view(v));
    else
      hasher.add(v);
  }
};

std::uint64_t look_hash(const Species& species) {
  Hasher hasher;
  ValueHash visit{hasher};
  describe(species.look, visit);
  geometry::describe_foliage(species.foliage, visit);
  return hasher.digest();
}

// So many trees are grown of every snapshot that gets its turn, however fast the next one comes: what somebody drags
// goes along.
constexpr std::size_t kAtLeast = 4;

/// What is kept of a tree from snapshot to snapshot.
struct Record {
  bool dirty = true;                   ///< it, or something that it hangs on, may be another
  bool edited = true;                  ///< somebody changed the tree itself, and has not seen it since
  std::uint64_t inputs = 0, mesh = 0;  ///< hashes that grown and meshes were made from; 0 none
  std::size_t triangles = 0;
  GrownTree grown;
  std::shared_ptr<const TreeMeshes> meshes;
  std::string warning;
};

struct Snapshot {
  std::shared_ptr<const Document> document;
  View view;
  PipelineOptions options;
  std::uint64_t number = 0;
};

}  // namespace

std::size_t TreeMeshes::bytes() const {
  const auto of = [](const TriangleMesh& m) {
    return m.positions.size() * sizeof(Vec3) + m.normals.size() * sizeof(Vec3) + m.uvs.size() * sizeof(Vec2) +
           m.colours.size() * sizeof(Rgba8) + m.indices.size() * sizeof(std::uint32_t);
  };
  return sizeof *this + of(branches) + of(leaves);
}

std::size_t triangles_seen(float height_m, float distance_m, float fineness) {
  std::size_t triangles = distance_m < 0.5f * height_m ? 3 * kNearestTriangles : kNearestTriangles;
  for (float d = height_m; d < distance_m && triangles > kFarthestTriangles; d *= 2.0f) triangles /= 3;
  const auto wanted = static_cast<std::size_t>(fineness * static_cast<float>(triangles));
  return std::clamp(wanted, kFarthestTriangles, kMostTriangles);
}

struct Pipeline::State {
  explicit State(const PipelineOptions& given) : skeletons(given.skeleton_bytes), meshes(given.mesh_bytes) {
    wanted.options = given;
  }

  // Between whoever asks and the worker, under the mutex.
  mutable std::mutex mutex;
  std::condition_variable wake;
  mutable std::condition_variable rest;
  Snapshot wanted;
  std::uint64_t done = 0;  ///< the newest snapshot that was worked on
  bool stop = false;
  std::list<FinishedTree> finished;
  std::unordered_map<std::int32_t, std::list<FinishedTree>::iterator> finished_at;
  std::shared_ptr<const Surroundings> around;
  std::vector<std::shared_ptr<const growth::Skeleton>> all_skeletons;  ///< of the last finished snapshot
  std::optional<Error> error;
  std::vector<std::string> warnings;

  std::atomic<std::uint64_t> newest{0};
  Progress progress;

  // The worker's own.
  SkeletonCache skeletons;
  HashCache<TreeMeshes> meshes;
  StandingKeeper standing;
  std::optional<Document> document;  ///< without trees to be removed; that of `around`
  View view;
  PipelineOptions options;
  std::unordered_map<std::int32_t, Record> records;
  std::map<std::shared_ptr<const Species>, std::uint64_t> looks;
  std::vector<std::string> space_notes;
  std::thread worker;

  bool superseded(const Snapshot& job) const { return newest.load() != job.number || progress.cancelled(); }

  void deliver(FinishedTree tree) {
    const std::lock_guard lock(mutex);
    const auto [at, added] = finished_at.try_emplace(tree.id);
    if (!added) finished.erase(at->second);
    finished.push_back(std::move(tree));
    at->second = std::prev(finished.end());
  }

  void loop() {
    for (;;) {
      Snapshot job;
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [&] { return stop || done != wanted.number; });
        if (stop) return;
        job = wanted;
      }
      std::optional<Error> failed;
      run_in_background(job.options.threads, [&] { failed = process(job); });
      const std::lock_guard lock(mutex);
      done = job.number;
      error = std::move(failed);
      warnings = space_notes;
      for (const auto& [id, record] : records)
        if (!record.warning.empty()) warnings.push_back(record.warning);
      if (done == wanted.number) rest.notify_all();
    }
  }

  std::optional<Error> process(const Snapshot& job) {
    if (auto failed = surround_trees(job)) return failed;
    if (superseded(job)) return std::nullopt;
    grow_trees(job);
    if (superseded(job)) return std::nullopt;
    std::vector<std::shared_ptr<const growth::Skeleton>> all;
    for (const Tree& tree : *document->trees) all.push_back(records.at(tree.id).grown.skeleton);
    const std::lock_guard lock(mutex);
    all_skeletons = std::move(all);
    return std::nullopt;
  }

  void mark_all() {
    for (auto& [id, record] : records) record.dirty = true;
  }

  // Brings `document`, `around` and the records' marks up to the snapshot.
  std::optional<Error> surround_trees(const Snapshot& job) {
    progress.begin("crown regions", 0);
    Document now = without_removed(*job.document);
    std::shared_ptr<const Surroundings> then;
    {
      const std::lock_guard lock(mutex);
      then = around;
    }
    std::vector<std::string> notes;
    std::vector<std::size_t> touched;
    Changes by;
    std::shared_ptr<const Surroundings> next;
    if (!document || !then || then->stages != job.options.stages) {
      auto whole = surround(now, job.options.stages, standing, notes, nullptr, &progress);
      if (!whole) return whole.error();
      next = std::make_shared<const Surroundings>(std::move(*whole));
      if (document) by = changes(*document, now);
      mark_all();
    } else {
      by = changes(*document, now);
      const bool moved = by.trees() || !by.species.empty() || by.fewer_species || by.obstacles || by.heroes ||
                         by.space || by.asymmetry || by.light || !by.ground.height.empty();
      if (moved) {
        auto update = update_surroundings(*then, *document, now, standing, notes, &progress);
        if (!update) return update.error();
        touched = std::move(update->touched);
        next = std::make_shared<const Surroundings>(std::move(update->now));
      } else {
        next = then;
        notes = space_notes;
      }
    }

    for (std::int32_t id : by.removed) {
      if (records.erase(id) == 0) continue;
      FinishedTree gone;
      gone.id = id, gone.gone = true, gone.snapshot = job.number;
      deliver(std::move(gone));
    }
    const Trees& trees = *now.trees;
    for (std::size_t i : touched) records[trees[i].id].dirty = true;
    for (const std::vector<std::int32_t>* ids : {&by.added, &by.changed})
      for (std::int32_t id : *ids) records[id].dirty = records[id].edited = true;
    for (std::size_t s : by.species)
      for (const Tree& tree : trees)
        if (tree.species == s) records[tree.id].dirty = true;
    const PipelineOptions& o = job.options;
    const bool other_look = o.detail != options.detail || o.year != options.year || o.meshes != options.meshes ||
                            o.season != options.season || o.foliage != options.foliage;
    if (by.site || other_look) mark_all();
    // Trees rise and sink with the ground under them.
    if (document && !by.ground.height.empty())
      for (const Tree& tree : trees)
        if (document->terrain->ground(tree.at) != now.terrain->ground(tree.at)) records[tree.id].dirty = true;

    document = std::move(now);
    options = job.options;
    space_notes = std::move(notes);
    const std::lock_guard lock(mutex);
    around = std::move(next);
    return std::nullopt;
  }

  Vec3 base_of(const Tree& tree) const { return to_world(tree.at, document->terrain->ground(tree.at)); }

  struct Task {
    std::size_t index;
    const Tree* tree;
    Record* record;
    Vec3 base;
    float distance;
    std::size_t triangles;
  };

  void grow_trees(const Snapshot& job) {
    std::shared_ptr<const Surroundings> there;
    {
      const std::lock_guard lock(mutex);
      there = around;
    }
    std::vector<Task> tasks;
    std::size_t index = 0;
    for (const Tree& tree : *document->trees) {
      Record& record = records[tree.id];
      const float height = document->mature_height_m(tree);
      const Vec3 base = base_of(tree);
      const float distance = glm::length(base + 0.5f * height * kUp - job.view.eye);
      const std::size_t triangles = triangles_seen(height, distance, job.options.fineness);
      if (job.options.meshes && record.triangles != triangles) record.dirty = true;
      if (record.dirty) tasks.push_back({index, &tree, &record, base, distance, triangles});
      ++index;
    }
    std::stable_sort(tasks.begin(), tasks.end(), [](const Task& a, const Task& b) {
      return a.record->edited != b.record->edited ? a.record->edited : a.distance < b.distance;
    });
    std::vector<float> order(tasks.size());
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = -static_cast<float>(n);
    std::vector<std::uint64_t> look(document->species.size());
    decltype(looks) kept;
    for (std::size_t s = 0; s < look.size(); ++s) {
      const auto& species = document->species[s];
      const auto known = looks.find(species);
      look[s] = kept[species] = known != looks.end() ? known->second : look_hash(*species);
    }
    looks = std::move(kept);

    progress.begin("trees", tasks.size());
    parallel_dearest_first(order, [&](std::size_t n) {
      if (progress.cancelled() || (n >= kAtLeast && superseded(job))) return;
      const Task& task = tasks[n];
      if (grow_one(job, task, *there, look[task.tree->species])) progress.advance();
    });
  }

  // False when broken off.
  bool grow_one(const Snapshot& job, const Task& task, const Surroundings& there, std::uint64_t look) {
    const Tree& tree = *task.tree;
    Record& record = *task.record;
    const TreeInputs inputs(*document, tree, there.of(task.index), options.detail);
    const std::uint64_t hash = inputs.hash();
    if (hash == record.inputs && record.grown.skeleton && record.warning.empty())
      skeletons.insert(hash, record.grown.skeleton);
    std::string warning;
    GrownTree grown = grow_tree(*document, tree, inputs, hash, options.year, &skeletons, &progress, warning);
    if (!grown.skeleton) return false;
    record.grown = grown;
    record.inputs = hash;
    record.warning = std::move(warning);
    record.triangles = task.triangles;
    if (options.meshes)
      make_meshes(tree, task, record, look);
    else
      record.meshes = nullptr;
    record.dirty = record.edited = false;

    FinishedTree told;
    told.id = tree.id;
    told.snapshot = job.number;
    told.tree = tree;
    told.base = task.base;
    told.grown = std::move(grown);
    told.meshes = record.meshes;
    deliver(std::move(told));
    return true;
  }

  void make_meshes(const Tree& tree, const Task& task, Record& record, std::uint64_t look) {
    const std::uint64_t key = Hasher()
                                  .add(record.inputs)
                                  .add(look)
                                  .add(record.grown.season)
                                  .add(static_cast<int>(options.season))
                                  .add(static_cast<int>(options.foliage))
                                  .add(static_cast<std::uint64_t>(task.triangles))
                                  .digest();
    if (record.meshes && record.mesh == key) return;
    record.mesh = key;
    record.meshes = meshes.find(key);
    if (record.meshes) return;
    const Species& species = document->species_of(tree);
    const growth::Skeleton& skeleton = *record.grown.skeleton;
    const int season = record.grown.season;
    const std::vector<float> radius = season < 0 ? skeleton.radius : growth::radii(skeleton, season);
    geometry::TreeMesh made =
        geometry::build_tree_mesh(skeleton, radius, species.look, species.foliage,
                                  {season, options.season, options.foliage, task.triangles, document->seed, tree.key});
    auto both = std::make_shared<TreeMeshes>();
    both->branches = std::move(made.branches);
    both->leaves = std::move(made.leaves);
    both->foliage = made.foliage;
    const std::size_t bytes = both->bytes();
    record.meshes = std::move(both);
    meshes.insert(key, record.meshes, bytes);
  }
};

Pipeline::Pipeline(const PipelineOptions& options) : state_(std::make_unique<State>(options)) {
  state_->worker = std::thread([state = state_.get()] { state->loop(); });
}

Pipeline::~Pipeline() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->stop = true;
  }
  state_->progress.cancel();
  state_->wake.notify_all();
  state_->worker.join();
}

std::uint64_t Pipeline::set_document(std::shared_ptr<const Document> document, const View& view) {
  const std::lock_guard lock(state_->mutex);
  state_->wanted.document = std::move(document);
  state_->wanted.view = view;
  state_->newest.store(++state_->wanted.number);
  state_->wake.notify_all();
  return state_->wanted.number;
}

void Pipeline::set_view(const View& view) {
  const std::lock_guard lock(state_->mutex);
  if (state_->wanted.view == view) return;
  state_->wanted.view = view;
  if (!state_->wanted.document) return;
  state_->newest.store(++state_->wanted.number);
  state_->wake.notify_all();
}

void Pipeline::set_options(const PipelineOptions& options) {
  const std::lock_guard lock(state_->mutex);
  state_->wanted.options = options;
  if (!state_->wanted.document) return;
  state_->newest.store(++state_->wanted.number);
  state_->wake.notify_all();
}

std::vector<FinishedTree> Pipeline::take_finished(std::size_t most) {
  std::vector<FinishedTree> out;
  const std::lock_guard lock(state_->mutex);
  while (!state_->finished.empty() && out.size() < most) {
    state_->finished_at.erase(state_->finished.front().id);
    out.push_back(std::move(state_->finished.front()));
    state_->finished.pop_front();
  }
  return out;
}

PipelineStatus Pipeline::status() const {
  const std::lock_guard lock(state_->mutex);
  PipelineStatus out;
  out.snapshot = state_->wanted.number;
  out.busy = state_->done != state_->wanted.number;
  out.stage = state_->progress.stage();
  out.done = state_->progress.done();
  out.total = state_->progress.total();
  if (!out.busy) out.error = state_->error, out.warnings = state_->warnings;
  return out;
}

bool Pipeline::idle() const {
  const std::lock_guard lock(state_->mutex);
  return state_->done == state_->wanted.number;
}

void Pipeline::wait() const {
  std::unique_lock lock(state_->mutex);
  state_->rest.wait(lock, [&] { return state_->done == state_->wanted.number; });
}

std::shared_ptr<const Surroundings> Pipeline::surroundings() const {
  const std::lock_guard lock(state_->mutex);
  return state_->around;
}

std::uint64_t Pipeline::skeleton_digest() const {
  std::vector<std::shared_ptr<const growth::Skeleton>> all;
  {
    const std::lock_guard lock(state_->mutex);
    all = state_->all_skeletons;
  }
  Hasher hasher;
  for (const auto& skeleton : all) hasher.add(growth::digest(*skeleton));
  return hasher.digest();
}

}  // namespace bosquet::scene
