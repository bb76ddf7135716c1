#include "exchange/tree_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "core/hash.h"
#include "core/letters.h"
#include "core/random.h"
#include "distribution/inventory.h"
#include "exchange/file_output.h"
#include "exchange/tree_table.h"
#include "growth/age.h"
#include "scene/measured_size.h"
#include "terrain/lattice.h"

namespace bosquet::exchange {
namespace {

using distribution::StandingTree;
using Known = std::span<const std::shared_ptr<const scene::Species>>;

constexpr std::uint64_t kMostSynonymBytes = 16 << 20;
constexpr double kAround_m = 1.0;  // left between a surveyed crown and the site's edge, as crowns lean a little
constexpr std::size_t kListedTwins = 20;

// What a name was taken for, and how often.
struct Use {
  scene::SpeciesMatch match;
  std::size_t trees = 0;
};

// One line for each name that did not mean just a species, first what had none, then those of most trees.
std::vector<std::string> substitution_lines(const std::map<std::string, Use>& uses, Known species,
                                            const std::string& file) {
  std::vector<std::pair<std::string, Use>> sorted(uses.begin(), uses.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.empty(), a.second.trees) > std::pair(b.first.empty(), b.second.trees);
  });
  std::vector<std::string> out;
  for (const auto& [name, use] : sorted) {
    const std::string& as = species[use.match.species]->name;
    const std::string drawn =
        fmt::format("{} drawn as {}", use.trees == 1 ? "1 tree is" : fmt::format("{} trees are", use.trees), as);
    switch (use.match.how) {
      case scene::NameMatch::exact:
        continue;
      case scene::NameMatch::species:
        out.push_back(
            fmt::format("{}: '{}': {}, its species{}", file, name, drawn, use.match.width < 1 ? ", narrower" : ""));
        break;
      case scene::NameMatch::genus:
        out.push_back(fmt::format("{}: '{}' is not a known species; {}, of its genus", file, name, drawn));
        break;
      case scene::NameMatch::leaf_type:
        out.push_back(fmt::format("{}: '{}' is not a known species; {}, a conifer", file, name, drawn));
        break;
      case scene::NameMatch::fallback:
        out.push_back(name.empty() ? fmt::format("{}: {} for want of any name; another species is set by "
                                                 "default_species in their [[planting]], or by names in the file",
                                                 file, drawn)
                                   : fmt::format("{}: '{}' is not a known species; {}", file, name, drawn));
        break;
    }
  }
  return out;
}

// Sizes as the row gives them; a note when they are beyond what the species can be.
std::string set_size(scene::Tree& tree, const scene::Species& species, const InventoryTree& row, float width) {
  const bool sized = row.height_m || row.trunk_diameter_m || row.crown_diameter_m;
  std::optional<float> height = row.height_m;
  if (!sized && row.age_years)
    height =
        std::max(0.02f, growth::height_share_at_age(species.growth, *row.age_years)) * species.shape.mature_height_m;
  std::string note;
  if (sized || height) {
    scene::set_measured_size(tree, species, height, row.trunk_diameter_m, row.crown_diameter_m);
    if (row.height_m && *row.height_m > scene::kMostMeasuredScale * species.shape.mature_height_m)
      note = fmt::format("{:g} m is more than twice the height of {}; cut to that", *row.height_m, species.name);
    else if (row.crown_diameter_m && *row.crown_diameter_m > scene::kMostMeasuredScale * species.shape.crown_width_m)
      note = fmt::format("a crown of {:g} m is more than twice that of {}; cut to that", *row.crown_diameter_m,
                         species.name);
    tree.measured = tree.measured && row.surveyed;
  }
  if (!row.crown_diameter_m) tree.scale_width *= width;
  return note;
}

ImportedTrees planted(Inventory inventory, const std::string& file, const TreeImport& import, std::uint64_t block,
                      std::uint64_t seed, Known species, const scene::Synonyms& synonyms, std::size_t fallback,
                      std::span<const StandingTree> others) {
  ImportedTrees out;
  out.place = std::move(inventory.place);
  out.tally.left_out = static_cast<std::size_t>(
      std::count_if(inventory.problems.begin(), inventory.problems.end(), [](const auto& p) { return !p.kept; }));
  out.tally.trees = inventory.trees.size();
  for (const std::string& note : inventory.notes) out.warnings.push_back(fmt::format("{}: {}", file, note));
  std::vector<RowProblem> problems = std::move(inventory.problems);

  std::vector<distribution::Species> kinds;
  for (const auto& s : species) kinds.push_back({s->name, s->shape.trunk_width_m, s->planting});
  std::map<std::string, Use> uses;
  std::vector<StandingTree> standing(others.begin(), others.end());
  for (std::size_t i = 0; i < inventory.trees.size(); ++i) {
    const InventoryTree& row = inventory.trees[i];
    const auto [use, fresh] = uses.try_emplace(row.species);
    if (fresh) use->second.match = scene::match_species(row.species, species, fallback, &synonyms);
    const scene::SpeciesMatch& match = use->second.match;
    ++use->second.trees;

    scene::Tree tree;
    tree.key = distribution::tree_key(block, i);
    tree.species = match.species;
    const distribution::PlantingRules& rules = species[match.species]->planting;
    const Vec2 range = import.scale.value_or(Vec2{rules.scale_min, rules.scale_max});
    RandomStream stream(seed, tree.key, Purpose::scale);
    tree.scale_height = tree.scale_width = stream.uniform(range.x, range.y);
    if (std::string note = set_size(tree, *species[match.species], row, match.width); !note.empty())
      problems.push_back({row.line, std::move(note), true});
    tree.status = row.status.value_or(import.status);
    out.tally.to_remove += tree.status == scene::TreeStatus::to_remove;
    tree.clear_stem_m = row.clear_stem_m.value_or(0.0f);
    tree.inventory_name = row.name_kept.value_or(row.species);
    tree.inventory_id = row.id;

    StandingTree stands = distribution::standing_tree(tree.key, static_cast<std::uint32_t>(tree.species),
                                                      kinds[tree.species], Vec2(row.plan), tree.scale_width);
    if (tree.trunk_diameter_m) stands.trunk_radius_m = 0.5f * *tree.trunk_diameter_m;
    out.trees.push_back(std::move(tree));
    standing.push_back(stands);
  }

  std::stable_sort(problems.begin(), problems.end(),
                   [](const RowProblem& a, const RowProblem& b) { return a.line < b.line; });
  for (std::string& line : substitution_lines(uses, species, file)) out.warnings.push_back(std::move(line));
  for (std::string& line : problem_lines(problems, file, inventory.features)) out.warnings.push_back(std::move(line));

  const Vec2 size = import.reading.size_m ? Vec2(*import.reading.size_m) : Vec2(1e9f);
  const auto where = [&](std::size_t line) {
    return inventory.features ? fmt::format("feature {}", line) : fmt::format("line {}", line);
  };
  if (const auto nameless = uses.find(""); nameless != uses.end()) {
    out.tally.nameless = nameless->second.trees;
    out.tally.drawn_as = species[nameless->second.match.species]->name;
  }
  std::size_t twins = 0;
  for (const auto& moved : distribution::move_duplicates_apart(standing, size)) {
    if (moved.index < others.size() || ++twins > kListedTwins) continue;
    const int line = inventory.trees[moved.index - others.size()].line;
    const std::string twin = moved.twin < others.size()
                                 ? "a tree that stands there"
                                 : where(static_cast<std::size_t>(inventory.trees[moved.twin - others.size()].line));
    out.warnings.push_back(
        fmt::format("{}: same place as {}; moved from ({:.2f}, {:.2f}) to ({:.2f}, {:.2f})",
                    inventory.features ? fmt::format("{}: feature {}", file, line) : fmt::format("{}:{}", file, line),
                    twin, moved.from.x, moved.from.y, moved.to.x, moved.to.y));
  }
  if (twins > kListedTwins)
    out.warnings.push_back(
        fmt::format("{}: and {} more trees at places of others, moved likewise", file, twins - kListedTwins));
  out.tally.moved = twins;

  out.standing.assign(standing.begin() + static_cast<std::ptrdiff_t>(others.size()), standing.end());
  for (std::size_t i = 0; i < out.trees.size(); ++i) out.trees[i].at = out.standing[i].at;
  return out;
}

Result<scene::Synonyms> synonyms_of(const TreeImport& import, Known species) {
  if (import.synonyms.empty()) return scene::Synonyms();
  return read_synonyms(import.synonyms, species);
}

std::string block_name(const TreeImport& import, const std::filesystem::path& file) {
  return import.block.empty() ? file.stem().string() : import.block;
}

}  // namespace

Result<scene::Synonyms> read_synonyms(const std::filesystem::path& file, Known known) {
  const auto bytes = read_file(file, kMostSynonymBytes);
  if (!bytes) return bytes.error();
  auto table = csv_table({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file.string());
  if (!table) return table.error();

  scene::Synonyms out;
  std::optional<Error> wrong;
  const auto add = [&](const std::vector<std::string>& fields, int line) {
    if (wrong) return;
    if (fields.size() < 2 || fields[0].empty() || fields[1].empty()) {
      wrong = Error{fmt::format("{}:{}: a row needs a name and the species it means: Stieleiche,english_oak",
                                file.string(), line)};
      return;
    }
    const scene::SpeciesMatch match = scene::match_species(fields[1], known, 0);
    if (match.how != scene::NameMatch::exact) {
      std::string names;
      for (const auto& s : known) names += (names.empty() ? "" : ", ") + s->name;
      wrong =
          Error{fmt::format("{}:{}: '{}' is not a known species; known are {}", file.string(), line, fields[1], names)};
      return;
    }
    if (!out.add(fields[0], known[match.species]->name))
      wrong = Error{fmt::format("{}:{}: '{}' means two species", file.string(), line, fields[0])};
  };
  // The first row is a header only when it says so.
  if (const auto& first = (*table)->columns; !(first.size() >= 2 && folded_words(first[1]) == "species")) add(first, 1);
  TableRow row;
  while ((*table)->next(row)) {
    if (!row.problem.empty()) return Error{fmt::format("{}:{}: {}", file.string(), row.line, row.problem)};
    add(row.fields, row.line);
  }
  if (wrong) return *wrong;
  return out;
}

std::string words(const ImportTally& tally, bool features) {
  const auto rows = [&](std::size_t n) {
    return fmt::format("{} {}{}", n, features ? "feature" : "row", n == 1 ? "" : "s");
  };
  std::string out = fmt::format("{} tree{}", tally.trees, tally.trees == 1 ? "" : "s");
  if (tally.left_out > 0) out += fmt::format(" of {}; {} left out", rows(tally.trees + tally.left_out), tally.left_out);
  if (tally.nameless > 0) out += fmt::format("; {} without a name, drawn as {}", tally.nameless, tally.drawn_as);
  if (tally.moved > 0) out += fmt::format("; {} moved aside from another's place", tally.moved);
  if (tally.to_remove > 0) out += fmt::format("; {} to be removed, so not grown", tally.to_remove);
  return out;
}

std::pair<DVec2, DVec2> site_around(std::span<const InventoryTree> trees, Known species, std::size_t fallback,
                                    const scene::Synonyms* synonyms) {
  std::map<std::string, scene::SpeciesMatch> matches;
  DVec2 low(INFINITY), high(-INFINITY);
  for (const InventoryTree& row : trees) {
    const auto [match, fresh] = matches.try_emplace(row.species);
    if (fresh) match->second = scene::match_species(row.species, species, fallback, synonyms);
    const scene::Species& kind = *species[match->second.species];
    scene::Tree tree;
    tree.scale_width = kind.planting.scale_max;
    set_size(tree, kind, row, match->second.width);
    const DVec2 crown(kAround_m + 0.5 * static_cast<double>(tree.scale_width * kind.shape.crown_width_m));
    low = glm::min(low, row.plan - crown), high = glm::max(high, row.plan + crown);
  }
  const DVec2 corner = glm::floor(low);
  return {corner, glm::max(glm::ceil(high - corner), DVec2(1.0))};
}

Result<std::vector<std::shared_ptr<const scene::Species>>> species_to_name(
    std::vector<std::shared_ptr<const scene::Species>> own) {
  for (const std::string& name : scene::builtin_species_names()) {
    if (std::any_of(own.begin(), own.end(), [&](const auto& s) { return s->name == name; })) continue;
    auto builtin = scene::builtin_species(name);
    if (!builtin) return builtin.error();
    own.push_back(std::make_shared<const scene::Species>(std::move(*builtin)));
  }
  return own;
}

Result<ImportedTrees> read_trees(const std::filesystem::path& file, const TreeImport& import, std::uint64_t seed,
                                 Known species, std::size_t fallback, std::span<const StandingTree> others) {
  auto synonyms = synonyms_of(import, species);
  if (!synonyms) return synonyms.error();
  auto inventory = read_inventory(file, import.reading);
  if (!inventory) return inventory.error();
  return planted(std::move(*inventory), file.string(), import, hash_text(block_name(import, file)), seed, species,
                 *synonyms, fallback, others);
}

Result<ImportedDocument> import_trees(const scene::Document& before, const std::filesystem::path& file,
                                      TreeImport import) {
  ImportedDocument out{before, {}, {}};
  scene::Document& document = out.document;

  // All species that a name may mean: the document's own first.
  const std::size_t own = document.species.size();
  auto known = species_to_name(document.species.all());
  if (!known) return known.error();
  const std::vector<std::shared_ptr<const scene::Species>> species = *std::move(known);
  const auto fallback =
      std::find_if(species.begin(), species.end(), [&](const auto& s) { return s->name == import.fallback; });
  if (fallback == species.end()) return Error{fmt::format("'{}' is not a known species", import.fallback)};
  auto synonyms = synonyms_of(import, species);
  if (!synonyms) return synonyms.error();

  import.reading.site = document.place;
  import.reading.size_m.reset();
  if (document.terrain) import.reading.size_m = DVec2(document.terrain->size_m());
  auto inventory = read_inventory(file, import.reading);
  if (!inventory) return inventory.error();
  if (inventory->trees.empty()) {
    const auto lines = problem_lines(inventory->problems, file.string(), inventory->features, 1);
    if (lines.empty()) return Error{fmt::format("{} has no tree", file.string())};
    // Where only the site is wrong, it can be laid round the trees, or another one is needed.
    if (lines.front().find("lies outside the site") == std::string::npos)
      return Error{fmt::format("{}: no row has a usable position on the site: {}", file.string(), lines.front())};
    const DVec2 size = *std::exchange(import.reading.size_m, std::nullopt);
    inventory = read_inventory(file, import.reading);
    if (!inventory) return inventory.error();
    const auto [corner, needed] =
        site_around(inventory->trees, species, static_cast<std::size_t>(fallback - species.begin()), &*synonyms);
    const bool placed = document.place.south_west != DVec2(0.0) || !document.place.crs_wkt.empty() || inventory->place;
    if (placed || needed.x > size.x || needed.y > size.y)
      return Error{
          fmt::format("{}: no row has a usable position on the site: {}; they fit a new site of {:g} x {:g} m or more, "
                      "and one round them is made by: bosquet import NAME.toml --trees FILE",
                      file.string(), lines.front(), needed.x, needed.y)};
    const DVec2 south_west = corner + glm::floor(0.5 * (needed - size));
    for (InventoryTree& tree : inventory->trees) tree.plan -= south_west;
    inventory->place = document.place;
    inventory->place->south_west = south_west;
    inventory->notes.push_back(
        fmt::format("the site had no place on the map; its south-west corner is now at {:.10g}, {:.10g}, "
                    "so that the trees stand in its middle",
                    south_west.x, south_west.y));
    import.reading.size_m = size;
  }
  if (!document.terrain) {
    const auto [corner, size] =
        site_around(inventory->trees, species, static_cast<std::size_t>(fallback - species.begin()), &*synonyms);
    auto lattice = terrain::make_lattice(Vec2(size));
    if (!lattice) return Error{fmt::format("{}: {}", file.string(), lattice.error().message)};
    terrain::Terrain ground;
    ground.height = terrain::Heightfield(*lattice);
    ground.exclusion = terrain::Mask(*lattice, 0.0f);
    ground.density = terrain::Mask(*lattice, 1.0f);
    document.terrain = std::make_shared<const terrain::Terrain>(std::move(ground));
    for (InventoryTree& tree : inventory->trees) tree.plan -= corner;
    if (!inventory->place) inventory->place = document.place;
    inventory->place->south_west += corner;
    import.reading.size_m = size;
  }

  std::vector<StandingTree> others;
  if (document.trees)
    for (const scene::Tree& tree : *document.trees) {
      StandingTree& stands = others.emplace_back();
      stands.key = tree.key, stands.at = tree.at;
      const float trunk = tree.scale_width * document.species_of(tree).shape.trunk_width_m;
      stands.trunk_radius_m = 0.5f * tree.trunk_diameter_m.value_or(trunk);
    }
  const std::uint64_t block = hash_text(fmt::format("{} {}", block_name(import, file), document.next_block++));
  ImportedTrees trees = planted(std::move(*inventory), file.string(), import, block, document.seed, species, *synonyms,
                                static_cast<std::size_t>(fallback - species.begin()), others);
  if (trees.place) document.place = *trees.place;
  out.warnings = std::move(trees.warnings);

  // Species that nothing needs stay out.
  std::vector<std::size_t> index(species.size());
  std::vector<std::shared_ptr<const scene::Species>> used(species.begin(),
                                                          species.begin() + static_cast<std::ptrdiff_t>(own));
  for (std::size_t s = 0; s < species.size(); ++s) {
    index[s] = s;
    if (s < own) continue;
    if (std::none_of(trees.trees.begin(), trees.trees.end(), [&](const scene::Tree& t) { return t.species == s; }))
      continue;
    index[s] = used.size();
    used.push_back(species[s]);
  }
  if (used.size() > own) document.species = scene::SharedList<std::shared_ptr<const scene::Species>>(std::move(used));
  for (scene::Tree& tree : trees.trees) {
    tree.species = index[tree.species];
    tree.id = document.next_tree_id++;
  }
  out.tally = trees.tally;
  document.trees = std::make_shared<const scene::Trees>(document.trees ? document.trees->edited(std::move(trees.trees))
                                                                       : scene::Trees(std::move(trees.trees)));
  return out;
}

}  // namespace bosquet::exchange
