// The tree of vessels in a mesentery, of which SHEET says that it is drawn. `rest` is on the sheet unfolded, m: x along the
// gut, y away from it.
#ifdef SHEET
// Trunks at the root, each parting into two from belt to belt on its way to the gut. The belts' width, m, the distance of
// the last branches, the half width of a branch there and how much it grows away from the gut, 1/m; an artery and, beside
// it, a vein. Fat stands along them, lobed, and thins out in between to a reddish film.
const float belt = 0.036, branch_spacing = 0.021, branch_width = 0.00055, branch_growth = 14.0;
const float meander_period = 0.26, meander_reach = 0.028;
const vec3 artery_tint = vec3(0.25, 0.035, 0.028), vein_tint = vec3(0.090, 0.034, 0.060);
const float vein_beside = 3.4;  // half widths
const vec3 film_tint = vec3(0.37, 0.185, 0.130);
const float fat_reach = 0.2;    // of the way from a branch to the next

// How far along the gut a place is from the nearest branch, m, and from the next one, as the share of half their distance.
vec2 off_branch(vec2 p) {
  float level = clamp(floor(p.y / belt), 0.0, 4.0);
  float parent = 2.0 * branch_spacing * exp2(level);
  float x = (fract(p.x / parent) - 0.5) * parent;
  float parted = level < 4.0 ? 1.0 - smoothstep(0.0, 1.0, p.y / belt - level) : 0.0;
  float off = abs(x) - 0.25 * parent * parted;
  return vec2(off, abs(off) / (0.25 * parent));
}

float branch_width_at(float away) { return branch_width * (1.0 + branch_growth * max(0.0, away)); }

// 0 within a vessel's half width of its middle, 1 from so much farther on.
float beyond(float off, float width, float blur) { return smoothstep(width, width + blur, abs(off)); }

// Where the pattern says how far branches sway there, along the gut and across it.
vec3 sway_of(vec3 rest) { return rest / meander_period; }
vec3 sway_across(vec3 rest) { return rest.yxz / meander_period + 0.37; }
#endif
