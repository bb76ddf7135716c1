#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <tuple>

#include "exchange/image_file.h"
#include "exchange/plan_contours.h"
#include "exchange/plan_drawing.h"
#include "exchange/plan_sheet.h"
#include "exchange/plan_symbols.h"
#include "exchange/recipe.h"
#include "exchange/tree_records.h"
#include "tests/exchange/scratch_folder.h"

namespace bosquet::exchange {
namespace {

scene::GrownScene grown(const std::string& text) {
  auto recipe = parse_recipe(text, "test.toml");
  EXPECT_TRUE(recipe) << recipe.error().message;
  auto built = build_document(*recipe);
  EXPECT_TRUE(built) << built.error().message;
  auto scene = scene::grow_scene(built->document, {}, nullptr);
  EXPECT_TRUE(scene);
  return std::move(*scene);
}

constexpr const char* kGarden = R"(
[site]
size_m = [40, 30]
south_west = [500000, 5700000]
[[terrain.path]]
name = "walk"
width_m = 2
points = [[-1, 10], [41, 10]]
[[obstacle]]
name = "house"
polygon = [[30, 20], [38, 20], [38, 26], [30, 26]]
[[planting]]
name = "oak"
kind = "single"
species = { english_oak = 1 }
at = [10, 20]
scale = 0.3
status = "protected"
[[planting]]
name = "old"
kind = "single"
species = { silver_birch = 1 }
at = [20, 22]
scale = 0.3
status = "to_remove"
[[planting]]
name = "hedge"
kind = "hedge"
species = { european_beech = 1 }
points = [[4, 4], [10, 4]]
form = "box"
form_height_m = 1.5
[plan]
title = "Garten & <Hof>"
author = "Ähm"
)";

double area(const std::vector<DVec2>& ring) {
  double twice = 0;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    twice += ring[j].x * ring[i].y - ring[i].x * ring[j].y;
  return 0.5 * twice;
}

std::vector<const PlanItem*> on_layer(const PlanDrawing& plan, const std::string& name) {
  std::vector<const PlanItem*> items;
  for (const PlanItem& item : plan.items)
    if (plan.layers[item.layer].name == name) items.push_back(&item);
  return items;
}

TEST(PlanContours, TheRingOfADiscHasItsAreaAndRunsAroundIt) {
  SampleGrid grid{{101, 101}, {-5.0, -5.0}, 0.1, {}};
  for (int j = 0; j < 101; ++j)
    for (int i = 0; i < 101; ++i)
      grid.values.push_back(3.0f - static_cast<float>(std::hypot(-5.0 + 0.1 * i, -5.0 + 0.1 * j)));
  const auto rings = rings_above(grid, 0.0f, 0.002);
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_NEAR(area(rings[0]), 9.0 * 3.14159265, 0.05);  // a chord's sagitta at 0.1 m on a radius of 3 m
}

TEST(PlanContours, AnAreaThatReachesTheEdgeIsClosedAlongIt) {
  SampleGrid grid{{11, 6}, {0.0, 0.0}, 1.0, std::vector<float>(66, 1.0f)};
  const auto rings = rings_above(grid, 0.5f, 1e-6);
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_NEAR(area(rings[0]), 50.0, 1e-9);
  EXPECT_TRUE(lines_at(grid, 0.5f, 1e-6).empty());
}

TEST(PlanContours, ARampHasOneStraightLine) {
  SampleGrid grid{{21, 11}, {0.0, 0.0}, 1.0, {}};
  for (int j = 0; j < 11; ++j)
    for (int i = 0; i < 21; ++i) grid.values.push_back(static_cast<float>(i));
  const auto lines = lines_at(grid, 7.25f, 1e-6);
  ASSERT_EQ(lines.size(), 1u);
  ASSERT_EQ(lines[0].size(), 2u);
  for (const DVec2& p : lines[0]) EXPECT_NEAR(p.x, 7.25, 1e-6);
}

TEST(PlanContours, SaddlesAreCutWithoutCrossings) {
  // A chessboard: every ring is closed and encloses a positive area.
  SampleGrid grid{{9, 9}, {0.0, 0.0}, 1.0, {}};
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i) grid.values.push_back((i + j) % 2 ? 1.0f : 0.0f);
  double total = 0;
  for (const auto& ring : rings_above(grid, 0.6f, 0.0)) {
    EXPECT_GT(area(ring), 0.0);
    total += area(ring);
  }
  EXPECT_GT(total, 5.0);
}

TEST(PlanSheet, TheSmallestSheetIsTakenOnWhichTheScaleIsGood) {
  const auto chosen = [](DVec2 site) {
    auto plan = lay_out({}, DVec2(0.0), site);
    return plan->paper + " 1:" + std::to_string(plan->scale);
  };
  EXPECT_EQ(chosen({50, 40}), "A3 1:200");
  EXPECT_EQ(chosen({120, 100}), "A3 1:400");
  EXPECT_EQ(chosen({140, 110}), "A3 1:500");
  EXPECT_EQ(chosen({200, 150}), "A2 1:500");
  EXPECT_EQ(chosen({280, 240}), "A1 1:500");
  EXPECT_EQ(chosen({1000, 500}), "A1 1:2000");
}

TEST(PlanSheet, AScaleThatDoesNotFitIsRefusedWithOneThatDoes) {
  scene::PlanSettings settings;
  settings.scale = 200, settings.paper = scene::Paper::a3;
  auto plan = lay_out(settings, DVec2(0.0), {300, 200});
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message.find("1:1000 does"), std::string::npos) << plan.error().message;
}

TEST(PlanSheet, TheSiteLiesWithinItsField) {
  for (const DVec2 site : {DVec2(50, 40), DVec2(8, 300), DVec2(3000, 20)}) {
    auto plan = lay_out({}, DVec2(0.0), site);
    ASSERT_TRUE(plan);
    for (const DVec2 corner : {DVec2(0.0), site}) {
      const DVec2 mm = plan->on_paper(corner);
      EXPECT_GT(mm.x, 10.0);
      EXPECT_GT(mm.y, 10.0);
      EXPECT_LT(mm.x, plan->paper_mm.x * 0.8);
      EXPECT_LT(mm.y, plan->paper_mm.y - 10.0);
    }
  }
}

TEST(PlanSymbols, SpeciesAreToldApart) {
  const scene::Species oak = *scene::builtin_species("english_oak");
  std::set<std::tuple<int, bool, bool, float, float>> seen;
  for (std::size_t place = 0; place < 40; ++place) {
    const SpeciesSymbol s = species_symbol(oak, place);
    EXPECT_TRUE(seen.emplace(static_cast<int>(s.pattern), s.ring, s.spokes, s.tint.r, s.tint.g).second) << place;
  }
  EXPECT_EQ(species_codes({"Tilia cordata", "Tilia platyphyllos", "Taxus caespitosa", "Tilia"}),
            (std::vector<std::string>{"TC", "TP", "TCA", "TI"}));
}

TEST(PlanSymbols, JoinedHedgePlantsAreOneBody) {
  const std::vector<DVec2> a{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, b{{1, 0}, {3, 0}, {3, 1}, {1, 1}},
      c{{9, 9}, {10, 9}, {10, 10}};
  const auto rings = joined({a, b, c});
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_NEAR(std::fabs(area(rings[0])) + std::fabs(area(rings[1])), 3.5, 1e-9);
}

TEST(PlanDrawing, CrownsStandAtTheirPlacesAsLargeAsTheyGrew) {
  const scene::GrownScene scene = grown(kGarden);
  auto plan = draw_plan(scene, "garden");
  ASSERT_TRUE(plan) << plan.error().message;
  const auto oak = on_layer(*plan, "TREES-PROTECTED-QUERCUS-ROBUR");
  ASSERT_GE(oak.size(), 2u);
  const auto& outline = std::get<PlanPath>(oak[0]->shape).lines[0];
  const double diameter = static_cast<double>(scene.trees[0].measures.crown_diameter_m);
  const double drawn = 2.0 * std::sqrt(std::fabs(area(outline)) / 3.14159265);
  EXPECT_NEAR(drawn, diameter, 0.25 * diameter);
  const auto& trunk = std::get<PlanCircle>(oak.back()->shape);
  EXPECT_EQ(trunk.centre, DVec2(10.0, 20.0));

  const auto roots = on_layer(*plan, "ROOT-PROTECTION");
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_NEAR(std::get<PlanCircle>(roots[0]->shape).radius_m,
              12.0 * static_cast<double>(scene.trees[0].measures.trunk_diameter_m), 1e-6);
  // A crown, its cross and its trunk: the removed tree, which was not grown.
  EXPECT_EQ(on_layer(*plan, "TREES-REMOVE-BETULA-PENDULA").size(), 3u);

  const auto path = on_layer(*plan, "AREA-PATH"), other = on_layer(*plan, "AREA-OTHER");
  ASSERT_EQ(path.size() + other.size(), 1u);
  double paved = 0;
  for (const auto& ring : std::get<PlanPath>((path.empty() ? other : path)[0]->shape).lines) paved += area(ring);
  EXPECT_NEAR(paved, 80.0, 4.0);
  EXPECT_EQ(on_layer(*plan, "BUILDINGS").size(), 1u);
}

TEST(PlanDrawing, TheKeyCountsEverySpecies) {
  const scene::GrownScene scene = grown(kGarden);
  auto plan = draw_plan(scene, "garden");
  std::vector<std::string> words;
  for (const PlanItem* item : on_layer(*plan, "SHEET"))
    if (const auto* text = std::get_if<PlanText>(&item->shape)) words.push_back(text->words);
  const auto has = [&](const std::string& word) { return std::count(words.begin(), words.end(), word) > 0; };
  EXPECT_TRUE(has("Quercus robur"));
  EXPECT_TRUE(has("Fagus sylvatica"));
  EXPECT_TRUE(has(std::to_string(scene.trees.size() - 1)));  // the hedge
  EXPECT_TRUE(has("To be removed"));
  EXPECT_TRUE(has("Garten & <Hof>"));
  EXPECT_TRUE(has("1:200 (A3)"));
}

TEST(PlanDrawing, WhatIsDrawnAsAnotherSpeciesIsNamedAsItsInventoryNamesIt) {
  const ScratchFolder folder;
  spit(folder / "t.csv",
       "x,y,species,height_m\n5,5,Bergahorn,4\n12,5,Spitzahorn,4\n19,5,Ginkgo biloba,4\n26,5,Bergahorn,4\n");
  auto recipe = parse_recipe("[site]\nsize_m = [32, 12]\n[[planting]]\nkind = \"inventory\"\nfile = \"t.csv\"\n",
                             folder / "test.toml");
  ASSERT_TRUE(recipe) << recipe.error().message;
  auto built = build_document(*recipe);
  ASSERT_TRUE(built) << built.error().message;
  const auto scene = scene::grow_scene(built->document, {}, nullptr);
  const auto plan = draw_plan(*scene, "survey");
  ASSERT_TRUE(plan);
  std::vector<std::string> words;
  for (const PlanItem* item : on_layer(*plan, "SHEET"))
    if (const auto* text = std::get_if<PlanText>(&item->shape)) words.push_back(text->words);
  const auto row = [&](const std::string& name, const std::string& second, const std::string& count) {
    const auto at = std::find(words.begin(), words.end(), name);
    ASSERT_TRUE(words.end() - at > 2) << name;
    EXPECT_EQ(at[1], second);
    EXPECT_EQ(at[2], count);
  };
  row("Bergahorn", "drawn as Acer platanoides", "2");
  row("Acer platanoides", "Norway maple", "1");
  row("Ginkgo biloba", "drawn as Quercus robur", "1");
  EXPECT_EQ(on_layer(*plan, "TREES-EXISTING-BERGAHORN").size(), 4u) << "two crowns and their trunks";

  const auto records = tree_records(*scene);
  EXPECT_EQ(records[0].stands_for, "Bergahorn");
  EXPECT_EQ(records[1].stands_for, "");
}

TEST(PlanDrawing, SvgHasALayerForEachOfThePlansAndTheSameBytesTwice) {
  ScratchFolder folder;
  const scene::GrownScene scene = grown(kGarden);
  auto plan = draw_plan(scene, "garden");
  auto bytes = write_plan_svg(*plan, folder / "a.svg");
  ASSERT_TRUE(bytes) << bytes.error().message;
  ASSERT_TRUE(write_plan_svg(*draw_plan(scene, "garden"), folder / "b.svg"));
  const std::string svg = slurp(folder / "a.svg");
  EXPECT_EQ(svg.size(), *bytes);
  EXPECT_EQ(svg, slurp(folder / "b.svg"));
  for (const PlanLayer& layer : plan->layers)
    EXPECT_NE(svg.find("<g id=\"" + layer.name + "\""), std::string::npos) << layer.name;
  EXPECT_NE(svg.find("width=\"420mm\" height=\"297mm\""), std::string::npos);
  EXPECT_NE(svg.find("Garten &amp; &lt;Hof&gt;"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(PlanDrawing, DxfIsReadByGdalAtItsPlaceOnEarth) {
  ScratchFolder folder;
  auto plan = draw_plan(grown(kGarden), "garden");
  ASSERT_TRUE(write_plan_dxf(*plan, folder / "plan.dxf"));
  const std::string dxf = slurp(folder / "plan.dxf");
  EXPECT_NE(dxf.find("TREES-PROTECTED-QUERCUS-ROBUR"), std::string::npos);
  EXPECT_NE(dxf.find("\\U+00C4hm"), std::string::npos) << "letters beyond ASCII";
  GDALAllRegister();
  const std::unique_ptr<GDALDataset> file(
      GDALDataset::Open((folder / "plan.dxf").c_str(), GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR));
  ASSERT_TRUE(file);
  std::size_t shapes = 0, houses = 0;
  std::set<std::string> layers;
  for (const auto& feature : *file->GetLayer(0)) {
    ++shapes;
    layers.insert(feature->GetFieldAsString("Layer"));
    OGREnvelope box;
    feature->GetGeometryRef()->getEnvelope(&box);
    houses += std::string(feature->GetFieldAsString("Layer")) == "BUILDINGS" && std::fabs(box.MinX - 500030) < 0.01 &&
              std::fabs(box.MaxX - 500038) < 0.01 && std::fabs(box.MinY - 5700020) < 0.01 &&
              std::fabs(box.MaxY - 5700026) < 0.01;
  }
  EXPECT_GT(shapes, 100u);
  EXPECT_EQ(houses, 1u);
  EXPECT_TRUE(layers.count("TREES-REMOVE-BETULA-PENDULA"));
}

TEST(PlanDrawing, ThePngIsTheSheetAt200DotsAnInch) {
  ScratchFolder folder;
  auto plan = draw_plan(grown(kGarden), "garden");
  ASSERT_TRUE(write_plan_png(*plan, folder / "sheet.plan.png"));
  const Image image = *read_image(folder / "sheet.plan.png");
  EXPECT_EQ(image.width, 3307);
  EXPECT_EQ(image.height, 2339);
  // The trunk of the oak is dark, the paper's margin white.
  const DVec2 trunk = plan->on_paper({10, 20}) * (200.0 / 25.4);
  EXPECT_LT(image.at(static_cast<int>(trunk.x), static_cast<int>(trunk.y))[1], 90);
  EXPECT_EQ(image.at(5, 5)[0], 255);
}

TEST(PlanDrawing, AnUnderlayLiesBeneathAndAMissingOneIsRefused) {
  ScratchFolder folder;
  Image picture(8, 4, 3);
  for (std::uint8_t& byte : picture.pixels) byte = 40;
  ASSERT_TRUE(write_image(folder / "old.png", picture));
  const std::string with = std::string(kGarden) + "[underlay]\nfile = '" + (folder / "old.png").string() +
                           "'\nsouth_west = [2, 3]\nwidth_m = 20\nopacity = 0.5\n";
  auto plan = draw_plan(grown(with), "garden");
  ASSERT_TRUE(plan) << plan.error().message;
  const auto under = on_layer(*plan, "UNDERLAY");
  ASSERT_EQ(under.size(), 1u);
  EXPECT_EQ(std::get<PlanPicture>(under[0]->shape).high, DVec2(22.0, 13.0));
  ASSERT_TRUE(write_plan_svg(*plan, folder / "u.svg"));
  EXPECT_NE(slurp(folder / "u.svg").find("data:image/jpeg;base64,/9j/"), std::string::npos);

  std::filesystem::remove(folder / "old.png");
  EXPECT_FALSE(draw_plan(grown(with), "garden"));
}

}  // namespace
}  // namespace bosquet::exchange
