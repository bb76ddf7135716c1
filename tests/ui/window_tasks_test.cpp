// Whole tasks in the real window: pointer and keys by xdotool, on an X server of the test's own.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include "desktop.h"
#include "x_client.h"

namespace bosquet::ui {
namespace {

using test::Json;
using test::rest;
using test::Started;

// A level lawn with a few species to paint.
constexpr const char* kLawn = R"([site]
size_m = [60, 50]
seed = 3
[[species]]
name = "silver_birch"
[[species]]
name = "rowan"
[[camera]]
name = "from the south"
eye = [30, -38, 26]
target = [30, 22, 0]
)";

// Birches in two rows, far enough from each other that the ends do not meet.
constexpr const char* kRows = R"([site]
size_m = [90, 40]
seed = 3
[[planting]]
name = "rows"
kind = "grid"
species = { silver_birch = 1 }
scale = [0.4, 0.4]
polygon = [[4, 12], [86, 12], [86, 26], [4, 26]]
spacing_m = 8
row_gap_m = 10
[[camera]]
name = "from the south"
eye = [45, -88, 50]
target = [45, 18, 0]
)";

bool grown(const Json& s) { return s["settled"].get<bool>() && s["grown"] == s["trees"]; }

std::map<int, std::pair<double, double>> places(const Json& s) {
  std::map<int, std::pair<double, double>> all;
  for (const Json& place : s["places"]) all[place["id"]] = {place["east"], place["north"]};
  return all;
}

// The tree of the southern row that stands at this place in it.
int in_front(const Json& s, std::size_t number) {
  std::vector<std::pair<double, int>> row;
  double south = 1e9;
  for (const Json& place : s["places"]) south = std::min(south, place["north"].get<double>());
  for (const Json& place : s["places"])
    if (place["north"].get<double>() < south + 3) row.emplace_back(place["east"].get<double>(), place["id"].get<int>());
  std::sort(row.begin(), row.end());
  return row.at(number).second;
}

// Share of the pixels of a part of the scene that are so.
template <class So>
double share(const Image& image, Vec2 low, Vec2 high, So so) {
  std::size_t yes = 0, all = 0;
  for (int y = static_cast<int>(low.y); y < static_cast<int>(high.y); ++y)
    for (int x = static_cast<int>(low.x); x < static_cast<int>(high.x); ++x, ++all) yes += so(image.at(x, y));
  return static_cast<double>(yes) / static_cast<double>(std::max<std::size_t>(1, all));
}
bool sky(const std::uint8_t* p) { return p[2] > p[0] + 15 && p[2] > 120; }
bool green(const std::uint8_t* p) { return p[1] > p[0] + 8 && p[1] > p[2] + 15; }
bool dark_green(const std::uint8_t* p) { return green(p) && p[1] < 105; }

using WindowTask = test::Desktop;

TEST_F(WindowTask, TheFirstStartShowsTheExampleParkAndFiveStepsThatCanBeGoneThrough) {
  open();
  ASSERT_TRUE(wait([](const Json& s) { return s["grown"] > 20; })) << said();
  Json now = state();
  EXPECT_GT(now["trees"], 200);
  EXPECT_EQ(now["title"], "Park - Bosquet");
  EXPECT_EQ(now["overlay_step"], 0);
  const Image image = screen("first_start");
  EXPECT_GT(share(image, scene(0.5f, 0.0f), scene(1, 0.08f), sky), 0.3);
  EXPECT_GT(share(image, scene(0, 0.3f), scene(1, 1), green), 0.4);
  for (int step = 1; step <= 5; ++step) {
    press("Next");
    ASSERT_TRUE(wait([&](const Json& s) { return s["overlay_step"] == (step < 5 ? step : -1); }, 60)) << step;
  }
  press("View");
  press("Feet and inches");
  ASSERT_TRUE(wait([](const Json& s) { return s["units"] == "feet"; }, 60));
  press("View");
  press("Dark");
  ASSERT_TRUE(wait([](const Json& s) { return s["dark"] == false; }, 60));
  key("ctrl+q");
  ASSERT_EQ(window_->ended(120), 0) << said();
  // Who has seen it once is not shown it again, and what was chosen stays so.
  open();
  EXPECT_EQ(state()["overlay_step"], -1);
  EXPECT_EQ(state()["units"], "feet");
  EXPECT_EQ(state()["dark"], false);
}

TEST_F(WindowTask, ALoweredRiverFillsWithWater) {
  open({write("lawn.toml", kLawn).string()});
  press("Lower ground");
  for (int stroke = 0; stroke < 3; ++stroke) drag(scene(0.02f, 0.5f), scene(0.98f, 0.5f), 14);
  ASSERT_TRUE(wait([](const Json& s) { return s["undo"] == "Lower ground"; }, 60));
  ASSERT_TRUE(settle());
  const Image dry = screen("river_dry");
  press("Water level");
  drag(scene(0.5f, 0.5f), scene(0.5f, 0.5f) - Vec2(0, 16));
  ASSERT_TRUE(wait([](const Json& s) { return s.contains("water_level_m"); }, 60));
  EXPECT_LT(state()["water_level_m"], 0.0);
  ASSERT_TRUE(settle());
  const Image wet = screen("river");
  // Water has no green of grass; it has the sky's blue.
  const Vec2 low = scene(0.3f, 0.48f), high = scene(0.7f, 0.52f);
  EXPECT_GT(share(dry, low, high, green), 0.8);
  EXPECT_LT(share(wet, low, high, green), 0.3);
}

TEST_F(WindowTask, TwoHundredPaintedTreesGrow) {
  std::string park = kLawn;
  park.replace(park.find("[60, 50]"), 8, "[90, 80]");
  park.replace(park.find("eye"), std::string::npos, "eye = [45, -80, 60]\ntarget = [45, 38, 0]\n");
  open({write("lawn.toml", park).string()});
  take("b", "Plant brush");
  for (int i = 0; i < 10; ++i) key("bracketright");
  ASSERT_TRUE(wait([](const Json& s) { return s["radius_m"] > 20; }, 60));
  const Image before = screen("lawn");
  hand("mousemove " + at(scene(0.1f, 0.4f)) + " sleep 0.1 mousedown 1");
  std::size_t trees = 0;
  for (int turn = 0; turn < 100 && trees < 200; ++turn) {
    const float x = 0.1f + 0.8f * static_cast<float>(turn % 8) / 7, y = turn % 2 ? 0.8f : 0.45f;
    hand("mousemove " + at(scene(x, y)) + " sleep 0.1");
    trees = state()["trees"];
  }
  // Shapes stand while the hand still moves.
  const Image painting = screen("painting");
  hand("mouseup 1 sleep 0.2");
  EXPECT_GT(share(painting, scene(0, 0.3f), scene(1, 1), dark_green),
            share(before, scene(0, 0.3f), scene(1, 1), dark_green) + 0.02);
  trees = state()["trees"];
  EXPECT_GE(trees, 200u);
  EXPECT_EQ(state()["undo"], "Plant " + std::to_string(trees) + " trees");
  EXPECT_TRUE(wait(grown)) << state()["grown"];
  screen("painted");
}

TEST_F(WindowTask, MovingOneTreeChangesItsNeighboursAloneAndUndoAndRedoGiveTheSameBits) {
  open({write("rows.toml", kRows).string()});
  ASSERT_TRUE(wait(grown)) << said();
  const Json before = state();
  ASSERT_GT(before["trees"], 15);
  const auto stood = places(before);
  ASSERT_EQ(stood.size(), before["trees"]);
  const int moved = in_front(before, 0);
  const Vec2 from = foot(moved);
  drag(from, from + Vec2(22, -14));
  ASSERT_TRUE(wait([](const Json& s) { return s["undo"] == "Move a tree"; }, 60)) << state()["undo"];
  rest(0.3);
  ASSERT_TRUE(wait(grown));
  const Json after = state();
  screen("moved");
  int changed = 0;
  for (const auto& [id, to] : places(after)) {
    const auto was = stood.at(id);
    if (id == moved)
      EXPECT_GT(std::hypot(to.first - was.first, to.second - was.second), 1.0);
    else
      EXPECT_EQ(to, was) << id;
    const bool other = after["skeletons"][std::to_string(id)] != before["skeletons"][std::to_string(id)];
    changed += other;
    const auto near = stood.at(moved);
    const double away =
        std::min(std::hypot(was.first - near.first, was.second - near.second),
                 std::hypot(was.first - places(after)[moved].first, was.second - places(after)[moved].second));
    EXPECT_TRUE(!other || away < 26) << id << " stands " << away << " m away";
  }
  EXPECT_GE(changed, 1);
  EXPECT_LT(changed, static_cast<int>(stood.size()));

  key("Delete");  // the moved tree is selected
  ASSERT_TRUE(wait([](const Json& s) { return s["undo"] == "Remove a tree"; }, 60)) << state()["undo"];
  key("ctrl+z");
  key("ctrl+z");
  ASSERT_TRUE(wait([](const Json& s) { return s["undo"] == ""; }, 60));
  rest(0.3);
  ASSERT_TRUE(wait(grown));
  EXPECT_EQ(state()["skeletons"], before["skeletons"]);
  EXPECT_EQ(places(state()), stood);
  key("ctrl+y");
  ASSERT_TRUE(wait([](const Json& s) { return s["undo"] == "Move a tree"; }, 60));
  rest(0.3);
  ASSERT_TRUE(wait(grown));
  EXPECT_EQ(state()["skeletons"], after["skeletons"]);
  key("ctrl+y");
  EXPECT_TRUE(wait([](const Json& s) { return s["redo"] == ""; }, 60));
}

TEST_F(WindowTask, DraggingInTheTriangleOfOneTreeLetsItAloneGrowAgain) {
  open({write("rows.toml", kRows).string()});
  ASSERT_TRUE(wait(grown)) << said();
  const Json before = state();
  const int tree = in_front(before, 4);
  click(foot(tree) - Vec2(0, 3));
  ASSERT_TRUE(wait([&](const Json& s) { return s["selection"] == Json{tree}; }, 60)) << state()["selection"];
  const Vec2 triangle = widget("Weights");
  drag(triangle, triangle + Vec2(-30, 25));
  const std::string own = std::to_string(tree);
  ASSERT_TRUE(wait([&](const Json& s) {
    return s["undo"] != "" && grown(s) && s["skeletons"][own] != before["skeletons"][own];
  })) << state()["undo"];
  const Json after = state();
  screen("triangle");
  for (const auto& [id, digest] : before["skeletons"].items())
    EXPECT_EQ(after["skeletons"][id] != digest, id == own) << id;
}

TEST_F(WindowTask, AnExportedGlbHoldsBeforeTheJudges) {
  open({write("rows.toml", kRows).string()});
  ASSERT_TRUE(wait(grown)) << said();
  key("ctrl+e");
  // As below: the dialog may find its place after it told where its button is.
  for (int turn = 0; turn < 5 && state()["question"] != "file"; ++turn) {
    press("Choose file...");
    wait([](const Json& s) { return s["question"] == "file"; }, 15);
  }
  ASSERT_EQ(state()["question"], "file");
  key("ctrl+a");
  type((folder_ / "out.glb").string());
  key("Return");
  ASSERT_TRUE(wait([](const Json& s) { return s["message"].get<std::string>().starts_with("Exported out.glb"); }))
      << state()["message"];
  const std::string file = (folder_ / "out.glb").string();
  const std::string quiet = " '" + file + "' > '" + (folder_ / "judged").string() + "' 2>&1";
  EXPECT_EQ(std::system((std::string(BOSQUET_PROGRAM) + " info --check" + quiet).c_str()), 0);
  const std::string web = std::string(BOSQUET_SOURCE_DIR) + "/tests/web";
  if (std::filesystem::exists(web + "/node_modules/gltf-validator")) {
    EXPECT_EQ(std::system(("node '" + web + "/validate.mjs'" + quiet).c_str()), 0);
  }
}

TEST_F(WindowTask, WorkThatWasPaintedBeforeTheProgramIsKilledIsRecovered) {
  open({write("lawn.toml", kLawn).string()});
  take("b", "Plant brush");
  hand("mousemove " + at(scene(0.2f, 0.6f)) + " sleep 0.1 mousedown 1");
  std::size_t painted = 0;
  for (int turn = 0; turn < 40 && painted < 15; ++turn) {
    hand("mousemove " + at(scene(0.2f + 0.015f * static_cast<float>(turn), 0.6f)) + " sleep 0.1");
    painted = state()["trees"];
  }
  ASSERT_GE(painted, 15u);
  rest(1.5);  // what is a second old is on the disk
  window_->kill_now();
  hand("mouseup 1");
  open();
  ASSERT_EQ(state()["question"], "recover");
  screen("recover");
  // A slow machine tells where the button was some frames ago: the dialog may have found its place since.
  for (int turn = 0; turn < 5 && state()["question"] == "recover"; ++turn) {
    press("Recover 0");
    wait([](const Json& s) { return s["question"] == ""; }, 15);
  }
  ASSERT_EQ(state()["question"], "");
  EXPECT_GE(state()["trees"], painted);
  EXPECT_TRUE(state()["unsaved"]);
  screen("recovered");
}

TEST_F(WindowTask, UnsavedWorkIsAskedAboutAndNeverLost) {
  open({write("lawn.toml", kLawn).string()});
  take("t", "Single tree");
  click(scene(0.5f, 0.6f));
  ASSERT_TRUE(wait([](const Json& s) { return s["trees"] == 1 && s["unsaved"]; }, 60));
  test::XClient desktop(display_);
  ASSERT_TRUE(desktop.close_window());
  ASSERT_TRUE(wait([](const Json& s) { return s["question"] == "unsaved"; }, 60));
  press("Cancel");
  ASSERT_TRUE(wait([](const Json& s) { return s["question"] == ""; }, 60));
  EXPECT_EQ(state()["trees"], 1);
  key("ctrl+q");
  press("Save");
  ASSERT_TRUE(wait([](const Json& s) { return s["question"] == "file"; }, 60));
  key("ctrl+a");
  type((folder_ / "kept.bosquet").string());
  key("Return");
  EXPECT_EQ(window_->ended(120), 0) << said();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "kept.bosquet"));

  // Opened twice, the second window cannot write over the first one's work.
  open({(folder_ / "kept.bosquet").string()});
  const std::filesystem::path first_state = state_;
  std::unique_ptr<Started> first = std::move(window_);
  open({(folder_ / "kept.bosquet").string()}, "second.json");
  EXPECT_NE(state()["title"].get<std::string>().find("(read-only)"), std::string::npos) << state()["title"];
}

TEST_F(WindowTask, AFileThatIsNoProjectIsNamedAndTheDocumentStays) {
  open({write("lawn.toml", kLawn).string()});
  const auto named = [&](const std::filesystem::path& file) {
    EXPECT_TRUE(wait(
        [&](const Json& s) {
          return s["message"].get<std::string>().find(file.filename().string()) != std::string::npos;
        },
        60))
        << state()["message"];
    EXPECT_EQ(state()["title"], "lawn - Bosquet");
  };
  const std::filesystem::path wrong = write("notes.txt", "hello"), broken = write("broken.bosquet", "no database");
  test::XClient desktop(display_);
  ASSERT_TRUE(desktop.drop(wrong.string()));
  named(wrong);
  key("ctrl+o");
  ASSERT_TRUE(wait([](const Json& s) { return s["question"] == "file"; }, 60));
  type(broken.string());
  key("Return");
  named(broken);
  // What is a recipe opens where it is dropped.
  ASSERT_TRUE(desktop.drop(write("meadow.toml", kLawn).string()));
  EXPECT_TRUE(wait([](const Json& s) { return s["title"] == "meadow - Bosquet"; }, 60)) << state()["title"];
}

TEST_F(WindowTask, AStrokeOfAHundredThousandTreesAsksFirst) {
  std::string wide = kLawn;
  wide.replace(wide.find("[60, 50]"), 8, "[4000, 4000]");
  wide.replace(wide.find("eye"), std::string::npos, "eye = [2000, -2600, 1800]\ntarget = [2000, 1400, 0]\n");
  open({write("wide.toml", wide).string()});
  take("p", "Fill area");
  for (Vec2 p : {Vec2(0.3f, 0.5f), Vec2(0.7f, 0.5f), Vec2(0.5f, 0.75f)}) click(scene(p.x, p.y));
  key("Return");
  ASSERT_TRUE(wait([](const Json& s) { return s["question"] == "many trees"; }, 60)) << state().dump();
  screen("many_trees");
  press("Do not");
  ASSERT_TRUE(wait([](const Json& s) { return s["question"] == ""; }, 60));
  EXPECT_EQ(state()["trees"], 0);
}

TEST_F(WindowTask, TheLastLineOfAScriptIsPlayedAndAnyNameOfAFileCanBeTold) {
  const std::filesystem::path script = write("s.script", "settle\ntool Single tree\nground 30 25\npress\n");
  open({write("l\xe4wn.toml", kLawn).string(), "--script", script.string()});
  EXPECT_EQ(window_->ended(60), 0) << said();
  EXPECT_EQ(state()["trees"], 1);
  EXPECT_NE(state()["title"].get<std::string>().find("l\xef\xbf\xbdwn"), std::string::npos) << state()["title"];
}

TEST_F(WindowTask, AStateFileThatCannotBeWrittenEndsItWithOneMessage) {
  const std::filesystem::path nowhere = folder_ / "nowhere" / "state.json";
  Started window({BOSQUET_PROGRAM, "ui", "--state", nowhere.string()}, environment(),
                 (folder_ / "window.log").string());
  EXPECT_EQ(window.ended(60), 2);
  EXPECT_NE(said().find(nowhere.string() + ": cannot be written"), std::string::npos) << said();
}

TEST_F(WindowTask, WithoutADisplayOrOpenGlItSaysWhatWorksWithoutThem) {
  const auto tried = [&](const std::vector<std::string>& environment) {
    Started window({BOSQUET_PROGRAM, "ui"}, environment, (folder_ / "window.log").string());
    EXPECT_EQ(window.ended(120), 2);
    return said();
  };
  EXPECT_NE(tried({"DISPLAY", "WAYLAND_DISPLAY"}).find("bosquet render"), std::string::npos) << said();
  std::vector<std::string> old = environment();
  old.insert(old.end(), {"MESA_GL_VERSION_OVERRIDE=2.1", "MESA_GLSL_VERSION_OVERRIDE=120"});
  const std::string message = tried(old);
  EXPECT_NE(message.find("3.3"), std::string::npos) << message;
  EXPECT_NE(message.find("bosquet render"), std::string::npos) << message;
}

}  // namespace
}  // namespace bosquet::ui
