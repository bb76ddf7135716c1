// Document digest: a 128-bit number for each section of a document, by which silent damage shows.
//
// Model     over the decoded values, not over bytes of a file: trees and the tiles of the ground are hashed one by one
//           with their ids and places and the hashes added up, so that neither blocks nor the order of work matter; lists
//           that have an order are hashed in it. -0 counts as 0, since files need not keep the sign
// Holds     equal documents have equal digests on every machine; derived things and unused padding have no part in them
// Cost      10,000 trees some 5 ms; a million samples of ground some 10 ms. A DigestKeeper finds again what it hashed for
//           the document before: sections, and tiles of the ground, that are shared cost nothing
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "scene/document.h"

namespace bosquet::scene {

struct Digest128 {
  std::uint64_t high = 0, low = 0;
  bool operator==(const Digest128&) const = default;
};

/// 32 lower-case hex digits.
std::string hex_digits(const Digest128& digest);

enum class Section { site, ground, species, planting, trees, obstacles, heroes, settings };
inline constexpr std::array<std::string_view, 8> kSectionNames{"site",  "ground",    "species", "planting",
                                                               "trees", "obstacles", "heroes",  "settings"};

/// site: seed, place and counters. ground: heights, water level, masks. planting: interactions and species bar. settings:
/// crown space, asymmetry, light, cameras, figures, sun, triangles, clearance, plan sheet and underlay.
struct SectionDigests {
  std::array<Digest128, kSectionNames.size()> of{};

  const Digest128& operator[](Section section) const { return of[static_cast<std::size_t>(section)]; }
  Digest128& operator[](Section section) { return of[static_cast<std::size_t>(section)]; }
  /// One for the whole document.
  Digest128 all() const;
  bool operator==(const SectionDigests&) const = default;
};

SectionDigests digest(const Document& document);

/// Digests of one document after another.
class DigestKeeper {
 public:
  DigestKeeper();
  ~DigestKeeper();
  DigestKeeper(DigestKeeper&&) noexcept;
  DigestKeeper& operator=(DigestKeeper&&) noexcept;

  /// Equal to digest(document).
  SectionDigests of(const Document& document);

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace bosquet::scene
