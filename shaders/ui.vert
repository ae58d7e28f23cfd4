// Vertex shader for Dear ImGui: pixels to clip space.
#version 460

layout(push_constant) uniform Picture {
  vec2 size;  // [px]
} picture;

layout(location = 0) in vec2 position;  // [px]
layout(location = 1) in vec2 uv;        // coordinates in the font's texture
layout(location = 2) in vec4 colour;    // display-referred, straight alpha

layout(location = 0) out vec2 uv_out;
layout(location = 1) out vec4 colour_out;

void main() {
  gl_Position = vec4(2.0 * position / picture.size - 1.0, 0.0, 1.0);
  uv_out = uv;
  colour_out = colour;
}
