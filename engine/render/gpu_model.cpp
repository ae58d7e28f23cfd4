#include "engine/render/gpu_model.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/render/material_data.h"
#include "engine/render/samplers.h"

namespace gearshift::engine {

namespace {

// [bytes] Distance between materials in the buffer: a multiple of every device's minUniformBufferOffsetAlignment
// (Vulkan 1.3, table "Required Limits": at most 256).
constexpr VkDeviceSize kMaterialStride = 512;
static_assert(sizeof(shader::MaterialData) <= kMaterialStride);

void upload_textures(Gpu& gpu, const Model& model, GpuModel& into) {
  const auto add = [&](const Texture& texture) {
    into.textures.push_back(make_texture(gpu, texture.pixels, texture.srgb, true));
    into.views.push_back(make_view(gpu, into.textures.back(), VK_IMAGE_VIEW_TYPE_2D));
    into.samplers.push_back(texture_sampler(gpu, texture));
  };
  for (const Texture& texture : model.textures) add(texture);
  add(Texture{.pixels = {1, 1, {255, 255, 255, 255}}});  // white; the last texture, bound where a material has no map
}

// For each material, whether any of its triangles has vertex colours; the last entry is for the default material.
std::vector<bool> coloured_materials(const Model& model) {
  std::vector<bool> coloured(model.materials.size() + 1, false);
  for (const Mesh& mesh : model.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      const std::size_t material =
          primitive.material == kNone ? model.materials.size() : static_cast<std::size_t>(primitive.material);
      const auto first = model.indices.begin() + primitive.first_index;
      if (!coloured[material])
        coloured[material] = std::any_of(first, first + primitive.index_count,
                                         [&](std::uint32_t i) { return model.vertices[i].colour != 0xffffffffu; });
    }
  }
  return coloured;
}

void upload_materials(Gpu& gpu, const Model& model, VkDescriptorSetLayout layout, GpuModel& into) {
  std::vector<Material> materials = model.materials;
  materials.emplace_back();
  const std::vector<bool> coloured = coloured_materials(model);
  std::vector<std::byte> data(materials.size() * kMaterialStride);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const shader::MaterialData content = data_of(materials[i]);
    std::memcpy(data.data() + i * kMaterialStride, &content, sizeof content);
  }
  into.material_data = make_device_buffer(gpu, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, data);

  const auto count = static_cast<std::uint32_t>(materials.size());
  const std::array sizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count * shader::kMaps},
                         VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count}};
  into.sets = SetPool(gpu, count, sizes);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const Material& material = materials[i];
    GpuMaterial& gpu_material = into.materials.emplace_back();
    gpu_material.features = features_of(material, coloured[i]);
    gpu_material.blended = material.alpha_mode == AlphaMode::blend;
    gpu_material.double_sided = material.double_sided;
    gpu_material.set = into.sets.make(layout);
    const auto maps = maps_of(material);
    for (std::uint32_t map = 0; map < shader::kMaps; ++map) {
      const int texture = maps[map]->texture;
      const std::size_t at = texture == kNone ? into.textures.size() - 1 : static_cast<std::size_t>(texture);
      bind_texture(gpu, gpu_material.set, map, into.views[at].get(), into.samplers[at].get());
    }
    bind_buffer(gpu, gpu_material.set, shader::kBindMaterial, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                into.material_data.get(), i * kMaterialStride, sizeof(shader::MaterialData));
  }
}

void list_parts(const Model& model, GpuModel& into) {
  for (const Mesh& mesh : model.meshes) {
    GpuMesh& gpu_mesh = into.meshes.emplace_back();
    gpu_mesh.first_part = static_cast<std::uint32_t>(into.parts.size());
    gpu_mesh.part_count = static_cast<std::uint32_t>(mesh.primitives.size());
    gpu_mesh.first_vertex = mesh.first_vertex;
    gpu_mesh.vertex_count = mesh.vertex_count;
    for (const Primitive& primitive : mesh.primitives) {
      const Box box{primitive.low, primitive.high};
      const auto material = primitive.material == kNone ? static_cast<std::uint32_t>(model.materials.size())
                                                        : static_cast<std::uint32_t>(primitive.material);
      gpu_mesh.box = &primitive == &mesh.primitives.front() ? box : united(gpu_mesh.box, box);
      into.parts.push_back({primitive.first_index, primitive.index_count, material, box});
    }
  }
}

Box box_at_rest(const Model& model, const GpuModel& gpu_model) {
  const std::vector<glm::mat4> world = rest_pose(model);
  Box total;
  bool first = true;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes[i].mesh == kNone) continue;
    const Box box = transformed(world[i], gpu_model.meshes[static_cast<std::size_t>(model.nodes[i].mesh)].box);
    total = first ? box : united(total, box);
    first = false;
  }
  return total;
}

}  // namespace

GpuModel upload_model(Gpu& gpu, const Model& model, VkDescriptorSetLayout material_layout) {
  GpuModel gpu_model;
  if (!model.indices.empty()) {
    gpu_model.vertices =
        make_device_buffer(gpu, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, std::as_bytes(std::span(model.vertices)));
    gpu_model.indices =
        make_device_buffer(gpu, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, std::as_bytes(std::span(model.indices)));
  }
  upload_textures(gpu, model, gpu_model);
  upload_materials(gpu, model, material_layout, gpu_model);
  list_parts(model, gpu_model);
  for (const Node& node : model.nodes) gpu_model.mesh_of_node.push_back(node.mesh);
  gpu_model.box = box_at_rest(model, gpu_model);
  return gpu_model;
}

}  // namespace gearshift::engine
