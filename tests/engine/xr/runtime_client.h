// A program that calls OpenXR directly, through the real loader and Khronos' validation layer, so that tests can make it
// break the rules at chosen points. It draws nothing.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/gpu/vulkan.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/xr_runtime/control.h"

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <openxr/openxr_platform.h>
#include <time.h>

namespace gearshift::xr_test {

inline constexpr XrPosef kIdentity{{0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};

template <std::size_t size>
void set_text(char (&to)[size], const char* from) {
  std::snprintf(to, size, "%s", from);
}

template <class Function>
Function xr_function(XrInstance instance, const char* name) {
  PFN_xrVoidFunction function = nullptr;
  REQUIRE(xrGetInstanceProcAddr(instance, name, &function) == XR_SUCCESS);
  return reinterpret_cast<Function>(function);
}

inline XrInstanceCreateInfo instance_info() {
  static constexpr const char* kExtensions[] = {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME,
                                                XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME};
  XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
  info.applicationInfo.apiVersion = XR_CURRENT_API_VERSION;
  set_text(info.applicationInfo.applicationName, "gearshift test");
  info.enabledExtensionCount = 2;
  info.enabledExtensionNames = kExtensions;
  return info;
}

// An OpenXR instance, and a Vulkan device if open_vulkan() was called, without a session.
class Machine {
 public:
  Machine() {
    test::choose_software_driver();
    control();
    const XrInstanceCreateInfo info = instance_info();
    REQUIRE(xrCreateInstance(&info, &instance) == XR_SUCCESS);
    const XrSystemGetInfo system_info{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    REQUIRE(xrGetSystem(instance, &system_info, &system) == XR_SUCCESS);
  }
  ~Machine() {
    xrDestroyInstance(instance);
    if (device != VK_NULL_HANDLE) vkDestroyDevice(device, nullptr);
    if (vulkan != VK_NULL_HANDLE) vkDestroyInstance(vulkan, nullptr);
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
    const VkInstanceCreateInfo vulkan_info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    XrVulkanInstanceCreateInfoKHR make{XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR};
    make.systemId = system;
    make.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
    make.vulkanCreateInfo = &vulkan_info;
    VkResult result = VK_ERROR_UNKNOWN;
    const auto make_instance = xr_function<PFN_xrCreateVulkanInstanceKHR>(instance, "xrCreateVulkanInstanceKHR");
    REQUIRE(make_instance(instance, &make, &vulkan, &result) == XR_SUCCESS);
    const XrVulkanGraphicsDeviceGetInfoKHR get{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR, nullptr, system, vulkan};
    const auto choose = xr_function<PFN_xrGetVulkanGraphicsDevice2KHR>(instance, "xrGetVulkanGraphicsDevice2KHR");
    REQUIRE(choose(instance, &get, &physical) == XR_SUCCESS);
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
    const auto make_device = xr_function<PFN_xrCreateVulkanDeviceKHR>(instance, "xrCreateVulkanDeviceKHR");
    REQUIRE(make_device(instance, &info, &device, &result) == XR_SUCCESS);
    REQUIRE(result == VK_SUCCESS);
  }

  XrGraphicsBindingVulkan2KHR binding() const {
    return {XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR, nullptr, vulkan, physical, device, 0, 0};
  }

  XrPath path(const std::string& text) const {
    XrPath created = XR_NULL_PATH;
    REQUIRE(xrStringToPath(instance, text.c_str(), &created) == XR_SUCCESS);
    return created;
  }

  XrInstance instance = XR_NULL_HANDLE;
  XrSystemId system = XR_NULL_SYSTEM_ID;
  VkInstance vulkan = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
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
    eyes = swapchain(VK_FORMAT_R8G8B8A8_SRGB, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 2);
    depth = swapchain(VK_FORMAT_D32_SFLOAT, XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 2);
    panel = swapchain(VK_FORMAT_B8G8R8A8_UNORM, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 1);
    set_up_layers();
  }
  ~Client() { xrDestroySession(session); }

  XrSpace reference(XrReferenceSpaceType type) const {
    const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, type, kIdentity};
    XrSpace space = XR_NULL_HANDLE;
    REQUIRE(xrCreateReferenceSpace(session, &info, &space) == XR_SUCCESS);
    return space;
  }

  static XrSwapchainCreateInfo swapchain_info(std::int64_t format, XrSwapchainUsageFlags usage, std::uint32_t slices) {
    return {XR_TYPE_SWAPCHAIN_CREATE_INFO, nullptr, 0, usage, format, 1, kWidth, kHeight, 1, slices, 1};
  }
  XrSwapchain swapchain(std::int64_t format, XrSwapchainUsageFlags usage, std::uint32_t slices) const {
    const XrSwapchainCreateInfo info = swapchain_info(format, usage, slices);
    XrSwapchain created = XR_NULL_HANDLE;
    REQUIRE(xrCreateSwapchain(session, &info, &created) == XR_SUCCESS);
    return created;
  }

  XrResult begin(XrViewConfigurationType type = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) const {
    const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, type};
    return xrBeginSession(session, &info);
  }
  XrResult wait() {
    frame = {XR_TYPE_FRAME_STATE};
    return xrWaitFrame(session, nullptr, &frame);
  }
  XrResult begin_frame() const { return xrBeginFrame(session, nullptr); }

  static void show_image(XrSwapchain to) {
    std::uint32_t index = 0;
    REQUIRE(xrAcquireSwapchainImage(to, nullptr, &index) == XR_SUCCESS);
    const XrSwapchainImageWaitInfo info{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
    REQUIRE(xrWaitSwapchainImage(to, &info) == XR_SUCCESS);
    REQUIRE(xrReleaseSwapchainImage(to, nullptr) == XR_SUCCESS);
  }

  XrResult end_frame(bool with_layers = true) const {
    const XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO,
                              nullptr,
                              frame.predictedDisplayTime,
                              blend,
                              with_layers ? static_cast<std::uint32_t>(layers.size()) : 0,
                              layers.data()};
    return xrEndFrame(session, &info);
  }

  // Begins the session and runs frames until it has the focus.
  void focus() {
    REQUIRE(begin() == XR_SUCCESS);
    for (int i = 0; i < 4; ++i) {
      REQUIRE(wait() == XR_SUCCESS);
      REQUIRE(begin_frame() == XR_SUCCESS);
      REQUIRE(end_frame(false) == XR_SUCCESS);
    }
    REQUIRE(control().record.state == XR_SESSION_STATE_FOCUSED);
  }

  XrSession session = XR_NULL_HANDLE;
  XrSpace local = XR_NULL_HANDLE;
  XrSwapchain eyes, depth, panel;
  XrFrameState frame{XR_TYPE_FRAME_STATE};
  XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  std::array<XrCompositionLayerProjectionView, 2> projections{};
  std::array<XrCompositionLayerDepthInfoKHR, 2> depths{};
  XrCompositionLayerProjection projection{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  XrCompositionLayerQuad quad{XR_TYPE_COMPOSITION_LAYER_QUAD};
  std::vector<const XrCompositionLayerBaseHeader*> layers;

 private:
  void set_up_layers() {
    const XrRect2Di all{{0, 0}, {static_cast<int>(kWidth), static_cast<int>(kHeight)}};
    const XrFovf fov{-0.8f, 0.8f, 0.7f, -0.7f};
    for (std::uint32_t eye = 0; eye < 2; ++eye) {
      depths[eye] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR, nullptr, {depth, all, eye}, 0.0f, 1.0f, 0.1f, 100.0f};
      projections[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW, &depths[eye], kIdentity, fov, {eyes, all, eye}};
    }
    projection.space = local;
    projection.viewCount = 2;
    projection.views = projections.data();
    quad = {XR_TYPE_COMPOSITION_LAYER_QUAD, nullptr,         0,         local,
            XR_EYE_VISIBILITY_BOTH,         {panel, all, 0}, kIdentity, {0.8f, 0.6f}};
    layers = {reinterpret_cast<XrCompositionLayerBaseHeader*>(&projection),
              reinterpret_cast<XrCompositionLayerBaseHeader*>(&quad)};
  }
};

// An action set with one action, which can be bound to a controller.
struct Controls {
  static constexpr const char* kSimpleController = "/interaction_profiles/khr/simple_controller";

  explicit Controls(const Client& client) : program(client), hand(client.path("/user/hand/left")) {
    XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO};
    set_text(info.actionSetName, "cabin");
    set_text(info.localizedActionSetName, "Cabin");
    REQUIRE(xrCreateActionSet(program.instance, &info, &set) == XR_SUCCESS);
    REQUIRE(make("press", press) == XR_SUCCESS);
  }

  XrResult make(const char* name, XrAction& action) const {
    XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO};
    set_text(info.actionName, name);
    set_text(info.localizedActionName, name);
    info.actionType = XR_ACTION_TYPE_BOOLEAN_INPUT;
    info.countSubactionPaths = 1;
    info.subactionPaths = &hand;
    return xrCreateAction(set, &info, &action);
  }
  XrResult suggest(const char* profile, const char* input) const {
    const XrActionSuggestedBinding binding{press, program.path(input)};
    const XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr,
                                                    program.path(profile), 1, &binding};
    return xrSuggestInteractionProfileBindings(program.instance, &info);
  }
  XrResult attach() const {
    const XrSessionActionSetsAttachInfo info{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set};
    return xrAttachSessionActionSets(program.session, &info);
  }
  XrResult sync() const {
    const XrActiveActionSet active{set, XR_NULL_PATH};
    const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
    return xrSyncActions(program.session, &info);
  }

  const Client& program;
  XrPath hand = XR_NULL_PATH;
  XrActionSet set = XR_NULL_HANDLE;
  XrAction press = XR_NULL_HANDLE;
};

}  // namespace gearshift::xr_test
