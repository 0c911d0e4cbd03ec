// Drops of blood and the trails that they leave: thin at the rim, where tissue shines through a little, and wet.
in vec3 p_W;
in vec3 n_W;
in vec3 rest;  // x: how thick, 0 at the rim to 1
uniform vec3 material_colour;
uniform float material_roughness;
out vec4 colour;

const float thin_light = 1.35;  // of a rim against the middle: light comes back from the tissue below
const vec3 ambient = vec3(0.20, 0.17, 0.17);
const vec3 water_f0 = vec3(0.030);
const float key_glint = 1.4, fill_glint = 1.2, mirror_straight = 0.05, mirror_grazing = 0.6, mirror_blur = 0.15;

void main() {
  aim_key(p_W);
  vec3 v = normalize(eye - p_W), n = normalize(n_W);
  float nl = max(dot(n, towards_key), 0.0), nv = clamp(dot(n, v), 0.0, 1.0);
  float shade = lit(p_W, n, nl);
  vec3 body = material_colour * mix(thin_light, 1.0, rest.x) * (key_colour * nl * shade + fill_colour * nv + ambient);
  vec3 glint = gloss(n, v, towards_key, material_roughness, water_f0) * key_colour * pi * shade * key_glint;
  glint += gloss(n, v, v, material_roughness, water_f0) * fill_colour * pi * fill_glint;
  vec3 mirror = room(reflect(-v, n), mirror_blur) * (mirror_straight + mirror_grazing * pow(1.0 - nv, 5.0));
  colour = vec4(film(body + glint + mirror * mix(0.5, 1.0, shade)), 1.0);
}
