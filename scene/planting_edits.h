// Planting edits: trees added to a document one by one, in rows, along a brush stroke or over an area, and brushed away.
//
// Model     what is planted and where hangs on the document and the number of the planting alone (distribution/): fields
//           by species, interactions and standing trees, types by the species bar. A PlantingGround only saves the fields
//           from being made anew for every stroke
// Decision  trees to be removed make room at once; nothing is sown into buildings that have an outline
// Decision  a number of planting is used up even when no tree finds room, so that the next try draws other places
// Frame     plan (east, north) metres
// Errors    rules that cannot be met, by name
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "distribution/planting.h"
#include "distribution/rows.h"
#include "distribution/sowing.h"
#include "scene/edits.h"

namespace bosquet::scene {

/// The planting of one document after another, kept in step with them. What it gives does not hang on what it was asked
/// before.
class PlantingGround {
 public:
  /// The document's ground and trees as planting sees them; whoever plants in it tells with planted().
  Result<distribution::Planting*> of(const Document& document);
  /// The planting holds the trees of this document now.
  void planted(const Document& document) { document_ = document; }

 private:
  std::optional<Document> document_;
  std::optional<distribution::Planting> planting_;
};

/// The document's species as planting sees them.
std::vector<distribution::Species> planting_species(const Document& document);

/// What brushes plant: the species bar, or all species alike.
std::vector<distribution::MixEntry> planted_mix(const Document& document);

/// One tree where somebody chose; why it may not stand there is the error.
Result<Edited> plant_tree(const Document& document, PlantingGround& ground, std::size_t species, Vec2 at, float scale);

/// Along a recorded stroke of the brush.
Result<Edited> plant_stroke(const Document& document, PlantingGround& ground, const distribution::PlantBrush& brush,
                            std::span<const distribution::BrushEvent> events, Progress* progress = nullptr);

/// Planting along a stroke while it is drawn: each edit is that of plant_stroke for the events so far, from the document
/// that the stroke began with, and costs what its new events do. The ground is its own until it goes.
class LivePlanting {
 public:
  static Result<LivePlanting> begin(const Document& document, PlantingGround& ground,
                                    const distribution::PlantBrush& brush);

  Edited extend(std::span<const distribution::BrushEvent> events);
  Edited finish();

 private:
  LivePlanting(const Document& document, PlantingGround& ground) : before_(document), ground_(&ground) {}
  Document before_;
  PlantingGround* ground_;
  std::unique_ptr<distribution::StrokeSower> sower_;
};

/// At given places, as rows and grids make them; `what` names them ("row").
Result<Edited> plant_places(const Document& document, PlantingGround& ground, std::span<const Vec2> places,
                            float jitter_m, std::string_view what);

/// So many in a region.
Result<Edited> plant_area(const Document& document, PlantingGround& ground, const distribution::Region& where,
                          std::size_t count, Progress* progress = nullptr);

/// Takes the trees away whose trunks stand within `radius_m` of a polyline.
Edited erase_stroke(const Document& document, std::span<const Vec2> points, float radius_m);

/// Trees with their bases in a region, by rising id: box and lasso.
std::vector<std::int32_t> trees_within(const Document& document, const distribution::Region& where);

}  // namespace bosquet::scene
