#include "core/letters.h"

#include <array>

namespace bosquet {
namespace {

// U+00C0 to U+00DF; the small letters, 32 places later, fold alike but for the last and the division sign.
constexpr std::array<std::string_view, 32> kLatin1{"a",  "a", "a", "a", "ae", "a", "ae", "c", "e",  "e", "e",
                                                   "e",  "i", "i", "i", "i",  "d", "n",  "o", "o",  "o", "o",
                                                   "oe", "x", "o", "u", "u",  "u", "ue", "y", "th", "ss"};

std::string_view latin1(unsigned code) {
  if (code == 0xf7) return " ";
  if (code == 0xff) return "y";
  return kLatin1[(code - 0xc0) % 32];
}

}  // namespace

std::string folded_letters(std::string_view utf8) {
  std::string out;
  out.reserve(utf8.size());
  const auto byte = [&](std::size_t i) { return i < utf8.size() ? static_cast<unsigned char>(utf8[i]) : 0u; };
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const unsigned c = byte(i), next = byte(i + 1);
    if (c >= 'A' && c <= 'Z') {
      out += static_cast<char>(c - 'A' + 'a');
    } else if (c == 0xc3 && next >= 0x80 && next < 0xc0) {
      out += latin1(next + 0x40), ++i;
    } else if (c == 0xc2 && next == 0xa0) {
      out += ' ', ++i;
    } else if (c == 0xc5 && (next == 0x92 || next == 0x93)) {
      out += "oe", ++i;
    } else if ((c == 0xcc && next >= 0x80 && next < 0xc0) || (c == 0xcd && next >= 0x80 && next < 0xb0)) {
      // A mark behind its letter: two dots make an umlaut, others go.
      if (c == 0xcc && next == 0x88 && !out.empty() && std::string_view("aou").find(out.back()) != std::string::npos)
        out += 'e';
      ++i;
    } else if (c == 0xe2 && next == 0x80 && byte(i + 2) >= 0x98 && byte(i + 2) <= 0x9f) {
      out += byte(i + 2) < 0x9c ? '\'' : '"', i += 2;
    } else {
      out += static_cast<char>(c);
    }
  }
  return out;
}

std::string folded_words(std::string_view utf8) {
  std::string out;
  for (const char c : folded_letters(utf8)) {
    const bool part = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
    if (part)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

}  // namespace bosquet
