#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "cli/command_words.h"
#include "cli/options.h"
#include "cli/version.h"

namespace bosquet::cli {
namespace {

const std::map<std::string, bool> kOnOff{{"on", true}, {"off", false}};

// A number in [low, high]; CLI11's own range lets "nan" pass.
CLI::Validator within(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return std::string();
        const std::string allowed =
            "' must be a number from " + CLI::detail::to_string(low) + " to " + CLI::detail::to_string(high);
        const auto comma = text.find(',');
        if (comma == std::string::npos) return "'" + text + allowed;
        std::string with_point = text;
        with_point[comma] = '.';
        return CLI::detail::lexical_cast(with_point, value)
                   ? "'" + text + allowed + "; decimals stand behind a point: " + with_point
                   : "'" + text + allowed;
      },
      "");
}

// A whole number from 0 on; CLI11 lets negative and overlong ones wrap round.
CLI::Validator whole(std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) {
  return CLI::Validator(
      [most](std::string& text) {
        std::uint64_t value = 0;
        const auto [end, mistake] = std::from_chars(text.data(), text.data() + text.size(), value);
        return !text.empty() && mistake == std::errc() && end == text.data() + text.size() && value <= most
                   ? std::string()
                   : "'" + text + "' must be a whole number from 0 to " + std::to_string(most);
      },
      "");
}

// One of these words.
template <class Value>
CLI::Validator one_of(const std::map<std::string, Value>& words) {
  return CLI::Validator(
      [words](std::string& text) {
        if (const auto found = words.find(text); found != words.end()) {
          text = std::to_string(static_cast<int>(found->second));
          return std::string();
        }
        std::string allowed;
        for (const auto& [word, value] : words) allowed += (allowed.empty() ? "" : ", ") + word;
        return "'" + text + "' must be one of: " + allowed;
      },
      "");
}

template <class Enum, std::size_t N>
std::map<std::string, Enum> by_name(const std::array<std::string_view, N>& names) {
  std::map<std::string, Enum> map;
  for (std::size_t i = 0; i < N; ++i) map.emplace(names[i], static_cast<Enum>(i));
  return map;
}

void add_threads(CLI::App* app, Options& o) {
  app->add_option("--threads", o.threads, "Threads to use; 0 is one per core")
      ->check(CLI::Range(0, 1024))
      ->option_text("N");
}

void add_replace(CLI::App* app, Options& o, const char* what = "A project or recipe") {
  app->add_flag("--replace", o.replace, std::string(what) + " that stands in an output's place may be lost");
}

void add_quiet(CLI::App* app, Options& o) { app->add_flag("--quiet", o.quiet, "Shows no progress and no warnings"); }

void add_common(CLI::App* app, Options& o) {
  add_threads(app, o);
  app->add_option("--report", o.report, "Writes counts, seconds and warnings as JSON")->option_text("FILE.json");
  add_quiet(app, o);
}

void add_detail(CLI::App* app, Options& o) {
  app->add_option("--detail", o.grow.detail, "Internodes are this many times shorter, 0.25 to 4")
      ->check(within(0.25, 4.0))
      ->option_text("K");
}

void add_season(CLI::App* app, Options& o) {
  auto seasons = by_name<geometry::Season>(geometry::kSeasonNames);
  seasons.emplace("winter", geometry::Season::bare);
  app->add_option("--season", o.season, "spring, summer, autumn or bare (winter is the same)")
      ->transform(one_of(seasons))
      ->option_text("NAME");
}

void add_growth(CLI::App* app, Options& o) {
  app->add_option("--seed", o.seed, "Seed in place of the recipe's")->check(whole())->option_text("S");
  app->add_option("--year", o.years,
                  "Age in years at which trees are shown; default: grown up. make takes several, like 5,15,40")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(within(0.0, 2000.0))
      ->option_text("N");
  add_detail(app, o);
  app->add_option("--regions", o.grow.regions, "on: trees keep to their crown regions")
      ->transform(one_of(kOnOff))
      ->option_text("on|off");
  app->add_option("--asymmetry", o.grow.asymmetry, "on: trees lean away from their neighbours")
      ->transform(one_of(kOnOff))
      ->option_text("on|off");
  app->add_option("--light", o.grow.light, "off: neighbours' crowns cast no shade, whatever the recipe says")
      ->transform(one_of(kOnOff))
      ->option_text("on|off");
}

void add_scene(CLI::App* app, Options& o) {
  add_growth(app, o);
  add_season(app, o);
  app->add_option("--foliage", o.foliage, "leaves, clusters or cards")
      ->transform(one_of(by_name<geometry::FoliageLevel>(geometry::kFoliageLevelNames)))
      ->option_text("LEVEL");
  app->add_option("--max-triangles", o.max_triangles, "Triangle budget of the scene; 0 is no limit")
      ->check(whole(1'000'000'000))
      ->option_text("N");
}

void add_gltf(CLI::App* app, Options& o) {
  app->add_option("--instancing", o.instancing, "on: leaves as instances (EXT_mesh_gpu_instancing, required)")
      ->transform(one_of(kOnOff))
      ->option_text("on|off");
  app->add_option("--wind", o.wind, "on: how far each vertex gives way to the wind, for engines' shaders (_WIND)")
      ->transform(one_of(kOnOff))
      ->option_text("on|off");
  app->add_option("--compress", o.compression, "none, quantize (opens nearly everywhere) or meshopt")
      ->transform(one_of(by_name<exchange::Compression>(exchange::kCompressionNames)))
      ->option_text("KIND");
  app->add_option("--lod", o.lod, "Coarser levels of each tree: none, nodes (children NAME_LOD0...) or msft (MSFT_lod)")
      ->transform(one_of(by_name<exchange::LodFiles>(exchange::kLodFilesNames)))
      ->option_text("KIND");
}

void add_size(CLI::App* app, Options& o, const std::string& meaning) {
  app->add_option_function<std::string>(
         "--size",
         [&o](const std::string& text) {
           int w = 0, h = 0, used = 0;
           if (std::sscanf(text.c_str(), "%dx%d%n", &w, &h, &used) != 2 ||
               static_cast<std::size_t>(used) != text.size() || w < 16 || h < 16 || w > 16384 || h > 16384)
             throw CLI::ValidationError("--size",
                                        "'" + text + "' must be WIDTHxHEIGHT in pixels, 16 to 16384, like 1600x900");
           o.width = w, o.height = h;
         },
         meaning)
      ->option_text("WxH");
}

void add_picture(CLI::App* app, Options& o) {
  app->add_option(
         "--camera", o.camera,
         "A camera of the recipe, or eye and target as east,north,height,east,north,height (heights above datum 0)")
      ->option_text("NAME|x,y,z,tx,ty,tz");
  app->add_option("--sun", o.sun, "\"2026-06-21 15:00\" or azimuth,elevation in degrees")->option_text("TIME|az,el");
  app->add_option_function<std::vector<std::string>>(
         "--figure",
         [&o](const std::vector<std::string>& places) {
           for (const std::string& text : places) {
             Vec2 at{0.0f};
             int used = 0;
             if (std::sscanf(text.c_str(), "%f,%f%n", &at.x, &at.y, &used) != 2 ||
                 static_cast<std::size_t>(used) != text.size() || !std::isfinite(at.x) || !std::isfinite(at.y))
               throw CLI::ValidationError("--figure", "'" + text + "' must be east,north in metres, like 12,30.5");
             o.figures.push_back(at);
           }
         },
         "A walking person 1.75 m high, for scale, in pictures; may be given several times")
      ->allow_extra_args(false)
      ->option_text("EAST,NORTH");
  add_size(app, o, "Pixels, default 1600x900");
}

}  // namespace

ParsedLine parse_command_line(int argc, char** argv) {
  ParsedLine parsed;
  Options& o = parsed.options;

  CLI::App app{"Bosquet: paint a forest, and every tree grows its own way.", "bosquet"};
  app.set_version_flag("--version", std::string("bosquet ") + kVersion);
  app.require_subcommand(0, 1);
  app.failure_message([](const CLI::App*, const CLI::Error& e) {
    return std::string("bosquet: ") + e.what() + "\nRun with --help for more information.\n";
  });

  CLI::App* make = app.add_subcommand(
      "make",
      "Grows the scene of a recipe and writes it: .glb .gltf .png .plan.png .svg .dxf .csv .species.csv "
      ".gpkg .geojson .shp .vdb .tree.json .bosquet .toml");
  make->alias("export");
  make->add_option("recipe", o.file, "Recipe (.toml) or project (.bosquet)")->required()->option_text("FILE");
  make->add_option("-o,--output", o.outputs, "Output; may be given several times")
      ->required()
      ->allow_extra_args(false)
      ->option_text("OUT");
  make->add_option("--tree", o.tree, "The tree, by its id, that goes into an output NAME.tree.json")
      ->check(whole(2'147'483'647))
      ->option_text("ID");
  add_replace(make, o);
  add_scene(make, o), add_gltf(make, o), add_picture(make, o), add_common(make, o);
  make->callback([&] { o.command = Command::make; });

  CLI::App* render = app.add_subcommand("render", "Grows the scene of a recipe and draws a picture of it");
  render->add_option("file", o.file, "Recipe (.toml) or project (.bosquet)")->required()->option_text("FILE");
  render->add_option("-o,--output", o.outputs, "Picture (.png)")->required()->expected(1)->option_text("OUT.png");
  render->add_option("--view", o.view, "trees, shapes, regions, arrows or plan")
      ->transform(one_of(std::map<std::string, ViewKind>{{"trees", ViewKind::trees},
                                                         {"shapes", ViewKind::shapes},
                                                         {"regions", ViewKind::regions},
                                                         {"arrows", ViewKind::arrows},
                                                         {"plan", ViewKind::plan}}))
      ->option_text("NAME");
  render->add_option("--slice", o.slice_m, "Height in metres at which --view regions cuts")
      ->check(within(-10000.0, 10000.0))
      ->option_text("M");
  add_scene(render, o), add_picture(render, o), add_common(render, o);
  render->callback([&] { o.command = Command::render; });

  CLI::App* info = app.add_subcommand("info", "Says what is in a glTF file, a recipe or a project");
  info->add_option("file", o.file, ".glb, .gltf, recipe (.toml) or project (.bosquet)")
      ->required()
      ->option_text("FILE");
  info->add_flag("--json", o.json, "As JSON");
  info->add_flag("--check", o.check,
                 "Judges a glTF file: bounds, instances, levels, packed data; exit status 1 if bad");
  info->callback([&] { o.command = Command::info; });

  CLI::App* add = app.add_subcommand(
      "import", "Adds ground, trees or obstacles to a project or recipe, which is made when missing");
  add->add_option("project", o.file, "Project (.bosquet) or recipe (.toml)")->required()->option_text("PROJECT");
  add->add_option("--dem", o.dem, "Elevation raster (GeoTIFF, PNG, ...)")->option_text("FILE");
  add->add_option("--trees", o.inventory, "Tree inventory (.csv .geojson .gpkg .shp .dxf)")->option_text("FILE");
  add->add_option("--obstacle", o.obstacle, "Into a project: mesh (.glb .gltf .obj) or outlines (.geojson .gpkg .shp)")
      ->option_text("FILE");
  add->callback([&] { o.command = Command::import_data; });

  CLI::App* recover = app.add_subcommand("recover", "Lists what sessions left that ended without saving, and saves it");
  recover->add_option("name", o.recovery, "list (the default), or a name of the list")->option_text("list|NAME");
  recover->add_option("-o,--output", o.outputs, "Project to save it as (.bosquet)")->expected(1)->option_text("FILE");
  add_replace(recover, o), add_quiet(recover, o);
  recover->callback([&, recover] {
    const bool list = o.recovery.empty() || o.recovery == "list";
    if (list == !o.outputs.empty())
      throw CLI::ValidationError("recover",
                                 list ? "-o needs the NAME of what is to be recovered" : "NAME needs -o FILE");
    o.command = list ? Command::recover_list : Command::recover;
  });

  CLI::App* stats = app.add_subcommand("stats", "Grows a recipe and measures the pattern of bases and crown centroids");
  stats->add_option("file", o.file, "Recipe (.toml) or project (.bosquet)")->required()->option_text("FILE");
  stats->add_flag("--json", o.json, "As JSON");
  add_growth(stats, o), add_common(stats, o);
  stats->callback([&] { o.command = Command::stats; });

  CLI::App* species = app.add_subcommand("species", "The built-in species");
  species->require_subcommand(1);
  species->add_subcommand("list", "Names them")->callback([&] { o.command = Command::species_list; });
  CLI::App* show = species->add_subcommand("show", "Prints a species' file");
  show->add_option("name", o.species)->required();
  show->callback([&] { o.command = Command::species_show; });
  CLI::App* calibrate = species->add_subcommand(
      "calibrate", "Grows trees that stand alone and measures them beside what the species' file says");
  calibrate->add_option("names", o.names, "Species, or files of your own (.toml); default: all built-in ones")
      ->option_text("NAME|FILE.toml");
  calibrate
      ->add_option("-o,--output", o.outputs,
                   "Writes the species file with the measured [shape] and pipe_exponent; a folder for several")
      ->expected(1)
      ->option_text("OUT.toml");
  calibrate->add_option("--trees", o.calibration_trees, "Trees to grow, default 20")
      ->check(CLI::Range(1, 1000))
      ->option_text("N");
  calibrate->add_flag("--quick", o.quick, "Leaves out the trees at detail 0.5 and 2");
  add_replace(calibrate, o, "A file"), add_threads(calibrate, o);
  calibrate->callback([&] { o.command = Command::species_calibrate; });
  CLI::App* gallery = species->add_subcommand(
      "gallery", "Draws a sheet of species, young, middle-aged and old, with and without leaves");
  gallery->add_option("names", o.names, "Species, or files of your own (.toml); default: all built-in ones")
      ->option_text("NAME|FILE.toml");
  gallery->add_option("-o,--output", o.outputs, "Picture (.png or .jpg)")->required()->expected(1)->option_text("OUT");
  gallery->add_option("--ages", o.ages, "Years, like 10,40,100; default: 10, 50 and 100, less for the short-lived")
      ->delimiter(',')
      ->check(within(1.0, 2000.0))
      ->option_text("A,B,C");
  add_season(gallery, o);
  add_detail(gallery, o);
  add_size(gallery, o, "Pixels the sheet may take, default 3200x4800");
  gallery->add_option("--seed", o.seed, "Other trees of the same species")->check(whole())->option_text("S");
  add_threads(gallery, o), add_quiet(gallery, o);
  gallery->callback([&, gallery] {
    o.command = Command::species_gallery;
    if (gallery->count("--size") == 0) o.width = 3200, o.height = 4800;
  });

  CLI::App* window = app.add_subcommand("ui", "The window; also what bosquet alone opens");
  window->add_option("file", o.file, "Project (.bosquet) or recipe (.toml)")->option_text("FILE");
  window->add_option("--script", o.script, "Replays the events of a file, then closes")->option_text("FILE");
  window->add_option("--screenshot", o.screenshot, "Saves the window's last frame as a picture")
      ->option_text("OUT.png");
  window->add_option("--report", o.report, "Writes the seconds of its frames as JSON")->option_text("FILE.json");
  window->add_option("--state", o.window_state, "Keeps a file that says what the window shows, as JSON")
      ->option_text("FILE.json");
  window->add_option("--scale", o.window_scale, "Size of text and buttons, 0.5 to 4; default: the screen's")
      ->check(within(0.5, 4.0))
      ->option_text("X");
  add_size(window, o, "Pixels of the window, default 1440x900 or what the screen has room for");
  add_threads(window, o);
  window->callback([&, window] {
    o.command = Command::ui;
    o.window_size_given = window->count("--size") > 0;
  });

  try {
    app.parse(argc, argv);
    if (o.years.size() > 1 && o.command != Command::make)
      throw CLI::ValidationError("--year", "one age; only make takes several, a set of files for each");
    if (o.slice_m && o.view != ViewKind::regions)
      throw CLI::ValidationError("--slice", "cuts crown regions; it goes with --view regions");
    if (o.years.size() == 1) o.grow.year = o.years.front();
  } catch (const CLI::ParseError& e) {
    // A word that nothing knows is the mistake behind whatever else is missing then.
    const auto wrong = e.get_exit_code() == 0 ? std::nullopt : wrong_word(app, {argv + 1, argv + argc});
    if (wrong)
      std::fprintf(stderr, "bosquet: %s\nRun with --help for more information.\n", wrong->c_str()),
          parsed.exit_status = 1;
    else
      parsed.exit_status = app.exit(e) == 0 ? 0 : 1;
  }
  return parsed;
}

}  // namespace bosquet::cli
