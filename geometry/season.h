// Season: what the year does to a tree's dress. An input of the mesh and texture builders, never of growth.
//
// bare      a deciduous tree shows twigs and buds only; an evergreen looks as in summer
#pragma once

#include <array>
#include <string_view>

namespace bosquet::geometry {

enum class Season { spring, summer, autumn, bare };

inline constexpr std::array<std::string_view, 4> kSeasonNames{"spring", "summer", "autumn", "bare"};

}  // namespace bosquet::geometry
