#include "scene/pipeline.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string_view>
#include <thread>

#include "core/background.h"
#include "growth/digest.h"
#include "tests/scene/pipeline_edits.h"

namespace bosquet::scene {
namespace {

std::shared_ptr<const Document> shared(const Document& document) { return std::make_shared<const Document>(document); }

TEST(Pipeline, GivesTheSameBitsWholeOrAfterRandomEdits) { edit_and_compare(40, 8); }

TEST(Pipeline, TellsEveryTreeOnceNearestToTheViewFirst) {
  PipelineOptions options;
  options.threads = 1;
  Pipeline pipeline(options);
  const Document document = small_grove();
  EXPECT_TRUE(pipeline.take_finished().empty());
  const View view{to_world({0, 0}, 1)};
  pipeline.set_document(shared(document), view);
  pipeline.wait();
  const auto finished = pipeline.take_finished();
  ASSERT_EQ(finished.size(), document.trees->size());
  float before = 0;
  for (const FinishedTree& tree : finished) {
    EXPECT_FALSE(tree.gone);
    ASSERT_TRUE(tree.grown.skeleton && tree.meshes);
    EXPECT_FALSE(tree.meshes->branches.empty());
    const float distance = glm::length(tree.base + 0.5f * document.mature_height_m(tree.tree) * kUp - view.eye);
    EXPECT_GE(distance, before);
    before = distance;
  }
  EXPECT_TRUE(pipeline.take_finished().empty());
  const PipelineStatus status = pipeline.status();
  EXPECT_FALSE(status.busy);
  EXPECT_EQ(status.done, document.trees->size());
}

TEST(Pipeline, AfterAMoveOnlyTouchedTreesAreToldAndUndoGrowsNothing) {
  std::vector<Vec2> places{{10, 10}, {12, 10}, {60, 60}, {62, 60}};
  const Document before = sample_document("silver_birch", places, {80, 80}, 0.12f);
  Pipeline pipeline;
  pipeline.set_document(shared(before), {});
  pipeline.wait();
  pipeline.take_finished();
  const Document after = move_trees(before, std::vector<std::int32_t>{2}, {1, 0})->document;
  pipeline.set_document(shared(after), {});
  pipeline.wait();
  std::set<std::int32_t> told;
  for (const FinishedTree& tree : pipeline.take_finished()) told.insert(tree.id);
  EXPECT_TRUE(told.contains(2));
  EXPECT_FALSE(told.contains(3) || told.contains(4));

  pipeline.set_document(shared(before), {});
  pipeline.wait();
  for (const FinishedTree& tree : pipeline.take_finished()) EXPECT_TRUE(tree.grown.from_cache) << tree.id;

  pipeline.set_document(shared(remove_trees(before, std::vector<std::int32_t>{4}).document), {});
  pipeline.wait();
  std::map<std::int32_t, bool> gone;
  for (const FinishedTree& tree : pipeline.take_finished()) gone[tree.id] = tree.gone;
  EXPECT_TRUE(gone.at(4));
  EXPECT_FALSE(gone.contains(1));
}

TEST(Pipeline, ManySnapshotsInARowEndWithTheLast) {
  RandomStream random(5, 1, Purpose::statistics);
  PlantingGround ground;
  Document document = small_grove();
  Pipeline pipeline;
  std::uint64_t last = 0;
  std::map<std::int32_t, FinishedTree> shown;
  const auto take = [&] {
    for (FinishedTree& tree : pipeline.take_finished()) {
      if (tree.gone)
        shown.erase(tree.id);
      else
        shown[tree.id] = std::move(tree);
    }
  };
  for (int n = 0; n < 30; ++n) {
    document = random_edit(document, ground, random);
    last = pipeline.set_document(shared(document), {});
    take();
  }
  pipeline.wait();
  take();
  EXPECT_EQ(pipeline.status().snapshot, last);
  const auto whole = grow_scene(document, {}, nullptr);
  ASSERT_TRUE(whole);
  ASSERT_EQ(shown.size(), whole->trees.size());
  for (std::size_t i = 0; i < whole->trees.size(); ++i) {
    const FinishedTree& tree = shown.at((*whole->document.trees)[i].id);
    EXPECT_EQ(growth::digest(*tree.grown.skeleton), growth::digest(*whole->trees[i].skeleton)) << tree.id;
    EXPECT_EQ(tree.tree, (*whole->document.trees)[i]);
  }
}

TEST(Pipeline, AnotherViewGivesOtherMeshesOfTheSameTrees) {
  Pipeline pipeline;
  const Document document = small_grove();
  pipeline.set_document(shared(document), {to_world({13, 12}, 1)});
  pipeline.wait();
  std::map<std::int32_t, std::size_t> near;
  for (const FinishedTree& tree : pipeline.take_finished())
    near[tree.id] = tree.meshes->branches.triangles() + tree.meshes->leaves.triangles();
  pipeline.set_view({to_world({13, -4000}, 1)});
  pipeline.wait();
  const auto far = pipeline.take_finished();
  ASSERT_EQ(far.size(), near.size());
  for (const FinishedTree& tree : far) {
    EXPECT_TRUE(tree.grown.from_cache);
    EXPECT_LE(tree.meshes->branches.triangles() + tree.meshes->leaves.triangles(), kFarthestTriangles);
    EXPECT_GT(near.at(tree.id), kFarthestTriangles);
  }
}

TEST(Pipeline, ASpaceTooLargeIsAnErrorAndTheNextSnapshotGoesOn) {
  Pipeline pipeline;
  Document document = small_grove();
  Document absurd = document;
  absurd.space.voxel_m = 0.02f, absurd.space.layer_m = 0.05f, absurd.space.memory_gb = 0.01f;
  pipeline.set_document(shared(absurd), {});
  pipeline.wait();
  ASSERT_TRUE(pipeline.status().error);
  pipeline.set_document(shared(document), {});
  pipeline.wait();
  EXPECT_FALSE(pipeline.status().error);
  EXPECT_EQ(pipeline.take_finished().size(), document.trees->size());
}

TEST(Pipeline, EndsAtOnceWhileItGrows) {
  Document document = sample_document("english_oak", {{10, 10}, {30, 10}, {10, 30}, {30, 30}}, {40, 40}, 1.0f);
  Pipeline pipeline;
  pipeline.set_document(shared(document), {});
  while (std::string_view(pipeline.status().stage) != "trees" && pipeline.status().busy) {
  }
}

TEST(Pipeline, WorksNice) {
  const int before = thread_nice();
  int nice = 0;
  std::thread([&] { run_in_background(1, [&] { nice = thread_nice(); }); }).join();
  EXPECT_EQ(nice, kBackgroundNice);
  EXPECT_EQ(thread_nice(), before);
}

}  // namespace
}  // namespace bosquet::scene
