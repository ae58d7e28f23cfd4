// The table of image uses and the barriers derived from it. Only this file knows layouts, stages and accesses.
#include <array>
#include <stdexcept>
#include <string>

#include "engine/gpu/gpu_image.h"

namespace gearshift::engine {
namespace {

struct Scope {
  const char* name;
  VkImageLayout layout;
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 reads, writes;
};

// One row per ImageUse, in the enum's order. `none` as a source means any earlier use. `present` waits and signals at
// the stage where Gpu::submit waits for the swapchain's semaphore, so that the next use of the image is ordered after
// its acquisition.
constexpr std::array<Scope, 8> kScopes{{
    {"none", VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0, VK_ACCESS_2_MEMORY_WRITE_BIT},
    {"colour_target", VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT},
    {"depth_target", VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
     VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT},
    // Vulkan resolves depth in the colour output stage (specification, section "Render Pass Multisample Resolve
    // Operations").
    {"depth_resolved", VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
     VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT},
    {"sampled", VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
     VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0},
    {"copy_from", VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
     VK_ACCESS_2_TRANSFER_READ_BIT, 0},
    {"copy_to", VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0,
     VK_ACCESS_2_TRANSFER_WRITE_BIT},
    {"present", VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0, 0},
}};

const Scope& scope_of(ImageUse use) {
  return kScopes[static_cast<std::size_t>(use)];
}

}  // namespace

VkImageLayout layout_of(ImageUse use) noexcept {
  return scope_of(use).layout;
}

std::optional<VkImageMemoryBarrier2> barrier_between(ImageUse from, ImageUse to, VkImageAspectFlags aspect,
                                                     ImageUse discarded_use) {
  if (to == ImageUse::none)
    throw std::logic_error("An image cannot transition to no use; call discard_content() instead.");
  const Scope& target = scope_of(to);
  if (from == to && target.writes == 0) return std::nullopt;
  const Scope& source = scope_of(from == ImageUse::none ? discarded_use : from);
  return VkImageMemoryBarrier2{
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
      .srcStageMask = source.stages,
      .srcAccessMask = source.writes,  // 0 after a read, because there is nothing to flush
      .dstStageMask = target.stages,
      .dstAccessMask = target.reads | target.writes,
      .oldLayout = layout_of(from),
      .newLayout = target.layout,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .subresourceRange = {
          .aspectMask = aspect, .levelCount = VK_REMAINING_MIP_LEVELS, .layerCount = VK_REMAINING_ARRAY_LAYERS}};
}

void transition(VkCommandBuffer commands, GpuImage& image, ImageUse use, std::uint32_t first_level,
                std::uint32_t level_count) {
  const std::uint32_t end = level_count == kAllLevels ? image.desc().levels : first_level + level_count;
  if (end > image.desc().levels)
    throw std::logic_error("A transition includes mip levels that the image does not have.");
  std::vector<VkImageMemoryBarrier2> barriers;
  for (std::uint32_t level = first_level; level < end; ++level) {
    auto& state = image.states_[level];
    auto barrier = barrier_between(state.use, use, image.aspect(), state.discarded_use);
    state = {.use = use};
    if (!barrier) continue;
    barrier->image = image.get();
    barrier->subresourceRange.baseMipLevel = level;
    barrier->subresourceRange.levelCount = 1;
    barriers.push_back(*barrier);
  }
  if (barriers.empty()) return;
  const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                    .imageMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
                                    .pImageMemoryBarriers = barriers.data()};
  vkCmdPipelineBarrier2(commands, &dependency);
}

void expect(const GpuImage& image, ImageUse use, std::uint32_t level) {
  if (image.use(level) == use) return;
  throw std::logic_error(std::string("An image is used as ") + scope_of(use).name + " but is in state " +
                         scope_of(image.use(level)).name + ".");
}

void discard_content(GpuImage& image) noexcept {
  for (auto& state : image.states_) {
    if (state.use != ImageUse::none) state = {.use = ImageUse::none, .discarded_use = state.use};
  }
}

}  // namespace gearshift::engine
