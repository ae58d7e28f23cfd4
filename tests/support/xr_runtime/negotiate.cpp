// Passes the runtime's functions to the OpenXR loader. Debian has no header with the structures for this, so they are
// defined here, as in the loader's document "Loader/Runtime Interface Negotiation".
#include <string_view>

#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

struct LoaderInfo {
  int structure_type;
  std::uint32_t structure_version;
  std::size_t structure_size;
  std::uint32_t min_interface, max_interface;
  XrVersion min_api, max_api;
};

struct RuntimeRequest {
  int structure_type;
  std::uint32_t structure_version;
  std::size_t structure_size;
  std::uint32_t interface_version;
  XrVersion api_version;
  PFN_xrGetInstanceProcAddr get_function;
};

struct Function {
  const char* name;
  const char* extension;
  PFN_xrVoidFunction address;
};
const Function functions[] = {
#define GEARSHIFT_XR_FUNCTION(name) reinterpret_cast<PFN_xrVoidFunction>(&xr::name)
#define GEARSHIFT_XR_ENTRY(name) {"xr" #name, nullptr, GEARSHIFT_XR_FUNCTION(name)},
    GEARSHIFT_XR_CORE(GEARSHIFT_XR_ENTRY)
#undef GEARSHIFT_XR_ENTRY
#define GEARSHIFT_XR_ENTRY(name) {"xr" #name, XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME, GEARSHIFT_XR_FUNCTION(name)},
        GEARSHIFT_XR_VULKAN_ENABLE2(GEARSHIFT_XR_ENTRY)
#undef GEARSHIFT_XR_ENTRY
#define GEARSHIFT_XR_ENTRY(name) {"xr" #name, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME, GEARSHIFT_XR_FUNCTION(name)},
            GEARSHIFT_XR_CONVERT_TIMESPEC_TIME(GEARSHIFT_XR_ENTRY)
#undef GEARSHIFT_XR_ENTRY
#undef GEARSHIFT_XR_FUNCTION
};

// True if the instance (there is at most one) enabled the extension.
bool enabled(const char* extension) {
  const auto has_it = [&](const InstanceObject& one) { return one.extensions.contains(extension); };
  return !state().instances.find_all(has_it).empty();
}

XrResult XRAPI_CALL get_function(XrInstance instance, const char* name, PFN_xrVoidFunction* address) {
  *address = nullptr;
  const std::string_view wanted = name;
  if (wanted == "xrGetInstanceProcAddr") {
    *address = reinterpret_cast<PFN_xrVoidFunction>(&get_function);
    return XR_SUCCESS;
  }
  const bool early = wanted == "xrCreateInstance" || wanted == "xrEnumerateInstanceExtensionProperties";
  if (instance == XR_NULL_HANDLE && !early) return XR_ERROR_HANDLE_INVALID;
  for (const Function& one : functions) {
    if (wanted != one.name || (one.extension != nullptr && !enabled(one.extension))) continue;
    *address = one.address;
    return XR_SUCCESS;
  }
  return XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace
}  // namespace gearshift::xr_test

// NOLINTNEXTLINE(readability-identifier-naming): the loader requires this name
extern "C" __attribute__((visibility("default"))) XrResult XRAPI_CALL xrNegotiateLoaderRuntimeInterface(
    const gearshift::xr_test::LoaderInfo* loader, gearshift::xr_test::RuntimeRequest* request) {
  constexpr std::uint32_t kInterface = 1;
  if (loader->min_interface > kInterface || loader->max_interface < kInterface) return XR_ERROR_INITIALIZATION_FAILED;
  request->interface_version = kInterface;
  request->api_version = XR_CURRENT_API_VERSION;
  request->get_function = gearshift::xr_test::get_function;
  return XR_SUCCESS;
}
