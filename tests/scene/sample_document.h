// Sample documents: small sites with built-in species, for tests of the pipeline.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/hash.h"
#include "scene/document.h"

namespace bosquet::scene {

/// A flat site of `size_m` with small trees of one species at these places.
inline Document sample_document(const std::string& species, const std::vector<Vec2>& places, Vec2 size_m,
                                float scale = 0.3f) {
  Document document;
  document.seed = 11;
  auto lattice = terrain::make_lattice(size_m);
  terrain::Terrain ground;
  ground.height = terrain::Heightfield(*lattice);
  ground.exclusion = terrain::Mask(*lattice, 0.0f);
  ground.density = terrain::Mask(*lattice, 1.0f);
  document.terrain = std::make_shared<const terrain::Terrain>(std::move(ground));
  auto read = builtin_species(species);
  EXPECT_TRUE(read);
  document.species.push_back(std::make_shared<const Species>(std::move(*read)));
  std::vector<Tree> trees;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Tree tree;
    tree.id = static_cast<std::int32_t>(i + 1);
    tree.key = hash_text("sample") + i;
    tree.at = places[i];
    tree.scale_height = tree.scale_width = scale;
    trees.push_back(tree);
  }
  document.trees = std::make_shared<const Trees>(std::move(trees));
  return document;
}

}  // namespace bosquet::scene
