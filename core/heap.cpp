#include "core/heap.h"

#include <unistd.h>

#include <fstream>

namespace bosquet {

double resident_mb() {
  std::ifstream pages("/proc/self/statm");
  double all = 0, resident = 0;
  if (!(pages >> all >> resident)) return 0;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

}  // namespace bosquet
