#include "render/shader_texts.h"

namespace bosquet::render {

const char* const kGroundPatches = R"(
// Ground is never even: drier and lusher patches over many metres, as much as `patchiness` (0..1) says.
vec3 ground_patches(vec2 p, float patchiness) {
  float wide = patchiness * (layered_noise(p / 38.0) - 0.5), near = patchiness * (layered_noise(p / 7.0 + 31.0) - 0.5);
  return (1.0 + 0.24 * wide + 0.10 * near) *
         mix(vec3(1.05, 1.0, 0.90), vec3(0.95, 1.01, 0.98), clamp(0.5 + 1.2 * wide + 0.3 * near, 0.0, 1.0));
}
)";

const char* const kGround = R"(
// A tiling texture at two scales, turned against each other so that it does not seem to repeat; `turned` is the share
// of the turned one.
vec3 ground_texture(sampler2D map, vec2 uv, float turned) {
  vec3 seen = texture(map, uv).rgb;
  if (turned > 0.0) seen = mix(seen, texture(map, mat2(0.259, 0.143, -0.143, 0.259) * uv + 0.37).rgb, turned);
  // From far away a field of tiles would show as a grid: its mean takes over.
  float tiles_per_pixel = max(length(dFdx(uv)), length(dFdy(uv)));
  return mix(seen, textureLod(map, uv, 16.0).rgb, 0.9 * smoothstep(0.02, 0.15, tiles_per_pixel));
}
// Tufts stand above what is between them; without their own shapes, by light and shade, gone with distance.
vec3 tufts(vec2 p, float distance_m) {
  float near = exp(-distance_m / 22.0);
  if (near < 0.02) return vec3(1.0);
  float clump = noise(p / 0.21) * 0.5 + noise(mat2(0.8, 0.6, -0.6, 0.8) * p / 0.07) * 0.5;
  float dry = noise(p / 1.3 + 71.0);
  vec3 shade = vec3(mix(0.80, 1.16, smoothstep(0.2, 0.8, clump)));
  shade *= mix(vec3(1.0), vec3(1.07, 1.02, 0.93), smoothstep(0.55, 0.95, dry));
  return mix(vec3(1.0), shade, near);
}
)";

const char* const kGroundMain = R"(
void main() {
  vec3 world = v_relative + eye.xyz;
  vec3 texel = maps.x > 0.5 ? ground_texture(colour_map, v_uv, material.w > 0.5 ? 0.0 : 0.45) : vec3(1.0);
  vec3 albedo = texel * base_factor.rgb * v_colour;
  if (shading.x > 1.5) { out_colour = vec4(0.0, 0.0, 0.0, 1.0); return; }
  if (shading.x > 0.5) { out_colour = vec4(albedo, 1.0); return; }
  // The site's edge fades into the land around along no straight line.
  if (over_height.w > 0.5) {
    vec2 inside = min(world.xz - ground_box.xy, ground_box.zw - world.xz);
    float rim = min(inside.x, inside.y) + 3.0 * (layered_noise(world.xz / 2.1 + 7.0) - 0.5);
    float shore = water.y > 0.5 ? smoothstep(0.1, 0.6, world.y - water.x) : 1.0;
    albedo = mix(albedo, texel * land.rgb, (1.0 - smoothstep(0.3, 4.0, rim)) * shore);
  }
  float green = smoothstep(1.0, 1.12, albedo.g / max(albedo.r, 1e-3));
  albedo *= ground_patches(world.xz, material.z) *
            mix(vec3(1.0), tufts(world.xz, length(v_relative)), green * mix(0.4, 1.0, material.z));
  // Soaked at the water's edge.
  float wet = water.y > 0.5 ? 1.0 - smoothstep(0.02, 0.30, world.y - water.x) : 0.0;
  albedo *= 1.0 - 0.45 * wet;
  vec3 to_eye = view_point.xyz - v_relative;
  float distance_m = length(to_eye);
  vec3 v = view_point.w > 0.5 ? -forward.xyz : to_eye / distance_m;
  vec3 surface = normalize(v_normal);
  vec3 n = bent_normal(surface, v_uv);
  float nl = dot(n, to_sun.xyz);
  float lit = nl > 0.0 ? sunlit(v_relative, surface, 0.14) : 0.0;
  float open = mix(0.36, 1.0, open_sky(world));
  vec3 light = albedo / pi * (sun_light.rgb * (lit * max(nl, 0.0)) + ambient_light(n) * open);
  out_colour = vec4(encoded(through_air(light, -v, distance_m)), 1.0);
}
)";

}  // namespace bosquet::render
