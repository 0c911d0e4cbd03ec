// An organ as a map of what its tissue is under: colour says how much, shading keeps the shape, nothing glints.
in vec3 p_W;
in vec3 n_W;
in float openness;
in float share;
uniform vec3 map_colours[5];  // tissue_map.h
out vec4 colour;

// Light from all around and of the two lamps: enough of it that the darkest colour is not taken for a shadow.
const float ambient = 0.55, key_share = 0.16, fill_share = 0.7;

void main() {
  aim_key(p_W);
  vec3 n = normalize(n_W);
  vec3 v = normalize(eye - p_W);
  float place = clamp(share, 0.0, 1.0) * 4.0;
  int below = min(int(place), 3);
  vec3 albedo = mix(map_colours[below], map_colours[below + 1], place - float(below));
  float key = max(dot(n, towards_key), 0.0) * lit(p_W, n, dot(n, towards_key));
  vec3 light = ambient * openness + key_colour * key * key_share + fill_colour * fill_share * max(dot(n, v), 0.0);
  colour = vec4(film(albedo * light), 1.0);
}
