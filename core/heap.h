// Heap: how the programs' allocator treats memory that is given back.
#pragma once

#include <cstddef>  // __GLIBC__

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bosquet {

/// At the start of a program: the arrays of trees and meshes come and go, tree by tree; kept, their memory need not be
/// cleared by the system each time.
inline void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 64 << 20), mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

}  // namespace bosquet
