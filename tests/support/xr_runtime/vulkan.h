// Creates images on the program's Vulkan device and reads their pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
#include <time.h>

// Fields left out of a designated initializer are zero, as Vulkan requires for unused fields.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

// clang-format off
#define GEARSHIFT_XR_VULKAN_FUNCTIONS(_)                                                                               \
  _(CreateImage) _(DestroyImage) _(GetImageMemoryRequirements) _(AllocateMemory) _(FreeMemory) _(BindImageMemory)      \
  _(CreateBuffer) _(DestroyBuffer) _(GetBufferMemoryRequirements) _(BindBufferMemory) _(MapMemory)                     \
  _(CreateCommandPool) _(DestroyCommandPool) _(AllocateCommandBuffers) _(BeginCommandBuffer) _(EndCommandBuffer)       \
  _(CmdPipelineBarrier) _(CmdCopyImageToBuffer) _(QueueSubmit) _(QueueWaitIdle) _(ResetCommandPool) _(GetDeviceQueue)
// clang-format on

namespace gearshift::xr_test {

struct SwapchainImage {
  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  bool has_layout = false;  // already in the layout that XR_KHR_vulkan_enable2 promises
};

struct Graphics {
  VkInstance instance = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory{};
#define GEARSHIFT_XR_FIELD(name) PFN_vk##name name = nullptr;
  GEARSHIFT_XR_VULKAN_FUNCTIONS(GEARSHIFT_XR_FIELD)
#undef GEARSHIFT_XR_FIELD
};

// These functions throw std::runtime_error if Vulkan fails.
Graphics open_graphics(const XrGraphicsBindingVulkanKHR& binding, PFN_vkGetInstanceProcAddr get);
void close_graphics(Graphics& graphics);
bool is_depth(std::int64_t format);
std::vector<SwapchainImage> make_images(const Graphics& graphics, const XrSwapchainCreateInfo& info,
                                        std::uint32_t count);
void free_images(const Graphics& graphics, std::vector<SwapchainImage>& images);
void set_initial_layout(const Graphics& graphics, SwapchainImage& image, const XrSwapchainCreateInfo& info);

// The region that read_pixels() reads: four bytes per pixel, rows from the top. The image must be in the layout that
// XR_KHR_vulkan_enable2 promises. Its format must be a colour format of four bytes or a 32-bit depth format.
struct ReadRegion {
  int x = 0, y = 0;
  std::uint32_t width = 0, height = 0, layer = 0;
};
std::vector<std::uint8_t> read_pixels(const Graphics& graphics, VkImage image, std::int64_t format, ReadRegion region);

}  // namespace gearshift::xr_test
