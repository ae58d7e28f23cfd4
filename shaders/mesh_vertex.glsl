// Vertex shader of a mesh: instance i is eye i. If LAYERED is defined, instance i is drawn to layer i.
layout(constant_id = 0) const uint features = 0u;

layout(set = 0, binding = kBindPass) uniform Pass { PassData pass; };
layout(set = 0, binding = kBindObjects, std430) readonly buffer Objects { ObjectData objects[]; };
layout(push_constant) uniform Draw { DrawData draw; };

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;
layout(location = 5) in vec4 in_colour;

layout(location = 0) out vec3 to_eye;  // [m]
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 uv;      // both UV sets
layout(location = 3) out vec3 lookup;  // coordinates in the shadow map or in the mirror's picture
layout(location = 4) out vec4 tangent;
layout(location = 5) out vec4 colour;
layout(location = 6) flat out uint eye;
invariant gl_Position;

// [texels] The shadow map is looked up at this distance from the surface, along the normal. The offset covers the depth
// range of a sloped surface within one texel.
const float kNormalOffset = 1.5;

void main() {
  ObjectData object = objects[draw.object];
  vec4 world = object.world * vec4(in_position, 1.0);
  eye = uint(gl_InstanceIndex);
  gl_Position = pass.clip_from_world[eye] * world;
#ifdef LAYERED
  gl_Layer = gl_InstanceIndex;
#endif
  to_eye = pass.eye[eye].xyz - world.xyz;
  // Normal and tangent are unit vectors for any scale of the node, because the slopes of the normal map are relative to
  // unit vectors.
  normal = normalize(mat3(object.normal[0].xyz, object.normal[1].xyz, object.normal[2].xyz) * in_normal);
  uv = vec4(in_uv0 + object.uv_shift.xy, in_uv1);
  if ((features & (kHasMap << kMapNormal)) != 0u)
    tangent = vec4(normalize(mat3(object.world) * in_tangent.xyz), in_tangent.w * object.normal[0].w);
  if ((features & kVertexColour) != 0u) colour = in_colour;
  if ((features & kShowsMirror) != 0u) {
    lookup = vec3(dot(pass.mirror_u, world), dot(pass.mirror_v, world), float(eye));
  } else if ((features & kShadowed) != 0u) {
    vec3 off = normal * (kNormalOffset * pass.shadow_texel.x);
    if (draw.thin > 0.0 && dot(normal, to_eye) < 0.0) off = -off;  // offset towards the visible side
    lookup = (pass.shadow_from_world * vec4(world.xyz + off, 1.0)).xyz;
  }
}
