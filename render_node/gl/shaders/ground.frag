// A surgical drape: matt, blue-green, shaded by what lies on it, fading into the backdrop.
in vec3 p_W;
in vec3 n_W;
in vec3 rest;      // place over the organ's radius
in float openness;
uniform vec3 material_colour;
out vec4 colour;

void main() {
  aim_key(p_W);
  float nl = max(dot(n_W, towards_key), 0.0);
  float shade = lit(p_W, vec3(0.0, 0.0, 1.0), nl);
  vec3 light = key_colour * nl * shade * mix(openness, 1.0, 0.4) + vec3(0.62, 0.69, 0.76) * openness;
  // the lamp's cone
  float r = length(rest.xy);
  float cone = exp(-0.16 * r * r);
  float fade = smoothstep(6.0, 1.2, r);
  vec3 cloth = material_colour * light * cone;
  colour = vec4(film(mix(backdrop(gl_FragCoord.xy), cloth, fade * (1.0 - scope))), 1.0);
}
