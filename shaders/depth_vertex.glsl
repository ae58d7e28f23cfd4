// Vertex shader of the depth-only passes: the shadow pass as seen from the sun, and the depth prepass as seen from the
// eyes. gl_Position must be bit-identical to that in mesh_vertex.glsl.
layout(constant_id = 0) const uint features = 0u;

layout(set = 0, binding = kBindPass) uniform Pass { PassData pass; };
layout(set = 0, binding = kBindObjects, std430) readonly buffer Objects { ObjectData objects[]; };
layout(push_constant) uniform Draw { DrawData draw; };

layout(location = 0) in vec3 in_position;
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;
layout(location = 5) in vec4 in_colour;
layout(location = 0) out vec2 uv;
layout(location = 1) out float alpha;  // alpha of the vertex colour
invariant gl_Position;

void main() {
  ObjectData object = objects[draw.object];
  vec4 world = object.world * vec4(in_position, 1.0);
  gl_Position = pass.clip_from_world[gl_InstanceIndex] * world;
#ifdef LAYERED
  gl_Layer = gl_InstanceIndex;
#endif
  if ((features & kMasked) != 0u)
    uv = (features & (kMapOnUv1 << kMapBaseColour)) != 0u ? in_uv1 : in_uv0 + object.uv_shift.xy;
  if ((features & kVertexColour) != 0u) alpha = in_colour.a;
}
