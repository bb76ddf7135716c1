#include "render/shader_texts.h"

namespace bosquet::render {

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
    vec3 albedo = land.rgb * (maps.x > 0.5 ? ground_texture(colour_map, world.xz * maps.y, 0.45) : vec3(1.0));
    albedo *= mix(vec3(1.0), ground_patches(world.xz, 1.0), exp(-t / 300.0)) * (1.0 + 0.5 * fields * exp(-t / 3000.0));
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

}  // namespace bosquet::render
