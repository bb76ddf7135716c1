#include "render/shaders.h"

#include <array>

namespace bosquet::render {
namespace {

// ---- shared by all ------------------------------------------------------------------------------------------------

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
  for (int i = 0; i < 16; ++i) lit += texture(shadow_map, vec4(p.xy + disc[i] * radius, float(c), p.z));
  return lit * 0.0625;
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

// ---- geometry -----------------------------------------------------------------------------------------------------

const char* const kMeshVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
uniform vec3 offset;  // of the node, relative to the eye
invariant gl_Position;
out vec3 v_relative, v_normal, v_colour;
out vec2 v_uv;
void main() {
  v_relative = position + offset;
  v_normal = normal.xyz;
  v_uv = uv;
  v_colour = colour.rgb;
  gl_Position = relative_to_clip * vec4(v_relative, 1.0);
  gl_ClipDistance[0] = dot(clip, vec4(v_relative, 1.0));
}
)";

const char* const kGround = R"(
// A tiling texture at two scales, turned against each other so that it does not seem to repeat.
vec3 ground_texture(sampler2D map, vec2 uv) {
  vec3 seen = mix(texture(map, uv).rgb, texture(map, mat2(0.259, 0.143, -0.143, 0.259) * uv + 0.37).rgb, 0.45);
  // From far away a field of tiles would show as a grid: its mean takes over.
  float tiles_per_pixel = max(length(dFdx(uv)), length(dFdy(uv)));
  return mix(seen, textureLod(map, uv, 16.0).rgb, 0.9 * smoothstep(0.02, 0.15, tiles_per_pixel));
}
// Tufts stand above what is between them; without their own shapes, by light and shade, gone with distance.
vec3 tufts(vec2 p, float distance_m) {
  float near = exp(-distance_m / 22.0);
  if (near < 0.02) return vec3(1.0);
  float clump = noise(p / 0.33) * 0.6 + noise(mat2(0.8, 0.6, -0.6, 0.8) * p / 0.11) * 0.4;
  float dry = noise(p / 1.3 + 71.0);
  vec3 shade = vec3(mix(0.66, 1.3, smoothstep(0.2, 0.8, clump)));
  shade *= mix(vec3(1.0), vec3(1.16, 1.04, 0.84), smoothstep(0.55, 0.95, dry));
  return mix(vec3(1.0), shade, near);
}
// Ground is never even: drier and lusher patches over many metres.
vec3 ground_patches(vec2 p) {
  float wide = layered_noise(p / 38.0) - 0.5, near = layered_noise(p / 7.0 + 31.0) - 0.5;
  return (1.0 + 0.28 * wide + 0.20 * near) *
         mix(vec3(1.06, 1.0, 0.88), vec3(0.95, 1.01, 0.98), clamp(0.5 + 1.4 * wide + 0.6 * near, 0.0, 1.0));
}
)";

const char* const kMeshFragment = R"(
in vec3 v_relative, v_normal, v_colour;
in vec2 v_uv;
uniform sampler2D colour_map, normal_map;
uniform vec4 base_factor;
uniform vec4 material;  // roughness, alpha cutoff, translucency, 1 if double sided (leaves: if it shows whole trees)
uniform vec2 maps;      // 1 if there is a base colour, a normal map
out vec4 out_colour;

// The surface's normal bent by the normal map; the tangent frame comes from how position and uv change over the
// screen (Mikkelsen 2010), so meshes need no tangents.
vec3 bent_normal(vec3 n, vec2 uv) {
  if (maps.y < 0.5) return n;
  vec3 px = dFdx(v_relative), py = dFdy(v_relative);
  vec2 tx = dFdx(uv), ty = dFdy(uv);
  vec3 across_y = cross(py, n), across_x = cross(n, px);
  vec3 t = across_y * tx.x + across_x * ty.x;
  // uv grows downward in the image, the map's y upward.
  vec3 b = -(across_y * tx.y + across_x * ty.y);
  float scale = max(dot(t, t), dot(b, b));
  if (scale < 1e-20) return n;
  vec3 m = texture(normal_map, uv).xyz * 2.0 - 1.0;
  return normalize(mat3(t * inversesqrt(scale), b * inversesqrt(scale), n) * m);
}

// Specular light of the sun (GGX, Smith as Hammon 2017); F0 of plants and stone.
float gloss(vec3 n, vec3 v, float roughness) {
  vec3 h = normalize(v + to_sun.xyz);
  float nl = max(dot(n, to_sun.xyz), 0.0), nv = max(abs(dot(n, v)), 0.05), nh = max(dot(n, h), 0.0);
  float a = roughness * roughness, a2 = a * a;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(v, h), 0.0), 5.0);
  return fresnel * a2 / (pi * d * d) * nl / (2.0 * mix(2.0 * nl * nv, nl + nv, a) + 1e-4);
}
)";

const char* const kSolidMain = R"(
void main() {
  vec4 texel = maps.x > 0.5 ? texture(colour_map, v_uv) : vec4(1.0);
  vec3 albedo = texel.rgb * base_factor.rgb * v_colour;
  if (shading.x > 1.5) { out_colour = vec4(0.0, 0.0, 0.0, 1.0); return; }
  if (shading.x > 0.5) { out_colour = vec4(albedo, 1.0); return; }
  vec3 to_eye = view_point.xyz - v_relative;
  float distance_m = length(to_eye);
  vec3 v = view_point.w > 0.5 ? -forward.xyz : to_eye / distance_m;
  vec3 surface = normalize(v_normal);
  if (material.w > 0.5 && !gl_FrontFacing) surface = -surface;
  vec3 n = bent_normal(surface, v_uv);
  float nl = dot(n, to_sun.xyz);
  float lit = dot(surface, to_sun.xyz) > 0.0 && nl > 0.0 ? sunlit(v_relative, surface, 0.10) : 0.0;
  float open = mix(0.36, 1.0, open_sky(v_relative + eye.xyz));
  vec3 light = albedo / pi * (sun_light.rgb * (lit * max(nl, 0.0)) + ambient_light(n) * open);
  light += sun_light.rgb * (lit * gloss(n, v, material.x));
  out_colour = vec4(encoded(through_air(light, -v, distance_m)), 1.0);
}
)";

// Leaves are drawn twice: depth alone where they cover, then light where that depth is met, so that of the many layers
// of a crown only what is seen is shaded.
const char* const kLeafCover = R"(
in vec2 v_uv;
uniform sampler2D colour_map;
uniform vec4 base_factor;
uniform vec4 material;
uniform vec2 maps;
out vec4 out_colour;
// Alpha sharpened around the cutoff to an edge one pixel wide.
float covered(float alpha) {
  return clamp((alpha - material.y) / max(fwidth(alpha), 1e-3) + 0.5, 0.0, 1.0);
}
void main() {
  float texel = maps.x > 0.5 ? texture(colour_map, v_uv).a : 1.0;
  float cover = material.y > 0.0 ? covered(texel * base_factor.a) : 1.0;
  // The hardware rounds coverage up; taking half a step off rounds it to the nearest.
  float alpha = cover >= 1.0 ? 1.0 : cover - 0.5 / max(shading.y, 1.0);
  if (alpha <= 0.0) discard;
  out_colour = vec4(0.0, 0.0, 0.0, alpha);
}
)";

const char* const kLeafMain = R"(
void main() {
  vec4 texel = maps.x > 0.5 ? texture(colour_map, v_uv) : vec4(1.0);
  vec3 albedo = texel.rgb * base_factor.rgb * v_colour;
  if (shading.x > 1.5) { out_colour = vec4(0.0, 0.0, 0.0, 1.0); return; }
  if (shading.x > 0.5) { out_colour = vec4(albedo, 1.0); return; }
  vec3 to_eye = view_point.xyz - v_relative;
  float distance_m = length(to_eye);
  vec3 v = view_point.w > 0.5 ? -forward.xyz : to_eye / distance_m;
  vec3 surface = normalize(v_normal);
  if (!gl_FrontFacing) surface = -surface;
  vec3 n = bent_normal(surface, v_uv);
  float nl = dot(n, to_sun.xyz);
  vec3 sunward = dot(surface, to_sun.xyz) > 0.0 ? surface : -surface;
  // The cards of a picture of a tree shade each other in stripes; its leaves would do so evenly.
  bool picture = material.w > 0.5;
  float lit = sunlit(picture ? v_relative + 10.0 * to_sun.xyz : v_relative, sunward, 0.12) * (picture ? 0.7 : 1.0);
  float open = mix(0.48, 1.0, open_sky(v_relative + eye.xyz));
  // Light that comes through a leaf is yellower: chlorophyll lets green and some red pass.
  vec3 through = pow(albedo, vec3(0.9)) * vec3(1.05, 1.0, 0.6) * material.z;
  vec3 kept = albedo * (1.0 - 0.35 * material.z);
  vec3 light = sun_light.rgb * lit * (kept * max(nl, 0.0) + through * max(-nl, 0.0));
  light += open * (kept * ambient_light(n) + 0.6 * through * ambient_light(-n));
  light /= pi;
  // A wax shine, gone where leaves become too small to be seen one by one.
  if (nl > 0.0) light += sun_light.rgb * (lit * 0.35 * min(gloss(n, v, max(material.x, 0.45)), 0.12) * exp(-distance_m / 40.0));
  out_colour = vec4(encoded(through_air(light, -v, distance_m)), 1.0);
}
)";

const char* const kGroundMain = R"(
void main() {
  vec3 world = v_relative + eye.xyz;
  vec3 texel = maps.x > 0.5 ? ground_texture(colour_map, v_uv) : vec3(1.0);
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
  albedo *= ground_patches(world.xz) * mix(vec3(1.0), tufts(world.xz, length(v_relative)), green);
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

const char* const kWater = R"(
uniform sampler2D ground_map, mirror_map;

float bed_height(vec2 p) { return texture(ground_map, (p - over_area.xy) * over_area.zw).r; }

// Slope of ripples: waves from a few directions, each left out where it is finer than a pixel; `lost` is the variance
// of slope that went with them.
vec2 ripple_slope(vec2 p, float pixel_m, out float lost) {
  const int count = 9;
  const vec2 heading[count] = vec2[count](vec2(0.94, 0.34), vec2(0.62, 0.78), vec2(0.99, -0.17), vec2(0.21, 0.98),
                                          vec2(0.80, -0.60), vec2(-0.34, 0.94), vec2(0.5, 0.866), vec2(0.97, 0.22),
                                          vec2(0.37, -0.93));
  const float wavelength[count] = float[count](2.3, 1.57, 1.13, 0.81, 0.53, 0.37, 0.26, 0.17, 0.12);
  // Gusts: patches of rougher and smoother water.
  float gust = 0.25 + 1.2 * layered_noise(p / 13.0);
  vec2 bend = vec2(noise(p / 2.9), noise(p / 2.9 + 57.0)) * 0.7;
  vec2 slope = vec2(0.0);
  lost = 0.0;
  for (int i = 0; i < count; ++i) {
    float k = 2.0 * pi / wavelength[i];
    float steep = 0.0085 * air.z * gust;
    float kept = clamp(wavelength[i] / (2.5 * pixel_m) - 0.5, 0.0, 1.0);
    slope += heading[i] * (steep * kept * cos(k * dot(heading[i], p + bend) + float(i) * 1.7));
    lost += steep * steep * 0.5 * (1.0 - kept * kept);
  }
  return slope;
}

// Light from the water's surface and body, and the share of what lies below that it hides. v points to the eye.
vec4 water_light(vec3 relative, vec3 v, float distance_m, float pixel_m) {
  vec3 world = relative + eye.xyz;
  float lost;
  vec2 slope = ripple_slope(world.xz, pixel_m, lost);
  vec3 n = normalize(vec3(-slope.x, 1.0, -slope.y));
  float nv = clamp(dot(n, v), 0.02, 1.0);
  float fresnel = 0.025 + 0.975 * pow(1.0 - nv, 5.0);

  // What it mirrors: the mirrored picture where there is one, shifted by the ripples, else the sky.
  vec3 r = reflect(-v, n);
  r.y = abs(r.y);
  // Water that no mirrored picture was drawn for sees banks and trees low down, sky above.
  vec3 banks = vec3(0.050, 0.062, 0.030) / pi * (sky_light.rgb + 0.4 * sun_light.rgb);
  vec3 mirrored = mix(banks, clear_sky(r), smoothstep(0.05, 0.35, r.y));
  if (water.z > 0.5 && abs(world.y - water.w) < 0.02) {
    // A tilt by s moves the mirror image by about 2 s of the distance of what is mirrored, here some 10 m behind.
    vec2 right = normalize(ray_right.xz + 1e-6);
    vec2 side = vec2(0.6 * dot(slope, right), dot(slope, vec2(right.y, -right.x)));
    float shift = 2.0 * 10.0 / (distance_m + 10.0);
    vec2 at = (gl_FragCoord.xy + target.zw) / target.xy + vec2(side.x, -side.y) * shift * 0.5 / lens.xy;
    mirrored = texture(mirror_map, clamp(at, 0.002, 0.998)).rgb;
  }

  // Below: light fades with the way through the water, murky green takes its place.
  float depth_m = max(world.y - bed_height(world.xz), 0.0);
  float way = depth_m / max(0.35, sqrt(1.0 - (1.0 - nv * nv) / 1.77)) + depth_m;
  vec3 passed = exp(-way * vec3(2.2, 1.3, 1.6));
  float lit = sunlit(relative, vec3(0.0, 1.0, 0.0), 0.4);
  float open = mix(0.4, 1.0, open_sky(world));
  vec3 murk = vec3(0.030, 0.044, 0.034) / pi *
              (sky_light.rgb * open + sun_light.rgb * (max(to_sun.y, 0.0) * mix(0.4, 1.0, lit)));

  // The sun's path on the water, spread by ripples too fine to see.
  vec3 h = normalize(v + to_sun.xyz);
  float a2 = 0.0009 + 2.0 * lost;
  float nh = max(dot(n, h), 0.0), d = nh * nh * (a2 - 1.0) + 1.0;
  vec3 glint = sun_light.rgb * (lit * min(fresnel * a2 / (pi * d * d) * 0.25 / nv, 2.0));

  float seen = dot(passed, vec3(0.35, 0.45, 0.20)) * (1.0 - fresnel);
  vec3 light = fresnel * mirrored + (1.0 - fresnel) * (vec3(1.0) - passed) * murk + glint;
  // Shallow water at the very edge is clear, so that the shore has no hard line.
  float hides = (1.0 - seen) * smoothstep(0.0, 0.06, depth_m);
  return vec4(through_air(light / max(1.0 - seen, 0.05), -v, distance_m), hides);
}
)";

const char* const kWaterMain = R"(
void main() {
  if (shading.x > 1.5) { out_colour = vec4(0.0, 0.0, 0.0, 1.0); return; }
  if (shading.x > 0.5) { out_colour = vec4(base_factor.rgb * v_colour, 1.0); return; }
  vec3 to_eye = view_point.xyz - v_relative;
  float distance_m = length(to_eye);
  vec3 v = view_point.w > 0.5 ? -forward.xyz : to_eye / distance_m;
  vec4 seen = water_light(v_relative, v, distance_m, max(length(dFdx(v_relative.xz)), length(dFdy(v_relative.xz))));
  out_colour = vec4(encoded(seen.rgb) * seen.a, seen.a);
}
)";

// ---- sky ----------------------------------------------------------------------------------------------------------

const char* const kSkyVertex = R"(
out vec2 v_screen;
void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  v_screen = p;
  gl_Position = vec4(p, 1.0, 1.0);
  gl_ClipDistance[0] = 1.0;
}
)";

const char* const kSkyFragment = R"(
in vec2 v_screen;
uniform sampler2D colour_map;
uniform vec2 maps;  // 1 if the ground has a texture, tiles per metre
out vec4 out_colour;

vec3 sky(vec3 d) {
  vec3 light = clear_sky(d);
  // Thin high cloud on a flat layer, whiter toward the sun, thinning out at the horizon.
  if (air.y > 0.0 && d.y > 0.0) {
    vec2 p = d.xz / (d.y + 0.10);
    vec2 drift = vec2(layered_noise(p * 0.7 + 3.0), layered_noise(p * 0.7 + 71.0)) - 0.5;
    // Long streaks of fine fibres, gathered in fields.
    vec2 q = mat2(0.91, 0.41, -0.41, 0.91) * p + 1.1 * drift;
    float field = layered_noise(p * 0.45 + 13.0), fibres = layered_noise(q * vec2(1.1, 4.6) + 2.2 * drift);
    float density = 0.55 * field + 0.30 * fibres + 0.15 * layered_noise(q * vec2(7.0, 19.0));
    float cover = smoothstep(0.70 - 0.45 * air.y, 0.92 - 0.30 * air.y, density) * smoothstep(0.0, 0.25, d.y) * 0.8;
    float nu = max(dot(d, to_sun.xyz), 0.0);
    vec3 cloud = sky_light.rgb * 0.30 + sun_light.rgb * (0.045 + 0.10 * pow(nu, 8.0));
    light = mix(light, cloud, cover);
  }
  // The sun's disc, a little larger than true, with a soft rim and a glow.
  float nu = dot(d, to_sun.xyz);
  light += sun_light.rgb * (smoothstep(0.99992, 0.99997, nu) * 40.0 + 0.25 * pow(max(nu, 0.0), 900.0));
  return light;
}

// A belt of woods far away: share of a pixel it fills, its crowns' tops by noise along the horizon.
float woods(vec2 heading, float climb, float far_m, float least_m, float most_m, float seed) {
  float along = atan(heading.y, heading.x) * far_m;
  float tops = layered_noise(vec2(along / 170.0, seed)) * 0.65 + layered_noise(vec2(along / 13.0, seed + 9.0)) * 0.35;
  float edge = (over_height.z - eye.y + mix(least_m, most_m, tops)) / far_m;
  return 1.0 - smoothstep(-0.7, 0.7, (climb - edge) / max(fwidth(climb), 1e-5));
}

void main() {
  vec3 across = ray_right.xyz * v_screen.x + ray_up.xyz * v_screen.y;
  bool parallel = view_point.w > 0.5;
  vec3 origin = parallel ? view_point.xyz + across : vec3(0.0);
  vec3 d = normalize(parallel ? ray_forward.xyz : ray_forward.xyz + across);
  bool mirrored = forward.w > 0.5, surrounded = over_height.w > 0.5;
  // The picture's sky is printed lighter than it is, as with a graduated filter on the land.
  vec3 light = d.y >= 0.0 ? pressed(sky(d) * 1.1, 0.7, 2.0) : haze_colour(d);

  // Plain land to the horizon; the mirrored pass looks up only.
  float t = 1e9;
  if (surrounded && !mirrored && d.y < 0.0) {
    float above = origin.y + eye.y - over_height.z;
    t = above > 0.0 ? above / -d.y : 0.0;
    vec3 p = origin + d * t, world = p + eye.xyz;
    float fields = layered_noise(world.xz / 310.0 + 5.0) - 0.5;
    vec3 albedo = land.rgb * (maps.x > 0.5 ? ground_texture(colour_map, world.xz * maps.y) : vec3(1.0));
    albedo *= mix(vec3(1.0), ground_patches(world.xz), exp(-t / 300.0)) * (1.0 + 0.5 * fields * exp(-t / 3000.0));
    // Shadows fall on it as on the site's edge next to it, so that they go on unbroken.
    vec3 edge = vec3(p.x, max(p.y, bed_height(world.xz) - eye.y + 0.1), p.z);
    float lit = sunlit(edge, vec3(0.0, 1.0, 0.0), 0.14);
    float open = mix(0.36, 1.0, open_sky(world));
    light = albedo / pi * (sun_light.rgb * (lit * max(to_sun.y, 0.0)) + sky_light.rgb * open);
    light = through_air(light, d, t);
    // A river flows on beyond the site.
    float down = eye.y + origin.y - water.x;
    if (water.y > 0.5 && down > 0.0) {
      float far = down / -d.y;
      vec3 q = origin + d * far;
      if (bed_height(q.xz + eye.xz) < water.x) {
        float pixel_m = far * 2.0 * lens.y / target.y / max(-d.y, 0.02);
        vec4 seen = water_light(q, -d, far, pixel_m);
        light = mix(light, seen.rgb, seen.a);
      }
    }
  }

  // Woods beyond the site, two belts deep.
  float level = length(d.xz), near_m = land.w;
  if (surrounded && !parallel && level > 0.2) {
    vec2 heading = d.xz / level;
    float climb = d.y / level;
    vec3 crowns = vec3(0.060, 0.078, 0.036) / pi * (sun_light.rgb * (0.45 + 0.25 * dot(-heading, to_sun.xz)) + sky_light.rgb);
    for (int belt = 1; belt >= 0; --belt) {
      float far_m = belt == 1 ? near_m * 2.6 : near_m;
      float fill = t > far_m ? woods(heading, climb, far_m, belt == 1 ? 14.0 : 3.0, belt == 1 ? 70.0 : 24.0, 3.0 + 20.0 * float(belt)) : 0.0;
      // They are painted standing: seen from high above they would be a wall, so they are left out there.
      fill *= 1.0 - smoothstep(0.02, 0.05, (eye.y - over_height.z) / far_m);
      light = mix(light, through_air(crowns, d, far_m * 1.3), fill);
    }
  }
  // Half a step of noise keeps the even sky from breaking into bands of 8 bits.
  vec3 shown = encoded(light);
  if (air.w > 0.5) shown += pow(shown, vec3(0.55)) * ((hash(ivec2(gl_FragCoord.xy + target.zw)) - 0.5) * 2.2 / 255.0);
  out_colour = vec4(shown, 1.0);
}
)";

// ---- shadows ------------------------------------------------------------------------------------------------------

const char* const kShadowVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 uv;
uniform vec3 offset;
uniform mat4 to_map;
out vec2 v_uv;
void main() {
  v_uv = uv;
  gl_Position = to_map * vec4(position + offset, 1.0);
  // Casters nearer to the sun than the map begins still cast.
  gl_Position.z = max(gl_Position.z, -gl_Position.w);
}
)";

const char* const kShadowSolid = R"(#version 330 core
void main() {}
)";

const char* const kShadowLeaf = R"(#version 330 core
in vec2 v_uv;
uniform sampler2D colour_map;
uniform vec4 base_factor;
uniform vec4 material;
void main() {
  if (texture(colour_map, v_uv).a * base_factor.a < material.y) discard;
}
)";

GLuint compile(GLenum kind, const std::string& source, std::string& log) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  std::array<char, 2048> buffer{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(buffer.size()), nullptr, buffer.data());
  log = buffer.data();
  glDeleteShader(shader);
  return 0;
}

}  // namespace

Result<Program> Program::make(const std::string& name, const std::string& vertex, const std::string& fragment) {
  std::string log;
  const auto fail = [&](const char* what) {
    return cannot_finish("the graphics driver (" +
                         std::string(reinterpret_cast<const char*>(glGetString(GL_RENDERER))) + ") does not " + what +
                         " the shader \"" + name + "\": " + log);
  };
  const GLuint v = compile(GL_VERTEX_SHADER, vertex, log);
  if (!v) return fail("compile");
  const GLuint f = compile(GL_FRAGMENT_SHADER, fragment, log);
  if (!f) {
    glDeleteShader(v);
    return fail("compile");
  }
  Program program;
  program.name_ = glCreateProgram();
  glAttachShader(program.name_, v);
  glAttachShader(program.name_, f);
  glLinkProgram(program.name_);
  glDeleteShader(v);
  glDeleteShader(f);
  GLint good = 0;
  glGetProgramiv(program.name_, GL_LINK_STATUS, &good);
  if (!good) {
    std::array<char, 2048> buffer{};
    glGetProgramInfoLog(program.name_, static_cast<GLsizei>(buffer.size()), nullptr, buffer.data());
    log = buffer.data();
    return fail("link");
  }

  // Block and texture units never change.
  const GLuint block = glGetUniformBlockIndex(program.name_, "Frame");
  if (block != GL_INVALID_INDEX) glUniformBlockBinding(program.name_, block, 0);
  glUseProgram(program.name_);
  const std::pair<const char*, GLint> units[] = {
      {"colour_map", kUnitColour}, {"normal_map", kUnitNormal}, {"shadow_map", kUnitShadow}, {"sky_map", kUnitSky},
      {"cover_map", kUnitCover},   {"ground_map", kUnitGround}, {"mirror_map", kUnitMirror}};
  for (const auto& [sampler, unit] : units)
    if (const GLint at = program.uniform(sampler); at >= 0) glUniform1i(at, unit);
  glUseProgram(0);
  return program;
}

Result<Programs> Programs::make() {
  const std::string frame = kFrame, shared = frame + kNoise + kGround + kLight;
  const std::string vertex = frame + kMeshVertex, fragment = shared + kMeshFragment;
  const std::string shadow = std::string("#version 330 core\n") + kShadowVertex;
  Programs programs;
  struct Source {
    Program Programs::*program;
    const char* name;
    std::string vertex, fragment;
  };
  const Source sources[] = {{&Programs::solid, "solid", vertex, fragment + kSolidMain},
                            {&Programs::leaf_cover, "leaf cover", vertex, frame + kLeafCover},
                            {&Programs::leaf, "leaf", vertex, fragment + kLeafMain},
                            {&Programs::ground, "ground", vertex, fragment + kGroundMain},
                            {&Programs::water, "water", vertex, fragment + kWater + kWaterMain},
                            {&Programs::sky, "sky", frame + kSkyVertex, shared + kWater + kSkyFragment},
                            {&Programs::shadow_solid, "shadow", shadow, kShadowSolid},
                            {&Programs::shadow_leaf, "leaf shadow", shadow, kShadowLeaf}};
  for (const Source& source : sources) {
    Result<Program> made = Program::make(source.name, source.vertex, source.fragment);
    if (!made) return made.error();
    programs.*source.program = std::move(*made);
  }
  return programs;
}

}  // namespace bosquet::render
