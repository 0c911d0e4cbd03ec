// The wall of a tube; begins with tube.glsl.
uniform mat4 clip_from_W;
uniform float by_turn;    // 1: `share` is how much the piece is folded, of twice eps
uniform float turn_full;  // twice eps
out vec3 p_W;
out vec3 n_W;
out vec3 rest;
out float openness;
out float charring;
out float share;
out float pallor;

const float kink_from = 0.5, kink_all = 0.2;
const float wall_steps = 255.0, full_pallor = 0.999;

vec3 wall_normal(vec3 of_surface, vec3 out_) {
  float length_of = length(of_surface);
  if (!(length_of > 0.0)) return out_;
  vec3 normal = of_surface / length_of;
  float part = clamp((dot(normal, out_) - kink_all) / (kink_from - kink_all), 0.0, 1.0);
  return normalize(out_ + part * (normal - out_));
}

// How the blend of both directions turns where their sum changes by this.
vec3 turned(vec3 by) { return reach * scale * (by - flat_ * dot(across, by) * across); }

// Openness and pallor of a frame's wall (render_node/tube_item.h packs them).
vec2 wall_values(vec4 low, vec4 high) {
  vec4 off_low = abs(corner.w - vec4(0.0, 1.0, 2.0, 3.0)), off_high = abs(corner.w - vec4(4.0, 5.0, 6.0, 7.0));
  vec4 of_low = max(1.0 - min(off_low, 8.0 - off_low), 0.0), of_high = max(1.0 - min(off_high, 8.0 - off_high), 0.0);
  return vec2(dot(of_low, floor(low)) + dot(of_high, floor(high)), dot(of_low, fract(low)) + dot(of_high, fract(high)));
}

void main() {
  p_W = skinned_place();
  float v = 1.0 - w, w_slope = skin_weight_slope(corner.z);
  vec3 turn = turned(w * wall_1.turn + v * wall_2.turn) + (w * wall_1.slope + v * wall_2.slope) * scale * sum;
  vec3 wall_along = turned(w_slope * (wall_1.across - wall_2.across)) + w_slope * (wall_1.reach - wall_2.reach) * scale * sum;
  vec3 along = w_slope * (from - to) + w * ahead + v * behind + radius * wall_along;
  vec3 normal = wall_normal(cross(turn, along), across);
  n_W = cap.y == 0.0 ? normal : normalize(cap.x * normal + cap.y / cap_depth * t_mean);
  float way = 0.5 * (corner.z + v);
  rest = vec3(mix(origin_along_1.w, origin_along_2.w, way) + cap_depth * radius * cap.y, radius * cap.x * corner.xy);
  vec2 values = w * wall_values(walls_low_1, walls_high_1) + v * wall_values(walls_low_2, walls_high_2);
  openness = values.x / wall_steps;
  charring = 0.0;
  pallor = values.y / full_pallor;
  share = by_turn > 0.0 ? bend_share_turn_1.w / turn_full : mix(bend_share_turn_1.z, bend_share_turn_2.z, way);
  gl_Position = clip_from_W * vec4(p_W, 1.0);
#ifdef PER_VERTEX
  light_vertex(p_W, n_W, rest, openness, charring, share, pallor);
#endif
}
