// Progress and cancellation of long work, as one object handed in.
//
// The worker names its stage, says how much there is and counts what is done; whoever shows it reads from another
// thread. A cancelled computation returns an Error of kind cannot_finish (or an incomplete value that its caller drops
// whole). All members may be called from any thread; cancel() also from a signal handler.
#pragma once

#include <atomic>
#include <cstddef>

namespace bosquet {

class Progress {
 public:
  /// Starts a stage of `total` steps. `name` must outlive the object (a literal).
  void begin(const char* name, std::size_t total) {
    done_.store(0);
    total_.store(total);
    name_.store(name);
  }
  void advance(std::size_t steps = 1) { done_.fetch_add(steps, std::memory_order_relaxed); }
  void cancel() { cancelled_.store(true); }

  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  const char* stage() const { return name_.load(); }
  std::size_t done() const { return done_.load(std::memory_order_relaxed); }
  std::size_t total() const { return total_.load(); }

 private:
  std::atomic<const char*> name_{""};
  std::atomic<std::size_t> done_{0}, total_{0};
  std::atomic<bool> cancelled_{false};
};

}  // namespace bosquet
