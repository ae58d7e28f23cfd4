// Text, lines and areas of Dear ImGui; the font's texture contains only coverage.
#version 460

layout(set = 0, binding = 0) uniform sampler2D font;

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 colour;

layout(location = 0) out vec4 fragment_colour;

void main() {
  fragment_colour = vec4(colour.rgb, colour.a * texture(font, uv).r);
}
