#include "scene/species_names.h"

#include <algorithm>
#include <array>

namespace bosquet::scene {
namespace {

constexpr std::array<std::string_view, 6> kNeedleWords{"pine", "spruce", "fir", "larch", "cedar", "juniper"};

// Lower-case letters and digits only, so that "Quercus robur", "quercus_robur" and "QUERCUS-ROBUR" are one.
std::string folded(std::string_view name) {
  std::string text;
  for (unsigned char c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<unsigned char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c >= 0x80) text.push_back(static_cast<char>(c));
  }
  return text;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

// Lower-case words of a name.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  for (char c : name) {
    if (is_letter(c))
      words.back() += folded(std::string_view(&c, 1));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

// A genus word stands alone or ends a compound: "black oak" and "blackoak", not "oakleaf hydrangea". A compound's first
// part is a word too, which "Al" of "Alpine" is not.
bool names_genus(const std::vector<std::string>& words, std::string_view genus) {
  constexpr std::size_t kShortestPart = 3;
  const std::string end = folded(genus);
  return std::any_of(words.begin(), words.end(), [&](const std::string& w) {
    return w == end || (w.ends_with(end) && w.size() >= end.size() + kShortestPart);
  });
}

// "Alpine" and "firethorn" are no conifers, so these words count only where they stand alone.
bool names_conifer(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [](const std::string& w) {
    return std::find(kNeedleWords.begin(), kNeedleWords.end(), w) != kNeedleWords.end();
  });
}

}  // namespace

SpeciesMatch match_species(std::string_view name, std::span<const std::shared_ptr<const Species>> known,
                           std::size_t fallback) {
  const std::string text = folded(name);
  if (text.empty()) return {fallback, NameMatch::fallback};
  for (std::size_t i = 0; i < known.size(); ++i)
    if (text == folded(known[i]->name)) return {i, NameMatch::exact};
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Species& s = *known[i];
    if (s.derived) continue;
    if (text == folded(s.botanical_name)) return {i, NameMatch::exact};
    for (const std::string& common : s.common_names)
      if (text == folded(common)) return {i, NameMatch::exact};
  }
  const std::vector<std::string> words = words_of(name);
  for (std::size_t i = 0; i < known.size(); ++i)
    for (const std::string& genus : known[i]->genus_words)
      if (!known[i]->derived && names_genus(words, genus)) return {i, NameMatch::genus};
  if (names_conifer(words))
    for (std::size_t i = 0; i < known.size(); ++i)
      if (!known[i]->derived && names_conifer(words_of(known[i]->name))) return {i, NameMatch::leaf_type};
  return {fallback, NameMatch::fallback};
}

}  // namespace bosquet::scene
