#include "core/parallel.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>

#include "core/background.h"

namespace bosquet {
namespace {

// Each run_with_threads is an epoch; a thread counts itself once in each.
std::atomic<std::uint32_t> epoch{1};
std::atomic<int> workers{0};

void note_worker() {
  thread_local std::uint32_t seen = 0;
  const std::uint32_t now = epoch.load(std::memory_order_relaxed);
  if (seen == now) return;
  seen = now;
  workers.fetch_add(1, std::memory_order_relaxed);
}

// On Linux a nice value belongs to a thread.
id_t this_thread() { return static_cast<id_t>(syscall(SYS_gettid)); }

// Makes the threads nice that come into an arena, and tries to take it back when they leave.
class NiceThreads : public tbb::task_scheduler_observer {
 public:
  explicit NiceThreads(tbb::task_arena& arena) : task_scheduler_observer(arena) { observe(true); }
  ~NiceThreads() override { observe(false); }
  void on_scheduler_entry(bool is_worker) override {
    if (is_worker) setpriority(PRIO_PROCESS, this_thread(), kBackgroundNice);
  }
  void on_scheduler_exit(bool is_worker) override {
    if (is_worker) setpriority(PRIO_PROCESS, this_thread(), 0);
  }
};

}  // namespace

int thread_nice() { return getpriority(PRIO_PROCESS, this_thread()); }

void run_in_background(int threads, const std::function<void()>& work) {
  setpriority(PRIO_PROCESS, this_thread(), kBackgroundNice);
  tbb::task_arena arena(threads > 0 ? threads : tbb::info::default_concurrency());
  NiceThreads nice(arena);
  arena.execute(work);
}

void run_with_threads(int threads, const std::function<void()>& work) {
  const int n = threads > 0 ? threads : tbb::info::default_concurrency();
  // An arena alone never exceeds the cores and global_control alone never leaves the default arena: both are needed.
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n));
  tbb::task_arena arena(n);
  workers.store(0);
  epoch.fetch_add(1);
  arena.execute(work);
}

int working_threads() { return std::max(1, workers.load()); }

void parallel_chunks(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  if (n == 0) return;
  const std::size_t chunks = (n + grain - 1) / grain;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, chunks, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        note_worker();
        for (std::size_t c = range.begin(); c != range.end(); ++c) body(c * grain, std::min(n, (c + 1) * grain));
      },
      tbb::simple_partitioner());
}

void parallel_dearest_first(std::span<const float> costs, const std::function<void(std::size_t)>& body) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  // A partitioner does not keep order, so bodies take the next dearest themselves.
  std::atomic<std::size_t> next{0};
  parallel_for(costs.size(), [&](std::size_t) { body(order[next.fetch_add(1)]); });
}

}  // namespace bosquet
