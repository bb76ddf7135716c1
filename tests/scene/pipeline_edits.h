// Random edits of a grove, and what must be equal however its scene was come by.
#pragma once

#include <gtest/gtest.h>

#include "core/random.h"
#include "crowns/crown_space.h"
#include "scene/edits.h"
#include "scene/grown_scene.h"
#include "scene/pipeline.h"
#include "scene/planting_edits.h"
#include "scene/settings_edits.h"
#include "scene/site_edits.h"
#include "tests/scene/sample_document.h"

namespace bosquet::scene {

inline Document small_grove() {
  std::vector<Vec2> places;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i)
      places.push_back({3.0f + 4.5f * static_cast<float>(i), 3.0f + 5.0f * static_cast<float>(j)});
  Document document = sample_document("silver_birch", places, {26, 24}, 0.12f);
  document.species.push_back(std::make_shared<const Species>(*builtin_species("scots_pine")));
  document.space.voxel_m = 0.5f;
  settle_counters(document);
  return document;
}

/// Any edit but those that change nothing of the scene.
inline Document random_edit(const Document& document, PlantingGround& ground, RandomStream& random) {
  std::vector<std::int32_t> some;
  for (std::uint32_t n = 1 + random.below(2); n-- > 0 && !document.trees->empty();)
    some.push_back((*document.trees)[random.below(static_cast<std::uint32_t>(document.trees->size()))].id);
  const Vec2 place{random.uniform(1, 25), random.uniform(1, 23)};
  const std::uint32_t what = random.below(40);
  if (what < 14) return move_trees(document, some, {random.uniform(-3, 3), random.uniform(-3, 3)})->document;
  if (what < 18 && document.trees->size() > 12) return remove_trees(document, some).document;
  if (what < 24 && document.trees->size() < 26) {
    auto planted = plant_tree(document, ground, random.below(2), place, random.uniform(0.08f, 0.16f));
    return planted ? planted->document : document;
  }
  if (what < 28) {
    const float by = random.uniform(0.8f, 1.25f);
    Document after = scale_trees(document, some, by, by)->document;
    // Sizes are kept small, so that a thousand edits stay quick.
    return change_trees(after, some, "{}",
                        [](Tree& t) {
                          t.scale_height = std::clamp(t.scale_height, 0.06f, 0.18f);
                          t.scale_width = std::clamp(t.scale_width, 0.06f, 0.18f);
                        })
        .document;
  }
  if (what < 30) return replace_species(document, some, random.below(2))->document;
  if (what < 31)
    return set_status(document, some, random.below(2) ? TreeStatus::to_remove : TreeStatus::existing).document;
  if (what < 33) {
    terrain::Stroke stroke;
    stroke.kind = random.below(2) ? terrain::BrushKind::raise : terrain::BrushKind::lower;
    stroke.points = {place};
    stroke.radius_m = 3;
    return shape_ground(document, stroke).document;
  }
  if (what < 35) {
    if (document.obstacles.size() > 2) return remove_obstacle(document, document.obstacles.front().id)->document;
    return add_building(document, "", {{place, place + Vec2(2, 0), place + Vec2(2, 3), place + Vec2(0, 3)}, {}}, 3)
        ->document;
  }
  if (what < 36) return set_water_level(document, random.uniform(-2, -1)).document;
  if (what < 37) {
    crowns::AsymmetryOptions asymmetry = document.asymmetry;
    asymmetry.distance_weight = random.uniform(1, 3);
    return set_asymmetry(document, asymmetry)->document;
  }
  if (what < 38) {
    crowns::LightOptions light = document.light;
    light.canopy_light = random.below(3) > 0;
    return set_light(document, light)->document;
  }
  if (what < 39) {
    Species changed = *document.species[1];
    changed.growth.shadow_strength = random.uniform(0.05f, 0.2f);
    return change_species(document, 1, changed)->document;
  }
  return set_overrides(document, some, {{"growth.shadow_strength", static_cast<double>(random.uniform(0.05f, 0.3f))}})
      ->document;
}

inline void expect_equal_spaces(const crowns::CrownSpace& a, const crowns::CrownSpace& b) {
  ASSERT_EQ(a.claimants().size(), b.claimants().size());
  ASSERT_EQ(a.claimed_voxels(), b.claimed_voxels());
  for (std::size_t i = 0; i < a.claimants().size(); ++i) {
    const crowns::CrownRegion x = crowns::region(a, i), y = crowns::region(b, i);
    ASSERT_EQ(x.low, y.low) << i;
    ASSERT_EQ(x.cells, y.cells) << i;
    ASSERT_EQ(x.bits, y.bits) << i;
  }
}

/// The pipeline's scene is that of a whole run.
inline void expect_whole(const Pipeline& pipeline, const Document& document) {
  auto whole = grow_scene(document, {}, nullptr);
  ASSERT_TRUE(whole);
  const auto around = pipeline.surroundings();
  expect_equal_spaces(around->space, whole->space);
  ASSERT_EQ(around->light.size(), whole->light.size());
  for (std::size_t i = 0; i < whole->light.size(); ++i) ASSERT_EQ(around->light.of(i), whole->light.of(i)) << i;
  for (std::size_t i = 0; i < whole->trees.size(); ++i) ASSERT_EQ(around->asymmetry[i], whole->trees[i].asymmetry) << i;
  ASSERT_EQ(pipeline.skeleton_digest(), whole->skeleton_digest);
}

/// Edits one after another, all handed to one pipeline, some before the one before was ready.
inline void edit_and_compare(int edits, int compare_every) {
  RandomStream random(21, 1, Purpose::statistics);
  PlantingGround ground;
  Document document = small_grove();
  Pipeline pipeline;
  pipeline.set_document(std::make_shared<const Document>(document), {});
  for (int n = 1; n <= edits; ++n) {
    SCOPED_TRACE(n);
    document = random_edit(document, ground, random);
    pipeline.set_document(std::make_shared<const Document>(document), {});
    if (n % compare_every) {
      if (random.below(3) == 0) pipeline.wait();
      continue;
    }
    pipeline.wait();
    ASSERT_FALSE(pipeline.status().error);
    ASSERT_NO_FATAL_FAILURE(expect_whole(pipeline, document));
  }
}

}  // namespace bosquet::scene
