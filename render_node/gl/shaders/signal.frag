// Arrows and markers: a clear colour with just enough shading to show their shape.
in vec3 p_W;
in vec3 n_W;
in vec3 rest;
in float openness;
uniform vec3 material_colour;
out vec4 colour;

void main() {
  vec3 v = normalize(eye - p_W);
  float facing = clamp(dot(normalize(n_W), v), 0.0, 1.0);
  vec3 light = material_colour * (0.55 + 0.75 * facing) + vec3(0.10) * pow(facing, 24.0);
  colour = vec4(film(light), 1.0);
}
