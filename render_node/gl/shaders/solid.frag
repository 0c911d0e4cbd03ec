// Metal and plastic: the room mirrored, and the lights.
in vec3 p_W;
in vec3 n_W;
in vec3 rest;
in float openness;
uniform vec3 material_colour;
uniform float material_metalness;
uniform float material_roughness;
out vec4 colour;

void main() {
  vec3 v = normalize(eye - p_W);
  vec3 n = normalize(n_W);
  vec3 f0 = mix(vec3(0.04), material_colour, material_metalness);
  vec3 base = material_colour * (1.0 - material_metalness);
  float nl = max(dot(n, towards_key), 0.0), nv = clamp(dot(n, v), 0.0, 1.0);
  float shade = lit(p_W, n, nl);
  float above = n.z * 0.5 + 0.5;
  vec3 ambient = mix(vec3(0.10, 0.06, 0.05), vec3(0.32, 0.35, 0.40), above);
  vec3 body = base * (key_colour * nl * shade + fill_colour * nv + ambient);
  vec3 fresnel = f0 + (max(vec3(1.0 - material_roughness), f0) - f0) * pow(1.0 - nv, 5.0);
  vec3 mirror = room(reflect(-v, n), material_roughness) * fresnel * mix(1.0, 1.5, material_metalness);
  vec3 glint = gloss(n, v, towards_key, material_roughness, f0) * key_colour * pi * shade * 0.6;
  glint += gloss(n, v, v, material_roughness * 1.4, f0) * fill_colour * pi * 0.5;
  colour = vec4(film(body + mirror + glint), 1.0);
}
