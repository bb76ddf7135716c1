// The same loops as parallel.cpp on plain threads, for ThreadSanitizer: it cannot see how oneTBB, which is not built with
// it, hands work over, and would report every loop. Built in place of parallel.cpp with -DBOSQUET_TSAN=ON.
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "core/background.h"
#include "core/parallel.h"

namespace bosquet {
namespace {

std::atomic<int> workers{0};
// Threads that a loop begun on this thread may use; a loop inside a loop runs alone.
thread_local int allowed = 0;

int cores() { return std::max(2, static_cast<int>(std::thread::hardware_concurrency())); }

class Allow {
 public:
  explicit Allow(int threads) : before_(allowed) { allowed = threads; }
  ~Allow() { allowed = before_; }

 private:
  int before_;
};

}  // namespace

int thread_nice() { return getpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid))); }

void run_in_background(int threads, const std::function<void()>& work) {
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kBackgroundNice);
  const Allow allow(threads > 0 ? threads : cores());
  work();
}

void run_with_threads(int threads, const std::function<void()>& work) {
  workers.store(0);
  const Allow allow(threads > 0 ? threads : cores());
  work();
}

int working_threads() { return std::max(1, workers.load()); }

void parallel_chunks(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  if (n == 0) return;
  const std::size_t chunks = (n + grain - 1) / grain;
  const int threads = allowed > 0 ? allowed : cores();
  std::atomic<std::size_t> next{0};
  std::exception_ptr failed;
  std::mutex failing;
  const auto take = [&] {
    const Allow alone(1);
    for (std::size_t c; (c = next.fetch_add(1)) < chunks;) try {
        body(c * grain, std::min(n, (c + 1) * grain));
      } catch (...) {
        const std::lock_guard lock(failing);
        failed = std::current_exception();
        next.store(chunks);
      }
  };
  std::vector<std::thread> others;
  for (std::size_t t = 1; t < std::min(static_cast<std::size_t>(threads), chunks); ++t) others.emplace_back(take);
  take();
  for (std::thread& thread : others) thread.join();
  workers.store(std::max(workers.load(), static_cast<int>(others.size()) + 1));
  if (failed) std::rethrow_exception(failed);
}

void parallel_dearest_first(std::span<const float> costs, const std::function<void(std::size_t)>& body) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  std::atomic<std::size_t> next{0};
  parallel_for(costs.size(), [&](std::size_t) { body(order[next.fetch_add(1)]); });
}

}  // namespace bosquet
