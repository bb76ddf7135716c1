// The program's version.
#pragma once

namespace bosquet::cli {

inline constexpr const char* kVersion = "0.1.0";

}  // namespace bosquet::cli
