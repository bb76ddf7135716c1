// Heap: the memory that a program holds, and how its allocator treats what is given back.
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

/// Where much was given back that what comes next cannot use, in other sizes and by other threads: to the system.
inline void give_back_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// Memory of the machine that the program holds now, in MB; 0 where the system does not tell.
double resident_mb();

}  // namespace bosquet
