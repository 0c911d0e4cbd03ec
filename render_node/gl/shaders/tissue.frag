// GUT is defined for the wall of a gut, SHEET for its mesentery: `rest` is then on a straight tube along x, or on the sheet
// unfolded, x along the gut and y away from it. WALL is defined for peritoneum over muscle. CUT is defined for an organ that was cut: heat may have charred it. BARED too for what lies bare of it: no capsule, but
// parenchyma, vessels, blood.
// Wet organ: light that enters comes out reddened and spread around the edge of the shade; a film of water mirrors.
in vec3 p_W;
in vec3 n_W;
in vec3 rest;
in float openness;
in float charring;
in float pallor;
uniform sampler3D pattern;   // rgb: gradient (0.5 is none), a: value of a smooth noise
uniform vec3 material_colour;
uniform float material_roughness;
out vec4 colour;

// Sizes of the pattern's period, m: mottling of the parenchyma, and the fine grain of the capsule.
const float mottle_period = 0.062;
const float grain_period = 0.0135;

// Light through tissue: how far it creeps around the terminator; red goes furthest (mean free path in liver).
const vec3 creep = vec3(0.26, 0.10, 0.08);

const float scattered = 0.35;  // more, where light creeps: what entered elsewhere comes out there

// The relief of the capsule: slopes of mottling and grain; grain is seen up to this many unit_lengths away.
#ifdef GUT
const float mottle_slope = 0.20, grain_slope = 0.06, grain_sight = 5.0;  // stretched over what it holds
#else
const float mottle_slope = 0.20, grain_slope = 0.13, grain_sight = 5.0;
#endif
const float soft_relief = 0.3;  // of it shades the body: light inside tissue does not see the capsule's grain

#ifdef CUT
// Tissue that a hot edge went through: baked brown, black in crusts, and dull; from so much charring on, frayed by the
// pattern. On the capsule a narrow seam of it is seen.
const vec3 baked = vec3(0.060, 0.021, 0.010), crust = vec3(0.0062, 0.0042, 0.0035);
const float char_fray = 0.55, crust_from = 0.42, crust_full = 0.68, dried = 0.6, char_mirror = 0.25;
#ifdef BARED
const float char_from = 0.30, char_full = 0.95, char_most = 0.88;
#else
const float char_from = 0.62, char_full = 1.0, char_most = 0.8;
#endif
#endif

#ifdef BARED
// Vessels run through the inside in two directions, one in most squares of this side, m; a cut shows their mouths: a pale
// wall around a dark lumen. They meander with the mottling.
const float vessel_spacing = 0.017, widest_vessel = 0.0026, vessel_wall = 0.0007, meander = 0.003;
const vec3 wall_tint = vec3(0.150, 0.060, 0.048), lumen_tint = vec3(0.020, 0.0020, 0.0024);
// Lobules, a millimetre or two across, stand out where they were parted.
const float lobule_period = 0.019, lobule_slope = 0.34, lobule_weight = 1.0;

// The distance to the outside of the vessel that crosses this square of a plane, m; large where none does.
float off_vessel(vec2 p) {
  vec2 square = floor(p / vessel_spacing);
  float radius = widest_vessel * (1.6 * grain(square + 41.0) - 0.6);
  vec2 middle = (square + 0.25 + 0.5 * vec2(grain(square), grain(square.yx + 17.0))) * vessel_spacing;
  return radius > 0.0 ? distance(p, middle) - radius : 1.0;
}
#endif

#if defined(GUT) || defined(WALL)
// Fine vessels under the serosa, where a slow noise of this period crosses its middle; their half width, m, their tint,
// and how strongly they show.
#ifdef WALL
const float web_period = 0.52, web_width = 0.0006, web_share = 0.28;
#else
const float web_period = 0.17, web_width = 0.0003, web_share = 0.4;
#endif
const vec3 web_tint = vec3(0.20, 0.030, 0.030);
#endif

#ifdef SHEET
// How much of what lies behind is hidden by film, fat and vessels, seen straight on; along the sheet light goes through more.
const float film_hides = 0.52, fat_hides = 0.90, vessel_hides = 0.92, along_hides = 0.55;
// Light from the other side comes through, reddened, most where there is no fat.
const vec3 through_film = vec3(0.50, 0.33, 0.26), through_fat = vec3(0.20, 0.13, 0.07);
const float lobe_period = 0.026, lobe_slope = 0.34, lobe_weight = 0.45;
#endif

// The pattern's share in the colour, and the tint of spots where blood stands.
#if defined(GUT) || defined(SHEET) || defined(WALL)
const float mottle_weight = 1.2, grain_weight = 0.8, contrast = 0.20;
#else
const float mottle_weight = 1.7, grain_weight = 0.8, contrast = 0.38;
#endif
const vec3 blood_tint = vec3(0.78, 0.74, 1.15);

// Without blood light goes farther before it comes out. What a colour lacks of white is absorbed along the way: half the
// absorption is its square root. So much of that is seen where all blood is gone: the tissue itself stays.
const float bloodless = 0.8;

const vec3 shade_light = vec3(0.15, 0.04, 0.03);  // of the key light, through the tissue beside a shadow

// The light at the lens: full at this many unit_lengths, at most so much nearer by (an endoscope dims itself).
const float torch_sight = 3.2, torch_most = 1.6;

// Light from all around, below and above, and by which powers of the openness its colours are lost in a hollow.
const vec3 ambient_below = vec3(0.11, 0.05, 0.042), ambient_above = vec3(0.22, 0.245, 0.28);
const vec3 hollow_power = vec3(1.2, 2.0, 2.1);
const float hollow_share = 0.8;  // of the direct light, too, is kept out of a hollow by what stands over it

// The film of water: reflectance at normal incidence (a little above water's 0.02: serous fluid), how the mottling roughens
// it, how strong the two lights glint, and what it mirrors of the room straight on and at grazing angles.
const vec3 water_f0 = vec3(0.028);
const float smoothest = 0.8, roughened = 0.5;
const float key_glint = 1.5, fill_glint = 1.3;
const float mirror_straight = 0.045, mirror_grazing = 0.75, mirror_blur = 0.25, mirror_in_shade = 0.4;

vec3 wrapped(float n_dot_l) {
  vec3 w = clamp((vec3(n_dot_l) + creep) / (1.0 + creep), 0.0, 1.0);
  return w * w * (1.0 + scattered * (1.0 - w));
}

void main() {
  aim_key(p_W);
  vec4 mottle = texture(pattern, rest / mottle_period);
  vec4 fine = texture(pattern, rest / grain_period);
  vec3 v = normalize(eye - p_W);
  vec3 n0 = normalize(n_W);
  // the relief fades with distance, where it would only flicker
  float near = clamp(unit_length * grain_sight / distance(eye, p_W), 0.0, 1.0);
  vec3 slope = (mottle.rgb - 0.5) * mottle_slope + (fine.rgb - 0.5) * grain_slope * near;
#ifdef BARED
  vec4 lobules = texture(pattern, rest.zxy / lobule_period);
  slope += (lobules.gbr - 0.5) * lobule_slope * near;
#endif
#ifdef SHEET
  vec4 lobes = texture(pattern, rest / lobe_period);
  slope += (lobes.rgb - 0.5) * lobe_slope * near;
#endif
  vec3 n = normalize(n0 - (slope - n0 * dot(slope, n0)));
  vec3 n_soft = normalize(mix(n0, n, soft_relief));

  // colour: darker, bluer spots where blood stands, paler between the lobules
  float spot = (mottle.a - 0.5) * mottle_weight + (fine.a - 0.5) * grain_weight;
  vec3 albedo = material_colour * (1.0 + contrast * spot);
  albedo = mix(albedo, albedo * blood_tint, clamp(-spot, 0.0, 1.0));
#if defined(GUT) || defined(WALL)
  float crossing = texture(pattern, rest.zxy / web_period).a - 0.5, from_pixel = fwidth(crossing);
  float half_width = web_width * max(from_pixel, 1e-4) / max(length(fwidth(p_W)), 1e-6);
  float thread = 1.0 - smoothstep(half_width, half_width + from_pixel, abs(crossing));
  albedo = mix(albedo, web_tint, web_share * thread * smoothstep(0.40, 0.65, mottle.a));
#endif
#ifdef SHEET
  vec2 bent = rest.xy + meander_reach * (vec2(texture(pattern, sway_of(rest)).a, texture(pattern, sway_across(rest)).a) - 0.5);
  vec2 off = off_branch(bent);
  float width = branch_width_at(rest.y);
  albedo *= 1.0 + lobe_weight * (lobes.a - 0.5);
  float fat = 1.0 - smoothstep(fat_reach, 1.1, off.y + 0.8 * (lobes.a - 0.5));
  albedo = mix(film_tint, albedo, fat);
  float blur = fwidth(bent.x) + 0.0001;
  float off_vein = beyond(off.x - vein_beside * width, width, blur), off_artery = beyond(off.x, width, blur);
  albedo = mix(vein_tint, albedo, 0.35 + 0.65 * off_vein);
  albedo = mix(artery_tint, albedo, 0.25 + 0.75 * off_artery);
  float hides = mix(vessel_hides, mix(film_hides, fat_hides, fat), min(off_vein, off_artery));
#endif
#ifdef BARED
  albedo *= 1.0 + lobule_weight * (lobules.a - 0.5);
  vec3 bent = rest + meander * (mottle.rgb - 0.5);
  float off = min(off_vessel(bent.xy), off_vessel(bent.yz));
  float blur = 0.5 * fwidth(off) + 0.0001;
  albedo = mix(wall_tint, albedo, smoothstep(-blur, blur, off));
  albedo = mix(lumen_tint, albedo, smoothstep(-blur, blur, off + vessel_wall));
#endif
  albedo = mix(albedo, sqrt(albedo), bloodless * pallor);
  float wet = material_roughness * (smoothest + roughened * mottle.a);
  float mirroring = 1.0;
#ifdef CUT
  float fray = char_fray * (fine.a + mottle.a - 1.0);
  float burnt = char_most * smoothstep(char_from, char_full, charring * (1.0 + fray));
  albedo = mix(albedo, mix(baked, crust, smoothstep(crust_from, crust_full, 0.5 * (fine.a + mottle.a))), burnt);
  wet = mix(wet, dried, burnt);
  mirroring = mix(1.0, char_mirror, burnt);
#endif

  // shadows on tissue are red, not grey: light enters beside them
  float shade = lit(p_W, n0, dot(n0, towards_key));
  vec3 light = key_colour * wrapped(dot(n_soft, towards_key)) * mix(shade_light, vec3(1.0), shade);
  float nv = clamp(dot(n_soft, v), 0.0, 1.0);
#ifdef SHEET
  light += key_colour * mix(through_film, through_fat, fat) * shade * max(0.0, -dot(n_soft, towards_key));
#endif
  float torch = clamp(unit_length * torch_sight / distance(eye, p_W), 0.0, torch_most);
  light += fill_colour * torch * nv;

  // ambient: cool from above, warm from the neighbouring tissue below; what a hollow keeps is redder
  float above = n_soft.z * 0.5 + 0.5;
  vec3 open = pow(vec3(openness), hollow_power);
  light += mix(ambient_below, ambient_above, above) * open * mix(vec3(1.0), ambient_in_body, scope);
  vec3 body = albedo * light * mix(vec3(1.0), open, hollow_share);

  // the film of water: sharp glints of both lights and a mirror of the room, strongest at grazing angles
  vec3 glint = gloss(n, v, towards_key, wet, water_f0) * key_colour * pi * shade * key_glint;
  glint += gloss(n, v, v, wet, water_f0) * fill_colour * torch * pi * fill_glint;
  glint *= openness;
  float grazing = pow(1.0 - nv, 5.0);
  vec3 mirror = room(reflect(-v, n), mirror_blur) * (mirror_straight + mirror_grazing * grazing);
  mirror *= openness * openness * mix(mirror_in_shade, 1.0, shade) * mirroring;

#ifdef SHEET
  // what shines on the film is not less for the film's being thin
  float shine = clamp(dot(glint + mirror, vec3(0.33)), 0.0, 1.0);
  colour = vec4(film(body + glint + mirror), max(mix(hides, 1.0, along_hides * (1.0 - nv)), shine));
#else
  colour = vec4(film(body + glint + mirror), 1.0);
#endif
}
