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

bool contains_word(const std::string& name, std::string_view word) {
  return name.find(folded(word)) != std::string::npos;
}

bool is_conifer(const Species& species) {
  return std::any_of(kNeedleWords.begin(), kNeedleWords.end(),
                     [&](std::string_view w) { return contains_word(folded(species.name), w); });
}

}  // namespace

SpeciesMatch match_species(std::string_view name, std::span<const std::shared_ptr<const Species>> known,
                           std::size_t fallback) {
  const std::string text = folded(name);
  if (text.empty()) return {fallback, NameMatch::fallback};
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Species& s = *known[i];
    if (text == folded(s.name) || text == folded(s.botanical_name)) return {i, NameMatch::exact};
    for (const std::string& common : s.common_names)
      if (text == folded(common)) return {i, NameMatch::exact};
  }
  for (std::size_t i = 0; i < known.size(); ++i)
    for (const std::string& word : known[i]->genus_words)
      if (contains_word(text, word)) return {i, NameMatch::genus};
  const bool needles =
      std::any_of(kNeedleWords.begin(), kNeedleWords.end(), [&](std::string_view w) { return contains_word(text, w); });
  for (std::size_t i = 0; needles && i < known.size(); ++i)
    if (is_conifer(*known[i])) return {i, NameMatch::leaf_type};
  return {fallback, NameMatch::fallback};
}

}  // namespace bosquet::scene
