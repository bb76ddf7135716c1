#include "scene/journal.h"

#include <gtest/gtest.h>

#include "full_document.h"
#include "scene/document_digest.h"
#include "scratch_files.h"

namespace bosquet::scene {
namespace {

Document moved(const Document& document, std::size_t index, Vec2 to) {
  std::vector<Tree> trees = document.trees->to_vector();
  trees[index].at = to;
  Document out = document;
  out.trees = std::make_shared<const Trees>(std::move(trees));
  return out;
}

class JournalTest : public ScratchTest {
 protected:
  // What a session leaves that ends without saving.
  void leave_behind(const Document& start, const std::filesystem::path& project, std::uint64_t edits) {
    auto journal = Journal::start(start, project, folder_);
    ASSERT_TRUE(journal) << journal.error().message;
    for (std::uint64_t i = 1; i <= edits; ++i) (*journal)->record(moved(start, 3, {static_cast<float>(i), 2.0f}), i);
    (*journal)->wait();
    EXPECT_EQ((*journal)->durable(), edits);
    EXPECT_EQ((*journal)->problem(), "");
  }
};

TEST_F(JournalTest, AnEditedDocumentIsFoundAgain) {
  const Document start = full_document(200);
  leave_behind(start, folder_ / "park.bosquet", 7);
  const auto found = list_recoveries(folder_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].edits, 7u);
  EXPECT_EQ(found[0].project, folder_ / "park.bosquet");
  EXPECT_EQ(found[0].name.substr(0, 5), "park-");
  EXPECT_FALSE(found[0].in_use);
  EXPECT_NEAR(static_cast<double>(found[0].time), static_cast<double>(std::time(nullptr)), 60.0);
  auto recovered = recover(found[0]);
  ASSERT_TRUE(recovered) << recovered.error().message;
  EXPECT_EQ(recovered->edit, 7u);
  EXPECT_TRUE(lines(recovered->state).empty());
  EXPECT_EQ(digest(recovered->document), digest(moved(start, 3, {7.0f, 2.0f})));
}

TEST_F(JournalTest, NothingStaysOfASessionThatSavedEverything) {
  const Document start = full_document(20);
  {
    auto journal = Journal::start(start, {}, folder_);
    ASSERT_TRUE(journal);
    (*journal)->record(moved(start, 1, {5, 5}), 1);
    (*journal)->saved(folder_ / "a.bosquet", 1);
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(JournalTest, EditsAfterASaveAreCountedFromThere) {
  const Document start = full_document(20);
  {
    auto journal = Journal::start(start, {}, folder_);
    ASSERT_TRUE(journal);
    (*journal)->record(moved(start, 1, {5, 5}), 4);
    (*journal)->saved(folder_ / "a.bosquet", 4);
    (*journal)->record(moved(start, 1, {6, 5}), 6);
  }
  const auto found = list_recoveries(folder_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].edits, 2u);
  EXPECT_EQ(found[0].project, folder_ / "a.bosquet");
}

TEST_F(JournalTest, ALivingSessionsFileIsInUseAndStays) {
  const Document start = full_document(20);
  auto journal = Journal::start(start, {}, folder_);
  ASSERT_TRUE(journal);
  (*journal)->record(moved(start, 1, {5, 5}), 1);
  (*journal)->wait();
  const auto found = list_recoveries(folder_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].in_use);
  discard(found[0]);
  EXPECT_TRUE(std::filesystem::exists(found[0].file));
  // A second session beside it has a file of its own.
  auto second = Journal::start(start, {}, folder_);
  ASSERT_TRUE(second);
  EXPECT_NE((*second)->file(), (*journal)->file());
}

TEST_F(JournalTest, SavingAProjectRemovesWhatWasDeclinedOfIt) {
  const Document start = full_document(20);
  leave_behind(start, folder_ / "a.bosquet", 2);
  leave_behind(start, folder_ / "b.bosquet", 2);
  ASSERT_EQ(list_recoveries(folder_).size(), 2u);
  auto journal = Journal::start(start, folder_ / "a.bosquet", folder_);
  ASSERT_TRUE(journal);
  (*journal)->saved(folder_ / "a.bosquet", 0);
  (*journal)->wait();
  const auto left = list_recoveries(folder_);
  std::size_t unsaved = 0;
  for (const Recovery& r : left)
    if (r.edits > 0) {
      ++unsaved;
      EXPECT_EQ(r.project, folder_ / "b.bosquet");
    }
  EXPECT_EQ(unsaved, 1u);
}

TEST_F(JournalTest, AFolderThatCannotBeMadeIsToldAtTheStart) {
  put(folder_ / "file", "");
  const auto journal = Journal::start(full_document(3), {}, folder_ / "file" / "state");
  ASSERT_FALSE(journal);
  EXPECT_NE(journal.error().message.find("cannot be made"), std::string::npos);
}

}  // namespace
}  // namespace bosquet::scene
