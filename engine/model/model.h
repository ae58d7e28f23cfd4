// A drawable model on the CPU: the subset of glTF 2.0 that a cabin needs. No GPU code here.
//
// Coordinates are in metres, right-handed, with +Y up. Textures follow glTF: row 0 is at the top, and (0, 0) is the
// upper left corner.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/image/image.h"

namespace gearshift::engine {

inline constexpr int kNone = -1;  // no node, mesh, texture, ...

// Layout of the GPU's vertex buffer: 60 bytes, no padding.
struct Vertex {
  glm::vec3 position{0.0f};                   // [m] in mesh space
  glm::vec3 normal{0.0f, 0.0f, 1.0f};         // unit vector
  glm::vec4 tangent{1.0f, 0.0f, 0.0f, 1.0f};  // unit vector; w: sign of the bitangent
  glm::vec2 uv0{0.0f};
  glm::vec2 uv1{0.0f};                 // second UV set: baked occlusion
  std::uint32_t colour = 0xffffffffu;  // linear RGBA8, red in the lowest byte
};
static_assert(sizeof(Vertex) == 60);

// Up to four joints of a skin that move a vertex; weights sum to 1.
struct VertexJoints {
  std::uint16_t joint[4] = {0, 0, 0, 0};  // index into Skin::joints
  float weight[4] = {1.0f, 0.0f, 0.0f, 0.0f};
};

enum class Wrap : std::uint8_t { repeat, mirror, clamp };
struct Texture {
  Image pixels;
  bool srgb = false;  // false: linear data
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool linear = true;  // linear filtering; false: nearest
};

// One use of a texture by a material, with its transform (KHR_texture_transform).
struct TextureUse {
  int texture = kNone;
  int uv_set = 0;  // 0 or 1
  glm::vec2 offset{0.0f};
  glm::vec2 scale{1.0f};
  float rotation = 0.0f;  // [rad] matrix() defines the sign
  // Transforms texture coordinates: uv = matrix() * vec3(uv of the set, 1). The sign of the rotation is that of the
  // Khronos sample viewer and of the example in KHR_texture_transform. The GLSL code in the text of that extension
  // rotates the other way.
  glm::mat3 matrix() const;
  bool plain() const { return offset == glm::vec2(0.0f) && scale == glm::vec2(1.0f) && rotation == 0.0f; }
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };
struct Material {
  std::string name;
  glm::vec4 base_colour{1.0f};  // linear
  float metallic = 1.0f;
  float roughness = 1.0f;
  float normal_scale = 1.0f;
  float occlusion_strength = 1.0f;
  glm::vec3 emissive{0.0f};  // linear, including KHR_materials_emissive_strength
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  TextureUse base_colour_map, metal_rough_map, normal_map, occlusion_map, emissive_map;
};

// Triangles of one material. Indices refer to Model::vertices directly (no base vertex).
struct Primitive {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;    // a multiple of 3
  int material = kNone;             // kNone: glTF's default material
  glm::vec3 low{0.0f}, high{0.0f};  // [m] bounding box in mesh space
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::uint32_t first_vertex = 0;  // first vertex of this mesh; meshes do not share vertices
  std::uint32_t vertex_count = 0;
};

struct Node {
  std::string name;
  int parent = kNone;  // index of the parent, which is earlier in Model::nodes
  glm::vec3 translation{0.0f};
  glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
  glm::vec3 scale{1.0f};
  int mesh = kNone;
  int skin = kNone;
  glm::mat4 local() const;  // translation * rotation * scale
};

struct Skin {
  std::vector<int> joints;              // node indices
  std::vector<glm::mat4> inverse_bind;  // mesh space -> joint space, one per joint
};

struct Model {
  std::vector<Vertex> vertices;
  std::vector<VertexJoints> vertex_joints;  // one per vertex if there is a skin, else empty
  std::vector<std::uint32_t> indices;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;  // parents before children
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Skin> skins;
  std::vector<std::string> skipped;          // features that the file uses but that are not drawn, each named once
  std::vector<std::filesystem::path> files;  // buffer and texture files that were read

  int node(std::string_view name) const;  // index of the first node with this name, or kNone
  std::uint64_t triangle_count() const;   // number of triangles of all nodes that carry a mesh
};

// Returns the world matrix of every node as placed by the file, one per entry of model.nodes.
std::vector<glm::mat4> rest_pose(const Model& model);

// Returns the world matrix of every node. local[i] is the transform of node i relative to its parent. `local` and the
// result have one entry per node.
std::vector<glm::mat4> world_from_local(const Model& model, const std::vector<glm::mat4>& local);

}  // namespace gearshift::engine
