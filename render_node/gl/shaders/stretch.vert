// Two triangles over the whole picture, and where in the smaller one their corners lie.
out vec2 place;
void main() {
  bool right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool upper = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  place = vec2(right, upper);
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
