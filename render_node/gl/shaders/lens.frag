// An endoscope's round field of view, black outside, dimmer towards its rim.
out vec4 colour;
void main() {
  vec2 p = (gl_FragCoord.xy - picture_size * vec2(middle, 0.5)) / (0.5 * picture_size.y);
  float r = length(p);
  float outside = smoothstep(1.06, 1.075, r);
  float dim = 0.55 * smoothstep(0.45, 1.06, r);
  colour = vec4(0.0, 0.0, 0.0, max(outside, dim));
}
