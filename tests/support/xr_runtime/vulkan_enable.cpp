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
    require_structure(requirements, XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR);
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
    require_structure(info, XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR);
    require_system(info->systemId);
    require_pointer(reinterpret_cast<const void*>(info->pfnGetInstanceProcAddr), "pfnGetInstanceProcAddr");
    require_pointer(info->vulkanCreateInfo, "vulkanCreateInfo");
    require_pointer(vulkan, "vulkanInstance");
    require_pointer(result, "vulkanResult");
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
    require_structure(info, XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR);
    require_system(info->systemId);
    require_pointer(device, "vulkanPhysicalDevice");
    const auto created = s.vulkan_instances.find(info->vulkanInstance);
    require(created != s.vulkan_instances.end(), "handle_live", "vulkanInstance is not of xrCreateVulkanInstanceKHR");
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
    require_structure(info, XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR);
    require_system(info->systemId);
    require_pointer(reinterpret_cast<const void*>(info->pfnGetInstanceProcAddr), "pfnGetInstanceProcAddr");
    require_pointer(info->vulkanCreateInfo, "vulkanCreateInfo");
    require_pointer(device, "vulkanDevice");
    require_pointer(result, "vulkanResult");
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
    require_pointer(from, "timespecTime");
    require_pointer(to, "time");
    *to = from->tv_sec * 1'000'000'000 + from->tv_nsec;
    require(*to > 0, "time_positive");
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL ConvertTimeToTimespecTimeKHR(XrInstance instance, XrTime from, timespec* to) {
  return call("xrConvertTimeToTimespecTimeKHR", [&](State&) {
    live(instance);
    require_pointer(to, "timespecTime");
    require(from > 0, "time_positive");
    *to = {.tv_sec = from / 1'000'000'000, .tv_nsec = from % 1'000'000'000};
    return XR_SUCCESS;
  });
}

}  // namespace xr
}  // namespace gearshift::xr_test
