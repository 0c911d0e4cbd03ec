// Every mesh of the scene. PER_VERTEX is defined where light is computed here (vertex_light.glsl).
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest_position;
layout(location = 3) in float openness_in;
layout(location = 4) in float charring_in;
layout(location = 5) in float share_in;
layout(location = 6) in float pallor_in;
uniform mat4 W_from_mesh;
uniform mat4 clip_from_W;
out vec3 p_W;
out vec3 n_W;
out vec3 rest;
out float openness;
out float charring;
out float share;
out float pallor;

void main() {
  vec4 p = W_from_mesh * vec4(position, 1.0);
  p_W = p.xyz;
  // exact for rotations and for stretching along or across the axis of an arrow
  mat3 linear = mat3(W_from_mesh);
  n_W = linear * (normal / vec3(dot(linear[0], linear[0]), dot(linear[1], linear[1]), dot(linear[2], linear[2])));
  rest = rest_position;
  openness = openness_in;
  charring = charring_in;
  share = share_in;
  pallor = pallor_in;
  gl_Position = clip_from_W * p;
#ifdef PER_VERTEX
  light_vertex(p_W, n_W, rest, openness, charring, share, pallor);
#endif
}
