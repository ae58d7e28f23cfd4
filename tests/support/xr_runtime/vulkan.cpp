#include "tests/support/xr_runtime/vulkan.h"

#include <cstring>
#include <stdexcept>
#include <string>

namespace gearshift::xr_test {
namespace {

void check_vk(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + " failed: " + std::to_string(result));
}

std::uint32_t memory_type(const Graphics& graphics, std::uint32_t bits, VkMemoryPropertyFlags wanted) {
  for (std::uint32_t i = 0; i < graphics.memory.memoryTypeCount; ++i) {
    if ((bits >> i & 1u) != 0 && (graphics.memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  }
  throw std::runtime_error("no Vulkan memory of the kind");
}

VkDeviceMemory allocate(const Graphics& graphics, const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) {
  const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                  .allocationSize = needs.size,
                                  .memoryTypeIndex = memory_type(graphics, needs.memoryTypeBits, wanted)};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check_vk(graphics.AllocateMemory(graphics.device, &info, nullptr, &memory), "vkAllocateMemory");
  return memory;
}

VkImageUsageFlags usage(const XrSwapchainCreateInfo& info) {
  // All images can be attachments, because XR_KHR_vulkan_enable2 promises an attachment layout. They can also be read.
  VkImageUsageFlags flags =
      VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
      (is_depth(info.format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  if ((info.usageFlags & XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT) != 0) flags |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if ((info.usageFlags & XR_SWAPCHAIN_USAGE_SAMPLED_BIT) != 0) flags |= VK_IMAGE_USAGE_SAMPLED_BIT;
  if ((info.usageFlags & XR_SWAPCHAIN_USAGE_UNORDERED_ACCESS_BIT) != 0) flags |= VK_IMAGE_USAGE_STORAGE_BIT;
  return flags;
}

VkImageLayout promised_layout(std::int64_t format) {
  return is_depth(format) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}

VkImageAspectFlags aspect(std::int64_t format) {
  return is_depth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

void barrier(const Graphics& graphics, VkImage image, std::int64_t format, VkImageLayout from, VkImageLayout to) {
  const VkImageMemoryBarrier all{
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
      .srcAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
      .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
      .oldLayout = from,
      .newLayout = to,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image,
      .subresourceRange = {aspect(format), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
  graphics.CmdPipelineBarrier(graphics.commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                              0, 0, nullptr, 0, nullptr, 1, &all);
}

void begin_commands(const Graphics& graphics) {
  check_vk(graphics.ResetCommandPool(graphics.device, graphics.pool, 0), "vkResetCommandPool");
  const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                      .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check_vk(graphics.BeginCommandBuffer(graphics.commands, &info), "vkBeginCommandBuffer");
}

void run_and_wait(const Graphics& graphics) {
  check_vk(graphics.EndCommandBuffer(graphics.commands), "vkEndCommandBuffer");
  const VkSubmitInfo submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &graphics.commands};
  check_vk(graphics.QueueSubmit(graphics.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  check_vk(graphics.QueueWaitIdle(graphics.queue), "vkQueueWaitIdle");
}

struct HostBuffer {
  HostBuffer(const Graphics& device, VkDeviceSize size) : graphics(device) {
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    check_vk(graphics.CreateBuffer(graphics.device, &info, nullptr, &buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    graphics.GetBufferMemoryRequirements(graphics.device, buffer, &needs);
    memory = allocate(graphics, needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check_vk(graphics.BindBufferMemory(graphics.device, buffer, memory, 0), "vkBindBufferMemory");
    check_vk(graphics.MapMemory(graphics.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
  }
  ~HostBuffer() {
    graphics.DestroyBuffer(graphics.device, buffer, nullptr);
    graphics.FreeMemory(graphics.device, memory, nullptr);
  }
  HostBuffer(const HostBuffer&) = delete;
  HostBuffer& operator=(const HostBuffer&) = delete;

  const Graphics& graphics;
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
};

}  // namespace

bool is_depth(std::int64_t format) {
  return format >= VK_FORMAT_D16_UNORM && format <= VK_FORMAT_D32_SFLOAT_S8_UINT;
}

Graphics open_graphics(const XrGraphicsBindingVulkanKHR& binding, PFN_vkGetInstanceProcAddr get) {
  Graphics graphics;
  graphics.instance = binding.instance;
  graphics.device = binding.device;
  const auto get_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(get(binding.instance, "vkGetDeviceProcAddr"));
#define GEARSHIFT_XR_LOAD(name) graphics.name = reinterpret_cast<PFN_vk##name>(get_device(binding.device, "vk" #name));
  GEARSHIFT_XR_VULKAN_FUNCTIONS(GEARSHIFT_XR_LOAD)
#undef GEARSHIFT_XR_LOAD
  reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(
      get(binding.instance, "vkGetPhysicalDeviceMemoryProperties"))(binding.physicalDevice, &graphics.memory);
  graphics.GetDeviceQueue(binding.device, binding.queueFamilyIndex, binding.queueIndex, &graphics.queue);
  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .queueFamilyIndex = binding.queueFamilyIndex};
  check_vk(graphics.CreateCommandPool(binding.device, &pool, nullptr, &graphics.pool), "vkCreateCommandPool");
  const VkCommandBufferAllocateInfo one{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                        .commandPool = graphics.pool,
                                        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                        .commandBufferCount = 1};
  check_vk(graphics.AllocateCommandBuffers(binding.device, &one, &graphics.commands), "vkAllocateCommandBuffers");
  return graphics;
}

void close_graphics(Graphics& graphics) {
  graphics.DestroyCommandPool(graphics.device, graphics.pool, nullptr);
}

std::vector<SwapchainImage> make_images(const Graphics& graphics, const XrSwapchainCreateInfo& info,
                                        std::uint32_t count) {
  const bool is_mutable = (info.usageFlags & XR_SWAPCHAIN_USAGE_MUTABLE_FORMAT_BIT) != 0;
  const VkImageCreateInfo image_info{
      .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
      .flags = is_mutable ? VkImageCreateFlags{VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT} : VkImageCreateFlags{0},
      .imageType = VK_IMAGE_TYPE_2D,
      .format = static_cast<VkFormat>(info.format),
      .extent = {info.width, info.height, 1},
      .mipLevels = info.mipCount,
      .arrayLayers = info.arraySize,
      .samples = static_cast<VkSampleCountFlagBits>(info.sampleCount),
      .tiling = VK_IMAGE_TILING_OPTIMAL,
      .usage = usage(info),
  };
  std::vector<SwapchainImage> images(count);
  for (SwapchainImage& image : images) {
    check_vk(graphics.CreateImage(graphics.device, &image_info, nullptr, &image.image), "vkCreateImage");
    VkMemoryRequirements needs;
    graphics.GetImageMemoryRequirements(graphics.device, image.image, &needs);
    image.memory = allocate(graphics, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check_vk(graphics.BindImageMemory(graphics.device, image.image, image.memory, 0), "vkBindImageMemory");
  }
  return images;
}

void free_images(const Graphics& graphics, std::vector<SwapchainImage>& images) {
  for (const SwapchainImage& image : images) {
    graphics.DestroyImage(graphics.device, image.image, nullptr);
    graphics.FreeMemory(graphics.device, image.memory, nullptr);
  }
  images.clear();
}

void set_initial_layout(const Graphics& graphics, SwapchainImage& image, const XrSwapchainCreateInfo& info) {
  if (image.has_layout) return;
  begin_commands(graphics);
  barrier(graphics, image.image, info.format, VK_IMAGE_LAYOUT_UNDEFINED, promised_layout(info.format));
  run_and_wait(graphics);
  image.has_layout = true;
}

std::vector<std::uint8_t> read_pixels(const Graphics& graphics, VkImage image, std::int64_t format, ReadRegion region) {
  const std::size_t size = std::size_t{4} * region.width * region.height;
  const HostBuffer buffer(graphics, size);
  begin_commands(graphics);
  barrier(graphics, image, format, promised_layout(format), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  const VkBufferImageCopy copy{.imageSubresource = {aspect(format), 0, region.layer, 1},
                               .imageOffset = {region.x, region.y, 0},
                               .imageExtent = {region.width, region.height, 1}};
  graphics.CmdCopyImageToBuffer(graphics.commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer, 1,
                                &copy);
  barrier(graphics, image, format, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, promised_layout(format));
  run_and_wait(graphics);
  std::vector<std::uint8_t> bytes(size);
  std::memcpy(bytes.data(), buffer.mapped, size);
  return bytes;
}

}  // namespace gearshift::xr_test
