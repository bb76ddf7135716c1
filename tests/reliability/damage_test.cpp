// Bytes of a project file flipped, overwritten and cut off: it is read, or what is missing is told; never a crash, a hang
// or silently another document. BOSQUET_DAMAGES=10000 asks for more cases than the tests have time for.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "../scene/full_document.h"
#include "../scene/scratch_files.h"
#include "core/random.h"
#include "scene/document_digest.h"
#include "scene/project_file.h"

namespace bosquet::scene {
namespace {

int cases(int usual) {
  const char* told = std::getenv("BOSQUET_DAMAGES");
  return told ? std::atoi(told) : usual;
}

struct Tally {
  int same = 0, told = 0, refused = 0;
  double slowest_s = 0;
};

class DamageTest : public ScratchTest {
 protected:
  void SetUp() override {
    ScratchTest::SetUp();
    const Document document = full_document(40);
    digest_ = digest(document);
    ASSERT_TRUE(write_project(document, path()));
    bytes_ = contents(path());
  }
  std::filesystem::path path() const { return folder_ / "a.bosquet"; }

  // Opens the damaged file and judges what is said of it.
  void judge(const std::string& damaged, const std::string& how, Tally& tally) {
    std::error_code ec;
    for (const char* suffix : {"-journal", "-wal", "-shm"}) std::filesystem::remove(path().string() + suffix, ec);
    put(path(), damaged);
    const auto begin = std::chrono::steady_clock::now();
    const auto read = read_project(path());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    tally.slowest_s = std::max(tally.slowest_s, seconds);
    EXPECT_LT(seconds, 20.0) << how;
    if (!read) {
      EXPECT_FALSE(read.error().message.empty());
      ++tally.refused;
    } else if (lines(read->state).empty()) {
      EXPECT_EQ(digest(read->document), digest_) << how;
      ++tally.same;
    } else {
      ++tally.told;
      // What was read can be worked with and saved elsewhere.
      if (tally.told % 50 == 0) {
        EXPECT_TRUE(write_project(read->document, folder_ / "b.bosquet")) << how;
      }
    }
  }

  void report(const char* what, const Tally& t) {
    std::printf("%s: %d the same document, %d told, %d refused; slowest %.0f ms\n", what, t.same, t.told, t.refused,
                1e3 * t.slowest_s);
  }

  SectionDigests digest_;
  std::string bytes_;
};

TEST_F(DamageTest, AFlippedBitIsToldUnlessItChangesNothing) {
  RandomStream random(1, 1, Purpose::statistics);
  Tally tally;
  for (int i = 0; i < cases(250); ++i) {
    std::string damaged = bytes_;
    const std::size_t at = random.below(static_cast<std::uint32_t>(bytes_.size()));
    const int bit = static_cast<int>(random.below(8));
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
    judge(damaged, "byte " + std::to_string(at) + ", bit " + std::to_string(bit), tally);
  }
  report("flipped bits", tally);
  EXPECT_GT(tally.told, 0);
}

TEST_F(DamageTest, EveryByteOfTheHeaderAndTheSchemaMayBeAnother) {
  RandomStream random(1, 2, Purpose::statistics);
  Tally tally;
  const int step = std::max(1, 4096 / cases(150));
  for (int at = 0; at < 4096; at += at < 100 ? 1 : step) {
    std::string damaged = bytes_;
    damaged[static_cast<std::size_t>(at)] =
        static_cast<char>(damaged[static_cast<std::size_t>(at)] + 1 + random.below(255));
    judge(damaged, "byte " + std::to_string(at), tally);
  }
  report("first page", tally);
}

TEST_F(DamageTest, ACutFileGivesWhatIsThere) {
  RandomStream random(1, 3, Purpose::statistics);
  Tally tally;
  for (int i = 0; i < cases(60); ++i) {
    const std::size_t size = random.below(static_cast<std::uint32_t>(bytes_.size()));
    judge(bytes_.substr(0, size), "cut to " + std::to_string(size), tally);
  }
  report("cut files", tally);
  EXPECT_EQ(tally.same, 0);
  EXPECT_GT(tally.told, 0) << "some can be read in part";
}

TEST_F(DamageTest, LostAndStrayBlocksAreTold) {
  RandomStream random(1, 4, Purpose::statistics);
  Tally tally;
  for (int i = 0; i < cases(60); ++i) {
    std::string damaged = bytes_;
    const std::size_t block = std::size_t{512} << random.below(4);
    const auto place = [&] { return block * random.below(static_cast<std::uint32_t>(bytes_.size() / block)); };
    const std::size_t to = place();
    if (i % 2)
      damaged.replace(to, block, std::string(block, '\0'));
    else
      damaged.replace(to, block, bytes_.substr(place(), block));
    judge(damaged, "block of " + std::to_string(block) + " at " + std::to_string(to), tally);
  }
  report("blocks", tally);
}

}  // namespace
}  // namespace bosquet::scene
