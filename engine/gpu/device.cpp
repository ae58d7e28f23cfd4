#include "engine/gpu/device.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace gearshift::engine {
namespace {

// Features that a device supports.
struct Features {
  VkPhysicalDeviceVulkan13Features v13{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceVulkan12Features v12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &v13};
  VkPhysicalDeviceFeatures2 core{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &v12};
  Features() = default;
  Features(const Features&) = delete;  // not copyable: the pNext chain points into this object
  Features& operator=(const Features&) = delete;

  bool is_sufficient() const {
    return v13.dynamicRendering == VK_TRUE && v13.synchronization2 == VK_TRUE && v12.timelineSemaphore == VK_TRUE;
  }
};

// Features requested from the device, one structure each. An XR runtime appends its own structures to the chain; a
// structure must not appear twice, nor together with the VkPhysicalDeviceVulkan1xFeatures structure that includes it
// (VUID-VkDeviceCreateInfo-pNext-02830). Layer selection in a vertex shader has no structure; enabling its extension is
// enough.
struct RequestedFeatures {
  VkPhysicalDeviceDynamicRenderingFeatures rendering{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES, .dynamicRendering = VK_TRUE};
  VkPhysicalDeviceSynchronization2Features synchronization{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES,
      .pNext = &rendering,
      .synchronization2 = VK_TRUE};
  VkPhysicalDeviceTimelineSemaphoreFeatures timeline{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES,
      .pNext = &synchronization,
      .timelineSemaphore = VK_TRUE};
  VkPhysicalDeviceFeatures2 core{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &timeline};
  RequestedFeatures() = default;
  RequestedFeatures(const RequestedFeatures&) = delete;  // not copyable: the pNext chain points into this object
  RequestedFeatures& operator=(const RequestedFeatures&) = delete;
};

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
  devices.resize(count);
  return devices;
}

std::vector<VkQueueFamilyProperties> queue_families(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  return families;
}

std::optional<std::uint32_t> graphics_family(VkPhysicalDevice physical) {
  const auto families = queue_families(physical);
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if ((families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) return i;
  }
  return std::nullopt;
}

bool has_extension(VkPhysicalDevice physical, const char* name) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
}

bool is_usable(VkPhysicalDevice physical, const VkPhysicalDeviceProperties& properties, bool swapchain) {
  if (properties.apiVersion < VK_API_VERSION_1_3 || !graphics_family(physical)) return false;
  if (swapchain && !has_extension(physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME)) return false;
  Features supported;
  vkGetPhysicalDeviceFeatures2(physical, &supported.core);
  return supported.is_sufficient();
}

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 0;
    default:
      return 1;
  }
}

VkPhysicalDevice choose(VkInstance instance, bool swapchain, const std::string& wanted) {
  VkPhysicalDevice best = VK_NULL_HANDLE;
  int best_rank = -1;
  std::string names;
  for (VkPhysicalDevice physical : physical_devices(instance)) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    if (!is_usable(physical, properties, swapchain)) continue;
    names += (names.empty() ? "" : ", ") + std::string(properties.deviceName);
    const bool named = std::string_view(properties.deviceName).find(wanted) != std::string_view::npos;
    if (!named || rank(properties.deviceType) <= best_rank) continue;
    best = physical;
    best_rank = rank(properties.deviceType);
  }
  if (names.empty()) {
    throw GpuError("No Vulkan 1.3 device was found. Install the package mesa-vulkan-drivers for a software renderer.");
  }
  if (best == VK_NULL_HANDLE) {
    throw GpuError(fmt::format(
        "No Vulkan 1.3 device has \"{}\" in its name (GEARSHIFT_GPU). The available devices are: {}.", wanted, names));
  }
  return best;
}

// Returns the device that the factory chooses, i.e. the one that the headset is connected to. Throws GpuError if the
// device is not usable.
VkPhysicalDevice choose_with(GpuFactory& factory, VkInstance instance, bool swapchain) {
  VkPhysicalDevice physical = factory.choose(instance);
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  if (is_usable(physical, properties, swapchain)) return physical;
  throw GpuError(fmt::format("The headset is connected to {}, which is not a usable Vulkan 1.3 device.",
                             static_cast<const char*>(properties.deviceName)));
}

std::string driver_of(VkPhysicalDevice physical) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 all{};
  all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  all.pNext = &driver;
  vkGetPhysicalDeviceProperties2(physical, &all);
  return fmt::format("{} {}", static_cast<const char*>(driver.driverName), static_cast<const char*>(driver.driverInfo));
}

GpuTraits traits_of(VkPhysicalDevice physical, const VkPhysicalDeviceProperties& properties, const Features& supported,
                    const VkQueueFamilyProperties& family) {
  const auto& limits = properties.limits;
  GpuTraits traits;
  traits.name = properties.deviceName;
  traits.driver = driver_of(physical);
  traits.is_cpu = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  traits.layered_vertex = supported.v12.shaderOutputLayer == VK_TRUE &&
                          has_extension(physical, VK_EXT_SHADER_VIEWPORT_INDEX_LAYER_EXTENSION_NAME);
  traits.four_samples =
      (limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts & VK_SAMPLE_COUNT_4_BIT) != 0;
  traits.depth_clamp = supported.core.features.depthClamp == VK_TRUE;
  if (supported.core.features.samplerAnisotropy == VK_TRUE && !traits.is_cpu) {
    traits.max_anisotropy = limits.maxSamplerAnisotropy;
  }
  traits.tick_ns = static_cast<double>(limits.timestampPeriod);
  traits.timestamp_bits = family.timestampValidBits;
  return traits;
}

VkDevice make_device(VkPhysicalDevice physical, std::uint32_t family, const GpuTraits& traits,
                     const Features& supported, bool swapchain, GpuFactory* factory) {
  RequestedFeatures requested;
  requested.core.features.depthClamp = supported.core.features.depthClamp;
  requested.core.features.samplerAnisotropy = traits.max_anisotropy > 1.0f ? VK_TRUE : VK_FALSE;
  const float priority = 1.0f;
  const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                      .queueFamilyIndex = family,
                                      .queueCount = 1,
                                      .pQueuePriorities = &priority};
  std::vector<const char*> extensions;
  if (swapchain) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  if (traits.layered_vertex) extensions.push_back(VK_EXT_SHADER_VIEWPORT_INDEX_LAYER_EXTENSION_NAME);
  const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                .pNext = &requested.core,
                                .queueCreateInfoCount = 1,
                                .pQueueCreateInfos = &queue,
                                .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                .ppEnabledExtensionNames = extensions.data()};
  VkDevice device = VK_NULL_HANDLE;
  check(factory != nullptr ? factory->make_device(physical, info, &device)
                           : vkCreateDevice(physical, &info, nullptr, &device),
        "vkCreateDevice");
  return device;
}

}  // namespace

Device::Device(VkInstance instance, bool swapchain, const std::string& wanted, GpuFactory* factory)
    : physical_(factory != nullptr ? choose_with(*factory, instance, swapchain) : choose(instance, swapchain, wanted)),
      family_(graphics_family(physical_).value()) {
  vkGetPhysicalDeviceProperties(physical_, &properties_);
  Features supported;
  vkGetPhysicalDeviceFeatures2(physical_, &supported.core);
  traits_ = traits_of(physical_, properties_, supported, queue_families(physical_)[family_]);
  device_ = make_device(physical_, family_, traits_, supported, swapchain, factory);
  vkGetDeviceQueue(device_, family_, 0, &queue_);
}

Device::~Device() {
  vkDestroyDevice(device_, nullptr);
}

}  // namespace gearshift::engine
