// View: everything that decides a picture besides the model itself.
//
// Frame     camera in world coordinates; the picture's upright is the world's +y
// Units     metres, pixels, degrees; colours linear
#pragma once

#include <optional>

#include "core/parameter.h"
#include "core/vec.h"
#include "scene/model.h"

namespace bosquet::render {

/// How surfaces are drawn.
enum class Shading {
  natural,     ///< sun, sky, shadows, haze, tone mapping
  flat,        ///< base colours alone, unlit: plans, keys, colour checks
  silhouette,  ///< black where anything but sky is, white elsewhere, background ignored: for comparing outlines
};

/// How much is spent on a picture.
enum class Quality {
  full,
  draft,  ///< while a hand moves: no mirror image in the water, and one shadow map of the whole scene, kept until the
          ///< scene or the sun changes
};

/// Light and lens: the part of a view that a designer tunes.
struct Look {
  float exposure_ev = 0.0f;         ///< added to the automatic exposure
  float haze_distance_m = 6000.0f;  ///< air that hides 63 % of what is this far away
  float turbidity = 2.2f;           ///< dust in the air
  float clouds = 0.35f;             ///< cover of thin high clouds
  float ripples = 1.0f;             ///< height of the water's ripples
  bool surroundings = true;         ///< plain land around the site; without it the sky goes on below the horizon
};

template <class Parameters, class Visitor>
void describe(Parameters& p, Visitor& visit) {
  visit(Real{"exposure_ev", "EV", -8, 8, "Makes the picture brighter or darker, in doublings of light"}, p.exposure_ev);
  visit(Real{"haze_distance_m", "m", 50, 1e6, "Distance at which the air hides 63 % of what is seen"},
        p.haze_distance_m);
  visit(Real{"turbidity", "", 1, 10, "Dust in the air: 1 none, 2 a clear day, 6 a hazy one"}, p.turbidity);
  visit(Real{"clouds", "", 0, 1, "Share of the sky under thin high clouds"}, p.clouds);
  visit(Real{"ripples", "", 0, 4, "Height of the ripples on water, 1 is a light breeze"}, p.ripples);
  visit(Switch{"surroundings", "Draws plain land around the site up to the horizon"}, p.surroundings);
}

struct View {
  scene::Camera camera;                ///< its field of view is the vertical one
  float orthographic_height_m = 0.0f;  ///< above 0: parallel projection that shows this height of world (plans)
  int width = 1600, height = 900;      ///< pixels
  std::optional<scene::Sun> sun;       ///< in place of the model's
  bool sky = true;                     ///< false: `background` is drawn where nothing stands; light stays the same
  Vec3 background{1.0f};               ///< linear
  Shading shading = Shading::natural;
  Quality quality = Quality::full;
  /// The picture is drawn this many times wider and higher and averaged, 1-4: calmer twigs and leaves. Windows take 1.
  int supersample = 2;
  /// Samples per pixel, 1-16, capped by what the driver offers (llvmpipe: 4). 0: 4, but 1 where software draws a
  /// supersampled picture; there samples cost as much as pixels and show less.
  int samples = 0;
  float grass_reach = 1.0f;  ///< how far tufts of grass are drawn, as a share of the usual; 0 none
  Look look;
};

}  // namespace bosquet::render
