// A puff of smoke: a soft disc, frayed by the pattern, lit from all around.
in vec3 p_W;
in vec3 rest;  // xy: -1 to 1 across the disc
uniform sampler3D pattern;
uniform vec3 material_colour;
uniform float material_opacity;
out vec4 colour;

const float fray_period = 0.05, fray = 0.9;  // m, and how much the pattern thins it

void main() {
  float inside = max(0.0, 1.0 - dot(rest.xy, rest.xy));
  float thin = 1.0 - fray * smoothstep(0.35, 0.70, texture(pattern, p_W / fray_period).a);
  colour = vec4(film(material_colour), material_opacity * inside * inside * thin);
}
