#include "render/shader_texts.h"

namespace bosquet::render {

const char* const kGrassVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 place;   // foot, height
layout(location = 3) in vec4 turn;    // cosine, sine, metres it can be told from, patchiness of its ground
layout(location = 4) in vec4 colour;  // alpha 0: not of the ground's colour
layout(location = 5) in vec3 up;      // of the ground
uniform vec3 offset;  // of the patch, relative to the eye
uniform float reach;
uniform sampler2D colour_map;
out vec3 v_colour;

void main() {
  v_colour = vec3(0.0);
  vec3 foot = place.xyz + offset, world = foot + eye.xyz;
  float far = turn.z * reach, shown = 1.0 - smoothstep(0.6, 1.0, length(foot) / far);
  // Toward the site's edge it is what grows on the land around: nothing that stands out.
  float rim = 0.0;
  if (over_height.w > 0.5) {
    vec2 inside = min(world.xz - ground_box.xy, ground_box.zw - world.xz);
    float edge = min(inside.x, inside.y) + 3.0 * (layered_noise(world.xz / 2.1 + 7.0) - 0.5);
    rim = 1.0 - smoothstep(0.3, 4.0, edge);
    shown *= 1.0 - rim;
  }
  if (shown <= 0.0) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  // Upright on a slope, its foot along the ground; it fades by sinking.
  vec3 p = place.w * vec3(turn.x * position.x - turn.y * position.z, position.y * shown, turn.y * position.x + turn.x * position.z);
  p.y -= dot(up.xz, p.xz) / max(up.y, 0.3);
  vec3 relative = foot + p;
  gl_Position = relative_to_clip * vec4(relative, 1.0);
  if (shading.x > 1.5) return;
  vec3 share = textureLod(colour_map, uv, 0.0).rgb, tone = colour.rgb;
  if (colour.a > 0.5) {
    // As it fades it takes the ground's own tone.
    share = mix(vec3(0.5), share, mix(0.35, 1.0, shown));
    tone = mix(tone, 2.0 * vec3(0.42, 0.42, 0.38) * land.rgb, rim) * ground_patches(world.xz, turn.w);
  }
  vec3 albedo = share * tone;
  if (shading.x > 0.5) { v_colour = albedo; return; }
  vec3 to_eye = view_point.xyz - relative;
  float distance_m = length(to_eye);
  vec3 v = to_eye / distance_m, n = normalize(up);
  float nl = dot(n, to_sun.xyz);
  float lit = nl > 0.0 ? sunlit(foot, n, 0.14) : 0.0;
  float open = mix(0.36, 1.0, open_sky(world));
  vec3 light = albedo / pi * (sun_light.rgb * (lit * max(nl, 0.0)) + ambient_light(n) * open);
  // Near the eye blades glow against the sun.
  float glow = pow(max(dot(-v, to_sun.xyz), 0.0), 3.0) * exp(-distance_m / 12.0) * (1.0 - uv.y);
  light += albedo / pi * sun_light.rgb * (0.5 * lit * glow) * vec3(1.0, 1.0, 0.6);
  v_colour = encoded(through_air(light, -v, distance_m));
}
)";

const char* const kGrassFragment = R"(#version 330 core
in vec3 v_colour;
out vec4 out_colour;
void main() { out_colour = vec4(v_colour, 1.0); }
)";

}  // namespace bosquet::render
