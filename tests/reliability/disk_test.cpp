// Disks that fill up or fail at every operation of a save: the file stays as it was, and a later save works.
#include <gtest/gtest.h>

#include "../scene/full_document.h"
#include "../scene/scratch_files.h"
#include "edits.h"
#include "failing_vfs.h"
#include "scene/document_digest.h"
#include "scene/journal.h"
#include "scene/project_file.h"

namespace bosquet::scene {
namespace {

using Fault = FailingVfs::Fault;

class DiskTest : public ScratchTest {
 protected:
  // What the file holds, read past the failing disk.
  SectionDigests on_disk(const std::filesystem::path& path) {
    vfs_.heal();
    auto read = read_project(path);
    EXPECT_TRUE(read) << (read ? "" : read.error().message);
    if (!read) return {};
    for (const std::string& line : lines(read->state)) ADD_FAILURE() << line;
    return digest(read->document);
  }

  FailingVfs vfs_;
};

TEST_F(DiskTest, ASaveThatFailsAnywhereLeavesTheFileAndCanBeRepeated) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  Document before = full_document(60);
  RandomStream random(1, 1, Purpose::statistics);
  for (const Fault fault : {Fault::disk_full, Fault::io_error})
    for (const bool for_good : {false, true}) {
      auto file = ProjectFile::create(path, before);
      ASSERT_TRUE(file) << file.error().message;
      bool met = true;
      for (int n = 1; met; ++n) {
        ASSERT_LT(n, 200);
        Document after = edited(edited(before, random), random);
        vfs_.fail_at(n, fault, for_good);
        const auto done = file->save(after);
        met = vfs_.failed();
        vfs_.heal();
        if (done) {
          before = after;
          EXPECT_EQ(on_disk(path), digest(before)) << "operation " << n;
          continue;
        }
        EXPECT_TRUE(met);
        EXPECT_EQ(on_disk(path), digest(before)) << "operation " << n << ": " << done.error().message;
        ASSERT_TRUE(file->save(after)) << "operation " << n;
        before = after;
        EXPECT_EQ(on_disk(path), digest(before)) << "after operation " << n;
      }
    }
}

TEST_F(DiskTest, ANewFileThatFailsAnywhereLeavesTheOldOne) {
  const std::filesystem::path path = folder_ / "a.bosquet";
  const Document before = full_document(30);
  RandomStream random(1, 2, Purpose::statistics);
  const Document after = edited(before, random);
  ASSERT_TRUE(write_project(before, path));
  bool met = true;
  for (int n = 1; met; n += n < 20 ? 1 : 7) {
    vfs_.fail_at(n, n % 2 ? Fault::disk_full : Fault::io_error, true);
    const auto done = write_project(after, path);
    met = vfs_.failed();
    EXPECT_EQ(on_disk(path), digest(done ? after : before)) << "operation " << n;
    EXPECT_EQ(files(), 1u) << "nothing stays beside it";
    if (done) {
      ASSERT_TRUE(write_project(before, path));
    }
  }
}

TEST_F(DiskTest, AJournalTellsOfAFullDiskAndGoesOnWhenThereIsRoom) {
  const Document start = full_document(30);
  RandomStream random(1, 3, Purpose::statistics);
  std::filesystem::path file;
  Document last = start;
  {
    auto journal = Journal::start(start, {}, folder_);
    ASSERT_TRUE(journal);
    (*journal)->wait();
    vfs_.fail_at(1, Fault::disk_full, true);
    last = edited(last, random);
    (*journal)->record(last, 1);
    (*journal)->wait();
    EXPECT_NE((*journal)->problem().find("full"), std::string::npos) << (*journal)->problem();
    EXPECT_EQ((*journal)->durable(), 0u);
    vfs_.heal();
    for (int i = 0; i < 500 && (*journal)->durable() < 1; ++i) ::usleep(10'000);
    EXPECT_EQ((*journal)->durable(), 1u) << "without another edit";
    EXPECT_EQ((*journal)->problem(), "");
  }
  const auto found = list_recoveries(folder_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(digest(recover(found[0])->document), digest(last));
}

}  // namespace
}  // namespace bosquet::scene
