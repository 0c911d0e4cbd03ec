// One triangle over the whole picture, as far away as can be.
void main() {
  vec2 p = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
  gl_Position = vec4(p, 1.0, 1.0);
}
