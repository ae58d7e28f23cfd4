// A program that uses OpenXR correctly, through the real loader. Tests of the test runtime make this program break the
// rules at chosen points. It draws only by clearing images. Vulkan's validation also checks the runtime's own commands.
#pragma once

#include <time.h>

#include <array>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/gpu/vulkan.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/xr_runtime/control.h"

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <openxr/openxr_platform.h>

namespace gearshift::xr_test {

inline constexpr XrPosef kIdentity{{0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};

template <class Function>
Function xr_function(XrInstance instance, const char* name) {
  PFN_xrVoidFunction function = nullptr;
  REQUIRE(xrGetInstanceProcAddr(instance, name, &function) == XR_SUCCESS);
  return reinterpret_cast<Function>(function);
}

// An OpenXR instance and a Vulkan device, without a session.
class Machine {
 public:
  explicit Machine(std::vector<const char*> extensions = {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME,
                                                          XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
                                                          XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME}) {
    test::choose_software_driver();
    control();
    XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
    info.applicationInfo.apiVersion = XR_CURRENT_API_VERSION;
    std::strcpy(info.applicationInfo.applicationName, "gearshift test");
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.enabledExtensionNames = extensions.data();
    REQUIRE(xrCreateInstance(&info, &instance) == XR_SUCCESS);
    const XrSystemGetInfo system_info{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    REQUIRE(xrGetSystem(instance, &system_info, &system) == XR_SUCCESS);
  }
  ~Machine() {
    if (instance != XR_NULL_HANDLE) xrDestroyInstance(instance);
    if (device != VK_NULL_HANDLE) {
      vkDestroyCommandPool(device, pool, nullptr);
      vkDestroyDevice(device, nullptr);
    }
    if (vulkan != VK_NULL_HANDLE) {
      reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
          vkGetInstanceProcAddr(vulkan, "vkDestroyDebugUtilsMessengerEXT"))(vulkan, messenger, nullptr);
      vkDestroyInstance(vulkan, nullptr);
    }
    for (const std::string& message : messages) FAIL_CHECK(message);
  }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  void get_requirements() const {
    XrGraphicsRequirementsVulkan2KHR requirements{XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR};
    const auto get_graphics_requirements =
        xr_function<PFN_xrGetVulkanGraphicsRequirements2KHR>(instance, "xrGetVulkanGraphicsRequirements2KHR");
    REQUIRE(get_graphics_requirements(instance, system, &requirements) == XR_SUCCESS);
  }

  void open_vulkan() {
    open_vulkan_instance();
    const XrVulkanGraphicsDeviceGetInfoKHR get{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR, nullptr, system, vulkan};
    const auto get_graphics_device =
        xr_function<PFN_xrGetVulkanGraphicsDevice2KHR>(instance, "xrGetVulkanGraphicsDevice2KHR");
    REQUIRE(get_graphics_device(instance, &get, &physical) == XR_SUCCESS);
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queues{
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
    const VkDeviceCreateInfo device_info{
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queues};
    XrVulkanDeviceCreateInfoKHR info{XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR};
    info.systemId = system;
    info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
    info.vulkanPhysicalDevice = physical;
    info.vulkanCreateInfo = &device_info;
    VkResult result = VK_ERROR_UNKNOWN;
    const auto create = xr_function<PFN_xrCreateVulkanDeviceKHR>(instance, "xrCreateVulkanDeviceKHR");
    REQUIRE(create(instance, &info, &device, &result) == XR_SUCCESS);
    REQUIRE(result == VK_SUCCESS);
    vkGetDeviceQueue(device, 0, 0, &queue);
    const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    REQUIRE(vkCreateCommandPool(device, &pool_info, nullptr, &pool) == VK_SUCCESS);
  }

  XrGraphicsBindingVulkan2KHR binding() const {
    return {XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR, nullptr, vulkan, physical, device, 0, 0};
  }

  // Clears a whole image to one colour, or to the depth `value[0]`. Before and after the call, the image has the layout
  // that OpenXR prescribes. Waits for the GPU.
  void clear(VkImage image, bool depth, std::array<float, 4> value) const;

  XrInstance instance = XR_NULL_HANDLE;
  XrSystemId system = XR_NULL_SYSTEM_ID;
  VkInstance vulkan = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  std::vector<std::string> messages;  // messages from Vulkan's validation layer

 private:
  static VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                        const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
    static_cast<Machine*>(self)->messages.emplace_back(data->pMessage);
    return VK_FALSE;
  }

  void open_vulkan_instance() {
    const char* const layer = "VK_LAYER_KHRONOS_validation";
    const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo instance_info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                             .pApplicationInfo = &application,
                                             .enabledLayerCount = 1,
                                             .ppEnabledLayerNames = &layer,
                                             .enabledExtensionCount = 1,
                                             .ppEnabledExtensionNames = &extension};
    XrVulkanInstanceCreateInfoKHR info{XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR};
    info.systemId = system;
    info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
    info.vulkanCreateInfo = &instance_info;
    VkResult result = VK_ERROR_UNKNOWN;
    const auto create = xr_function<PFN_xrCreateVulkanInstanceKHR>(instance, "xrCreateVulkanInstanceKHR");
    REQUIRE(create(instance, &info, &vulkan, &result) == XR_SUCCESS);
    REQUIRE(result == VK_SUCCESS);
    const VkDebugUtilsMessengerCreateInfoEXT messenger_info{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = on_message,
        .pUserData = this};
    REQUIRE(reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
                vulkan, "vkCreateDebugUtilsMessengerEXT"))(vulkan, &messenger_info, nullptr, &messenger) == VK_SUCCESS);
  }
};

inline void Machine::clear(VkImage image, bool depth, std::array<float, 4> value) const {
  const VkCommandBufferAllocateInfo one{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                        .commandPool = pool,
                                        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                        .commandBufferCount = 1};
  VkCommandBuffer commands = VK_NULL_HANDLE;
  REQUIRE(vkAllocateCommandBuffers(device, &one, &commands) == VK_SUCCESS);
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  vkBeginCommandBuffer(commands, &begin);
  const VkImageLayout final_layout =
      depth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  const VkImageAspectFlags aspect = depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  const VkImageSubresourceRange all{aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
  const auto change = [&](VkImageLayout from, VkImageLayout to) {
    const VkAccessFlags access = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    const VkImageMemoryBarrier barrier{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                       .srcAccessMask = access,
                                       .dstAccessMask = access,
                                       .oldLayout = from,
                                       .newLayout = to,
                                       .image = image,
                                       .subresourceRange = all};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                         nullptr, 0, nullptr, 1, &barrier);
  };
  change(final_layout, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  if (depth) {
    const VkClearDepthStencilValue clear{value[0], 0};
    vkCmdClearDepthStencilImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &clear, 1, &all);
  } else {
    const VkClearColorValue clear{{value[0], value[1], value[2], value[3]}};
    vkCmdClearColorImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &clear, 1, &all);
  }
  change(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, final_layout);
  vkEndCommandBuffer(commands);
  const VkSubmitInfo submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
  vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE);
  vkQueueWaitIdle(queue);
  vkFreeCommandBuffers(device, pool, 1, &commands);
}

struct Chain {
  XrSwapchain handle = XR_NULL_HANDLE;
  std::vector<VkImage> images;
};

// A session and its swapchains: one for both eyes, one for their depth, one for a quad.
class Client : public Machine {
 public:
  static constexpr std::uint32_t kWidth = 64, kHeight = 48;

  Client() {
    get_requirements();
    open_vulkan();
    const XrGraphicsBindingVulkan2KHR vulkan_binding = binding();
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &vulkan_binding, 0, system};
    REQUIRE(xrCreateSession(instance, &info, &session) == XR_SUCCESS);
    local = reference(XR_REFERENCE_SPACE_TYPE_LOCAL);
    eyes = chain(VK_FORMAT_R8G8B8A8_SRGB, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 2);
    depth = chain(VK_FORMAT_D32_SFLOAT, XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 2);
    panel = chain(VK_FORMAT_B8G8R8A8_UNORM, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 1);
    set_up_layers();
  }
  ~Client() { close(); }

  void close() {
    if (session == XR_NULL_HANDLE) return;
    for (const Chain* one : {&eyes, &depth, &panel}) {
      if (one->handle != XR_NULL_HANDLE) xrDestroySwapchain(one->handle);
    }
    xrDestroySpace(local);
    xrDestroySession(session);
    session = XR_NULL_HANDLE;
  }

  XrSpace reference(XrReferenceSpaceType type) const {
    const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, type, kIdentity};
    XrSpace space = XR_NULL_HANDLE;
    REQUIRE(xrCreateReferenceSpace(session, &info, &space) == XR_SUCCESS);
    return space;
  }

  static XrSwapchainCreateInfo chain_info(std::int64_t format, XrSwapchainUsageFlags usage, std::uint32_t slices) {
    return {XR_TYPE_SWAPCHAIN_CREATE_INFO,
            nullptr,
            0,
            usage | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT,
            format,
            1,
            kWidth,
            kHeight,
            1,
            slices,
            1};
  }

  Chain chain(std::int64_t format, XrSwapchainUsageFlags usage, std::uint32_t slices) const {
    const XrSwapchainCreateInfo info = chain_info(format, usage, slices);
    Chain created;
    REQUIRE(xrCreateSwapchain(session, &info, &created.handle) == XR_SUCCESS);
    std::uint32_t count = 0;
    REQUIRE(xrEnumerateSwapchainImages(created.handle, 0, &count, nullptr) == XR_SUCCESS);
    std::vector<XrSwapchainImageVulkan2KHR> images(count, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR});
    REQUIRE(xrEnumerateSwapchainImages(created.handle, count, &count,
                                       reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())) == XR_SUCCESS);
    for (const auto& image : images) created.images.push_back(image.image);
    return created;
  }

  // Returns the session states that the runtime reported, in order.
  std::vector<XrSessionState> poll() {
    std::vector<XrSessionState> states;
    XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
    while (xrPollEvent(instance, &event) == XR_SUCCESS) {
      if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
        states.push_back(reinterpret_cast<XrEventDataSessionStateChanged&>(event).state);
        state = states.back();
      }
      if (on_event) on_event(event);
      event = {XR_TYPE_EVENT_DATA_BUFFER};
    }
    return states;
  }

  XrResult begin() const {
    const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
    return xrBeginSession(session, &info);
  }

  XrResult wait() {
    const XrFrameWaitInfo info{XR_TYPE_FRAME_WAIT_INFO};
    frame = {XR_TYPE_FRAME_STATE};
    return xrWaitFrame(session, &info, &frame);
  }
  XrResult begin_frame() const {
    const XrFrameBeginInfo info{XR_TYPE_FRAME_BEGIN_INFO};
    return xrBeginFrame(session, &info);
  }
  XrResult locate() {
    const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO,
                                frame.predictedDisplayTime, local};
    view_state = {XR_TYPE_VIEW_STATE};
    std::uint32_t count = 0;
    const XrResult result = xrLocateViews(session, &info, &view_state, 2, &count, views.data());
    for (std::size_t eye = 0; eye < 2; ++eye) {
      projections[eye].pose = views[eye].pose;
      projections[eye].fov = views[eye].fov;
    }
    return result;
  }

  void draw(const Chain& to, bool is_depth, std::array<float, 4> value) const {
    std::uint32_t index = 0;
    REQUIRE(xrAcquireSwapchainImage(to.handle, nullptr, &index) == XR_SUCCESS);
    const XrSwapchainImageWaitInfo info{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
    REQUIRE(xrWaitSwapchainImage(to.handle, &info) == XR_SUCCESS);
    clear(to.images[index], is_depth, value);
    REQUIRE(xrReleaseSwapchainImage(to.handle, nullptr) == XR_SUCCESS);
  }
  void draw_all() const {
    draw(eyes, false, {1.0f, 0.0f, 0.5f, 1.0f});
    draw(depth, true, {0.25f});
    draw(panel, false, {0.0f, 1.0f, 0.0f, 0.5f});
  }

  XrFrameEndInfo end_info() const {
    return {XR_TYPE_FRAME_END_INFO,
            nullptr,
            frame.predictedDisplayTime,
            XR_ENVIRONMENT_BLEND_MODE_OPAQUE,
            static_cast<std::uint32_t>(layers.size()),
            layers.data()};
  }
  XrResult end_frame(bool with_layers = true) const {
    XrFrameEndInfo info = end_info();
    if (!with_layers) info.layerCount = 0;
    return xrEndFrame(session, &info);
  }

  // Runs one frame; draws only if the runtime requests it.
  void run_frame() {
    REQUIRE(wait() == XR_SUCCESS);
    REQUIRE(begin_frame() == XR_SUCCESS);
    REQUIRE(locate() == XR_SUCCESS);
    const bool shown = frame.shouldRender == XR_TRUE;
    if (shown) draw_all();
    REQUIRE(end_frame(shown) == XR_SUCCESS);
  }
  void run(int frames) {
    for (int i = 0; i < frames; ++i) {
      poll();
      run_frame();
    }
    poll();
  }
  void begin_and_focus() {
    poll();
    REQUIRE(begin() == XR_SUCCESS);
    run(4);
    REQUIRE(state == XR_SESSION_STATE_FOCUSED);
  }

  XrSession session = XR_NULL_HANDLE;
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  XrSpace local = XR_NULL_HANDLE;
  Chain eyes, depth, panel;
  XrFrameState frame{XR_TYPE_FRAME_STATE};
  XrViewState view_state{XR_TYPE_VIEW_STATE};
  std::array<XrView, 2> views{XrView{XR_TYPE_VIEW}, XrView{XR_TYPE_VIEW}};
  std::array<XrCompositionLayerProjectionView, 2> projections{};
  std::array<XrCompositionLayerDepthInfoKHR, 2> depths{};
  XrCompositionLayerProjection projection{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  XrCompositionLayerQuad quad{XR_TYPE_COMPOSITION_LAYER_QUAD};
  std::vector<const XrCompositionLayerBaseHeader*> layers;
  std::function<void(const XrEventDataBuffer&)> on_event;

 private:
  void set_up_layers() {
    const XrRect2Di all{{0, 0}, {static_cast<int>(kWidth), static_cast<int>(kHeight)}};
    for (std::uint32_t eye = 0; eye < 2; ++eye) {
      depths[eye] = {
          XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR, nullptr, {depth.handle, all, eye}, 0.0f, 1.0f, 0.1f, 100.0f};
      projections[eye] = {
          XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW, &depths[eye], kIdentity, {}, {eyes.handle, all, eye}};
    }
    projection.space = local;
    projection.viewCount = 2;
    projection.views = projections.data();
    quad = {XR_TYPE_COMPOSITION_LAYER_QUAD,
            nullptr,
            XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT,
            local,
            XR_EYE_VISIBILITY_BOTH,
            {panel.handle, all, 0},
            {{0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}},
            {0.8f, 0.6f}};
    layers = {reinterpret_cast<XrCompositionLayerBaseHeader*>(&projection),
              reinterpret_cast<XrCompositionLayerBaseHeader*>(&quad)};
  }
};

}  // namespace gearshift::xr_test
