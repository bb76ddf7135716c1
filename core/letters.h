// Letters: names folded so that they can be compared, whoever wrote them.
//
// Model     UTF-8. A-Z become a-z; letters with marks lose them (é e, ç c, ø o), German ones become two (ä ae, ö oe, ü ue,
//           ß ss) and so do æ and œ; × becomes x, curly quotes straight ones, a hard space a plain one. A mark that
//           stands behind its letter (decomposed text) counts as one with it. All else stays as it is
// Holds     folding twice is folding once, for UTF-8; bytes that are none stay as they are
#pragma once

#include <string>
#include <string_view>

namespace bosquet {

std::string folded_letters(std::string_view utf8);

/// Folded words joined by single underscores, without other signs: "Crown Ø (m)" is crown_o_m.
std::string folded_words(std::string_view utf8);

}  // namespace bosquet
