// One triangle over the whole picture, and where in the smaller one its corners lie.
out vec2 place;
void main() {
  place = vec2((gl_VertexID & 1) * 2, gl_VertexID & 2);
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
