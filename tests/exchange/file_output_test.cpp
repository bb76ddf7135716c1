#include "exchange/file_output.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "scratch_folder.h"

namespace bosquet::exchange {
namespace {

TEST(FileOutput, AppearsOnlyWhenCommitted) {
  const ScratchFolder folder;
  {
    auto file = FileOutput::create(folder / "a.txt");
    ASSERT_TRUE(file);
    file->write("half");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  }
  EXPECT_EQ(folder.entries(), 0u) << "an abandoned file leaves nothing behind";

  auto file = FileOutput::create(folder / "a.txt");
  ASSERT_TRUE(file);
  file->write("whole");
  const auto bytes = file->commit();
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, 5u);
  EXPECT_EQ(slurp(folder / "a.txt"), "whole");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(FileOutput, ManySmallAndFewLargeWritesKeepTheirOrder) {
  const ScratchFolder folder;
  auto file = FileOutput::create(folder / "a.bin");
  ASSERT_TRUE(file);
  std::string expected;
  for (int i = 0; i < 1000; ++i) {
    const std::string piece(static_cast<std::size_t>(i % 100 == 99 ? 5 << 20 : i), static_cast<char>('a' + i % 26));
    file->write(piece);
    expected += piece;
  }
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(slurp(folder / "a.bin"), expected);
}

// A write that fails half way: the limit on file size stands in for a disk that fills up.
TEST(FileOutput, AFailedWriteLeavesTheOldFileAndNoRest) {
  const ScratchFolder folder;
  spit(folder / "a.bin", "the old one");
  rlimit old{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1 << 20, old.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto written = write_file(folder / "a.bin", std::string(6 << 20, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);

  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::cannot_finish);
  EXPECT_NE(written.error().message.find("a.bin"), std::string::npos);
  EXPECT_EQ(slurp(folder / "a.bin"), "the old one");
  EXPECT_EQ(folder.entries(), 1u);
}

// /dev/full is a disk without room; being no regular file it is written to directly and stays what it is.
TEST(FileOutput, AFullDiskIsSaidToBeFull) {
  const auto written = write_file("/dev/full", "anything");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::cannot_finish);
  EXPECT_EQ(written.error().message, "cannot write /dev/full: the disk is full");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(FileOutput, AMissingFolderAndAFolderAsTargetAreTheUsersMistakes) {
  const ScratchFolder folder;
  const auto nowhere = write_file(folder / "no/such/a.txt", "x");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().kind, ErrorKind::input);
  EXPECT_NE(nowhere.error().message.find("there is no folder " + (folder / "no/such").string()), std::string::npos);

  const auto no_place = write_file("/proc/bosquet.txt", "x");  // a folder that is there and takes no files
  ASSERT_FALSE(no_place);
  EXPECT_EQ(no_place.error().message.find("there is no folder"), std::string::npos) << no_place.error().message;

  const auto onto_folder = write_file(folder.path(), "x");
  ASSERT_FALSE(onto_folder);
  EXPECT_EQ(onto_folder.error().kind, ErrorKind::input);
  EXPECT_NE(onto_folder.error().message.find("is a folder"), std::string::npos);
}

TEST(FileOutput, ReplacingKeepsPermissionsAndLinks) {
  const ScratchFolder folder;
  spit(folder / "real.txt", "old");
  ASSERT_EQ(::chmod((folder / "real.txt").c_str(), 0640), 0);
  std::filesystem::create_symlink("real.txt", folder / "link.txt");
  ASSERT_TRUE(write_file(folder / "link.txt", "new"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(slurp(folder / "real.txt"), "new");
  struct stat facts {};
  ASSERT_EQ(::stat((folder / "real.txt").c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0640u);
}

TEST(FileOutput, AMovedFromFileDoesNotTakeTheHiddenOneAway) {
  const ScratchFolder folder;
  auto first = FileOutput::create(folder / "a.txt");
  ASSERT_TRUE(first);
  first->write("kept");
  {
    FileOutput moved = *std::move(first);
    moved.write(" whole");
    ASSERT_TRUE(moved.commit());
  }
  EXPECT_EQ(slurp(folder / "a.txt"), "kept whole");
}

TEST(ReadFile, RefusesWhatIsMissingTooLargeOrNoFile) {
  const ScratchFolder folder;
  spit(folder / "a.txt", "12345");
  EXPECT_TRUE(read_file(folder / "a.txt", 5));
  const auto large = read_file(folder / "a.txt", 4);
  ASSERT_FALSE(large);
  EXPECT_NE(large.error().message.find("5 bytes; at most 4"), std::string::npos);
  const auto missing = read_file(folder / "b.txt", 5);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("there is no file"), std::string::npos);
  EXPECT_FALSE(read_file(folder.path(), 5));
}

}  // namespace
}  // namespace bosquet::exchange
