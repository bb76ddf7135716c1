// Sessions killed at random moments of editing and saving: the project always opens as one of the documents that were
// saved, and nothing older than a second is lost. BOSQUET_KILLS=1000 asks for more than the tests have time for.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>

#include "../scene/scratch_files.h"
#include "core/random.h"
#include "scene/document_digest.h"
#include "scene/project_file.h"
#include "scene/recovery.h"

namespace bosquet::scene {
namespace {

struct Record {
  std::uint64_t kind, edit, time_ns;
  Digest128 digest;
};
static_assert(sizeof(Record) == 40);

constexpr std::uint64_t kAny = 0, kSaveBegins = 3;
constexpr std::uint64_t kSecond_ns = 1'000'000'000;

std::uint64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * kSecond_ns + static_cast<std::uint64_t>(now.tv_nsec);
}

struct Session {
  std::vector<Record> said;
  std::uint64_t killed_ns = 0;
};

class KillTest : public ScratchTest {
 protected:
  // Starts a session and kills it so long after so many records of a kind, whatever else the machine has to do.
  Session kill_after(std::size_t records, std::uint64_t kind, std::uint64_t delay_us, std::uint64_t seed) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]), ::close(ends[1]);
      const std::string project = path().string(), state = folder_ / "state", number = std::to_string(seed);
      ::execl(BOSQUET_SESSION, BOSQUET_SESSION, project.c_str(), state.c_str(), number.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    Session session;
    std::string bytes;
    const auto take = [&](int wait_ms) {
      pollfd waiting{ends[0], POLLIN, 0};
      if (::poll(&waiting, 1, wait_ms) <= 0) return true;
      char some[4096];
      const ssize_t n = ::read(ends[0], some, sizeof some);
      if (n > 0) bytes.append(some, static_cast<std::size_t>(n));
      return n > 0;
    };
    const auto there = [&] {
      const std::vector<Record> said = records_in(bytes);
      return static_cast<std::size_t>(
          std::count_if(said.begin(), said.end(), [&](const Record& r) { return kind == kAny || r.kind == kind; }));
    };
    while (there() < records && take(20'000)) {
    }
    EXPECT_FALSE(bytes.empty()) << "the session did not start";
    for (const std::uint64_t until = now_ns() + delay_us * 1000; now_ns() < until;)
      if (!take(0)) break;
    session.killed_ns = now_ns();
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it ended by itself, with status " << WEXITSTATUS(status);
    while (take(1000)) {
      if (::fcntl(ends[0], F_GETFD) < 0) break;
    }
    ::close(ends[0]);
    session.said = records_in(bytes);
    return session;
  }

  static std::vector<Record> records_in(const std::string& bytes) {
    std::vector<Record> out(bytes.size() / sizeof(Record));
    if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(Record));
    return out;
  }

  // Files of an unfinished save: what a transaction would undo, and forerunners of whole new files.
  bool undone() const { return std::filesystem::exists(path().string() + "-journal"); }
  std::set<std::string> forerunners() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      if (entry.path().extension() == ".part") names.insert(entry.path().filename());
    return names;
  }
  std::filesystem::path path() const { return folder_ / "a.bosquet"; }
};

TEST_F(KillTest, NothingOlderThanASecondIsLost) {
  const char* told = std::getenv("BOSQUET_KILLS");
  const int kills = told ? std::atoi(told) : 50;
  RandomStream random(1, 5, Purpose::statistics);
  std::uint64_t edits = 0, in_a_save = 0, in_transactions = 0, in_new_files = 0, recovered_count = 0, lost = 0;
  std::uint64_t oldest_lost_ns = 0;
  std::vector<std::uint64_t> save_us{4'000};  // how long the saves took that came to their end
  for (int n = 0; n < kills && !HasFailure(); ++n) {
    // Two of three die at a random moment after a save began, the others anywhere.
    const std::set<std::string> old_parts = forerunners();
    std::nth_element(save_us.begin(), save_us.begin() + static_cast<std::ptrdiff_t>(save_us.size() / 2), save_us.end());
    const auto usual_us = static_cast<std::uint32_t>(save_us[save_us.size() / 2]);
    const Session session =
        n % 3 ? kill_after(1 + random.below(6), kSaveBegins, random.below(usual_us), static_cast<std::uint64_t>(n))
              : kill_after(1 + random.below(n % 5 == 0 ? 4 : 60), kAny, random.below(8'000),
                           static_cast<std::uint64_t>(n));
    std::map<std::uint64_t, Record> edit;
    std::uint64_t saved = 0, saving = 0, durable = 0;
    std::uint64_t began_ns = 0;
    for (const Record& r : session.said) {
      if (r.kind == 1) edit[r.edit] = r;
      if (r.kind == 2) durable = r.edit;
      if (r.kind == kSaveBegins) saving = r.edit, began_ns = r.time_ns;
      if (r.kind == 4) saved = r.edit;
      if (r.kind == 4 && r.edit > 0) save_us.push_back((r.time_ns - began_ns) / 1000);
    }
    edits += edit.size();
    in_a_save += saving > saved;
    in_transactions += saving > saved && undone();
    for (const std::string& part : forerunners()) in_new_files += saving > saved && !old_parts.contains(part);
    EXPECT_LE(forerunners().size(), 2u) << "what was left before goes with the next new file";

    // The project is the one last saved, or that of the save which was going on.
    const auto project = read_project(path());
    ASSERT_TRUE(project) << project.error().message;
    for (const std::string& line : lines(project->state)) ADD_FAILURE() << line;
    const Digest128 there = digest(project->document).all();
    std::uint64_t kept = saved;
    if (!(there == edit[saved].digest)) {
      ASSERT_GT(saving, saved) << "kill " << n << ": the project is none that was saved";
      EXPECT_EQ(hex_digits(there), hex_digits(edit[saving].digest)) << "kill " << n;
      kept = saving;
    }

    // The recovery file has at least what was told to be on the disk.
    const auto found = list_recoveries(folder_ / "state");
    ASSERT_LE(found.size(), 1u);
    if (!found.empty()) {
      const auto recovered = recover(found[0]);
      ASSERT_TRUE(recovered) << recovered.error().message;
      for (const std::string& line : lines(recovered->state)) ADD_FAILURE() << line;
      ASSERT_TRUE(edit.count(recovered->edit)) << "kill " << n;
      EXPECT_EQ(hex_digits(digest(recovered->document).all()), hex_digits(edit[recovered->edit].digest))
          << "kill " << n;
      kept = std::max(kept, recovered->edit);
      ++recovered_count;
      discard(found[0]);
    }
    EXPECT_GE(kept, durable) << "kill " << n;
    if (const auto next = edit.upper_bound(kept); next != edit.end()) {
      const std::uint64_t age = session.killed_ns - std::min(session.killed_ns, next->second.time_ns);
      EXPECT_LT(age, kSecond_ns) << "kill " << n << ": edit " << next->first << " is lost";
      lost += static_cast<std::uint64_t>(std::distance(next, edit.end()));
      oldest_lost_ns = std::max(oldest_lost_ns, age);
    }
    if (n % 20 == 19) std::filesystem::remove(path());
  }
  std::printf(
      "%d kills, %llu of them in a save (%llu with a transaction to undo, %llu with a new file unfinished); %llu "
      "edits, "
      "%llu sessions recovered; %llu edits lost, the oldest %.0f ms old\n",
      kills, static_cast<unsigned long long>(in_a_save), static_cast<unsigned long long>(in_transactions),
      static_cast<unsigned long long>(in_new_files), static_cast<unsigned long long>(edits),
      static_cast<unsigned long long>(recovered_count), static_cast<unsigned long long>(lost),
      1e-6 * static_cast<double>(oldest_lost_ns));
  EXPECT_GT(recovered_count, 0u);
  EXPECT_GT(in_transactions, 0u);
}

}  // namespace
}  // namespace bosquet::scene
