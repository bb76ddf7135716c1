#include "scene/species_names.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/letters.h"
#include "scene/common_names.h"

namespace bosquet::scene {
namespace {

using Known = std::span<const std::shared_ptr<const Species>>;

bool part_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
}
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }

// Letters and digits only, so that "Quercus robur", "quercus_robur" and "QUERCUS-ROBUR" are one.
std::string folded(std::string_view name) {
  std::string text = folded_letters(name);
  std::erase_if(text, [](char c) { return !part_of_name(c); });
  return text;
}

// Folded words of a name.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : folded_letters(name)) {
    if (is_letter(c))
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

template <class Test>
bool any_of_list(std::string_view list, Test&& test) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(';'), list.size());
    if (test(list.substr(0, end))) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

bool in_list(std::string_view list, std::string_view name) {
  return any_of_list(list, [&](std::string_view entry) { return entry == name; });
}

// A genus word stands alone or ends a compound: "black oak" and "blackoak", not "oakleaf hydrangea". A compound's first
// part is a word too, which "Al" of "Alpine" is not.
bool ends_a_word(const std::vector<std::string>& words, std::string_view end) {
  constexpr std::size_t kShortestPart = 3;
  return std::any_of(words.begin(), words.end(), [&](const std::string& w) {
    return w == end || (w.ends_with(end) && w.size() >= end.size() + kShortestPart);
  });
}

bool is_a_word(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// "Alpine" and "firethorn" are no conifers, so these words count only where they stand alone.
bool names_conifer(const std::vector<std::string>& words) {
  return any_of_list(conifer_words(), [&](std::string_view w) { return is_a_word(words, w); }) ||
         any_of_list(conifer_compounds(), [&](std::string_view w) { return ends_a_word(words, w); });
}

// The built-in names of a species; none for a user's own.
const CommonNames* names_of(const Species& species) {
  for (const CommonNames& names : common_names())
    if (names.species == species.name) return &names;
  return nullptr;
}

// Genus and species of a botanical name, without cultivar; empty when it has less.
std::vector<std::string> binomial(const Species& species) {
  const std::string& name = species.botanical_name;
  std::vector<std::string> words = words_of(std::string_view(name).substr(0, name.find('\'')));
  if (words.size() < 2) return {};
  return words;
}

// Whether the words of a botanical name stand in a row in the name; a lone x marks a hybrid and may be left out.
bool holds_binomial(std::vector<std::string> words, std::vector<std::string> wanted) {
  std::erase(words, "x");
  std::erase(wanted, "x");
  return !wanted.empty() && std::search(words.begin(), words.end(), wanted.begin(), wanted.end()) != words.end();
}

std::optional<std::size_t> by_exact_name(std::string_view text, Known known) {
  for (std::size_t i = 0; i < known.size(); ++i)
    if (text == folded(known[i]->name)) return i;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Species& s = *known[i];
    if (s.derived) continue;
    if (text == folded(s.botanical_name)) return i;
    for (const std::string& common : s.common_names)
      if (text == folded(common)) return i;
    if (const CommonNames* names = names_of(s); names && in_list(names->names, text)) return i;
  }
  return {};
}

// A cultivar often follows its species' common name: "Spitzahorn 'Globosum'".
std::optional<std::size_t> by_beginning(std::string_view text, Known known) {
  constexpr std::size_t kTelling = 9;  // letters; shorter names begin others' too
  const auto begins = [&](std::string_view name) { return name.size() >= kTelling && text.starts_with(name); };
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Species& s = *known[i];
    if (s.derived) continue;
    for (const std::string& common : s.common_names)
      if (begins(folded(common))) return i;
    if (const CommonNames* names = names_of(s); names && any_of_list(names->names, begins)) return i;
  }
  return {};
}

// Botanical and English words come before German and French ones: "pin oak" is no pine.
std::optional<std::size_t> by_genus(const std::vector<std::string>& words, Known known) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i]->derived) continue;
    // The genus itself ends no compound: Carpinus is no pine.
    const std::vector<std::string> botanical = words_of(known[i]->botanical_name);
    for (const std::string& word : known[i]->genus_words) {
      const std::string genus = folded(word);
      const bool itself = !botanical.empty() && genus == botanical.front();
      if (itself ? is_a_word(words, genus) : ends_a_word(words, genus)) return i;
    }
  }
  for (std::size_t i = 0; i < known.size(); ++i)
    if (const CommonNames* names = names_of(*known[i]); names && !known[i]->derived)
      if (any_of_list(names->compounds, [&](std::string_view w) { return ends_a_word(words, w); })) return i;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (const CommonNames* names = names_of(*known[i]); names && !known[i]->derived)
      if (any_of_list(names->words, [&](std::string_view w) { return is_a_word(words, w); })) return i;
  return {};
}

SpeciesMatch match(std::string_view name, Known known, std::size_t fallback, const Synonyms* synonyms) {
  const std::string text = folded(name);
  if (text.empty()) return {fallback, NameMatch::fallback};
  if (const std::string* own = synonyms ? synonyms->find(name) : nullptr)
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i]->name == *own) return {i, NameMatch::exact};
  if (const auto exact = by_exact_name(text, known)) return {*exact, NameMatch::exact};

  const std::vector<std::string> words = words_of(name);
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!known[i]->derived && holds_binomial(words, binomial(*known[i]))) {
      // "Populus nigra" is the wild tree, of which ours is a cultivar.
      const bool cultivar = known[i]->botanical_name.find('\'') != std::string::npos &&
                            text.find(folded(known[i]->botanical_name)) == std::string::npos;
      return {i, cultivar ? NameMatch::genus : NameMatch::species};
    }
  if (const auto begun = by_beginning(text, known)) return {*begun, NameMatch::species};
  const bool misleading =
      any_of_list(misleading_names(), [&](std::string_view other) { return text.find(other) != std::string::npos; });
  if (!misleading)
    if (const auto genus = by_genus(words, known)) return {*genus, NameMatch::genus};
  // A cypress that is none of ours is a conifer all the same.
  const bool cypress = ends_a_word(words, "cypress") || ends_a_word(words, "zypresse") || is_a_word(words, "cypres");
  if (cypress || names_conifer(words))
    for (std::size_t i = 0; i < known.size(); ++i)
      if (!known[i]->derived && names_conifer(words_of(known[i]->name))) return {i, NameMatch::leaf_type};
  return {fallback, NameMatch::fallback};
}

}  // namespace

bool Synonyms::add(std::string_view name, std::string species) {
  std::string key = folded(name);
  if (key.empty()) return false;
  const auto [at, fresh] = by_name_.emplace(std::move(key), std::move(species));
  return fresh || at->second == species;
}

const std::string* Synonyms::find(std::string_view name) const {
  const auto at = by_name_.find(folded(name));
  return at == by_name_.end() ? nullptr : &at->second;
}

SpeciesMatch match_species(std::string_view name, std::span<const std::shared_ptr<const Species>> known,
                           std::size_t fallback, const Synonyms* synonyms) {
  SpeciesMatch out = match(name, known, fallback, synonyms);
  // Species that are narrow themselves are as wide as they are.
  const bool narrow = known[out.species]->botanical_name.find('\'') != std::string::npos ||
                      known[out.species]->name == "italian_cypress";
  if (!narrow && (out.how == NameMatch::exact || out.how == NameMatch::species || out.how == NameMatch::genus))
    for (const std::string& word : words_of(name))
      if (in_list(columnar_words(), word)) out.width = kColumnarWidth;
  return out;
}

}  // namespace bosquet::scene
