#include "tests/engine/render/counted_pipelines.h"

#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <cstdint>

int gearshift::test::compiled_pipelines = 0;

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkCreateGraphicsPipelines(VkDevice device, VkPipelineCache cache,
                                                                    std::uint32_t count,
                                                                    const VkGraphicsPipelineCreateInfo* infos,
                                                                    const VkAllocationCallbacks* allocator,
                                                                    VkPipeline* pipelines) {
  gearshift::test::compiled_pipelines += static_cast<int>(count);
  const auto real = reinterpret_cast<PFN_vkCreateGraphicsPipelines>(dlsym(RTLD_NEXT, "vkCreateGraphicsPipelines"));
  return real(device, cache, count, infos, allocator, pipelines);
}
