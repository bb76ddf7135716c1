#include "scene/project_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>

#include "full_document.h"
#include "scene/document_digest.h"
#include "scene/project_database.h"
#include "scene/project_store.h"
#include "scratch_files.h"

namespace bosquet::scene {
namespace {

// Equal in all that a document is; shared parts by their contents.
void expect_equal(const Document& a, const Document& b) {
  const SectionDigests da = digest(a), db = digest(b);
  for (std::size_t i = 0; i < kSectionNames.size(); ++i)
    EXPECT_EQ(hex_digits(da.of[i]), hex_digits(db.of[i])) << kSectionNames[i];
  EXPECT_EQ(a.trees->to_vector(), b.trees->to_vector());
  EXPECT_EQ(a.place, b.place);
  EXPECT_EQ(a.space, b.space);
  EXPECT_EQ(a.asymmetry, b.asymmetry);
  EXPECT_EQ(a.cameras, b.cameras);
  EXPECT_EQ(a.figures, b.figures);
  EXPECT_EQ(a.sun, b.sun);
  EXPECT_EQ(a.clearance, b.clearance);
  EXPECT_EQ(a.plan, b.plan);
  EXPECT_EQ(a.underlay, b.underlay);
  EXPECT_EQ(a.ground_cover, b.ground_cover);
  EXPECT_EQ(a.species_bar, b.species_bar);
  EXPECT_EQ(a.max_triangles, b.max_triangles);
  EXPECT_EQ(a.next_tree_id, b.next_tree_id);
  EXPECT_EQ(a.next_standing_id, b.next_standing_id);
  EXPECT_EQ(a.next_block, b.next_block);
  EXPECT_EQ(a.terrain->areas.all(), b.terrain->areas.all());
}

Document read_whole(const std::filesystem::path& path) {
  auto read = read_project(path);
  EXPECT_TRUE(read) << (read ? "" : read.error().message);
  if (!read) return {};
  for (const std::string& line : lines(read->state)) ADD_FAILURE() << line;
  return read->document;
}

class ProjectFileTest : public ScratchTest {};

TEST_F(ProjectFileTest, EveryFieldOfADocumentComesBack) {
  const Document before = full_document();
  ASSERT_TRUE(write_project(before, folder_ / "a.bosquet"));
  expect_equal(before, read_whole(folder_ / "a.bosquet"));
  EXPECT_EQ(files(), 1u) << "nothing stays beside the file";
}

// One tree elsewhere, all blocks but one shared.
Document with_moved_tree(const Document& document, std::int32_t id, Vec2 to) {
  Tree tree = *document.trees->find(id);
  tree.at = to;
  Document out = document;
  out.trees = std::make_shared<const Trees>(document.trees->edited({tree}));
  return out;
}

Document with_stroke(const Document& document) {
  terrain::Stroke stroke;
  stroke.points = {{40, 40}, {60, 45}};
  Document out = document;
  out.terrain = std::make_shared<const terrain::Terrain>(terrain::apply(*document.terrain, stroke));
  return out;
}

// Changes a file as another program would.
void change(const std::filesystem::path& path, const std::string& sql) {
  auto database = Database::open(path, Database::Mode::read_write);
  ASSERT_TRUE(database);
  const auto done = database->run(sql);
  ASSERT_TRUE(done) << done.error().message;
}

TEST_F(ProjectFileTest, AnEmptySiteComesBack) {
  Document before;
  before.terrain = std::make_shared<const terrain::Terrain>(
      terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({1.0f, 3.0f}))));
  before.trees = std::make_shared<const Trees>();
  ASSERT_TRUE(write_project(before, folder_ / "a.bosquet"));
  expect_equal(before, read_whole(folder_ / "a.bosquet"));
}

TEST_F(ProjectFileTest, SavesAfterEditsGiveTheFileOfTheLastDocument) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  Document d = full_document();
  auto file = ProjectFile::create(path, d);
  ASSERT_TRUE(file) << file.error().message;
  const auto save = [&](const Document& next) {
    const auto done = file->save(next);
    ASSERT_TRUE(done) << done.error().message;
    d = next;
    expect_equal(d, read_whole(path));
  };
  save(with_moved_tree(d, 5, {70.25f, 3.5f}));
  save(with_stroke(d));
  // Trees go and come.
  const std::vector<std::int32_t> gone{2, 8, 299};
  Tree fresh = d.trees->back();
  fresh.id += 1000;
  Document next = d;
  next.trees = std::make_shared<const Trees>(d.trees->edited({fresh}, gone));
  save(next);
  // A species is added, then one is taken out of the middle, and trees are told anew which is theirs.
  next.species.push_back(std::make_shared<const Species>(*builtin_species("scots_pine")));
  save(next);
  next.species.erase(0);
  std::vector<Tree> trees = next.trees->to_vector();
  for (Tree& t : trees) t.species = t.species > 0 ? t.species - 1 : 0;
  next.trees = std::make_shared<const Trees>(std::move(trees));
  next.species_bar = {};
  next.heroes = {};
  save(next);
  // Obstacles, cameras and interactions go, the site gets another place on earth.
  next.obstacles.erase(0);
  next.cameras = {};
  next.interactions.erase(1);
  next.place.south_west = {100.0, 200.0};
  next.place.crs_wkt.clear();
  next.seed = 3;
  save(next);
  // Another ground of another size.
  next.terrain = std::make_shared<const terrain::Terrain>(
      terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({40.0f, 20.0f}), 3.0f)));
  save(next);
}

TEST_F(ProjectFileTest, ASaveAfterOpeningWritesOnlyWhatChanged) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  const Document before = full_document(5000);
  ASSERT_TRUE(write_project(before, path));
  auto file = ProjectFile::open(path);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(lines(file->state()).empty());
  const Document after = with_moved_tree(file->document(), 2, {1.0f, 2.0f});
  const std::string old = contents(path);
  ASSERT_TRUE(file->save(after));
  const std::string now = contents(path);
  // Pages that differ: the header, the tree's row, the digest; far from all.
  ASSERT_EQ(old.size(), now.size());
  std::size_t pages = 0, differ = 0;
  for (std::size_t at = 0; at < old.size(); at += 4096, ++pages) differ += old.compare(at, 4096, now, at, 4096) != 0;
  EXPECT_GT(pages, 200u);
  EXPECT_LE(differ, 4u);
  expect_equal(after, read_whole(path));
}

TEST_F(ProjectFileTest, AFileOfThePastIsMigratedInACopyAndWrittenAsNewBySaving) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  const Document before = full_document(50);
  ASSERT_TRUE(write_project(before, path));
  // An invented format 0, in which clear stems had another name.
  change(path,
         "ALTER TABLE trees RENAME COLUMN clear_stem_m TO clear; UPDATE bosquet_meta SET value = '0' WHERE name = "
         "'format'");
  const std::string old = contents(path);

  auto unknown = ProjectFile::open(path);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("format 0"), std::string::npos) << unknown.error().message;

  const Migration steps[] = {{0, "ALTER TABLE trees RENAME COLUMN clear TO clear_stem_m"}};
  ProjectOptions options;
  options.migrations = steps;
  auto file = ProjectFile::open(path, options);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->state().migrated_from, 0);
  EXPECT_FALSE(file->state().damaged);
  expect_equal(before, file->document());
  EXPECT_EQ(contents(path), old) << "opening changes nothing";
  ASSERT_TRUE(file->save(file->document()));
  EXPECT_FALSE(file->state().migrated_from);
  expect_equal(before, read_whole(path));
}

TEST_F(ProjectFileTest, ANewerFormatIsRefusedWithBothNumbers) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  ASSERT_TRUE(write_project(full_document(3), path));
  change(path, "UPDATE bosquet_meta SET value = '7' WHERE name = 'format'");
  auto file = ProjectFile::open(path);
  ASSERT_FALSE(file);
  EXPECT_NE(file.error().message.find("format 7"), std::string::npos);
  EXPECT_NE(file.error().message.find("up to 1"), std::string::npos);
}

TEST_F(ProjectFileTest, ATreeMovedByAnotherProgramIsReadAndAskedAbout) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  Document before = full_document(60);
  ASSERT_TRUE(write_project(before, path));
  {
    // As a GIS writes it: a new geometry for one row, a row of its own with the columns that people fill in.
    auto database = Database::open(path, Database::Mode::read_write);
    ASSERT_TRUE(database);
    auto row = database->prepare("SELECT geom FROM trees WHERE id = 5");
    ASSERT_TRUE(row->step());
    std::vector<std::byte> geometry(row->bytes(0).begin(), row->bytes(0).end());
    row->reset();
    const DVec2 to = before.place.south_west + DVec2(33.5, 44.25);
    std::memcpy(geometry.data() + 13, &to.x, 16);
    auto move = database->prepare("UPDATE trees SET geom = ?1, species = 'english_oak' WHERE id = 5");
    move->bind(0, std::span<const std::byte>(geometry));
    ASSERT_TRUE(move->run());
    auto add = database->prepare("INSERT INTO trees (geom, species) VALUES (?1, 'some kind')");
    add->bind(0, std::span<const std::byte>(geometry));
    ASSERT_TRUE(add->run());
    ASSERT_TRUE(database->run("DELETE FROM trees WHERE id = 8"));
  }
  auto file = ProjectFile::open(path);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(file->state().edited_elsewhere);
  EXPECT_FALSE(file->state().damaged);
  EXPECT_EQ(file->state().read_only, "");
  ASSERT_FALSE(file->state().notes.empty());
  const Trees& trees = *file->document().trees;
  EXPECT_EQ(trees.size(), before.trees->size());
  EXPECT_EQ(trees.find(5)->at, Vec2(33.5f, 44.25f));
  EXPECT_EQ(trees.find(5)->species, 1u);
  EXPECT_EQ(trees.find(8), nullptr);
  EXPECT_EQ(trees.back().at, Vec2(33.5f, 44.25f));
  EXPECT_EQ(*trees.find(11), *before.trees->find(11)) << "the others are as they were";

  EXPECT_FALSE(file->save(file->document())) << "nobody was asked";
  ASSERT_TRUE(file->save(file->document(), true));
  expect_equal(file->document(), read_whole(path));
}

TEST_F(ProjectFileTest, AChangeByAnotherProgramWhileItIsOpenIsAskedAbout) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  const Document before = full_document(30);
  auto file = ProjectFile::create(path, before);
  ASSERT_TRUE(file);
  EXPECT_FALSE(file->changed_meanwhile());
  change(path, "DELETE FROM trees WHERE id = 5");
  EXPECT_TRUE(file->changed_meanwhile());
  EXPECT_FALSE(file->save(before));
  ASSERT_TRUE(file->save(before, true));
  EXPECT_FALSE(file->changed_meanwhile());
  expect_equal(before, read_whole(path));
  // Gone altogether: it is written anew.
  std::filesystem::remove(path);
  ASSERT_TRUE(file->save(before));
  expect_equal(before, read_whole(path));
}

TEST_F(ProjectFileTest, WhatAnUnfinishedSaveLeftGoesWithTheNextNewFile) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  put(folder_ / ".a.bosquet-Ab12Cd.part", "half a project");
  put(folder_ / ".b.bosquet-Ab12Cd.part", "of another");
  put(folder_ / ".a.bosquet-backup", "somebody's own");
  ASSERT_TRUE(write_project(full_document(3), path));
  EXPECT_FALSE(std::filesystem::exists(folder_ / ".a.bosquet-Ab12Cd.part"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / ".b.bosquet-Ab12Cd.part"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / ".a.bosquet-backup"));
}

TEST_F(ProjectFileTest, ASecondOpenerReadsOnly) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  const Document before = full_document(10);
  std::optional<ProjectFile> first(*ProjectFile::create(path, before));
  auto second = ProjectFile::open(path);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->state().read_only, "another window has it open");
  expect_equal(before, second->document());
  EXPECT_FALSE(second->save(before));
  ASSERT_TRUE(second->save_as(before, folder_ / "b.bosquet")) << "under another name it can be saved";
  EXPECT_EQ(second->state().read_only, "");
  ASSERT_TRUE(first->save(with_stroke(before)));
  first.reset();
  EXPECT_EQ(ProjectFile::open(path)->state().read_only, "");
}

TEST_F(ProjectFileTest, SavingUnderAnotherNameLeavesTheFirstFile) {
  const Document before = full_document(10);
  auto file = ProjectFile::create(folder_ / "a.bosquet", before);
  ASSERT_TRUE(file);
  const std::string old = contents(folder_ / "a.bosquet");
  put(folder_ / "b.bosquet", "something else that was here");
  ASSERT_TRUE(file->save_as(with_stroke(before), folder_ / "b.bosquet"));
  EXPECT_EQ(file->path(), folder_ / "b.bosquet");
  EXPECT_EQ(contents(folder_ / "a.bosquet"), old);
  expect_equal(with_stroke(before), read_whole(folder_ / "b.bosquet"));
  ASSERT_TRUE(file->save(before));
  expect_equal(before, read_whole(folder_ / "b.bosquet"));
}

TEST_F(ProjectFileTest, WhereNothingMayBeWrittenAMessageSaysSoAndTheFileStays) {
  const Document before = full_document(10);
  const std::filesystem::path path = folder_ / "a.bosquet";
  EXPECT_NE(ProjectFile::create(folder_ / "no" / "a.bosquet", before).error().message.find("cannot be written"),
            std::string::npos);
  EXPECT_FALSE(write_project(before, folder_));
  // A file size limit stands for a full disk.
  auto file = ProjectFile::create(path, before);
  ASSERT_TRUE(file);
  const std::string old = contents(path);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ::getrlimit(RLIMIT_FSIZE, &usual);
  rlimit small = usual;
  small.rlim_cur = 20'000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  const auto full = file->save(with_stroke(full_document(400)));
  const auto elsewhere = write_project(before, folder_ / "b.bosquet");
  ::setrlimit(RLIMIT_FSIZE, &usual);
  EXPECT_FALSE(full);
  EXPECT_FALSE(elsewhere);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.bosquet"));
  EXPECT_EQ(contents(path), old);
  ASSERT_TRUE(file->save(with_stroke(before))) << "and may be tried again";
  expect_equal(with_stroke(before), read_whole(path));
}

TEST_F(ProjectFileTest, WhatIsNoProjectIsRefused) {
  put(folder_ / "text.bosquet", std::string(5000, 'x'));
  put(folder_ / "empty.bosquet", "");
  for (const char* name : {"text.bosquet", "empty.bosquet", "missing.bosquet", "."}) {
    const auto file = ProjectFile::open(folder_ / name);
    ASSERT_FALSE(file) << name;
    EXPECT_NE(file.error().message.find(name), std::string::npos) << file.error().message;
  }
  auto database = Database::open(folder_ / "other.bosquet", Database::Mode::create);
  ASSERT_TRUE(database->run("CREATE TABLE x (y)"));
  EXPECT_NE(ProjectFile::open(folder_ / "other.bosquet").error().message.find("no bosquet project"), std::string::npos);
}

TEST_F(ProjectFileTest, LostPartsAreNamedAndTheRestIsThere) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  const Document before = full_document(30);
  ASSERT_TRUE(write_project(before, path));
  change(path,
         "DELETE FROM bosquet_blob WHERE section = 'mesh' AND item = -5;"
         "UPDATE bosquet_blob SET data = x'00' WHERE section = 'height' AND part = 1;"
         "UPDATE bosquet_text SET json = '{' WHERE section = 'cameras' AND number = 0;"
         "DELETE FROM bosquet_text WHERE section = 'species' AND number = 1");
  auto file = ProjectFile::open(path);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(file->state().damaged);
  EXPECT_NE(file->state().read_only, "");
  std::string all;
  for (const std::string& part : file->state().missing) all += part + "\n";
  for (const char* words : {"obstacle 'house'", "height: 1 of", "cameras 1", "species 2"})
    EXPECT_NE(all.find(words), std::string::npos) << words << " in\n" << all;
  EXPECT_EQ(file->document().obstacles.size(), 1u);
  EXPECT_EQ(file->document().trees->size(), before.trees->size());
  EXPECT_EQ(file->document().species.size(), 3u);
  EXPECT_EQ(file->document().cameras[1], before.cameras[1]);
}

TEST_F(ProjectFileTest, OtherProgramsFindItWhole) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  Document before = full_document(40);
  ASSERT_TRUE(write_project(before, path));
  auto database = Database::open(path, Database::Mode::read_only);
  ASSERT_TRUE(database);
  EXPECT_TRUE(database->damage().empty());
  EXPECT_EQ(database->integer("PRAGMA application_id"), 0x47504B47);
  EXPECT_EQ(database->integer("PRAGMA user_version"), 10300);
  EXPECT_FALSE(database->integer("SELECT 1 FROM pragma_foreign_key_check"));
  EXPECT_EQ(database->text("PRAGMA journal_mode"), "delete");

  // ogrinfo of gdal-bin reads it as layers: the trees as points with their attributes, the site as a polygon.
  const std::string command = "ogrinfo -al -so GPKG:'" + path.string() + "' >'" + (folder_ / "ogr").string() + "' 2>&1";
  if (std::system("command -v ogrinfo >/dev/null") != 0)
    GTEST_SKIP() << "no ogrinfo: scripts/setup.sh test installs it";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string said = contents(folder_ / "ogr");
  for (const char* words : {"Layer name: trees", "Geometry: Point", "Feature Count: 40", "Layer name: site",
                            "Geometry: Polygon", "species: String", "scale_height: Real"})
    EXPECT_NE(said.find(words), std::string::npos) << words << " in\n" << said;
  for (const char* words : {"Warning", "ERROR"}) EXPECT_EQ(said.find(words), std::string::npos) << said;
}

}  // namespace
}  // namespace bosquet::scene
