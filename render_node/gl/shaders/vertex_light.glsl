// Light at a vertex, for frames that software OpenGL draws: a pixel is then a mixture of three colours. What the mesh can
// carry of the shaders that light each pixel: their colours, lamps and room, no shadow and no relief finer than its
// triangles. Before surface.vert; one of TISSUE, SOLID, GROUND, MAP, SIGNAL is defined, for TISSUE also what tissue.frag
// tells apart by.
uniform sampler3D pattern;
uniform vec3 material_colour;
uniform float material_metalness;
uniform float material_roughness;
uniform vec3 map_colours[5];
out vec3 seen;  // as the display shows it

struct Meeting {  // light and a surface
  vec3 n, v;      // unit
  float nl, nv;
};

#ifdef TISSUE
// As in tissue.frag; mottling by its value alone.
const float mottle_period = 0.062, grain_period = 0.0135;
const vec3 creep = vec3(0.26, 0.10, 0.08), blood_tint = vec3(0.78, 0.74, 1.15);
const vec3 ambient_below = vec3(0.11, 0.05, 0.042), ambient_above = vec3(0.22, 0.245, 0.28);
const float scattered = 0.35, hollow_share = 0.8, torch_sight = 3.2, torch_most = 1.6;
const float bloodless = 0.8;
const vec3 burnt_tint = vec3(0.030, 0.012, 0.007);
// Glints are wider than a vertex' share of the surface: narrower ones would jump from one to the next.
const float widest_film = 0.42;
#if defined(GUT) || defined(SHEET) || defined(WALL)
const float contrast = 0.20;
#else
const float contrast = 0.38;
#endif

struct Lit {
  vec3 body, shine;  // of an albedo of 1; whatever it is
};

vec3 bleached(vec3 albedo, float pale) { return mix(albedo, sqrt(albedo), bloodless * pale); }

vec3 albedo_of(vec3 at_rest, float charred, float pale) {
  float mottle = textureLod(pattern, at_rest / mottle_period, 0.0).a - 0.5;
  float fine = textureLod(pattern, at_rest / grain_period, 0.0).a - 0.5;
  float spot = 1.7 * mottle + 0.8 * fine;
  vec3 albedo = material_colour * (1.0 + contrast * spot);
  albedo = mix(albedo, albedo * blood_tint, clamp(-spot, 0.0, 1.0));
  albedo = bleached(albedo, pale);
#ifdef CUT
  albedo = mix(albedo, burnt_tint, 0.85 * smoothstep(0.5, 1.0, charred));
#endif
  return albedo;
}

Lit light_on(Meeting m, vec3 p, float open) {
  vec3 w = clamp((vec3(m.nl) + creep) / (1.0 + creep), 0.0, 1.0);
  float torch = clamp(unit_length * torch_sight / distance(eye, p), 0.0, torch_most);
  vec3 light = key_colour * w * w * (1.0 + scattered * (1.0 - w)) + fill_colour * torch * m.nv;
  vec3 kept = vec3(open, open * open, open * open);
  light += mix(ambient_below, ambient_above, m.n.z * 0.5 + 0.5) * kept * mix(vec3(1.0), ambient_in_body, scope);
  vec3 glint = gloss(m.n, m.v, towards_key, max(material_roughness, widest_film), vec3(0.028)) * key_colour;
  glint += gloss(m.n, m.v, m.v, max(material_roughness, widest_film), vec3(0.028)) * fill_colour * torch;
  float grazing = pow(1.0 - m.nv, 5.0);
  vec3 mirror = room(reflect(-m.v, m.n), 0.6) * (0.045 + 0.75 * grazing) * open * open;
  return Lit(light * mix(vec3(1.0), kept, hollow_share), glint * pi * open + mirror);
}
#endif

#ifdef SHEET
// Vessels are narrower than a triangle: a pixel chooses by `bent` and `width` (vertex_lit.frag) between `seen`, which is
// fat, and these.
out vec3 seen_film, seen_artery, seen_vein;
out vec2 bent;    // rest.xy, swayed
out float width;  // half of a vessel's

void light_vessels(Lit lit, vec3 at_rest, float pale) {
  seen_film = developed(bleached(film_tint, pale) * lit.body + lit.shine);
  seen_artery = developed(bleached(artery_tint, pale) * lit.body + lit.shine);
  seen_vein = developed(bleached(vein_tint, pale) * lit.body + lit.shine);
  vec2 sway = vec2(textureLod(pattern, sway_of(at_rest), 0.0).a, textureLod(pattern, sway_across(at_rest), 0.0).a);
  bent = at_rest.xy + meander_reach * (sway - 0.5);
  width = branch_width_at(at_rest.y);
}
#endif

#ifdef SOLID
uniform vec3 material_glow;

vec3 solid(Meeting m) {
  vec3 f0 = mix(vec3(0.04), material_colour, material_metalness);
  vec3 base = material_colour * (1.0 - material_metalness);
  vec3 ambient = mix(vec3(0.10, 0.06, 0.05), vec3(0.32, 0.35, 0.40), m.n.z * 0.5 + 0.5);
  vec3 body = base * (key_colour * max(m.nl, 0.0) + fill_colour * m.nv + ambient);
  vec3 fresnel = f0 + (max(vec3(1.0 - material_roughness), f0) - f0) * pow(1.0 - m.nv, 5.0);
  vec3 mirror = room(reflect(-m.v, m.n), material_roughness) * fresnel * mix(1.0, 1.5, material_metalness);
  return body + mirror + gloss(m.n, m.v, towards_key, material_roughness, f0) * key_colour * pi * 0.6 + material_glow;
}
#endif

#ifdef GROUND
// Fades into the backdrop as ground.frag does; where that is on the screen is known here in front of the eye only.
vec3 ground(Meeting m, vec3 at_rest, float open) {
  vec3 light = key_colour * max(m.nl, 0.0) * mix(open, 1.0, 0.4) + vec3(0.62, 0.69, 0.76) * open;
  float r = length(at_rest.xy);
  vec2 pixel = (gl_Position.xy / max(gl_Position.w, 1e-3) * 0.5 + 0.5) * picture_size;
  float fade = smoothstep(6.0, 1.2, r);
  return mix(backdrop(pixel), material_colour * light * exp(-0.16 * r * r), fade * (1.0 - scope));
}
#endif

#ifdef MAP
vec3 map_of(Meeting m, float open, float up) {
  float place = clamp(up, 0.0, 1.0) * 4.0;
  int below = min(int(place), 3);
  vec3 albedo = mix(map_colours[below], map_colours[below + 1], place - float(below));
  return albedo * (0.55 * open + key_colour * max(m.nl, 0.0) * 0.16 + fill_colour * 0.7 * m.nv);
}
#endif

// `n`: as it is interpolated, not unit; gl_Position is set. Sets `seen`.
void light_vertex(vec3 p, vec3 n, vec3 at_rest, float open, float charred, float up, float pale) {
  Meeting m;
  m.n = normalize(n);
  m.v = normalize(eye - p);
  aim_key(p);
  m.nl = dot(m.n, towards_key);
  m.nv = clamp(dot(m.n, m.v), 0.0, 1.0);
#if defined(TISSUE)
  Lit lit = light_on(m, p, open);
  vec3 light = albedo_of(at_rest, charred, pale) * lit.body + lit.shine;
#ifdef SHEET
  light_vessels(lit, at_rest, pale);
#endif
#elif defined(SOLID)
  vec3 light = solid(m);
#elif defined(GROUND)
  vec3 light = ground(m, at_rest, open);
#elif defined(MAP)
  vec3 light = map_of(m, open, up);
#else  // SIGNAL
  vec3 light = material_colour * (0.55 + 0.75 * m.nv) + vec3(0.10) * pow(m.nv, 24.0);
#endif
  seen = developed(light);
}
