// Light was computed at the vertices (vertex_light.glsl): a pixel mixes. Only a mesentery (SHEET) has what is finer than its
// triangles and is the picture's: its vessels.
in vec3 seen;
out vec4 colour;
#ifdef SHEET
in vec3 seen_film, seen_artery, seen_vein;
in vec2 bent;
in float width;

void main() {
  vec2 off = off_branch(bent);
  vec3 tissue = mix(seen_film, seen, 1.0 - smoothstep(fat_reach, 1.1, off.y));
  float blur = fwidth(bent.x) + 0.0001;
  tissue = mix(seen_vein, tissue, 0.35 + 0.65 * beyond(off.x - vein_beside * width, width, blur));
  tissue = mix(seen_artery, tissue, 0.25 + 0.75 * beyond(off.x, width, blur));
  colour = vec4(tissue, 1.0);
}
#else
void main() { colour = vec4(seen, 1.0); }
#endif
