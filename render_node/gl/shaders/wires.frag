// Edges of triangles: light enough for raw tissue, thin enough to leave it seen.
out vec4 colour;

void main() {
  colour = vec4(0.80, 0.95, 1.0, 0.55);
}
