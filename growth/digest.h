// Digest: 64 bits that stand for a whole skeleton, to show that two runs gave the same bits.
#pragma once

#include <cstdint>

#include "growth/skeleton.h"

namespace bosquet::growth {

/// Hash over all arrays of the skeleton, by their bits.
std::uint64_t digest(const Skeleton& skeleton);

}  // namespace bosquet::growth
