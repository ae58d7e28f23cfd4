#include "engine/render/samplers.h"

namespace gearshift::engine {

namespace {

VkSamplerAddressMode address_mode(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case Wrap::mirror:
      return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    default:
      return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  }
}

constexpr VkSamplerAddressMode kClamp = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;

}  // namespace

Sampler texture_sampler(const Gpu& gpu, const Texture& texture) {
  return make_sampler(gpu, {.linear = texture.linear,
                            .u = address_mode(texture.wrap_u),
                            .v = address_mode(texture.wrap_v),
                            .anisotropic = texture.linear});
}

Sampler picture_sampler(const Gpu& gpu) {
  return make_sampler(gpu, {.u = kClamp, .v = kClamp});
}

// Interpolating between two roughness levels is expensive on a software driver, so software drivers do not interpolate.
Sampler reflection_sampler(const Gpu& gpu) {
  if (!gpu.traits().is_cpu) return picture_sampler(gpu);
  const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                 .magFilter = VK_FILTER_LINEAR,
                                 .minFilter = VK_FILTER_LINEAR,
                                 .mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                 .addressModeU = kClamp,
                                 .addressModeV = kClamp,
                                 .addressModeW = kClamp,
                                 .maxLod = VK_LOD_CLAMP_NONE};
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(gpu.device(), &info, nullptr, &sampler), "vkCreateSampler");
  return {gpu.device(), sampler};
}

Sampler shadow_sampler(const Gpu& gpu) {
  return make_sampler(gpu, {.linear = false, .u = kClamp, .v = kClamp, .mips = false, .compare = true});
}

}  // namespace gearshift::engine
