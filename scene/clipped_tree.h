// Clipped tree: a tree that is ordered by the body it is kept cut to takes its size from that.
//
// Model     it is as high as its form, and asks for room as wide as the form reaches from its base, so that nothing that
//           is left free in the division of space is missing in the form
// Units     metres; frame of the form: crowns/clipped_form.h
#pragma once

#include "scene/document.h"

namespace bosquet::scene {

/// S_h of a tree with this form: its height as a share of the mature one's.
float clipped_scale(const Species& species, const crowns::ClippedForm& form);

/// Gives a tree a form (with width, depth and height) on a clear stem, and the scales that go with it.
void set_form(Tree& tree, const Species& species, const crowns::ClippedForm& form, float clear_stem_m);

}  // namespace bosquet::scene
