// Wet organ: light that enters comes out reddened and spread around the edge of the shade; a film of water mirrors.
in vec3 p_W;
in vec3 n_W;
in vec3 rest;
in float openness;
uniform sampler3D pattern;   // rgb: gradient (0.5 is none), a: value of a smooth noise
uniform vec3 material_colour;
uniform float material_roughness;
out vec4 colour;

// Sizes of the pattern's period, m: mottling of the parenchyma, and the fine grain of the capsule.
const float mottle_period = 0.062;
const float grain_period = 0.0135;

// Light through tissue: how far it creeps around the terminator; red goes furthest (mean free path in liver).
const vec3 creep = vec3(0.26, 0.10, 0.08);

vec3 wrapped(float n_dot_l) {
  vec3 w = clamp((vec3(n_dot_l) + creep) / (1.0 + creep), 0.0, 1.0);
  return w * w * (1.0 + 0.35 * (1.0 - w)) ;
}

void main() {
  vec4 mottle = texture(pattern, rest / mottle_period);
  vec4 fine = texture(pattern, rest / grain_period);
  vec3 v = normalize(eye - p_W);
  vec3 n0 = normalize(n_W);
  // the relief fades with distance, where it would only flicker
  float near = clamp(unit_length * 5.0 / distance(eye, p_W), 0.0, 1.0);
  vec3 slope = (mottle.rgb - 0.5) * 0.20 + (fine.rgb - 0.5) * 0.13 * near;
  vec3 n = normalize(n0 - (slope - n0 * dot(slope, n0)));
  vec3 n_soft = normalize(mix(n0, n, 0.3));

  // colour: darker, bluer spots where blood stands, paler between the lobules
  float spot = (mottle.a - 0.5) * 1.7 + (fine.a - 0.5) * 0.8;
  vec3 albedo = material_colour * (1.0 + 0.38 * spot);
  albedo = mix(albedo, albedo * vec3(0.78, 0.74, 1.15), clamp(-spot, 0.0, 1.0));

  // shadows on tissue are red, not grey: light enters beside them
  float shade = lit(p_W, n0, dot(n0, towards_key));
  vec3 light = key_colour * wrapped(dot(n_soft, towards_key)) * mix(vec3(0.15, 0.04, 0.03), vec3(1.0), shade);
  float nv = clamp(dot(n_soft, v), 0.0, 1.0);
  float torch = clamp(unit_length * 3.2 / distance(eye, p_W), 0.0, 1.6);
  light += fill_colour * torch * nv;

  // ambient: cool from above, warm from the neighbouring tissue below; what a hollow keeps is redder
  float above = n_soft.z * 0.5 + 0.5;
  vec3 open = pow(vec3(openness), vec3(1.2, 2.0, 2.1));
  light += mix(vec3(0.11, 0.05, 0.042), vec3(0.22, 0.245, 0.28), above) * open;
  vec3 body = albedo * light * mix(vec3(1.0), open, 0.8);

  // the film of water: sharp glints of both lights and a mirror of the room, strongest at grazing angles
  vec3 f0 = vec3(0.028);
  float wet = material_roughness * (0.8 + 0.5 * mottle.a);
  vec3 glint = gloss(n, v, towards_key, wet, f0) * key_colour * pi * shade * 1.5;
  glint += gloss(n, v, v, wet, f0) * fill_colour * torch * pi * 1.3;
  glint *= openness;
  float grazing = pow(1.0 - nv, 5.0);
  vec3 mirror = room(reflect(-v, n), 0.25) * (0.045 + 0.75 * grazing) * openness * openness * mix(0.4, 1.0, shade);

  colour = vec4(film(body + glint + mirror), 1.0);
}
