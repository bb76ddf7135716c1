// Wide: whether loops written for eight lanes may run on this processor.
//
// Who       inner loops written twice, for any processor and with the AVX2 instructions of the last ten years' ones. Both
//           ways give the same bits
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#define BOSQUET_WIDE 1
#include <immintrin.h>
#else
#define BOSQUET_WIDE 0
#endif

namespace bosquet {

inline bool wide_here() {
#if BOSQUET_WIDE
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

}  // namespace bosquet
