// Shared by all fragment shaders: lights, shadow, the room that wet surfaces mirror, and the film.
// SOFT_SHADOWS is defined for fine frames (software OpenGL runs both sides of every branch), NO_SHADOWS for coarse ones,
// PER_VERTEX where a vertex shader computes light.
uniform vec3 eye;            // in W, m
uniform vec3 far_key;        // towards the key light, unit, in W
uniform vec3 lamp;           // of a scope, in W, m
uniform float lamp_reach;    // where it is as bright as the key light, m; 0: that is far away
uniform mat4 light_from_W;   // clip coordinates of the shadow map
uniform sampler2DShadow shadow_map;
uniform vec2 picture_size;   // pixels
uniform float middle;        // of the view, share of the width
uniform float scope;         // 1: seen through an endoscope, inside a body; 0: on a table
uniform float unit_length;   // radius of what is looked at, m

const float pi = 3.14159265;

// Radiance scale of the two lights, chosen so that lit tissue lands in the middle of the film's curve.
const vec3 key_radiance = vec3(3.45, 3.24, 2.97);
const vec3 fill_colour = vec3(0.46, 0.49, 0.52);

// A scope's light, of the key light's: it meets all that is seen head-on, so less is enough; at most so much brighter nearby (its
// camera dims it), and how it falls off towards the rim of its cone. Light from all around is what red tissue sends back.
const float lamp_share = 0.62, lamp_most = 2.4, lamp_cone = 1.5;
const vec3 ambient_in_body = vec3(0.62, 0.34, 0.28);

// The key light here: towards it, and its radiance. Every main() that is lit begins with aim_key().
vec3 towards_key = far_key, key_colour = key_radiance;
void aim_key(vec3 p_W) {
  if (lamp_reach == 0.0) return;
  vec3 to_lamp = lamp - p_W;
  float away = length(to_lamp);
  towards_key = to_lamp / away;
  float nearness = lamp_reach / away;
  key_colour *= lamp_share * min(nearness * nearness, lamp_most) * pow(max(dot(towards_key, far_key), 0.0), lamp_cone);
}

// The backdrop: how fast it falls off from behind the organ (per squared height of the picture), its height there, and
// its colours at the rim and in the middle, on a table and inside a body.
const float backdrop_fall = 7.0, backdrop_height = 0.52, widest_backdrop = 1.7;
const vec3 table_rim = vec3(0.0035, 0.0050, 0.0070), table_middle = vec3(0.030, 0.046, 0.058);
const vec3 cavity_rim = vec3(0.006, 0.0012, 0.001), cavity_middle = vec3(0.060, 0.014, 0.009);

const float exposure = 0.92;  // white of the film just above lit drape and below glints

// Shadows: how far a point is lifted along its normal, of unit_length (grazing light needs most: there a texel of the map
// covers the longest stretch of surface), the reach of soft edges (5 texels of the map's 1024: 1.5 mm on a liver) and the
// share of the map's half side from which they fade out.
const float lift_grazing = 0.022, lift_facing = 0.006;
const float soft_reach = 5.0 / 1024.0;
const int soft_points = 8;           // more are not told apart under the grain
const float golden_angle = 2.39996;  // rad: a sunflower's points never line up
const float shadow_fade = 0.75;

// The room as things mirror it: its floor and ceiling, the cosine at which the soft box around the key light and the strip
// beside it end, how much their edges widen from a polished to a matt mirror, their radiance, and how much dimmer and
// brighter the two sides of the room are.
const vec3 room_floor = vec3(0.085, 0.090, 0.092), room_ceiling = vec3(0.30, 0.33, 0.37);
const float box_edge = 0.86, strip_edge = 0.82, sharpest_edge = 0.04, softest_edge = 0.35;
const vec3 box_light = vec3(3.2, 3.1, 2.9), strip_light = vec3(0.9, 1.05, 1.25);
const float box_lost_to_blur = 0.6;  // the same light over a wider spot
const float strip_height = 0.45;     // of the strip's direction: about 24 degrees up
const float dim_side = 0.7, bright_side = 1.5;
const vec3 room_in_body = vec3(1.0, 0.62, 0.52);  // tissue all around reflects red

// A fixed pattern of 0..1 per pixel without visible structure (Jimenez 2014, interleaved gradient noise).
float grain(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

// The empty picture: dark, lighter behind the organ, darker in the corners.
vec3 backdrop(vec2 pixel) {
  vec2 p = pixel / picture_size - vec2(middle, backdrop_height);
  p.x *= min(picture_size.x / picture_size.y, widest_backdrop);
  float fall = 1.0 / (1.0 + backdrop_fall * dot(p, p));
  fall *= fall;
  return mix(mix(table_rim, table_middle, fall), mix(cavity_rim, cavity_middle, fall), scope);
}

// Linear light to display: a filmic curve (Narkowicz 2015, a fit of ACES), and the display's gamma (2: a square root is
// a tenth of a power's cost in software).
vec3 developed(vec3 x) {
  x *= exposure;
  return sqrt(clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0));
}

#ifndef PER_VERTEX
// The same with half a step of grain against banding.
vec3 film(vec3 x) { return developed(x) + (grain(gl_FragCoord.xy) - 0.5) / 255.0; }

// How much of the key light arrives. The point is moved along its normal against self-shadowing.
float lit(vec3 p_W, vec3 n, float n_dot_l) {
#ifdef NO_SHADOWS
  return 1.0;
#else
  vec3 q = p_W + n * unit_length * mix(lift_grazing, lift_facing, clamp(n_dot_l, 0.0, 1.0));
  vec4 in_light = light_from_W * vec4(q, 1.0);
  vec3 s = in_light.xyz / in_light.w * 0.5 + 0.5;
#ifdef SOFT_SHADOWS
  // the points of a sunflower disc, turned from pixel to pixel
  float turn = 2.0 * pi * grain(gl_FragCoord.xy);
  float sum = 0.0;
  for (int i = 0; i < soft_points; ++i) {
    float angle = turn + golden_angle * float(i);
    float radius = soft_reach * sqrt((float(i) + 0.5) / float(soft_points));
    sum += texture(shadow_map, vec3(s.xy + radius * vec2(cos(angle), sin(angle)), s.z));
  }
  float arrives = sum / float(soft_points);
#else
  float arrives = texture(shadow_map, s);
#endif
  // the map's edge is never seen: shadows fade out before it
  vec2 off = abs(s.xy - 0.5) * 2.0;
  return mix(arrives, 1.0, smoothstep(shadow_fade, 1.0, max(off.x, off.y)));
#endif
}
#endif

// The room as a smooth surface mirrors it: dark floor, dim walls, a wide soft box around the key light and a strip.
vec3 room(vec3 direction, float blur) {
  float height = direction.z * 0.5 + 0.5;
  vec3 walls = mix(room_floor, room_ceiling, smoothstep(0.2, 1.0, height));
  float edge = mix(sharpest_edge, softest_edge, blur);
  float key = smoothstep(box_edge - edge, box_edge + edge * 0.5, dot(direction, towards_key));
  vec3 side = normalize(vec3(-towards_key.y, towards_key.x, strip_height));
  // one side of the room is brighter: without that, a shaft would be an even grey
  walls *= mix(dim_side, bright_side, smoothstep(-0.5, 0.9, dot(direction, side)));
  float strip = smoothstep(strip_edge - edge, strip_edge + edge * 0.5, dot(direction, side));
  vec3 light = walls + key * box_light * (1.0 - box_lost_to_blur * blur) + strip * strip_light;
  return mix(light, light * room_in_body, scope);
}

// Reflection of one light by a rough dielectric or metal: GGX with Smith's visibility (Walter 2007).
vec3 gloss(vec3 n, vec3 v, vec3 l, float roughness, vec3 f0) {
  vec3 h = normalize(v + l);
  float a2 = roughness * roughness * roughness * roughness;
  float nh = max(dot(n, h), 0.0), nl = max(dot(n, l), 0.0), nv = max(dot(n, v), 1e-3);
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float k = 0.5 * roughness * roughness;
  float visibility = 0.25 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
  vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - clamp(dot(v, h), 0.0, 1.0), 5.0);
  return fresnel * (a2 / (pi * d * d)) * visibility * nl;
}
