// Project text: the parts of a document that stand as JSON texts in a project file.
//
// Format    a section is a list of rows, each a name for people and an object; described parameters by their keys
//           (project_json.h), other fields by the names here
// Holds     rows read back give the values that were written
// Errors    what cannot be read keeps its default and is noted as "section.key"
#pragma once

#include <string>
#include <vector>

#include "scene/document.h"
#include "terrain/terrain.h"

namespace bosquet::scene {

struct TextRow {
  std::string name, json;
};

// Sections, in the order in which they are read.
inline constexpr const char* kTextSections[] = {"settings",    "ground",    "areas",  "species", "interactions",
                                                "species_bar", "obstacles", "heroes", "cameras", "figures"};

/// The rows of a section. When `before` is given, rows whose source both documents share are left empty: they are what
/// they were.
std::vector<TextRow> text_rows(const std::string& section, const Document& document, const Document* before);

/// How large the grids of a ground are; its row in the section "ground".
struct GroundFrame {
  terrain::Lattice lattice;
  std::optional<float> water_level_m;
  IVec2 areas{1}, ponds{1};  ///< cells of these grids
};

/// Reads rows into a document. Obstacles come without meshes, heroes without skeletons. `json` may be empty: such a row
/// is missing. The ground's frame and areas come apart, as a terrain is put together from them and blobs.
struct TextReader {
  Document& document;
  std::optional<GroundFrame> ground;
  std::vector<terrain::Area> areas;
  std::vector<std::string> problems;

  void read(const std::string& section, const std::vector<TextRow>& rows);
};

}  // namespace bosquet::scene
