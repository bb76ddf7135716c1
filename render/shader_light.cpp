#include "render/shader_texts.h"

namespace bosquet::render {

const char* const kFrame = R"(#version 330 core
layout(std140) uniform Frame {
  mat4 relative_to_clip;
  mat4 relative_to_shadow[3];
  vec4 cascade_far, cascade_texel, cascade_depth;
  vec4 eye, view_point, forward;
  vec4 ray_right, ray_up, ray_forward;
  vec4 to_sun, gain, sun_light, sky_light;
  vec4 ambient[9];
  vec4 air, tone;
  vec4 over_area, over_height, land, ground_box;
  vec4 water, target, lens, shading, clip;
};
)";

const char* const kNoise = R"(
// Hash of a lattice point to 0..1 by integer mixing, the same on every driver.
float hash(ivec2 p) {
  uint h = uint(p.x) * 0x8da6b343u ^ uint(p.y) * 0xd8163841u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return float((h ^ (h >> 15)) & 0xffffffu) / 16777215.0;
}
float noise(vec2 p) {
  vec2 cell = floor(p), f = p - cell;
  ivec2 i = ivec2(cell);
  f = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  return mix(mix(hash(i), hash(i + ivec2(1, 0)), f.x), mix(hash(i + ivec2(0, 1)), hash(i + ivec2(1, 1)), f.x), f.y);
}
float layered_noise(vec2 p) {
  float sum = 0.0, weight = 0.5;
  for (int i = 0; i < 5; ++i) {
    sum += weight * noise(p);
    p = mat2(1.6, 1.2, -1.2, 1.6) * p + 17.3;
    weight *= 0.5;
  }
  return sum / 0.96875;
}
)";

const char* const kLight = R"(
#ifndef SHADOW_TAPS
#define SHADOW_TAPS 16
#endif
uniform sampler2DArrayShadow shadow_map;
uniform sampler2D sky_map, cover_map;
const float pi = 3.14159265;

// Irradiance from all around but the sun itself (Ramamoorthi and Hanrahan 2001).
vec3 ambient_light(vec3 n) {
  vec3 e = ambient[0].rgb * 0.282095 + ambient[1].rgb * (0.488603 * n.y) + ambient[2].rgb * (0.488603 * n.z) +
           ambient[3].rgb * (0.488603 * n.x) + ambient[4].rgb * (1.092548 * n.x * n.y) +
           ambient[5].rgb * (1.092548 * n.y * n.z) + ambient[6].rgb * (0.315392 * (3.0 * n.z * n.z - 1.0)) +
           ambient[7].rgb * (1.092548 * n.x * n.z) + ambient[8].rgb * (0.546274 * (n.x * n.x - n.y * n.y));
  return max(e, vec3(0.0));
}

// Radiance of the clear sky; the table of render/atmosphere.h.
vec3 clear_sky(vec3 direction) {
  float elevation = asin(clamp(direction.y, 0.0, 1.0));
  float both = length(direction.xz) * length(to_sun.xz);
  float azimuth = both > 1e-6 ? acos(clamp(dot(direction.xz, to_sun.xz) / both, -1.0, 1.0)) : 0.0;
  return texture(sky_map, vec2(sqrt(azimuth / pi), sqrt(elevation * 2.0 / pi))).rgb * gain.rgb;
}

// Brightness that film and eye still tell apart around the sun: light above `knee` is pressed below knee + room.
vec3 pressed(vec3 light, float knee, float room) {
  float bright = dot(light, vec3(0.2126, 0.7152, 0.0722)), over = max(bright - knee, 0.0);
  return light * ((min(bright, knee) + over / (1.0 + over / room)) / max(bright, 1e-5));
}

// Colour of distant air in a direction.
vec3 haze_colour(vec3 direction) {
  return pressed(clear_sky(normalize(vec3(direction.x, max(direction.y, 0.03), direction.z))), 0.35, 0.5);
}
vec3 through_air(vec3 colour, vec3 direction, float distance_m) {
  return mix(haze_colour(direction), colour, exp(-distance_m * air.x));
}

// Share of the sky that a point sees past what stands overhead (Cantelli's inequality on blurred heights).
float higher_share(vec2 moments, float y) {
  float d = moments.x - y;
  if (d <= 0.0) return 0.0;
  float least = 0.25 * over_height.y;
  float variance = max(moments.y - moments.x * moments.x, least * least);
  return d * d / (variance + d * d);
}
float open_sky(vec3 world) {
  vec4 moments = texture(cover_map, (world.xz - over_area.xy) * over_area.zw);
  float y = (world.y + 0.15 - over_height.x) * over_height.y;
  return 1.0 - 0.5 * (higher_share(moments.xy, y) + higher_share(moments.zw, y));
}

// Sixteen points evenly over a disc (Vogel's spiral), the same for every pixel: no grain.
const vec2 disc[16] = vec2[16](
  vec2(0.177, 0.0), vec2(-0.226, 0.207), vec2(0.035, -0.394), vec2(0.285, 0.371),
  vec2(-0.522, -0.092), vec2(0.494, -0.314), vec2(-0.165, 0.615), vec2(-0.315, -0.608),
  vec2(0.685, 0.250), vec2(-0.712, 0.294), vec2(0.343, -0.733), vec2(0.253, 0.809),
  vec2(-0.764, -0.443), vec2(0.897, -0.197), vec2(-0.548, 0.778), vec2(-0.125, -0.976));

float lit_by_cascade(int c, vec3 relative, vec3 normal, float widen) {
  float texel = cascade_texel[c];
  float slope = 1.0 - abs(dot(normal, to_sun.xyz));
  vec3 lifted = relative + normal * (texel * (0.6 + 1.4 * slope)) + to_sun.xyz * (texel * 1.0 + 0.01);
  vec3 p = (relative_to_shadow[c] * vec4(lifted, 1.0)).xyz * 0.5 + 0.5;
  if (any(greaterThan(abs(p.xy - 0.5), vec2(0.5)))) return 1.0;
  p.z = clamp(p.z, 0.0, 0.99999);  // what lies beyond the map is in nobody's shade
  // A penumbra of some 10 cm, at least a texel and a half so that the map's steps do not show.
  float size = 1.0 / float(textureSize(shadow_map, 0).x);
  vec2 radius = vec2(size * clamp(widen / texel, 1.5, 5.0));
  float lit = 0.0;
  for (int i = 0; i < SHADOW_TAPS; ++i) lit += texture(shadow_map, vec4(p.xy + disc[i] * radius, float(c), p.z));
  return lit / float(SHADOW_TAPS);
}

// Share of the sun that a point sees. `normal` faces the sun's side.
float sunlit(vec3 relative, vec3 normal, float widen) {
  int count = int(cascade_far.w);
  if (count == 0) return 1.0;
  float depth = dot(relative, forward.xyz);
  int c = 0;
  while (c + 1 < count && depth > cascade_far[c]) ++c;
  float lit = lit_by_cascade(c, relative, normal, widen);
  // The last tenth of a cascade fades into the next.
  if (c + 1 < count) {
    float begin = c > 0 ? cascade_far[c - 1] : 0.0;
    float fade = smoothstep(0.9, 1.0, (depth - begin) / (cascade_far[c] - begin));
    if (fade > 0.0) lit = mix(lit, lit_by_cascade(c + 1, relative, normal, widen), fade);
  }
  return lit;
}

// Tone curve of Lottes 2016 on channels mixed a little, so that bright colours pale as film does.
vec3 tone_mapped(vec3 c) {
  const float mixed = 0.05, apart = 0.055;
  c = mix(c, vec3(c.r + c.g + c.b) / 3.0, mixed * 1.5);
  vec3 z = pow(max(c, vec3(0.0)), vec3(tone.x));
  c = z / (pow(z, vec3(tone.y)) * tone.z + tone.w);
  c = mix(c, vec3(c.r + c.g + c.b) / 3.0, -apart * 1.5);
  return clamp(c, 0.0, 1.0);
}
vec3 encoded(vec3 light) { return air.w > 0.5 ? tone_mapped(light) : min(light, vec3(60.0)); }
)";

}  // namespace bosquet::render
