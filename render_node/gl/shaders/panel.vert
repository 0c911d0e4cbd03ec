// Two triangles over a part of the picture, from `low` to `high` in shares of its sides, and where that is.
uniform vec2 low;
uniform vec2 high;
out vec2 place;
void main() {
  bool right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool upper = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  place = mix(low, high, vec2(right, upper));
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
