#include "scene/figures.h"

#include "geometry/human_figure.h"

namespace bosquet::scene {
namespace {

// Dark clothes, no more than a measure.
constexpr Vec4 kWalkerColour{0.045f, 0.047f, 0.055f, 1.0f};

}  // namespace

void add_figures(Model& model, std::span<const Figure> figures, const terrain::Terrain& terrain) {
  if (figures.empty()) return;
  Material ink;
  ink.name = "figure";
  ink.surface = Surface::obstacle;
  ink.base_factor = kWalkerColour;
  model.materials.push_back(std::move(ink));
  for (const Figure& figure : figures) {
    Node node;
    node.name = "figure";
    node.translation = to_world(figure.at, terrain.ground(figure.at));
    node.parts.push_back(
        {std::make_shared<const TriangleMesh>(geometry::human_figure(figure.heading_deg)), model.materials.size() - 1});
    model.nodes.push_back(std::move(node));
  }
}

}  // namespace bosquet::scene
