// Replacing: which files a command may write over without asking.
//
// Decision  pictures, models and schedules are products: they are made anew. Projects and recipes hold people's own work:
//           one that is there is replaced when the user says so (--replace), or when it is a project that the same file
//           made and nobody has edited since
// Errors    what stands there, and how to allow it
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"

namespace bosquet::cli {

/// `source` is what `target` is to be made from; empty when it is no file.
Result<void> check_replacing(const std::filesystem::path& target, const std::filesystem::path& source, bool replace);

/// How a project calls the file that it is made from: by the way there from its own folder.
std::string way_between(const std::filesystem::path& target, const std::filesystem::path& source);

}  // namespace bosquet::cli
