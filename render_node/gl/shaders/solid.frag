// Metal and plastic: the room mirrored, and the lights.
in vec3 p_W;
in vec3 n_W;
in vec3 rest;
in float openness;
uniform vec3 material_colour;
uniform float material_metalness;
uniform float material_roughness;
uniform vec3 material_glow;
out vec4 colour;

const vec3 plastic_f0 = vec3(0.04);  // reflectance at normal incidence of a dielectric of index 1.5
// Light from all around: from below the warm tissue's, from above the room's.
const vec3 ambient_below = vec3(0.10, 0.06, 0.05), ambient_above = vec3(0.32, 0.35, 0.40);
const float metal_mirror = 1.5;                 // polished steel in a room that is brighter than its few lights
// What only metal shows of the room: a dark horizon, and a second strip of light across from the first one.
const float horizon_dark = 0.3, horizon_height = 0.30, far_strip_edge = 0.72, far_strip_soft = 0.22;
const float metal_walls = 0.7;  // what a brushed surface blurs away
const vec3 far_strip = vec3(1.35, 1.50, 1.70);
// And inside a body: lit tissue ahead of the scope, the dark behind it.
const vec3 tissue_ahead = vec3(0.58, 0.27, 0.23), dark_behind = vec3(0.045, 0.030, 0.028);
const float satin = 0.46;  // roughness of metal for the two lights: instruments are brushed against glare
const float key_glint = 0.6, fill_glint = 0.5;  // of the lights' radiance: a shaft's glints must not burn out
const float fill_spread = 1.4;                  // the fill light is a ring around the lens, not a point

vec3 around_metal(vec3 direction) {
  float ahead = smoothstep(-0.55, 0.75, -dot(direction, far_key));
  vec3 body = mix(dark_behind, tissue_ahead, ahead * ahead);
  vec3 across = normalize(vec3(towards_key.y, -towards_key.x, 0.2));
  vec3 table = room(direction, material_roughness) * mix(horizon_dark, 1.0, smoothstep(0.0, horizon_height, abs(direction.z)));
  table += far_strip * smoothstep(far_strip_edge, far_strip_edge + far_strip_soft, dot(direction, across));
  return mix(metal_walls * table, body, scope);
}

void main() {
  aim_key(p_W);
  vec3 v = normalize(eye - p_W);
  vec3 n = normalize(n_W);
  vec3 f0 = mix(plastic_f0, material_colour, material_metalness);
  vec3 base = material_colour * (1.0 - material_metalness);
  float nl = max(dot(n, towards_key), 0.0), nv = clamp(dot(n, v), 0.0, 1.0);
  float shade = lit(p_W, n, nl);
  float above = n.z * 0.5 + 0.5;
  vec3 ambient = mix(ambient_below, ambient_above, above) * mix(vec3(1.0), ambient_in_body, scope);
  vec3 body = base * (key_colour * nl * shade + fill_colour * nv + ambient);
  vec3 fresnel = f0 + (max(vec3(1.0 - material_roughness), f0) - f0) * pow(1.0 - nv, 5.0);
  vec3 mirrored = reflect(-v, n);
  vec3 mirror = material_metalness > 0.5 ? around_metal(mirrored) * metal_mirror : room(mirrored, material_roughness);
  mirror *= fresnel;
  float brushed = mix(material_roughness, max(material_roughness, satin), material_metalness);
  vec3 glint = gloss(n, v, towards_key, brushed, f0) * key_colour * pi * shade * key_glint;
  glint += gloss(n, v, v, brushed * fill_spread, f0) * fill_colour * pi * fill_glint;
  colour = vec4(film(body + mirror + glint + material_glow), 1.0);
}
