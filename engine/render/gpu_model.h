// A model on the GPU: one vertex and one index buffer, an image and a sampler per texture, a descriptor set per
// material.
#pragma once

#include <span>
#include <vector>

#include "engine/gpu/gpu_buffer.h"
#include "engine/gpu/gpu_image.h"
#include "engine/gpu/pipeline.h"
#include "engine/model/model.h"
#include "engine/render/frustum.h"

namespace gearshift::engine {

// The unit of drawing: one primitive of a mesh.
struct Part {
  std::uint32_t first_index = 0, index_count = 0;
  std::uint32_t material = 0;  // index into GpuModel::materials, whose last entry is the default material
  Box box;                     // [m] in mesh space
};

struct GpuMesh {
  std::uint32_t first_part = 0, part_count = 0;
  std::uint32_t first_vertex = 0, vertex_count = 0;
  Box box;
};

struct GpuMaterial {
  std::uint32_t features = 0;  // bits: shader::kHasMap, shader::kMasked, ...
  bool blended = false, double_sided = false;
  VkDescriptorSet set = VK_NULL_HANDLE;
};

struct GpuModel {
  GpuBuffer vertices, indices, material_data;
  std::vector<GpuImage> textures;
  std::vector<ImageView> views;
  std::vector<Sampler> samplers;
  SetPool sets;
  std::vector<Part> parts;
  std::vector<GpuMesh> meshes;
  std::vector<GpuMaterial> materials;
  std::vector<int> mesh_of_node;  // or kNone
  Box box;                        // [m] world, in the rest pose
};

GpuModel upload_model(Gpu& gpu, const Model& model, VkDescriptorSetLayout material_layout);

}  // namespace gearshift::engine
