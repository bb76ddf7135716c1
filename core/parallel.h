// Parallel loops: the only door to oneTBB.
//
// Holds     a loop body writes to its own slots only, and a reduction joins fixed chunks in a fixed order, so results
//           are the same bits for any number of threads
// Errors    none of their own; an exception thrown by a body stops the loop and reaches the caller
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace bosquet {

/// Runs `work` with at most `threads` threads (0: one per core), the calling one included; more threads than cores
/// really run.
void run_with_threads(int threads, const std::function<void()>& work);

/// Number of distinct threads that executed a loop body since the outermost run_with_threads began.
int working_threads();

/// Calls body(begin, end) for disjoint chunks that cover [0, n), each at most `grain` long.
void parallel_chunks(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

/// Calls body(i) once for each i in [0, n).
template <class Body>
void parallel_for(std::size_t n, const Body& body, std::size_t grain = 1) {
  parallel_chunks(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Calls body(i) once for each index of `costs`, the dearest first (ties by index), so that one late giant does not
/// leave the other threads idle.
void parallel_dearest_first(std::span<const float> costs, const std::function<void(std::size_t)>& body);

/// join(... join(map(0, grain), map(grain, 2*grain)) ...) in chunk order: the same value for any number of threads. The
/// grain is part of the answer: make it a named constant.
template <class T, class Map, class Join>
T deterministic_reduce(std::size_t n, std::size_t grain, T identity, const Map& map, const Join& join) {
  const std::size_t chunks = (n + grain - 1) / grain;
  std::vector<T> parts(chunks, identity);
  parallel_for(chunks, [&](std::size_t c) {
    const std::size_t begin = c * grain;
    parts[c] = map(begin, begin + grain < n ? begin + grain : n);
  });
  for (T& part : parts) identity = join(std::move(identity), std::move(part));
  return identity;
}

}  // namespace bosquet
