#include "exchange/schedule.h"

#include <gtest/gtest.h>

#include <numbers>

#include "exchange/inventory.h"
#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

std::vector<ScheduleRow> rows() {
  return {{1, "English oak", "Quercus robur", {1.005, 2}, 12.345, 0.4, 8, ""},
          {2, "Silver birch", "Betula pendula", {3, -0.001}, 9, 0.2, 4, "Birke, \"hell\""},
          {7, "English oak", "Quercus robur", {5, 6}, 8, 0.2, 6, "QURO"}};
}

TEST(Schedule, IsOneLineATreeWithQuotesWhereNeeded) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_schedule(folder / "a.csv", rows()));
  EXPECT_EQ(slurp(folder / "a.csv"),
            "id,species,botanical_name,east_m,north_m,height_m,trunk_diameter_cm,crown_diameter_m,inventory_name\n"
            "1,English oak,Quercus robur,1.00,2.00,12.35,40.0,8.00,\n"
            "2,Silver birch,Betula pendula,3.00,0.00,9.00,20.0,4.00,\"Birke, \"\"hell\"\"\"\n"
            "7,English oak,Quercus robur,5.00,6.00,8.00,20.0,6.00,QURO\n");
}

TEST(Schedule, CanBeReadAgainAsAnInventory) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_schedule(folder / "a.csv", rows()));
  const auto inventory = read_inventory(folder / "a.csv");
  ASSERT_TRUE(inventory) << inventory.error().message;
  EXPECT_TRUE(inventory->problems.empty());
  ASSERT_EQ(inventory->trees.size(), 3u);
  EXPECT_EQ(inventory->trees[2].plan, DVec2(5, 6));
  EXPECT_EQ(inventory->trees[2].id, "7");
  EXPECT_FLOAT_EQ(*inventory->trees[0].trunk_diameter_m, 0.4f);
  EXPECT_FLOAT_EQ(*inventory->trees[1].crown_diameter_m, 4.0f);
}

TEST(Schedule, SpeciesAreSummedInTheOrderOfTheirNames) {
  const auto sums = summarise(rows());
  ASSERT_EQ(sums.size(), 2u);
  EXPECT_EQ(sums[0].species, "English oak");
  EXPECT_EQ(sums[0].trees, 2u);
  EXPECT_DOUBLE_EQ(sums[0].mean_height_m, (12.345 + 8) / 2);
  EXPECT_DOUBLE_EQ(sums[0].lowest_m, 8);
  EXPECT_DOUBLE_EQ(sums[0].highest_m, 12.345);
  EXPECT_DOUBLE_EQ(sums[0].mean_trunk_diameter_m, 0.3);
  EXPECT_DOUBLE_EQ(sums[0].basal_area_m2, std::numbers::pi / 4 * (0.16 + 0.04));
  EXPECT_EQ(sums[1].trees, 1u);
  EXPECT_TRUE(summarise({}).empty());

  const ScratchFolder folder;
  ASSERT_TRUE(write_summary(folder / "s.csv", sums));
  EXPECT_EQ(slurp(folder / "s.csv"),
            "species,botanical_name,trees,mean_height_m,lowest_m,highest_m,mean_trunk_diameter_cm,"
            "mean_crown_diameter_m,basal_area_m2\n"
            "English oak,Quercus robur,2,10.17,8.00,12.35,30.0,7.00,0.157\n"
            "Silver birch,Betula pendula,1,9.00,9.00,9.00,20.0,4.00,0.031\n");
}

}  // namespace
}  // namespace bosquet::exchange
