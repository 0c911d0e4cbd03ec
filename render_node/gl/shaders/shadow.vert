// The scene as the key light sees it: depth only.
layout(location = 0) in vec3 position;
uniform mat4 W_from_mesh;
uniform mat4 clip_from_W;
void main() { gl_Position = clip_from_W * W_from_mesh * vec4(position, 1.0); }
