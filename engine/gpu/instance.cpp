#include "engine/gpu/instance.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace gearshift::engine {
namespace {

constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";

bool is_layer_installed() {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(), [](const auto& l) { return std::strcmp(l.layerName, kLayer) == 0; });
}

// Newer validation layers give the rule only as the message's name.
VKAPI_ATTR VkBool32 VKAPI_CALL on_debug_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                                const VkDebugUtilsMessengerCallbackDataEXT* data, void* instance) {
  const bool has_text = data->pMessage != nullptr && *data->pMessage != '\0';
  const std::string_view text = has_text ? data->pMessage : "validation message without text";
  const std::string_view rule = data->pMessageIdName != nullptr ? data->pMessageIdName : "";
  const bool names_rule = text.find(rule) != std::string_view::npos;
  static_cast<Instance*>(instance)->count(names_rule ? std::string(text) : fmt::format("{}: {}", rule, text));
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
                                               .pfnUserCallback = on_debug_message,
                                               .pUserData = this};
  const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  // A messenger in the pNext chain also reports on vkCreateInstance and vkDestroyInstance themselves.
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
  const VkResult result = config.factory != nullptr ? config.factory->make_instance(info, &instance_)
                                                    : vkCreateInstance(&info, nullptr, &instance_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    throw GpuError(
        "No Vulkan driver could be loaded. Install your graphics card's driver, or the package mesa-vulkan-drivers for "
        "a software renderer.");
  }
  check(result, "vkCreateInstance");
  if (!validates_) return;
  const auto create = load<PFN_vkCreateDebugUtilsMessengerEXT>(instance_, "vkCreateDebugUtilsMessengerEXT");
  const VkResult created = create(instance_, &messenger, nullptr, &messenger_);
  if (created != VK_SUCCESS) vkDestroyInstance(instance_, nullptr);
  check(created, "vkCreateDebugUtilsMessengerEXT");
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    load<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_,
                                                                                            nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

}  // namespace gearshift::engine
