#include "engine/gpu/pipeline.h"

#include <array>

namespace gearshift::engine {
namespace {

ShaderModule make_module(const Gpu& gpu, std::span<const std::uint32_t> code) {
  const VkShaderModuleCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = code.size_bytes(), .pCode = code.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(gpu.device(), &info, nullptr, &module), "vkCreateShaderModule");
  return {gpu.device(), module};
}

std::vector<VkSpecializationMapEntry> constant_entries(std::size_t count) {
  std::vector<VkSpecializationMapEntry> entries(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    entries[i] = {.constantID = i, .offset = i * 4, .size = sizeof(std::uint32_t)};
  }
  return entries;
}

VkPipelineColorBlendAttachmentState blend_state(Blend blend) {
  return {.blendEnable = blend == Blend::alpha ? VK_TRUE : VK_FALSE,
          .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
          .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
          .colorBlendOp = VK_BLEND_OP_ADD,
          .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
          .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
          .alphaBlendOp = VK_BLEND_OP_ADD,
          .colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                            VK_COLOR_COMPONENT_A_BIT};
}

VkPipelineRasterizationStateCreateInfo raster_state(const Gpu& gpu, const PipelineDesc& desc) {
  const bool biased = desc.depth_bias != 0.0f || desc.depth_slope != 0.0f;
  return {.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
          .depthClampEnable = desc.depth_clamp && gpu.traits().depth_clamp ? VK_TRUE : VK_FALSE,
          .polygonMode = VK_POLYGON_MODE_FILL,
          .depthBiasEnable = biased ? VK_TRUE : VK_FALSE,
          .depthBiasConstantFactor = desc.depth_bias,
          .depthBiasSlopeFactor = desc.depth_slope,
          .lineWidth = 1.0f};
}

VkPipelineDepthStencilStateCreateInfo depth_state(Depth use) {
  return {.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
          .depthTestEnable = use != Depth::none ? VK_TRUE : VK_FALSE,
          .depthWriteEnable = use == Depth::write ? VK_TRUE : VK_FALSE,
          .depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL};
}

}  // namespace

Pipeline make_pipeline(const Gpu& gpu, const PipelineDesc& desc) {
  const ShaderModule vertex = make_module(gpu, desc.vertex);
  const ShaderModule fragment = desc.fragment.empty() ? ShaderModule{} : make_module(gpu, desc.fragment);
  const auto entries = constant_entries(desc.constants.size());
  const VkSpecializationInfo constants{.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                                       .pMapEntries = entries.data(),
                                       .dataSize = desc.constants.size_bytes(),
                                       .pData = desc.constants.data()};
  const auto stage = [&](VkShaderStageFlagBits bit, VkShaderModule module) {
    return VkPipelineShaderStageCreateInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                           .stage = bit,
                                           .module = module,
                                           .pName = "main",
                                           .pSpecializationInfo = &constants};
  };
  const std::array stages{stage(VK_SHADER_STAGE_VERTEX_BIT, vertex.get()),
                          stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get())};

  const VkVertexInputBindingDescription binding{.stride = desc.input.stride};
  const VkPipelineVertexInputStateCreateInfo input{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
      .vertexBindingDescriptionCount = desc.input.stride > 0 ? 1u : 0u,
      .pVertexBindingDescriptions = &binding,
      .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(desc.input.attributes.size()),
      .pVertexAttributeDescriptions = desc.input.attributes.data()};
  const VkPipelineInputAssemblyStateCreateInfo assembly{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
      .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  const VkPipelineViewportStateCreateInfo viewport{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
  const VkPipelineRasterizationStateCreateInfo raster = raster_state(gpu, desc);
  const VkPipelineMultisampleStateCreateInfo multisample{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO, .rasterizationSamples = desc.samples};
  const VkPipelineDepthStencilStateCreateInfo depth = depth_state(desc.depth_use);
  const VkPipelineColorBlendAttachmentState attachment = blend_state(desc.blend);
  const bool has_colour = desc.colour != VK_FORMAT_UNDEFINED;
  const VkPipelineColorBlendStateCreateInfo blend{.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                                                  .attachmentCount = has_colour ? 1u : 0u,
                                                  .pAttachments = &attachment};
  const std::array dynamics{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_CULL_MODE,
                            VK_DYNAMIC_STATE_FRONT_FACE};
  const VkPipelineDynamicStateCreateInfo dynamic{.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                 .dynamicStateCount = static_cast<std::uint32_t>(dynamics.size()),
                                                 .pDynamicStates = dynamics.data()};
  const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                .colorAttachmentCount = has_colour ? 1u : 0u,
                                                .pColorAttachmentFormats = &desc.colour,
                                                .depthAttachmentFormat = desc.depth};
  const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                          .pNext = &rendering,
                                          .stageCount = fragment ? 2u : 1u,
                                          .pStages = stages.data(),
                                          .pVertexInputState = &input,
                                          .pInputAssemblyState = &assembly,
                                          .pViewportState = &viewport,
                                          .pRasterizationState = &raster,
                                          .pMultisampleState = &multisample,
                                          .pDepthStencilState = &depth,
                                          .pColorBlendState = &blend,
                                          .pDynamicState = &dynamic,
                                          .layout = desc.layout};
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(gpu.device(), gpu.cache(), 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
  return {gpu.device(), pipeline};
}

}  // namespace gearshift::engine
