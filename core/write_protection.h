// Write protection: a file that may not be written is not replaced either.
//
// Decision  files appear by a rename over the old one, which asks the folder alone; but who made a file read-only wants to
//           keep it
// Errors    kind `input`: which file, and what can be done
#pragma once

#include <filesystem>

#include "core/result.h"

namespace bosquet {

/// Refuses a regular file without permission to write, for its owner or for this user. What is not there may be made.
Result<void> check_replaceable(const std::filesystem::path& target);

}  // namespace bosquet
