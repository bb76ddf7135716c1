// Background work: parallel loops on threads that give way to everything else.
//
// Model     like run_with_threads, but its threads run at nice kBackgroundNice, and it neither limits nor counts threads
//           elsewhere: a window goes on beside it
// Decision  only privileged processes may take back a nice value, so worker threads of the scheduler that once served the
//           background may stay nice when they serve something else
#pragma once

#include <functional>

namespace bosquet {

inline constexpr int kBackgroundNice = 10;

/// Runs `work` on the calling thread, which is made nice for good, and its parallel loops with at most `threads` threads
/// (0: one per core).
void run_in_background(int threads, const std::function<void()>& work);

/// The calling thread's nice value.
int thread_nice();

}  // namespace bosquet
