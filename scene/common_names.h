// Common names: what the built-in species are called beside the names in their files, in English, German and French, and
// the cultivars that towns plant most.
//
// Model     `names` mean the species itself, or a cultivar that is drawn as it. `compounds` name the genus as a word or at
//           the end of one (Stieleiche), `words` only as a word of its own. `not_these` hold a genus' word and are others
// Decision  names are folded (core/letters.h) and without anything but letters
#pragma once

#include <span>
#include <string_view>

namespace bosquet::scene {

struct CommonNames {
  std::string_view species;
  std::string_view names, compounds, words;  ///< parted by ;
};
std::span<const CommonNames> common_names();

/// Hornbeams that are no beeches, and their like; parted by ;
std::string_view misleading_names();

/// Words for conifers, alone and at the end of a compound; parted by ;
std::string_view conifer_words();
std::string_view conifer_compounds();

/// Words of cultivars with narrow upright crowns; parted by ;
std::string_view columnar_words();

}  // namespace bosquet::scene
