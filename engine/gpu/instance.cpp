#include "engine/gpu/instance.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace gearshift {
namespace {

constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";

bool is_layer_installed() {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(), [](const auto& l) { return std::strcmp(l.layerName, kLayer) == 0; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL heard(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* instance) {
  const bool has_text = data->pMessage != nullptr && *data->pMessage != '\0';
  static_cast<Instance*>(instance)->count(has_text ? data->pMessage : "a validation message without text");
  return VK_FALSE;
}

template <class Function>
Function load(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

void Instance::count(std::string_view message) {
  ++messages_;
  if (on_message_) on_message_(message);
}

Instance::Instance(const GpuConfig& config)
    : on_message_(config.on_validation), validates_(config.validation && is_layer_installed()) {
  VkDebugUtilsMessengerCreateInfoEXT messenger{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
                                               .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                                                  VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
                                               .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
                                               .pfnUserCallback = heard,
                                               .pUserData = this};
  const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  // The messenger in the chain hears the making and the end of the instance itself.
  const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                         .pNext = &messenger,
                                         .enabledValidationFeatureCount = 1,
                                         .pEnabledValidationFeatures = &synchronization};
  std::vector<const char*> extensions = config.instance_extensions;
  if (validates_) {
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  }
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                      .pApplicationName = "gearshift",
                                      .pEngineName = "gearshift",
                                      .apiVersion = VK_API_VERSION_1_3};
  const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                  .pNext = validates_ ? &features : nullptr,
                                  .pApplicationInfo = &application,
                                  .enabledLayerCount = validates_ ? 1u : 0u,
                                  .ppEnabledLayerNames = &kLayer,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
  const VkResult result = config.maker != nullptr ? config.maker->make_instance(info, &instance_)
                                                  : vkCreateInstance(&info, nullptr, &instance_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    throw GpuError("No Vulkan driver is installed: the package mesa-vulkan-drivers brings one that needs no card.");
  }
  check(result, "vkCreateInstance");
  if (!validates_) return;
  const auto create = load<PFN_vkCreateDebugUtilsMessengerEXT>(instance_, "vkCreateDebugUtilsMessengerEXT");
  const VkResult made = create(instance_, &messenger, nullptr, &messenger_);
  if (made != VK_SUCCESS) vkDestroyInstance(instance_, nullptr);
  check(made, "vkCreateDebugUtilsMessengerEXT");
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    load<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_,
                                                                                            nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

}  // namespace gearshift
