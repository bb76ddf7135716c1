// Barred ground: what a hand is told that plants where planting is barred, a lawn, a path or ground kept free.
//
// Frame     plan (east, north) metres
#pragma once

#include <span>
#include <string>

#include "scene/document.h"

namespace bosquet::ui {

/// The message, with what bars planting and the tool that frees it when half of the places or more are barred; places off
/// the site do not count.
std::string with_what_bars(std::string message, const scene::Document& document, std::span<const Vec2> places);

}  // namespace bosquet::ui
