#include "engine/xr/headset_runtime.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "engine/xr/headset_hands.h"
#include "engine/xr/headset_runtime_state.h"

namespace gearshift::engine {
namespace {

constexpr const char* kNoService =
    "the OpenXR runtime is installed, but its service does not run; start SteamVR, monado-service, wivrn-server or the "
    "headset's own program";
constexpr const char* kNoRuntime =
    "no OpenXR runtime found; start the headset's software, or set XR_RUNTIME_JSON to the runtime's manifest";

std::vector<XrExtensionProperties> offered_extensions() {
  try {
    return list_of<XrExtensionProperties>(
        "xrEnumerateInstanceExtensionProperties", {XR_TYPE_EXTENSION_PROPERTIES},
        [](std::uint32_t capacity, std::uint32_t* count, XrExtensionProperties* items) {
          return xrEnumerateInstanceExtensionProperties(nullptr, capacity, count, items);
        });
  } catch (const HeadsetError&) {
    throw HeadsetError(kNoRuntime);
  }
}

bool has_extension(const std::vector<XrExtensionProperties>& offered, const char* name) {
  return std::any_of(offered.begin(), offered.end(),
                     [&](const auto& extension) { return std::strcmp(extension.extensionName, name) == 0; });
}

std::string version_text(XrVersion version) {
  return fmt::format("{}.{}.{}", XR_VERSION_MAJOR(version), XR_VERSION_MINOR(version), XR_VERSION_PATCH(version));
}

glm::ivec2 size_of(std::uint32_t width, std::uint32_t height) {
  return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace

HeadsetRuntime::State::State() {
  make_instance();
  try {
    find_headset();
    check_vulkan();
  } catch (...) {
    xrDestroyInstance(instance);
    throw;
  }
}

HeadsetRuntime::State::~State() {
  xrDestroyInstance(instance);
}

void HeadsetRuntime::State::make_instance() {
  const std::vector<XrExtensionProperties> offered = offered_extensions();
  if (!has_extension(offered, XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME))
    throw HeadsetError("the OpenXR runtime does not support Vulkan (XR_KHR_vulkan_enable2)");
  std::vector<const char*> wanted{XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME};
  traits.depth = has_extension(offered, XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
  timespec = has_extension(offered, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME);
  if (has_extension(offered, XR_EXT_USER_PRESENCE_EXTENSION_NAME))
    wanted.push_back(XR_EXT_USER_PRESENCE_EXTENSION_NAME);
  for (const char* const name : HeadsetHands::extensions())
    if (has_extension(offered, name)) wanted.push_back(name);
  if (traits.depth) wanted.push_back(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
  if (timespec) wanted.push_back(XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME);
  extensions.assign(wanted.begin(), wanted.end());
  XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
  std::strcpy(info.applicationInfo.applicationName, "gearshift");
  std::strcpy(info.applicationInfo.engineName, "gearshift");
  info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  info.enabledExtensionCount = static_cast<std::uint32_t>(wanted.size());
  info.enabledExtensionNames = wanted.data();
  const XrResult result = xrCreateInstance(&info, &instance);
  // Monado's client reports the first of these while nobody serves it.
  if (result == XR_ERROR_RUNTIME_FAILURE || result == XR_ERROR_RUNTIME_UNAVAILABLE ||
      result == XR_ERROR_INITIALIZATION_FAILED)
    throw HeadsetError(kNoService);
  check(result, "xrCreateInstance");
  XrInstanceProperties properties{XR_TYPE_INSTANCE_PROPERTIES};
  if (XR_SUCCEEDED(xrGetInstanceProperties(instance, &properties)))
    traits.runtime =
        fmt::format("{} {}", static_cast<const char*>(properties.runtimeName), version_text(properties.runtimeVersion));
}

void HeadsetRuntime::State::find_headset() {
  XrSystemGetInfo wanted{XR_TYPE_SYSTEM_GET_INFO};
  wanted.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
  const XrResult result = xrGetSystem(instance, &wanted, &system);
  if (result == XR_ERROR_FORM_FACTOR_UNAVAILABLE)
    throw HeadsetAbsent(fmt::format("no headset is connected to {}", traits.runtime));
  check(result, "xrGetSystem");
  XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES};
  check(xrGetSystemProperties(instance, system, &properties), "xrGetSystemProperties");
  traits.headset = properties.systemName;
  const auto views = list_of<XrViewConfigurationView>(
      "xrEnumerateViewConfigurationViews", {XR_TYPE_VIEW_CONFIGURATION_VIEW},
      [&](std::uint32_t capacity, std::uint32_t* count, XrViewConfigurationView* items) {
        return xrEnumerateViewConfigurationViews(instance, system, kTwoEyes, capacity, count, items);
      });
  if (views.size() != 2)
    throw HeadsetError(fmt::format("{} does not show a picture for each of two eyes", traits.headset));
  traits.eye = size_of(views[0].recommendedImageRectWidth, views[0].recommendedImageRectHeight);
  traits.largest = size_of(views[0].maxImageRectWidth, views[0].maxImageRectHeight);
  const auto blends = list_of<XrEnvironmentBlendMode>(
      "xrEnumerateEnvironmentBlendModes", XR_ENVIRONMENT_BLEND_MODE_OPAQUE,
      [&](std::uint32_t capacity, std::uint32_t* count, XrEnvironmentBlendMode* items) {
        return xrEnumerateEnvironmentBlendModes(instance, system, kTwoEyes, capacity, count, items);
      });
  const bool is_opaque_offered = std::find(blends.begin(), blends.end(), blend) != blends.end();
  if (!is_opaque_offered && !blends.empty()) blend = blends.front();
}

// OpenXR requires this query before a session is created.
void HeadsetRuntime::State::check_vulkan() const {
  XrGraphicsRequirementsVulkan2KHR needs{XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR};
  const auto get_requirements =
      load<PFN_xrGetVulkanGraphicsRequirements2KHR>(instance, "xrGetVulkanGraphicsRequirements2KHR");
  check(get_requirements(instance, system, &needs), "xrGetVulkanGraphicsRequirements2KHR");
  if (needs.minApiVersionSupported > XR_MAKE_VERSION(1, 3, 0))
    throw HeadsetError(fmt::format("{} requires Vulkan {}; this program uses 1.3", traits.runtime,
                                   version_text(needs.minApiVersionSupported)));
}

HeadsetRuntime::HeadsetRuntime() : state_(std::make_unique<State>()) {}
HeadsetRuntime::~HeadsetRuntime() = default;

const HeadsetTraits& HeadsetRuntime::traits() const noexcept {
  return state_->traits;
}

VkResult HeadsetRuntime::make_instance(const VkInstanceCreateInfo& info, VkInstance* instance) {
  XrVulkanInstanceCreateInfoKHR xr_info{XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR};
  xr_info.systemId = state_->system;
  xr_info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
  xr_info.vulkanCreateInfo = &info;
  VkResult result = VK_SUCCESS;
  const auto create = load<PFN_xrCreateVulkanInstanceKHR>(state_->instance, "xrCreateVulkanInstanceKHR");
  check(create(state_->instance, &xr_info, instance, &result), "xrCreateVulkanInstanceKHR");
  return result;
}

VkPhysicalDevice HeadsetRuntime::choose(VkInstance instance) {
  XrVulkanGraphicsDeviceGetInfoKHR xr_info{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR};
  xr_info.systemId = state_->system;
  xr_info.vulkanInstance = instance;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  const auto get = load<PFN_xrGetVulkanGraphicsDevice2KHR>(state_->instance, "xrGetVulkanGraphicsDevice2KHR");
  check(get(state_->instance, &xr_info, &physical), "xrGetVulkanGraphicsDevice2KHR");
  return physical;
}

VkResult HeadsetRuntime::make_device(VkPhysicalDevice physical, const VkDeviceCreateInfo& info, VkDevice* device) {
  XrVulkanDeviceCreateInfoKHR xr_info{XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR};
  xr_info.systemId = state_->system;
  xr_info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
  xr_info.vulkanPhysicalDevice = physical;
  xr_info.vulkanCreateInfo = &info;
  VkResult result = VK_SUCCESS;
  const auto create = load<PFN_xrCreateVulkanDeviceKHR>(state_->instance, "xrCreateVulkanDeviceKHR");
  check(create(state_->instance, &xr_info, device, &result), "xrCreateVulkanDeviceKHR");
  return result;
}

}  // namespace gearshift::engine
