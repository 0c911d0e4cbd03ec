out vec4 colour;
void main() { colour = vec4(film(backdrop(gl_FragCoord.xy)), 1.0); }
