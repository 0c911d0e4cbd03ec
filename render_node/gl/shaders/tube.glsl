// A tube between two of its frames (Raghupathi 2004, section 5.2): render_node/tube_cylinder.cpp in GLSL, with the same
// names, numbers and steps; its comments say why. Per instance: a frame and the next one.
layout(location = 0) in vec4 corner;  // cosine, sine, z, direction
layout(location = 1) in vec2 cap;     // outwards, forward
layout(location = 2) in vec4 origin_along_1;
layout(location = 3) in vec4 t_ahead_1;
layout(location = 4) in vec4 k_behind_1;
layout(location = 5) in vec4 bend_share_turn_1;
layout(location = 6) in vec4 walls_low_1;
layout(location = 7) in vec4 walls_high_1;
layout(location = 8) in vec4 origin_along_2;
layout(location = 9) in vec4 t_ahead_2;
layout(location = 10) in vec4 k_behind_2;
layout(location = 11) in vec4 bend_share_turn_2;
layout(location = 12) in vec4 walls_low_2;
layout(location = 13) in vec4 walls_high_2;
uniform float radius;

const float cap_depth = 0.6, free_bend = 0.5, given_bend = 0.2, least_blend = 0.2, slope_fades = 3.0;

float skin_weight(float z) {
  float squared = z * z;
  return squared < 0.25 ? 1.0 - 2.0 * squared : (1.0 - squared) * (1.0 - squared) / (0.75 + 1.5 * squared);
}

float skin_weight_slope(float z) {
  float squared = z * z, under = 0.75 + 1.5 * squared, over = 1.0 - squared;
  return squared < 0.25 ? -4.0 * z : -z * over * (4.0 * under + 3.0 * over) / (under * under);
}

// A frame's wall in the corner's direction.
struct Wall { vec3 across, turn; float reach, slope, along; };
Wall wall_at(vec3 t, vec3 k, vec2 bends) {
  vec3 b = cross(t, k);
  float bend = dot(corner.xy, bends);
  float way = 1.0, slope = 0.0, along = 1.0;
  if (bend > free_bend) {
    float given = tanh((bend - free_bend) / given_bend);
    way = (free_bend + given_bend * given) / bend;
    slope = (1.0 - given * given - way) / bend * (corner.x * bends.y - corner.y * bends.x);
    along = min(1.0, slope_fades * (1.0 - way * bend));
  }
  return Wall(corner.x * k + corner.y * b, corner.x * b - corner.y * k, way, slope, along);
}

// Of the piece at the corner: the share w of the first frame, both walls and their blend, both ends of the axis.
float w, scale, flat_, reach;
Wall wall_1, wall_2;
vec3 sum, across, ahead, behind, from, to, t_mean;

vec3 skinned_place() {
  w = skin_weight(corner.z);
  wall_1 = wall_at(t_ahead_1.xyz, k_behind_1.xyz, bend_share_turn_1.xy);
  wall_2 = wall_at(t_ahead_2.xyz, k_behind_2.xyz, bend_share_turn_2.xy);
  sum = w * wall_1.across + (1.0 - w) * wall_2.across;
  float length_ = max(length(sum), least_blend);
  across = sum / length_;
  bool is_outer = w > 0.0 && w < 1.0 && dot(sum, t_ahead_2.xyz - t_ahead_1.xyz) < 0.0;
  scale = is_outer ? 1.0 / length_ : 1.0;
  flat_ = is_outer ? 1.0 : 0.0;
  reach = w * wall_1.reach + (1.0 - w) * wall_2.reach;
  ahead = wall_1.along * t_ahead_1.w * t_ahead_1.xyz;
  behind = wall_2.along * k_behind_2.w * t_ahead_2.xyz;
  from = origin_along_1.xyz + corner.z * ahead;
  to = origin_along_2.xyz - (1.0 - corner.z) * behind;
  t_mean = w * t_ahead_1.xyz + (1.0 - w) * t_ahead_2.xyz;
  return w * from + (1.0 - w) * to + radius * (cap.x * reach * scale * sum + cap_depth * cap.y * t_mean);
}
