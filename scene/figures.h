// Figures: people for scale, as nodes of a model that is to be drawn.
//
// Frame     a figure's plan point (east, north) and heading become world places on the ground; metres
#pragma once

#include <span>

#include "scene/document.h"
#include "scene/model.h"

namespace bosquet::scene {

/// Sets the figures on the ground of a site, in a material of their own.
void add_figures(Model& model, std::span<const Figure> figures, const terrain::Terrain& terrain);

}  // namespace bosquet::scene
