// Instance, system, events; XR_KHR_vulkan_enable2, which creates Vulkan objects for the program (this runtime adds
// nothing to the create infos); XR_KHR_convert_timespec_time.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

constexpr XrSystemId kSystem = 0x67656172;

void require_system(XrInstance instance, XrSystemId system,
                    XrViewConfigurationType type = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) {
  live(instance);
  require(system == kSystem, "offered", "systemId");
  require(type == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, "offered", "viewConfigurationType");
}

std::vector<const char*> offered(const Script& script) {
  std::vector<const char*> names;
  if (script.vulkan_enable2) names.push_back(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME);
  if (script.composition_layer_depth) names.push_back(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
  if (script.convert_timespec_time) names.push_back(XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME);
  for (const std::string& name : script.controllers) names.push_back(name.c_str());
  if (script.user_presence) names.push_back("XR_EXT_user_presence");
  return names;
}

// Called by each xrPollEvent that returns no event. Advances the stepped clock while no session is running, and counts
// down the calls until a session becomes READY.
void tick(State& s) {
  bool frames_running = false;
  for (auto& [handle, session] : s.all<XrSession>()) {
    frames_running |= session.running;
    if (session.polls_before_ready > 0 && --session.polls_before_ready == 0)
      set_state(s, handle, XR_SESSION_STATE_READY);
  }
  if (s.begin != 0 && !frames_running && s.control.script.pacing == Pacing::stepped) ++s.next_step;
}

}  // namespace

XrResult XRAPI_CALL xr::EnumerateInstanceExtensionProperties(const char*, std::uint32_t capacity, std::uint32_t* count,
                                                             XrExtensionProperties* properties) {
  return call("xrEnumerateInstanceExtensionProperties", [&](State& s) {
    return fill(capacity, count, properties, offered(s.control.script),
                [](XrExtensionProperties& to, const char* name) {
                  std::snprintf(to.extensionName, sizeof to.extensionName, "%s", name);
                });
  });
}

XrResult XRAPI_CALL xr::CreateInstance(const XrInstanceCreateInfo* info, XrInstance* instance) {
  return call("xrCreateInstance", [&](State& s) {
    // The OpenXR loader puts Khronos' validation layer in front of this runtime, or creates no instance.
    const char* const layers = std::getenv("XR_ENABLE_API_LAYERS");
    require(layers != nullptr && std::strcmp(layers, "XR_APILAYER_LUNARG_core_validation") == 0, "validated");
    const std::vector<const char*> names = offered(s.control.script);
    for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
      const std::string_view wanted = info->enabledExtensionNames[i];
      if (std::find(names.begin(), names.end(), wanted) == names.end()) return XR_ERROR_EXTENSION_NOT_PRESENT;
    }
    *instance = add<XrInstance>(
        {.extensions = {info->enabledExtensionNames, info->enabledExtensionNames + info->enabledExtensionCount}});
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL xr::DestroyInstance(XrInstance instance) {
  return call("xrDestroyInstance", [&](State& s) {
    drop_leaked<XrSession>(instance, drop_session);
    drop_leaked<XrActionSet>(instance, drop_action_set);
    drop(instance);
    s.vulkan_device = VK_NULL_HANDLE;
    s.events.clear();
    s.control.record.state = XR_SESSION_STATE_UNKNOWN;
  });
}

XrResult XRAPI_CALL xr::GetInstanceProperties(XrInstance instance, XrInstanceProperties* properties) {
  return call("xrGetInstanceProperties", [&](State&) {
    live(instance);
    properties->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
    std::snprintf(properties->runtimeName, sizeof properties->runtimeName, "gearshift test runtime");
  });
}

XrResult XRAPI_CALL xr::PollEvent(XrInstance instance, XrEventDataBuffer* data) {
  return call("xrPollEvent", [&](State& s) {
    if (!s.all<XrInstance>().at(instance).lost) play_timeline(s, seconds(s, now(s)));
    if (s.events.empty()) {
      live(instance);
      tick(s);
      return XR_EVENT_UNAVAILABLE;
    }
    *data = s.events.front();
    s.events.pop_front();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL xr::GetSystem(XrInstance instance, const XrSystemGetInfo* info, XrSystemId* system) {
  return call("xrGetSystem", [&](State& s) {
    live(instance);
    require(info->formFactor == XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY, "offered", "formFactor");
    if (!s.control.script.headset) return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
    *system = kSystem;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL xr::GetSystemProperties(XrInstance instance, XrSystemId system, XrSystemProperties* properties) {
  return call("xrGetSystemProperties", [&](State&) {
    require_system(instance, system);
    properties->systemId = system;
    std::snprintf(properties->systemName, sizeof properties->systemName, "gearshift test headset");
  });
}

XrResult XRAPI_CALL xr::EnumerateEnvironmentBlendModes(XrInstance instance, XrSystemId system,
                                                       XrViewConfigurationType type, std::uint32_t capacity,
                                                       std::uint32_t* count, XrEnvironmentBlendMode* modes) {
  return call("xrEnumerateEnvironmentBlendModes", [&](State&) {
    require_system(instance, system, type);
    return fill(capacity, count, modes, std::vector{XR_ENVIRONMENT_BLEND_MODE_OPAQUE});
  });
}

XrResult XRAPI_CALL xr::EnumerateViewConfigurationViews(XrInstance instance, XrSystemId system,
                                                        XrViewConfigurationType type, std::uint32_t capacity,
                                                        std::uint32_t* count, XrViewConfigurationView* views) {
  return call("xrEnumerateViewConfigurationViews", [&](State& s) {
    require_system(instance, system, type);
    const Script& script = s.control.script;
    return fill(capacity, count, views, std::vector{0, 1}, [&](XrViewConfigurationView& to, int) {
      to.recommendedImageRectWidth = script.recommended_width;
      to.recommendedImageRectHeight = script.recommended_height;
      to.maxImageRectWidth = to.maxImageRectHeight = script.max_width;
    });
  });
}

XrResult XRAPI_CALL xr::GetVulkanGraphicsRequirements2KHR(XrInstance instance, XrSystemId system,
                                                          XrGraphicsRequirementsVulkanKHR* requirements) {
  return call("xrGetVulkanGraphicsRequirements2KHR", [&](State&) {
    require_system(instance, system);
    live(instance).requirements_queried = true;
    requirements->minApiVersionSupported = XR_MAKE_VERSION(1, 0, 0);
    requirements->maxApiVersionSupported = XR_MAKE_VERSION(1, 3, 0);
  });
}

XrResult XRAPI_CALL xr::CreateVulkanInstanceKHR(XrInstance instance, const XrVulkanInstanceCreateInfoKHR* info,
                                                VkInstance* vulkan, VkResult* result) {
  return call("xrCreateVulkanInstanceKHR", [&](State& s) {
    require_system(instance, info->systemId);
    *result = vkCreateInstance(info->vulkanCreateInfo, info->vulkanAllocator, vulkan);
    if (*result == VK_SUCCESS) s.vulkan_instance = *vulkan;
  });
}

XrResult XRAPI_CALL xr::GetVulkanGraphicsDevice2KHR(XrInstance instance, const XrVulkanGraphicsDeviceGetInfoKHR* info,
                                                    VkPhysicalDevice* device) {
  return call("xrGetVulkanGraphicsDevice2KHR", [&](State& s) {
    require_system(instance, info->systemId);
    require(info->vulkanInstance == s.vulkan_instance, "graphics", "vulkanInstance");
    std::uint32_t count = 1;
    *device = VK_NULL_HANDLE;
    vkEnumeratePhysicalDevices(info->vulkanInstance, &count, device);
    if (*device == VK_NULL_HANDLE) reject_call(XR_ERROR_RUNTIME_FAILURE);
    s.vulkan_physical = *device;
  });
}

XrResult XRAPI_CALL xr::CreateVulkanDeviceKHR(XrInstance instance, const XrVulkanDeviceCreateInfoKHR* info,
                                              VkDevice* device, VkResult* result) {
  return call("xrCreateVulkanDeviceKHR", [&](State& s) {
    require_system(instance, info->systemId);
    require(info->vulkanPhysicalDevice == s.vulkan_physical, "graphics", "vulkanPhysicalDevice");
    *result = vkCreateDevice(info->vulkanPhysicalDevice, info->vulkanCreateInfo, info->vulkanAllocator, device);
    if (*result == VK_SUCCESS) s.vulkan_device = *device;
  });
}

XrResult XRAPI_CALL xr::ConvertTimespecTimeToTimeKHR(XrInstance instance, const timespec* from, XrTime* to) {
  return call("xrConvertTimespecTimeToTimeKHR", [&](State&) {
    live(instance);
    *to = from->tv_sec * 1'000'000'000 + from->tv_nsec;
  });
}

}  // namespace gearshift::xr_test
