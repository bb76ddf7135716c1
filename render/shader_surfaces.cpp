#include "render/shader_texts.h"

namespace bosquet::render {

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

const char* const kMeshFragment = R"(
in vec3 v_relative, v_normal, v_colour;
in vec2 v_uv;
uniform sampler2D colour_map, normal_map;
uniform vec4 base_factor;
uniform vec4 material;  // roughness, alpha cutoff, translucency, 1 if double sided (leaves: if it shows whole trees; ground: -, -,
                        // patchiness, 1 if laid as a pattern)
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

// main() of what stands on the ground; lit_surface() and both_sides() differ between wood and leaves.
const char* const kSurfaceMain = R"(
void main() {
  vec4 texel = maps.x > 0.5 ? texture(colour_map, v_uv) : vec4(1.0);
  vec3 albedo = texel.rgb * base_factor.rgb * v_colour;
  if (shading.x > 1.5) { out_colour = vec4(0.0, 0.0, 0.0, 1.0); return; }
  if (shading.x > 0.5) { out_colour = vec4(albedo, 1.0); return; }
  vec3 to_eye = view_point.xyz - v_relative;
  float distance_m = length(to_eye);
  vec3 v = view_point.w > 0.5 ? -forward.xyz : to_eye / distance_m;
  vec3 surface = normalize(v_normal);
  if (both_sides() && !gl_FrontFacing) surface = -surface;
  vec3 light = lit_surface(albedo, surface, bent_normal(surface, v_uv), v, distance_m);
  out_colour = vec4(encoded(through_air(light, -v, distance_m)), 1.0);
}
)";

const char* const kSolid = R"(
bool both_sides() { return material.w > 0.5; }
vec3 lit_surface(vec3 albedo, vec3 surface, vec3 n, vec3 v, float distance_m) {
  float nl = dot(n, to_sun.xyz);
  float lit = dot(surface, to_sun.xyz) > 0.0 && nl > 0.0 ? sunlit(v_relative, surface, 0.10) : 0.0;
  float open = mix(0.36, 1.0, open_sky(v_relative + eye.xyz));
  vec3 light = albedo / pi * (sun_light.rgb * (lit * max(nl, 0.0)) + ambient_light(n) * open);
  return light + sun_light.rgb * (lit * gloss(n, v, material.x));
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

const char* const kLeaf = R"(
bool both_sides() { return true; }
vec3 lit_surface(vec3 albedo, vec3 surface, vec3 n, vec3 v, float distance_m) {
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
  return light;
}
)";

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

}  // namespace bosquet::render
