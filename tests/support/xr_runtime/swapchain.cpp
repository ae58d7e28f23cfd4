// Swapchains: the program acquires their images in turn. Vulkan images on the program's device, and their pixels.
#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

constexpr std::uint32_t kImages = 3;  // per swapchain

void check_vk(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + " failed: " + std::to_string(result));
}

VkDeviceMemory allocate(const Graphics& graphics, const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(graphics.physical, &memory);
  std::uint32_t type = 0;  // Vulkan guarantees that there is one
  while ((needs.memoryTypeBits >> type & 1u) == 0 || (memory.memoryTypes[type].propertyFlags & wanted) != wanted)
    ++type;
  const VkMemoryAllocateInfo info{
      .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = type};
  VkDeviceMemory allocated = VK_NULL_HANDLE;
  check_vk(vkAllocateMemory(graphics.device, &info, nullptr, &allocated), "vkAllocateMemory");
  return allocated;
}

VkImageLayout promised_layout(std::int64_t format) {
  return is_depth(format) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}

VkImageAspectFlags aspect(std::int64_t format) {
  return is_depth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

void barrier(VkCommandBuffer commands, VkImage image, std::int64_t format, VkImageLayout from, VkImageLayout to) {
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
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr,
                       0, nullptr, 1, &all);
}

// Runs the commands that `record` records, and waits for the GPU.
template <class Record>
void run(const Graphics& graphics, Record record) {
  const VkCommandBufferAllocateInfo one{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                        .commandPool = graphics.pool,
                                        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                        .commandBufferCount = 1};
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check_vk(vkAllocateCommandBuffers(graphics.device, &one, &commands), "vkAllocateCommandBuffers");
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                       .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check_vk(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  record(commands);
  check_vk(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  const VkSubmitInfo submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
  check_vk(vkQueueSubmit(graphics.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  check_vk(vkQueueWaitIdle(graphics.queue), "vkQueueWaitIdle");
  vkFreeCommandBuffers(graphics.device, graphics.pool, 1, &commands);
}

// All images can be attachments, because XR_KHR_vulkan_enable2 promises an attachment layout. They can also be read.
std::vector<SwapchainImage> make_images(const Graphics& graphics, const XrSwapchainCreateInfo& info) {
  VkImageUsageFlags usage =
      VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
      (is_depth(info.format) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  if ((info.usageFlags & XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT) != 0) usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  const VkImageCreateInfo image_info{
      .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
      .imageType = VK_IMAGE_TYPE_2D,
      .format = static_cast<VkFormat>(info.format),
      .extent = {info.width, info.height, 1},
      .mipLevels = 1,
      .arrayLayers = info.arraySize,
      .samples = VK_SAMPLE_COUNT_1_BIT,
      .tiling = VK_IMAGE_TILING_OPTIMAL,
      .usage = usage,
  };
  std::vector<SwapchainImage> images(kImages);
  for (SwapchainImage& image : images) {
    check_vk(vkCreateImage(graphics.device, &image_info, nullptr, &image.image), "vkCreateImage");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(graphics.device, image.image, &needs);
    image.memory = allocate(graphics, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check_vk(vkBindImageMemory(graphics.device, image.image, image.memory, 0), "vkBindImageMemory");
  }
  return images;
}

void free_images(const Graphics& graphics, const std::vector<SwapchainImage>& images) {
  for (const SwapchainImage& image : images) {
    vkDestroyImage(graphics.device, image.image, nullptr);
    vkFreeMemory(graphics.device, image.memory, nullptr);
  }
}

void set_initial_layout(const Graphics& graphics, SwapchainImage& image, std::int64_t format) {
  if (image.has_layout) return;
  run(graphics, [&](VkCommandBuffer commands) {
    barrier(commands, image.image, format, VK_IMAGE_LAYOUT_UNDEFINED, promised_layout(format));
  });
  image.has_layout = true;
}

std::vector<std::int64_t> formats(const Script& script) {
  std::vector<std::int64_t> all = script.colour_formats;
  all.insert(all.end(), script.depth_formats.begin(), script.depth_formats.end());
  return all;
}

void check_create_info(const Script& script, const XrSwapchainCreateInfo& info) {
  const std::vector<std::int64_t> known = formats(script);
  require(std::find(known.begin(), known.end(), info.format) != known.end(), "offered", "format");
  const auto within = [](std::uint32_t value, std::uint32_t limit) { return value >= 1 && value <= limit; };
  require(within(info.width, script.max_width) && within(info.height, script.max_width) && info.sampleCount == 1 &&
              within(info.arraySize, 2) && info.mipCount == 1 && info.faceCount == 1,
          "swapchain_size");
}

}  // namespace

bool is_depth(std::int64_t format) {
  return format >= VK_FORMAT_D16_UNORM && format <= VK_FORMAT_D32_SFLOAT_S8_UINT;
}

Graphics open_graphics(const XrSessionCreateInfo& info) {
  const State& s = state();
  const auto& binding =
      *static_cast<const XrGraphicsBindingVulkanKHR*>(find_chained(&info, XR_TYPE_GRAPHICS_BINDING_VULKAN_KHR));
  const bool is_ours = binding.device == s.vulkan_device && binding.physicalDevice == s.vulkan_physical &&
                       binding.instance == s.vulkan_instance;
  require(is_ours, "graphics", "the device is not of xrCreateVulkanDeviceKHR");
  Graphics graphics{.physical = binding.physicalDevice, .device = binding.device};
  vkGetDeviceQueue(binding.device, binding.queueFamilyIndex, binding.queueIndex, &graphics.queue);
  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .queueFamilyIndex = binding.queueFamilyIndex};
  check_vk(vkCreateCommandPool(binding.device, &pool, nullptr, &graphics.pool), "vkCreateCommandPool");
  return graphics;
}

void close_graphics(const Graphics& graphics) {
  vkDestroyCommandPool(graphics.device, graphics.pool, nullptr);
}

std::vector<std::uint8_t> read_pixels(const XrSwapchainSubImage& region) {
  const Object<XrSwapchain>& swapchain = live(region.swapchain);
  const Graphics& graphics = live(swapchain.parent).graphics;
  const VkImage image = swapchain.images[*swapchain.released].image;
  const std::int64_t format = swapchain.info.format;
  const VkOffset3D offset{region.imageRect.offset.x, region.imageRect.offset.y, 0};
  const VkExtent3D extent{static_cast<std::uint32_t>(region.imageRect.extent.width),
                          static_cast<std::uint32_t>(region.imageRect.extent.height), 1};
  std::vector<std::uint8_t> bytes(std::size_t{4} * extent.width * extent.height);
  const VkBufferCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes.size(), .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
  VkBuffer buffer = VK_NULL_HANDLE;
  check_vk(vkCreateBuffer(graphics.device, &info, nullptr, &buffer), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(graphics.device, buffer, &needs);
  const VkDeviceMemory memory =
      allocate(graphics, needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check_vk(vkBindBufferMemory(graphics.device, buffer, memory, 0), "vkBindBufferMemory");
  run(graphics, [&](VkCommandBuffer commands) {
    barrier(commands, image, format, promised_layout(format), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy copy{.imageSubresource = {aspect(format), 0, region.imageArrayIndex, 1},
                                 .imageOffset = offset,
                                 .imageExtent = extent};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &copy);
    barrier(commands, image, format, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, promised_layout(format));
  });
  void* mapped = nullptr;
  check_vk(vkMapMemory(graphics.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
  std::memcpy(bytes.data(), mapped, bytes.size());
  vkDestroyBuffer(graphics.device, buffer, nullptr);
  vkFreeMemory(graphics.device, memory, nullptr);
  return bytes;
}

void drop_swapchain(XrSwapchain handle) {
  Object<XrSwapchain>& swapchain = state().all<XrSwapchain>().at(handle);
  free_images(state().all<XrSession>().at(swapchain.parent).graphics, swapchain.images);
  drop(handle);
}

XrResult XRAPI_CALL xr::EnumerateSwapchainFormats(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                                  std::int64_t* list) {
  return call("xrEnumerateSwapchainFormats", [&](State& s) {
    live(session);
    return fill(capacity, count, list, formats(s.control.script));
  });
}

XrResult XRAPI_CALL xr::CreateSwapchain(XrSession session, const XrSwapchainCreateInfo* info, XrSwapchain* swapchain) {
  return call("xrCreateSwapchain", [&](State& s) {
    const Object<XrSession>& owner = live(session);
    check_create_info(s.control.script, *info);
    *swapchain = add<XrSwapchain>({.parent = session, .info = *info, .images = make_images(owner.graphics, *info)});
  });
}

XrResult XRAPI_CALL xr::DestroySwapchain(XrSwapchain swapchain) {
  return call("xrDestroySwapchain", [&](State& s) {
    // The swapchain is destroyed anyway.
    if (!s.all<XrSwapchain>().at(swapchain).acquired.empty())
      write_violation("image_order", "destroyed while acquired");
    drop_swapchain(swapchain);
  });
}

XrResult XRAPI_CALL xr::EnumerateSwapchainImages(XrSwapchain swapchain, std::uint32_t capacity, std::uint32_t* count,
                                                 XrSwapchainImageBaseHeader* images) {
  return call("xrEnumerateSwapchainImages", [&](State&) {
    auto* const out = reinterpret_cast<XrSwapchainImageVulkanKHR*>(images);
    return fill(capacity, count, out, live(swapchain).images,
                [](XrSwapchainImageVulkanKHR& to, const SwapchainImage& from) { to.image = from.image; });
  });
}

XrResult XRAPI_CALL xr::AcquireSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo*,
                                              std::uint32_t* index) {
  return call("xrAcquireSwapchainImage", [&](State&) {
    Object<XrSwapchain>& object = live(swapchain);
    require(object.acquired.size() < object.images.size(), "image_order", "all images are acquired");
    *index = object.next;
    object.next = (object.next + 1) % kImages;
    object.acquired.push_back(*index);
    set_initial_layout(live(object.parent).graphics, object.images[*index], object.info.format);
  });
}

XrResult XRAPI_CALL xr::WaitSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageWaitInfo*) {
  return call("xrWaitSwapchainImage", [&](State&) {
    Object<XrSwapchain>& object = live(swapchain);
    require(!object.acquired.empty() && !object.waited, "image_order");
    object.waited = true;
  });
}

XrResult XRAPI_CALL xr::ReleaseSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo*) {
  return call("xrReleaseSwapchainImage", [&](State&) {
    Object<XrSwapchain>& object = live(swapchain);
    require(object.waited, "image_order");
    object.released = object.acquired.front();
    object.acquired.pop_front();
    object.waited = false;
  });
}

}  // namespace gearshift::xr_test
