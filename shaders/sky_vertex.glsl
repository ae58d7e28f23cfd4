// A triangle that covers the whole picture at infinity. The sky is visible where nothing else was drawn.
layout(set = 0, binding = kBindPass) uniform Pass { PassData pass; };
layout(location = 0) out vec3 direction;

void main() {
  vec2 clip = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  gl_Position = vec4(clip, 0.0, 1.0);
#ifdef LAYERED
  gl_Layer = gl_InstanceIndex;
#endif
  direction = pass.sky_centre[gl_InstanceIndex].xyz + clip.x * pass.sky_right[gl_InstanceIndex].xyz +
              clip.y * pass.sky_down[gl_InstanceIndex].xyz;
}
