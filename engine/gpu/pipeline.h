// Compact description of graphics pipelines for dynamic rendering.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/gpu/gpu.h"

namespace gearshift::engine {

struct VertexInput {
  std::uint32_t stride = 0;  // 0: the shader generates the vertices
  std::vector<VkVertexInputAttributeDescription> attributes;
};

enum class Blend { none, alpha };        // alpha: source over destination, with straight (not premultiplied) alpha
enum class Depth { none, test, write };  // test: greater or equal (reverse-Z); write: test and write

struct PipelineDesc {
  std::span<const std::uint32_t> vertex;    // SPIR-V
  std::span<const std::uint32_t> fragment;  // empty: depth only
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VertexInput input;
  VkFormat colour = VK_FORMAT_UNDEFINED;
  VkFormat depth = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  Blend blend = Blend::none;
  Depth depth_use = Depth::none;
  float depth_bias = 0.0f, depth_slope = 0.0f;
  // Clamps depth if the device supports it. Needed for shadow casters in front of a shadow map's near plane.
  bool depth_clamp = false;
  std::span<const std::uint32_t> constants;  // values of specialization constants 0, 1, 2, ... in both stages
};
// Makes a pipeline for triangle lists. Viewport, scissor, cull mode and front face are dynamic state.
Pipeline make_pipeline(const Gpu& gpu, const PipelineDesc& desc);

struct Binding {
  std::uint32_t binding = 0;
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  VkShaderStageFlags stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
  std::uint32_t count = 1;
};
SetLayout make_set_layout(const Gpu& gpu, std::span<const Binding> bindings);
PipelineLayout make_pipeline_layout(const Gpu& gpu, std::span<const VkDescriptorSetLayout> sets,
                                    std::uint32_t push_constant_bytes);

// Descriptor pool of fixed size: sets are allocated once and live as long as the pool.
class SetPool {
 public:
  SetPool() = default;
  SetPool(const Gpu& gpu, std::uint32_t sets, std::span<const VkDescriptorPoolSize> sizes);
  VkDescriptorSet make(VkDescriptorSetLayout layout);

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  DescriptorPool pool_;
};

void bind_buffer(const Gpu& gpu, VkDescriptorSet set, std::uint32_t binding, VkDescriptorType type, VkBuffer buffer,
                 VkDeviceSize offset = 0, VkDeviceSize size = VK_WHOLE_SIZE);
void bind_texture(const Gpu& gpu, VkDescriptorSet set, std::uint32_t binding, VkImageView view, VkSampler sampler);

}  // namespace gearshift::engine
