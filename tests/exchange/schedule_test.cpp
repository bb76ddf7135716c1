#include "exchange/schedule.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "exchange/inventory.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

TreeRecord record(int id, std::string common, std::string botanical, DVec2 map, float height, float trunk, float crown,
                  scene::TreeStatus status, std::string name) {
  TreeRecord r;
  r.id = id, r.map = map, r.status = status;
  r.common = std::move(common), r.botanical = std::move(botanical), r.inventory_name = std::move(name);
  r.grown = GrownSizes{height, trunk, crown, 41.6f};
  return r;
}

std::vector<TreeRecord> records() {
  using enum scene::TreeStatus;
  return {record(1, "English oak", "Quercus robur", {512345.6789, 5400002}, 12.345f, 0.4f, 8, proposed, ""),
          record(2, "Silver birch", "Betula pendula", {3, -0.0001}, 9, 0.2f, 4, existing, "Birke, \"hell\""),
          record(7, "English oak", "Quercus robur", {5, 6}, 8, 0.2f, 6, to_remove, "QURO")};
}

TEST(Schedule, IsOneLineATreeWithQuotesWhereNeeded) {
  const ScratchFolder folder;
  auto trees = records();
  trees[1].clear_stem_m = 2.2f, trees[1].inventory_id = "B-17", trees[1].form = "ball";
  trees[2].grown.reset();
  trees[2].stands_for = "QUPE";
  trees[2].height_m = 7.5f, trees[2].crown_diameter_m = 3;
  ASSERT_TRUE(write_schedule(folder / "a.csv", trees));
  EXPECT_EQ(slurp(folder / "a.csv"),
            "id,species,botanical_name,stands_for,status,east_m,north_m,height_m,trunk_diameter_cm,crown_diameter_m,"
            "clear_stem_m,"
            "form,age_years,inventory_id,inventory_name\n"
            "1,English oak,Quercus robur,,proposed,512345.679,5400002.000,12.35,40.0,8.00,,,42,,\n"
            "2,Silver birch,Betula pendula,,existing,3.000,0.000,9.00,20.0,4.00,2.20,ball,42,B-17,"
            "\"Birke, \"\"hell\"\"\"\n"
            "7,English oak,Quercus robur,QUPE,to_remove,5.000,6.000,7.50,,3.00,,,,,QURO\n");
}

TEST(Schedule, CanBeReadAgainAsAnInventory) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_schedule(folder / "a.csv", records()));
  const auto inventory = read_inventory(folder / "a.csv");
  ASSERT_TRUE(inventory) << inventory.error().message;
  EXPECT_TRUE(inventory->problems.empty());
  ASSERT_EQ(inventory->trees.size(), 3u);
  EXPECT_EQ(inventory->trees[2].plan, DVec2(5, 6));
  EXPECT_EQ(inventory->trees[0].plan, DVec2(512345.679, 5400002));
  EXPECT_EQ(inventory->trees[2].status, scene::TreeStatus::to_remove);
  EXPECT_EQ(inventory->trees[1].name_kept.value_or("none"), "Birke, \"hell\"");
  EXPECT_FLOAT_EQ(*inventory->trees[0].trunk_diameter_m, 0.4f);
  EXPECT_FLOAT_EQ(*inventory->trees[1].crown_diameter_m, 4.0f);
}

TEST(Schedule, SpeciesAreSummedInTheOrderOfTheirNames) {
  const auto sums = summarise(records());
  ASSERT_EQ(sums.size(), 2u);
  EXPECT_EQ(sums[0].species, "English oak");
  EXPECT_EQ(sums[0].trees, 2u);
  EXPECT_EQ(sums[0].by_status, (std::array<std::size_t, 4>{1, 0, 1, 0}));
  EXPECT_NEAR(sums[0].mean_height_m, (12.345 + 8) / 2, 1e-5);
  EXPECT_DOUBLE_EQ(sums[0].lowest_m, 8);
  EXPECT_NEAR(sums[0].highest_m, 12.345, 1e-5);
  EXPECT_NEAR(sums[0].mean_trunk_diameter_m, 0.3, 1e-7);
  EXPECT_NEAR(sums[0].basal_area_m2, std::numbers::pi / 4 * (0.16 + 0.04), 1e-7);
  EXPECT_NEAR(sums[0].crown_area_m2, std::numbers::pi / 4 * (64 + 36), 1e-9);
  EXPECT_NEAR(sums[0].crown_area_kept_m2, std::numbers::pi / 4 * 64, 1e-9);
  EXPECT_EQ(sums[1].trees, 1u);
  EXPECT_TRUE(summarise({}).empty());
  auto with_another = records();
  with_another[2].stands_for = "Sessile oak";
  const auto apart = summarise(with_another);
  ASSERT_EQ(apart.size(), 3u);
  EXPECT_EQ(apart[1].stands_for, "Sessile oak") << "what is drawn as an oak is counted apart from oaks";

  const ScratchFolder folder;
  ASSERT_TRUE(write_summary(folder / "s.csv", sums));
  EXPECT_EQ(
      slurp(folder / "s.csv"),
      "species,botanical_name,stands_for,trees,proposed,existing,to_remove,protected,mean_height_m,lowest_m,highest_m,"
      "mean_trunk_diameter_cm,mean_crown_diameter_m,trunk_to_10_cm,trunk_10_to_20_cm,trunk_20_to_40_cm,"
      "trunk_40_to_60_cm,trunk_60_to_80_cm,trunk_from_80_cm,height_to_5_m,height_5_to_10_m,height_10_to_15_m,"
      "height_15_to_20_m,height_20_to_25_m,height_from_25_m,basal_area_m2,crown_area_m2,crown_area_kept_m2\n"
      "English oak,Quercus robur,,2,1,0,1,0,10.17,8.00,12.35,30.0,7.00,0,0,1,1,0,0,0,1,1,0,0,0,0.157,78.5,50.3\n"
      "Silver birch,Betula pendula,,1,0,1,0,0,9.00,9.00,9.00,20.0,4.00,0,0,1,0,0,0,0,1,0,0,0,0,0.031,12.6,12.6\n");
}

TEST(Schedule, ClassesOfSizesHoldEveryTreeOnce) {
  std::vector<TreeRecord> trees;
  for (int i = 0; i < 300; ++i)
    trees.push_back(record(i + 1, "a", "b", {}, 0.1f * static_cast<float>(i + 1), 0.004f * static_cast<float>(i + 1), 1,
                           scene::TreeStatus::existing, ""));
  const SpeciesRow sum = summarise(trees).at(0);
  EXPECT_EQ(std::accumulate(sum.by_trunk.begin(), sum.by_trunk.end(), std::size_t{0}), trees.size());
  EXPECT_EQ(std::accumulate(sum.by_height.begin(), sum.by_height.end(), std::size_t{0}), trees.size());
}

}  // namespace
}  // namespace bosquet::exchange
