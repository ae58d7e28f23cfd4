#include "engine/window/swapchain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "engine/gpu/commands.h"

namespace gearshift::engine {
namespace {

// Longer than the frame period of any display. A compositor that provides no image for this long is not showing our
// window.
constexpr std::uint64_t kAcquireTimeout = 100'000'000;  // [ns]

Semaphore make_semaphore(VkDevice device) {
  const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(device, &info, nullptr, &semaphore), "vkCreateSemaphore");
  return {device, semaphore};
}

// Thrown when a Vulkan call reports that the surface is lost, which any call that uses a surface may do. Never leaves
// this file.
struct SurfaceLost {};
void check_surface(VkResult result, const char* what) {
  if (result == VK_ERROR_SURFACE_LOST_KHR) throw SurfaceLost{};
  check(result, what);
}

template <class T, class Query>
std::vector<T> query_list(Query query) {
  std::uint32_t count = 0;
  check_surface(query(&count, static_cast<T*>(nullptr)), "a query of the surface");
  std::vector<T> items(count);
  check_surface(query(&count, items.data()), "a query of the surface");
  items.resize(count);
  return items;
}

void require_present(const Gpu& gpu, VkSurfaceKHR surface) {
  VkBool32 can_present = VK_FALSE;
  check_surface(vkGetPhysicalDeviceSurfaceSupportKHR(gpu.physical(), gpu.queue_family(), surface, &can_present),
                "vkGetPhysicalDeviceSurfaceSupportKHR");
  if (can_present == VK_FALSE) {
    throw GpuError(fmt::format("{} cannot draw to this window.", gpu.traits().name));
  }
}

// Chooses an sRGB format, so that the blit filters linear light and encodes the result.
VkSurfaceFormatKHR choose_format(const Gpu& gpu, VkSurfaceKHR surface) {
  const auto formats = query_list<VkSurfaceFormatKHR>([&](auto* count, auto* items) {
    return vkGetPhysicalDeviceSurfaceFormatsKHR(gpu.physical(), surface, count, items);
  });
  for (const VkSurfaceFormatKHR& f : formats) {
    const bool is_srgb = f.format == VK_FORMAT_B8G8R8A8_SRGB || f.format == VK_FORMAT_R8G8B8A8_SRGB;
    if (is_srgb && f.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR &&
        gpu.supports(f.format, VK_FORMAT_FEATURE_2_BLIT_DST_BIT)) {
      return f;
    }
  }
  throw GpuError(fmt::format("{} offers no sRGB format for this window.", gpu.traits().name));
}

VkPresentModeKHR choose_mode(const Gpu& gpu, VkSurfaceKHR surface, bool vsync) {
  if (vsync) return VK_PRESENT_MODE_FIFO_KHR;
  const auto modes = query_list<VkPresentModeKHR>([&](auto* count, auto* items) {
    return vkGetPhysicalDeviceSurfacePresentModesKHR(gpu.physical(), surface, count, items);
  });
  for (const VkPresentModeKHR wanted : {VK_PRESENT_MODE_MAILBOX_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR}) {
    if (std::find(modes.begin(), modes.end(), wanted) != modes.end()) return wanted;
  }
  return VK_PRESENT_MODE_FIFO_KHR;
}

VkExtent2D choose_extent(const VkSurfaceCapabilitiesKHR& capabilities, glm::ivec2 framebuffer) {
  if (capabilities.currentExtent.width != std::numeric_limits<std::uint32_t>::max()) return capabilities.currentExtent;
  const auto within = [](int wanted, std::uint32_t min, std::uint32_t max) {
    return std::clamp(static_cast<std::uint32_t>(wanted), min, max);
  };
  return {within(framebuffer.x, capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
          within(framebuffer.y, capabilities.minImageExtent.height, capabilities.maxImageExtent.height)};
}

VkCompositeAlphaFlagBitsKHR choose_alpha(VkCompositeAlphaFlagsKHR supported) {
  if ((supported & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0) return VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  return static_cast<VkCompositeAlphaFlagBitsKHR>(supported & (~supported + 1));  // the lowest supported bit
}

}  // namespace

VkRect2D placement_of(const ShownLayer& layer, VkExtent2D picture, VkExtent2D window) {
  const auto at = [&](float fraction) {
    return std::lround(std::clamp(fraction, 0.0f, 1.0f) * static_cast<float>(window.width));
  };
  const double left = static_cast<double>(at(layer.from)), width = static_cast<double>(at(layer.to)) - left;
  const double scale = std::min(width / picture.width, static_cast<double>(window.height) / picture.height);
  const long shown_width = std::max(std::lround(picture.width * scale), 1L);
  const long shown_height = std::max(std::lround(picture.height * scale), 1L);
  return {.offset = {static_cast<std::int32_t>(left + (width - static_cast<double>(shown_width)) / 2.0),
                     static_cast<std::int32_t>((window.height - shown_height) / 2)},
          .extent = {static_cast<std::uint32_t>(shown_width), static_cast<std::uint32_t>(shown_height)}};
}

struct Swapchain::State {
  State(Gpu& g, Window& w, bool v) : gpu(g), window(w), vsync(v) {
    for (Semaphore& semaphore : acquired) semaphore = make_semaphore(gpu.device());
    try {
      make_surface();
    } catch (const SurfaceLost&) {
      lost = true;
    }
  }
  ~State() { drop_surface(); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void make_surface();
  void drop_surface() noexcept;
  void build();
  bool make_ready();  // false if there is nothing to present to
  bool handle_result(VkResult result, const char* what);

  Gpu& gpu;
  Window& window;
  bool vsync;
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  VkSwapchainKHR swapchain = VK_NULL_HANDLE;
  VkSurfaceFormatKHR format{};
  VkExtent2D extent{};
  glm::ivec2 built_for{0};  // framebuffer size at the last build
  bool stale = true;        // the swapchain must be rebuilt before the next frame
  bool lost = false;        // the surface must be recreated, too
  std::vector<GpuImage> images;
  std::vector<Semaphore> rendered;  // one per image; can be signalled again after its image is acquired again
  // One more than the number of frames in flight, because a frame acquires its image before it waits for the oldest
  // frame in flight.
  std::array<Semaphore, kFramesInFlight + 1> acquired;
  std::size_t frame = 0;
  std::uint32_t index = 0;  // index of the acquired image
  std::uint64_t builds = 0;
};

void Swapchain::State::make_surface() {
  surface = window.make_surface(gpu.instance());
  try {
    require_present(gpu, surface);
    format = choose_format(gpu, surface);
  } catch (...) {
    drop_surface();
    throw;
  }
  lost = false;
  stale = true;
}

void Swapchain::State::drop_surface() noexcept {
  gpu.wait_idle();
  images.clear();
  rendered.clear();
  vkDestroySwapchainKHR(gpu.device(), std::exchange(swapchain, VK_NULL_HANDLE), nullptr);
  vkDestroySurfaceKHR(gpu.instance(), std::exchange(surface, VK_NULL_HANDLE), nullptr);
}

void Swapchain::State::build() {
  VkSurfaceCapabilitiesKHR capabilities;
  check_surface(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu.physical(), surface, &capabilities),
                "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  stale = true;  // stays true until the build has completed
  built_for = window.framebuffer();
  extent = choose_extent(capabilities, built_for);
  if (extent.width == 0 || extent.height == 0) return;
  gpu.wait_idle();  // frames in flight may still use the old images
  images.clear();
  rendered.clear();
  const std::uint32_t max =
      capabilities.maxImageCount == 0 ? std::numeric_limits<std::uint32_t>::max() : capabilities.maxImageCount;
  const VkSwapchainKHR old = swapchain;
  const VkSwapchainCreateInfoKHR info{.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                      .surface = surface,
                                      .minImageCount = std::min(capabilities.minImageCount + 1, max),
                                      .imageFormat = format.format,
                                      .imageColorSpace = format.colorSpace,
                                      .imageExtent = extent,
                                      .imageArrayLayers = 1,
                                      .imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                      .preTransform = capabilities.currentTransform,
                                      .compositeAlpha = choose_alpha(capabilities.supportedCompositeAlpha),
                                      .presentMode = choose_mode(gpu, surface, vsync),
                                      .clipped = VK_TRUE,
                                      .oldSwapchain = old};
  const VkResult result = vkCreateSwapchainKHR(gpu.device(), &info, nullptr, &swapchain);
  vkDestroySwapchainKHR(gpu.device(), old, nullptr);  // a failed creation also retires the old swapchain
  if (result != VK_SUCCESS) swapchain = VK_NULL_HANDLE;
  check_surface(result, "vkCreateSwapchainKHR");
  const auto raw = query_list<VkImage>(
      [&](auto* count, auto* items) { return vkGetSwapchainImagesKHR(gpu.device(), swapchain, count, items); });
  for (VkImage image : raw) {
    images.emplace_back(image, ImageDesc{.width = extent.width, .height = extent.height, .format = format.format});
    rendered.push_back(make_semaphore(gpu.device()));
  }
  stale = false;
  ++builds;
}

bool Swapchain::State::make_ready() {
  const glm::ivec2 framebuffer = window.framebuffer();
  if (framebuffer.x <= 0 || framebuffer.y <= 0) return false;
  try {
    if (lost) {
      drop_surface();
      make_surface();
    }
    // Compare the sizes, because not every driver reports that the images no longer match the window.
    if (stale || framebuffer != built_for) build();
  } catch (const SurfaceLost&) {
    lost = true;
    return false;
  }
  return !stale;
}

// Handles the result of a call that acquires or presents an image. Returns true if the image can be used.
bool Swapchain::State::handle_result(VkResult result, const char* what) {
  switch (result) {
    case VK_SUBOPTIMAL_KHR:
      stale = true;
      return true;
    case VK_TIMEOUT:
    case VK_NOT_READY:
      return false;
    case VK_ERROR_OUT_OF_DATE_KHR:
      stale = true;
      return false;
    case VK_ERROR_SURFACE_LOST_KHR:
      lost = true;
      return false;
    default:
      check(result, what);
      return true;
  }
}

Swapchain::Swapchain(Gpu& gpu, Window& window, bool vsync) : state_(std::make_unique<State>(gpu, window, vsync)) {}

Swapchain::~Swapchain() = default;

bool Swapchain::acquire() {
  State& s = *state_;
  if (!s.make_ready()) return false;
  const std::size_t next = (s.frame + 1) % s.acquired.size();
  const VkResult result = vkAcquireNextImageKHR(s.gpu.device(), s.swapchain, s.vsync ? kAcquireTimeout : 0,
                                                s.acquired[next].get(), VK_NULL_HANDLE, &s.index);
  // If the acquisition failed, the semaphore was not used, so the next call uses the same one.
  if (!s.handle_result(result, "vkAcquireNextImageKHR")) return false;
  s.frame = next;
  return true;
}

VkSemaphore Swapchain::acquired() const noexcept {
  return state_->acquired[state_->frame].get();
}
VkSemaphore Swapchain::rendered() const noexcept {
  return state_->rendered[state_->index].get();
}

void Swapchain::record(VkCommandBuffer commands, GpuImage& picture, std::span<const ShownLayer> layers) {
  State& s = *state_;
  expect(picture, ImageUse::copy_from);
  GpuImage& image = s.images[s.index];
  discard_content(image);
  transition(commands, image, ImageUse::copy_to);
  const VkClearColorValue black{.float32 = {0.0f, 0.0f, 0.0f, 1.0f}};
  const VkImageSubresourceRange all{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1};
  vkCmdClearColorImage(commands, image.get(), layout_of(ImageUse::copy_to), &black, 1, &all);
  transition(commands, image, ImageUse::copy_to);  // orders the blit after the clear
  for (const ShownLayer& layer : layers) {
    const VkRect2D rect = placement_of(layer, picture.extent(), s.extent);
    blit_into(commands, picture, layer.layer, image, rect);
  }
  transition(commands, image, ImageUse::present);
}

void Swapchain::present() {
  State& s = *state_;
  const VkSemaphore wait_for = rendered();
  const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                              .waitSemaphoreCount = 1,
                              .pWaitSemaphores = &wait_for,
                              .swapchainCount = 1,
                              .pSwapchains = &s.swapchain,
                              .pImageIndices = &s.index};
  s.handle_result(vkQueuePresentKHR(s.gpu.queue(), &info), "vkQueuePresentKHR");
}

VkExtent2D Swapchain::extent() const noexcept {
  return state_->extent;
}
std::uint64_t Swapchain::rebuild_count() const noexcept {
  return state_->builds;
}

}  // namespace gearshift::engine
