// A tube as the key light sees it: depth only; begins with tube.glsl.
uniform mat4 clip_from_W;
void main() { gl_Position = clip_from_W * vec4(skinned_place(), 1.0); }
