// Creates descriptor set layouts, pipeline layouts and descriptor sets, and binds resources in the sets.
#include "engine/gpu/pipeline.h"

namespace gearshift::engine {

SetLayout make_set_layout(const Gpu& gpu, std::span<const Binding> bindings) {
  std::vector<VkDescriptorSetLayoutBinding> list;
  for (const Binding& b : bindings) {
    list.push_back(
        {.binding = b.binding, .descriptorType = b.type, .descriptorCount = b.count, .stageFlags = b.stages});
  }
  const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                             .bindingCount = static_cast<std::uint32_t>(list.size()),
                                             .pBindings = list.data()};
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(gpu.device(), &info, nullptr, &layout), "vkCreateDescriptorSetLayout");
  return {gpu.device(), layout};
}

PipelineLayout make_pipeline_layout(const Gpu& gpu, std::span<const VkDescriptorSetLayout> sets,
                                    std::uint32_t push_constant_bytes) {
  const VkPushConstantRange range{.stageFlags = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
                                  .size = push_constant_bytes};
  const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                        .setLayoutCount = static_cast<std::uint32_t>(sets.size()),
                                        .pSetLayouts = sets.data(),
                                        .pushConstantRangeCount = push_constant_bytes > 0 ? 1u : 0u,
                                        .pPushConstantRanges = &range};
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(gpu.device(), &info, nullptr, &layout), "vkCreatePipelineLayout");
  return {gpu.device(), layout};
}

SetPool::SetPool(const Gpu& gpu, std::uint32_t sets, std::span<const VkDescriptorPoolSize> sizes)
    : device_(gpu.device()) {
  const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .maxSets = sets,
                                        .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                        .pPoolSizes = sizes.data()};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device_, &info, nullptr, &pool), "vkCreateDescriptorPool");
  pool_ = DescriptorPool(device_, pool);
}

VkDescriptorSet SetPool::make(VkDescriptorSetLayout layout) {
  const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                         .descriptorPool = pool_.get(),
                                         .descriptorSetCount = 1,
                                         .pSetLayouts = &layout};
  VkDescriptorSet set = VK_NULL_HANDLE;
  check(vkAllocateDescriptorSets(device_, &info, &set), "vkAllocateDescriptorSets");
  return set;
}

void bind_buffer(const Gpu& gpu, VkDescriptorSet set, std::uint32_t binding, VkDescriptorType type, VkBuffer buffer,
                 VkDeviceSize offset, VkDeviceSize size) {
  const VkDescriptorBufferInfo content{.buffer = buffer, .offset = offset, .range = size};
  const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = set,
                                   .dstBinding = binding,
                                   .descriptorCount = 1,
                                   .descriptorType = type,
                                   .pBufferInfo = &content};
  vkUpdateDescriptorSets(gpu.device(), 1, &write, 0, nullptr);
}

void bind_texture(const Gpu& gpu, VkDescriptorSet set, std::uint32_t binding, VkImageView view, VkSampler sampler) {
  const VkDescriptorImageInfo content{
      .sampler = sampler, .imageView = view, .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = set,
                                   .dstBinding = binding,
                                   .descriptorCount = 1,
                                   .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                   .pImageInfo = &content};
  vkUpdateDescriptorSets(gpu.device(), 1, &write, 0, nullptr);
}

}  // namespace gearshift::engine
