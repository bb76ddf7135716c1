// The documents that "New" offers, as recipes.
#include <array>

#include "exchange/recipe.h"
#include "ui/session.h"

namespace bosquet::ui {
namespace {

struct Template {
  const char* name;
  const char* recipe;
};

constexpr const char* kSpecies = R"(
[[species]]
name = "english_oak"
[[species]]
name = "silver_birch"
[[species]]
name = "small_leaved_lime"
[[species]]
name = "norway_maple"
[[species]]
name = "wild_cherry"
[[species]]
name = "scots_pine"
)";

constexpr std::array<Template, 5> kTemplates{{
    {"Meadow", R"([site]
size_m = [80, 80]
[terrain.noise]
amplitude_m = 0.4
scale_m = 25
)"},
    {"River bank", R"([site]
size_m = [100, 80]
[terrain]
water_level_m = -0.8
[terrain.noise]
amplitude_m = 0.4
scale_m = 25
[[terrain.stroke]]
kind = "lower"
radius_m = 13
amount_m = 3
hardness = 0.25
points = [[-12, 26], [22, 32], [50, 24], [78, 32], [112, 26]]
[[species]]
name = "weeping_willow"
)"},
    {"City square", R"([site]
size_m = [60, 60]
[[terrain.exclusion]]
name = "square"
polygon = [[8, 8], [52, 8], [52, 52], [8, 52]]
[[species]]
name = "london_plane"
)"},
    {"Avenue", R"([site]
size_m = [120, 50]
[terrain.noise]
amplitude_m = 0.15
scale_m = 30
[[terrain.path]]
name = "drive"
width_m = 5
points = [[-2, 25], [122, 25]]
[[planting]]
name = "avenue"
kind = "row"
species = { small_leaved_lime = 1 }
scale = [0.8, 0.9]
points = [[6, 25], [114, 25]]
spacing_m = 9
sides = "both"
offset_m = 6
)"},
    {"Forest edge", R"([site]
size_m = [80, 60]
[terrain.noise]
amplitude_m = 0.6
scale_m = 25
[[planting]]
name = "wood"
kind = "fill"
species = { english_oak = 2, silver_birch = 2, norway_spruce = 1 }
scale = [0.5, 0.9]
polygon = [[0, 28], [25, 34], [55, 28], [80, 36], [80, 60], [0, 60]]
density_per_ha = 350
[[planting]]
name = "edge"
kind = "fill"
species = { common_hazel = 2, rowan = 1 }
scale = [0.6, 1.0]
polygon = [[0, 20], [25, 26], [55, 20], [80, 28], [80, 36], [55, 28], [25, 34], [0, 28]]
density_per_ha = 250
)"},
}};

}  // namespace

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const Template& t : kTemplates) names.emplace_back(t.name);
  return names;
}

namespace {

Result<scene::Document> made(const std::string& recipe_text, const std::string& name) {
  auto recipe = exchange::parse_recipe(recipe_text, name + ".toml");
  if (!recipe) return recipe.error();
  auto built = exchange::build_document(*recipe);
  if (!built) return built.error();
  scene::settle_counters(built->document);
  return std::move(built->document);
}

}  // namespace

Result<scene::Document> make_example() { return made(example_park_recipe(), "park"); }

Result<scene::Document> make_template(const std::string& name) {
  for (const Template& t : kTemplates)
    if (name == t.name) return made(std::string(t.recipe) + kSpecies, name);
  std::string known;
  for (const Template& t : kTemplates) known += (known.empty() ? "" : ", ") + std::string(t.name);
  return Error{"no template is called '" + name + "'; there are: " + known};
}

}  // namespace bosquet::ui
