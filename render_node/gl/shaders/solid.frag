// Metal and plastic: the room mirrored, and the lights.
in vec3 p_W;
in vec3 n_W;
in vec3 rest;
in float openness;
uniform vec3 material_colour;
uniform float material_metalness;
uniform float material_roughness;
out vec4 colour;

const vec3 plastic_f0 = vec3(0.04);  // reflectance at normal incidence of a dielectric of index 1.5
// Light from all around: from below the warm tissue's, from above the room's.
const vec3 ambient_below = vec3(0.10, 0.06, 0.05), ambient_above = vec3(0.32, 0.35, 0.40);
const float metal_mirror = 1.5;                 // polished steel in a room that is brighter than its few lights
const float key_glint = 0.6, fill_glint = 0.5;  // of the lights' radiance: a shaft's glints must not burn out
const float fill_spread = 1.4;                  // the fill light is a ring around the lens, not a point

void main() {
  vec3 v = normalize(eye - p_W);
  vec3 n = normalize(n_W);
  vec3 f0 = mix(plastic_f0, material_colour, material_metalness);
  vec3 base = material_colour * (1.0 - material_metalness);
  float nl = max(dot(n, towards_key), 0.0), nv = clamp(dot(n, v), 0.0, 1.0);
  float shade = lit(p_W, n, nl);
  float above = n.z * 0.5 + 0.5;
  vec3 ambient = mix(ambient_below, ambient_above, above);
  vec3 body = base * (key_colour * nl * shade + fill_colour * nv + ambient);
  vec3 fresnel = f0 + (max(vec3(1.0 - material_roughness), f0) - f0) * pow(1.0 - nv, 5.0);
  vec3 mirror = room(reflect(-v, n), material_roughness) * fresnel * mix(1.0, metal_mirror, material_metalness);
  vec3 glint = gloss(n, v, towards_key, material_roughness, f0) * key_colour * pi * shade * key_glint;
  glint += gloss(n, v, v, material_roughness * fill_spread, f0) * fill_colour * pi * fill_glint;
  colour = vec4(film(body + mirror + glint), 1.0);
}
