// Shared by all fragment shaders: lights, shadow, the room that wet surfaces mirror, and the film.
// SOFT_SHADOWS is defined for fine frames (software OpenGL runs both sides of every branch).
uniform vec3 eye;            // in W, m
uniform vec3 towards_key;    // unit, in W
uniform mat4 light_from_W;   // clip coordinates of the shadow map
uniform sampler2DShadow shadow_map;
uniform vec2 picture_size;   // pixels
uniform float middle;        // of the view, share of the width
uniform float scope;         // 1: seen through an endoscope, inside a body; 0: on a table
uniform float unit_length;   // radius of what is looked at, m

const float pi = 3.14159265;

// Radiance scale of the two lights, chosen so that lit tissue lands in the middle of the film's curve.
const vec3 key_colour = vec3(3.45, 3.24, 2.97);
const vec3 fill_colour = vec3(0.46, 0.49, 0.52);

// A fixed pattern of 0..1 per pixel without visible structure (Jimenez 2014, interleaved gradient noise).
float grain(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

// The empty picture: dark, lighter behind the organ, darker in the corners.
vec3 backdrop(vec2 pixel) {
  vec2 p = pixel / picture_size - vec2(middle, 0.52);
  p.x *= min(picture_size.x / picture_size.y, 1.7);
  float fall = 1.0 / (1.0 + 7.0 * dot(p, p));
  fall *= fall;
  vec3 table = mix(vec3(0.0035, 0.0050, 0.0070), vec3(0.030, 0.046, 0.058), fall);
  vec3 cavity = mix(vec3(0.006, 0.0012, 0.001), vec3(0.060, 0.014, 0.009), fall);
  return mix(table, cavity, scope);
}

// Linear light to display: a filmic curve (Narkowicz 2015, a fit of ACES), the display's gamma (2: a square root is
// a tenth of a power's cost in software), and half a step of grain against banding.
vec3 film(vec3 x) {
  x *= 0.92;
  x = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
  return sqrt(x) + (grain(gl_FragCoord.xy) - 0.5) / 255.0;
}

// How much of the key light arrives. The point is moved along its normal against self-shadowing.
float lit(vec3 p_W, vec3 n, float n_dot_l) {
  vec3 q = p_W + n * unit_length * mix(0.022, 0.006, clamp(n_dot_l, 0.0, 1.0));
  vec3 s = (light_from_W * vec4(q, 1.0)).xyz * 0.5 + 0.5;
#ifdef SOFT_SHADOWS
  // eight points of a sunflower disc, turned from pixel to pixel
  const float reach = 5.0 / 1024.0;
  float turn = 2.0 * pi * grain(gl_FragCoord.xy);
  float sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    float angle = turn + 2.39996 * float(i);
    sum += texture(shadow_map, vec3(s.xy + reach * sqrt((float(i) + 0.5) / 8.0) * vec2(cos(angle), sin(angle)), s.z));
  }
  float arrives = sum / 8.0;
#else
  float arrives = texture(shadow_map, s);
#endif
  // the map's edge is never seen: shadows fade out before it
  vec2 off = abs(s.xy - 0.5) * 2.0;
  return mix(arrives, 1.0, smoothstep(0.75, 1.0, max(off.x, off.y)));
}

// The room as a smooth surface mirrors it: dark floor, dim walls, a wide soft box around the key light and a strip.
vec3 room(vec3 direction, float blur) {
  float height = direction.z * 0.5 + 0.5;
  vec3 walls = mix(vec3(0.085, 0.090, 0.092), vec3(0.30, 0.33, 0.37), smoothstep(0.2, 1.0, height));
  float edge = mix(0.04, 0.35, blur);
  float key = smoothstep(0.86 - edge, 0.86 + edge * 0.5, dot(direction, towards_key));
  vec3 side = normalize(vec3(-towards_key.y, towards_key.x, 0.45));
  // one side of the room is brighter: without that, a shaft would be an even grey
  walls *= mix(0.7, 1.5, smoothstep(-0.5, 0.9, dot(direction, side)));
  float strip = smoothstep(0.82 - edge, 0.82 + edge * 0.5, dot(direction, side));
  vec3 light = walls + key * vec3(3.2, 3.1, 2.9) * (1.0 - 0.6 * blur) + strip * vec3(0.9, 1.05, 1.25);
  return mix(light, light * vec3(1.0, 0.62, 0.52), scope);
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
