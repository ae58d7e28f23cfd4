#include "engine/render/frame_slot.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace gearshift::engine {

namespace {

// [bytes] Distance between the data of two passes in the uniform buffer: a multiple of 256, the largest offset
// alignment that a device may require (Vulkan 1.3, required limits).
constexpr VkDeviceSize kPassStride = (sizeof(shader::PassData) + 255) / 256 * 256;

// The normal matrix is the inverse transpose times the absolute value of the determinant, that is, the cofactor matrix
// times the sign of the determinant.
shader::ObjectData object_data(const NodeState& state) {
  const glm::vec3 x(state.world[0]), y(state.world[1]), z(state.world[2]);
  const float sign = glm::dot(glm::cross(x, y), z) < 0.0f ? -1.0f : 1.0f;
  shader::ObjectData data{};
  data.world = state.world;
  data.normal[0] = glm::vec4(sign * glm::cross(y, z), sign);
  data.normal[1] = glm::vec4(sign * glm::cross(z, x), 0.0f);
  data.normal[2] = glm::vec4(sign * glm::cross(x, y), 0.0f);
  data.uv_shift = glm::vec4(state.uv_shift, 0.0f, 0.0f);
  return data;
}

Box box_of(std::span<const Vertex> vertices) {
  Box box{vertices.front().position, vertices.front().position};
  for (const Vertex& vertex : vertices) {
    box.low = glm::min(box.low, vertex.position);
    box.high = glm::max(box.high, vertex.position);
  }
  return box;
}

void grow(Gpu& gpu, GpuBuffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage) {
  if (buffer.size() < size) buffer = GpuBuffer(gpu, size, usage, MemoryKind::upload);
}

}  // namespace

FrameSlot::FrameSlot(Gpu& gpu, const std::array<VkDescriptorSet, kPassKinds>& sets)
    : sets_(sets), passes_(gpu, kPassKinds * kPassStride, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryKind::upload) {
  for (std::size_t pass = 0; pass < kPassKinds; ++pass)
    bind_buffer(gpu, sets_[pass], shader::kBindPass, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, passes_.get(),
                pass * kPassStride, sizeof(shader::PassData));
}

void FrameSlot::write_pass(PassKind pass, const shader::PassData& data) {
  std::memcpy(passes_.mapped() + static_cast<std::size_t>(pass) * kPassStride, &data, sizeof data);
}

void FrameSlot::write_objects(Gpu& gpu, const FrameScene& scene) {
  const VkDeviceSize size = std::max<std::size_t>(1, scene.nodes.size()) * sizeof(shader::ObjectData);
  if (objects_.size() < size) {
    grow(gpu, objects_, size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    for (const VkDescriptorSet set : sets_)
      bind_buffer(gpu, set, shader::kBindObjects, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, objects_.get());
  }
  std::byte* to = objects_.mapped();
  for (const NodeState& state : scene.nodes) {
    const shader::ObjectData data = object_data(state);
    std::memcpy(to, &data, sizeof data);
    to += sizeof data;
  }
}

std::vector<DeformedRange> FrameSlot::write_deformed(Gpu& gpu, const GpuModel& model,
                                                     std::span<const DeformedMesh> meshes) {
  std::vector<DeformedRange> ranges;
  std::uint32_t count = 0;
  for (const DeformedMesh& mesh : meshes) {
    const auto index = static_cast<std::size_t>(mesh.mesh);
    if (mesh.mesh < 0 || index >= model.meshes.size() || mesh.vertices.size() != model.meshes[index].vertex_count ||
        mesh.vertices.empty())
      throw std::invalid_argument("A deformed mesh is not in the model, or has a different number of vertices.");
    ranges.push_back({mesh.mesh, mesh.node, count, box_of(mesh.vertices)});
    count += static_cast<std::uint32_t>(mesh.vertices.size());
  }
  if (count == 0) return ranges;
  grow(gpu, vertices_, count * sizeof(Vertex), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  for (std::size_t i = 0; i < meshes.size(); ++i)
    std::memcpy(vertices_.mapped() + ranges[i].first_vertex * sizeof(Vertex), meshes[i].vertices.data(),
                meshes[i].vertices.size() * sizeof(Vertex));
  return ranges;
}

}  // namespace gearshift::engine
