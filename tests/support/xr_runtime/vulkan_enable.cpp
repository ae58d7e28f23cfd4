// XR_KHR_vulkan_enable2, which creates Vulkan objects for the program (this runtime adds nothing to the create infos),
// and XR_KHR_convert_timespec_time.
#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {

namespace {

VkPhysicalDevice first_device(VkInstance instance, PFN_vkGetInstanceProcAddr get) {
  const auto enumerate = reinterpret_cast<PFN_vkEnumeratePhysicalDevices>(get(instance, "vkEnumeratePhysicalDevices"));
  std::uint32_t count = 1;
  VkPhysicalDevice first = VK_NULL_HANDLE;
  enumerate(instance, &count, &first);
  return first;
}

}  // namespace

namespace xr {

XrResult XRAPI_CALL GetVulkanGraphicsRequirements2KHR(XrInstance instance, XrSystemId system,
                                                      XrGraphicsRequirementsVulkanKHR* requirements) {
  return call("xrGetVulkanGraphicsRequirements2KHR", [&](State&) {
    InstanceObject& object = live(instance);
    require_system(system);
    requirements->minApiVersionSupported = XR_MAKE_VERSION(1, 0, 0);
    requirements->maxApiVersionSupported = XR_MAKE_VERSION(1, 3, 0);
    object.requirements_queried = true;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL CreateVulkanInstanceKHR(XrInstance instance, const XrVulkanInstanceCreateInfoKHR* info,
                                            VkInstance* vulkan, VkResult* result) {
  return call("xrCreateVulkanInstanceKHR", [&](State& s) {
    live(instance);
    require_system(info->systemId);
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(info->pfnGetInstanceProcAddr(VK_NULL_HANDLE, "vkCreateInstance"));
    *result = create(info->vulkanCreateInfo, info->vulkanAllocator, vulkan);
    if (*result == VK_SUCCESS) s.vulkan_instances[*vulkan] = info->pfnGetInstanceProcAddr;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL GetVulkanGraphicsDevice2KHR(XrInstance instance, const XrVulkanGraphicsDeviceGetInfoKHR* info,
                                                VkPhysicalDevice* device) {
  return call("xrGetVulkanGraphicsDevice2KHR", [&](State& s) {
    live(instance);
    require_system(info->systemId);
    const auto created = s.vulkan_instances.find(info->vulkanInstance);
    require(created != s.vulkan_instances.end(), "graphics_binding", "vulkanInstance is not the runtime's");
    *device = first_device(info->vulkanInstance, created->second);
    if (*device == VK_NULL_HANDLE) return XR_ERROR_RUNTIME_FAILURE;
    s.vulkan_physicals[*device] = info->vulkanInstance;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL CreateVulkanDeviceKHR(XrInstance instance, const XrVulkanDeviceCreateInfoKHR* info,
                                          VkDevice* device, VkResult* result) {
  return call("xrCreateVulkanDeviceKHR", [&](State& s) {
    live(instance);
    require_system(info->systemId);
    const auto known = s.vulkan_physicals.find(info->vulkanPhysicalDevice);
    require(known != s.vulkan_physicals.end(), "graphics_binding", "vulkanPhysicalDevice is not the runtime's");
    const auto create =
        reinterpret_cast<PFN_vkCreateDevice>(info->pfnGetInstanceProcAddr(known->second, "vkCreateDevice"));
    *result = create(info->vulkanPhysicalDevice, info->vulkanCreateInfo, info->vulkanAllocator, device);
    if (*result == VK_SUCCESS) s.vulkan_devices[*device] = info->vulkanPhysicalDevice;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL ConvertTimespecTimeToTimeKHR(XrInstance instance, const timespec* from, XrTime* to) {
  return call("xrConvertTimespecTimeToTimeKHR", [&](State&) {
    live(instance);
    *to = from->tv_sec * 1'000'000'000 + from->tv_nsec;
    require(*to > 0, "time_positive");
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL ConvertTimeToTimespecTimeKHR(XrInstance instance, XrTime from, timespec* to) {
  return call("xrConvertTimeToTimespecTimeKHR", [&](State&) {
    live(instance);
    require(from > 0, "time_positive");
    *to = {.tv_sec = from / 1'000'000'000, .tv_nsec = from % 1'000'000'000};
    return XR_SUCCESS;
  });
}

}  // namespace xr
}  // namespace gearshift::xr_test
