// Instance, system, events, names of enumeration values.
#include <openxr/openxr_reflection.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

constexpr XrSystemId kSystem = 0x67656172;

struct Offer {
  const char* name;
  std::uint32_t version;
};

std::vector<Offer> offered(const Script& script) {
  std::vector<Offer> offers;
  if (script.vulkan_enable2)
    offers.push_back({XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME, XR_KHR_vulkan_enable2_SPEC_VERSION});
  if (script.composition_layer_depth) {
    offers.push_back({XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME, XR_KHR_composition_layer_depth_SPEC_VERSION});
  }
  if (script.convert_timespec_time) {
    offers.push_back({XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME, XR_KHR_convert_timespec_time_SPEC_VERSION});
  }
  return offers;
}

// True if the OpenXR loader puts Khronos' validation layer in front of this runtime. If the layer is missing, the loader
// creates no instance.
bool is_validated() {
  const char* const layers = std::getenv("XR_ENABLE_API_LAYERS");
  return layers != nullptr && std::strcmp(layers, "XR_APILAYER_LUNARG_core_validation") == 0;
}

template <std::size_t size>
void copy_text(char (&to)[size], const std::string& from) {
  std::snprintf(to, size, "%s", from.c_str());
}

// Called by each xrPollEvent that returns no event. Advances the stepped clock while no session is running, and counts
// down the calls until a session becomes READY.
void tick(State& s) {
  const bool frames_running = !s.sessions.find_all([](const SessionObject& one) { return one.running; }).empty();
  if (s.begin != 0 && !frames_running && s.control.script.pacing == Pacing::stepped) ++s.next_step;
  for (const XrSession handle :
       s.sessions.find_all([](const SessionObject& one) { return one.polls_before_ready > 0; })) {
    SessionObject& session = *s.sessions.find(handle);
    if (--session.polls_before_ready == 0) set_state(s, handle, session, XR_SESSION_STATE_READY);
  }
}

}  // namespace

void require_system(XrSystemId system) {
  require(system == kSystem, "system_id");
}

void require_stereo(XrViewConfigurationType type) {
  require(type == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, "view_configuration");
}

namespace xr {

XrResult XRAPI_CALL EnumerateInstanceExtensionProperties(const char* layer, std::uint32_t capacity,
                                                         std::uint32_t* count, XrExtensionProperties* properties) {
  return call("xrEnumerateInstanceExtensionProperties", [&](State& s) {
    if (layer != nullptr) return XR_ERROR_API_LAYER_NOT_PRESENT;
    return fill(capacity, count, properties, offered(s.control.script),
                [](XrExtensionProperties& to, const Offer& from) {
                  copy_text(to.extensionName, from.name);
                  to.extensionVersion = from.version;
                });
  });
}

XrResult XRAPI_CALL CreateInstance(const XrInstanceCreateInfo* info, XrInstance* instance) {
  return call("xrCreateInstance", [&](State& s) {
    require(is_validated(), "validated");
    if (s.instances.size() != 0) return XR_ERROR_LIMIT_REACHED;
    InstanceObject created;
    const std::vector<Offer> offers = offered(s.control.script);
    for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
      const std::string name = info->enabledExtensionNames[i];
      if (std::none_of(offers.begin(), offers.end(), [&](const Offer& one) { return name == one.name; })) {
        return XR_ERROR_EXTENSION_NOT_PRESENT;
      }
      created.extensions.insert(name);
    }
    if (XR_VERSION_MAJOR(info->applicationInfo.apiVersion) != 1) return XR_ERROR_API_VERSION_UNSUPPORTED;
    *instance = s.instances.add(std::move(created));
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL DestroyInstance(XrInstance instance) {
  return call("xrDestroyInstance", [&](State& s) {
    for (const XrSession session :
         s.sessions.find_all([&](const SessionObject& one) { return one.instance == instance; })) {
      leak(s, "session", "instance");
      drop_session(s, session);
    }
    for (const XrActionSet set :
         s.action_sets.find_all([&](const ActionSetObject& one) { return one.instance == instance; })) {
      leak(s, "action set", "instance");
      drop_action_set(s, set);
    }
    s.instances.erase(instance);
    s.vulkan_instances.clear();
    s.vulkan_physicals.clear();
    s.vulkan_devices.clear();
    s.events.clear();
    s.control.record.state = XR_SESSION_STATE_UNKNOWN;
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL GetInstanceProperties(XrInstance instance, XrInstanceProperties* properties) {
  return call("xrGetInstanceProperties", [&](State&) {
    live(instance);
    properties->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
    copy_text(properties->runtimeName, "gearshift test runtime");
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL PollEvent(XrInstance instance, XrEventDataBuffer* data) {
  return call("xrPollEvent", [&](State& s) {
    InstanceObject* const object = s.instances.find(instance);
    if (!object->lost) play_timeline(s, seconds(s, now(s)));
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

XrResult XRAPI_CALL ResultToString(XrInstance instance, XrResult value, char buffer[XR_MAX_RESULT_STRING_SIZE]) {
  return call("xrResultToString", [&](State&) {
    live(instance);
    std::string name = (value < 0 ? "XR_UNKNOWN_FAILURE_" : "XR_UNKNOWN_SUCCESS_") + std::to_string(value);
#define GEARSHIFT_XR_NAME(one, number) \
  if (value == (number)) name = #one;
    XR_LIST_ENUM_XrResult(GEARSHIFT_XR_NAME);
    std::snprintf(buffer, XR_MAX_RESULT_STRING_SIZE, "%s", name.c_str());
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL StructureTypeToString(XrInstance instance, XrStructureType value,
                                          char buffer[XR_MAX_STRUCTURE_NAME_SIZE]) {
  return call("xrStructureTypeToString", [&](State&) {
    live(instance);
    std::string name = "XR_UNKNOWN_STRUCTURE_TYPE_" + std::to_string(value);
    XR_LIST_ENUM_XrStructureType(GEARSHIFT_XR_NAME);
#undef GEARSHIFT_XR_NAME
    std::snprintf(buffer, XR_MAX_STRUCTURE_NAME_SIZE, "%s", name.c_str());
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL GetSystem(XrInstance instance, const XrSystemGetInfo* info, XrSystemId* system) {
  return call("xrGetSystem", [&](State& s) {
    live(instance);
    require(info->formFactor == XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY, "form_factor");
    if (!s.control.script.headset) return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
    *system = kSystem;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL GetSystemProperties(XrInstance instance, XrSystemId system, XrSystemProperties* properties) {
  return call("xrGetSystemProperties", [&](State& s) {
    live(instance);
    require_system(system);
    properties->systemId = system;
    properties->vendorId = 0;
    copy_text(properties->systemName, "gearshift test headset");
    properties->graphicsProperties = {s.control.script.max_height, s.control.script.max_width,
                                      XR_MIN_COMPOSITION_LAYERS_SUPPORTED};
    properties->trackingProperties = {XR_TRUE, XR_TRUE};
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL EnumerateEnvironmentBlendModes(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                                                   std::uint32_t capacity, std::uint32_t* count,
                                                   XrEnvironmentBlendMode* modes) {
  return call("xrEnumerateEnvironmentBlendModes", [&](State&) {
    live(instance);
    require_system(system);
    require_stereo(type);
    return fill(capacity, count, modes, std::vector{XR_ENVIRONMENT_BLEND_MODE_OPAQUE});
  });
}

XrResult XRAPI_CALL EnumerateViewConfigurations(XrInstance instance, XrSystemId system, std::uint32_t capacity,
                                                std::uint32_t* count, XrViewConfigurationType* types) {
  return call("xrEnumerateViewConfigurations", [&](State&) {
    live(instance);
    require_system(system);
    return fill(capacity, count, types, std::vector{XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO});
  });
}

XrResult XRAPI_CALL GetViewConfigurationProperties(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                                                   XrViewConfigurationProperties* properties) {
  return call("xrGetViewConfigurationProperties", [&](State&) {
    live(instance);
    require_system(system);
    require_stereo(type);
    properties->viewConfigurationType = type;
    properties->fovMutable = XR_TRUE;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL EnumerateViewConfigurationViews(XrInstance instance, XrSystemId system,
                                                    XrViewConfigurationType type, std::uint32_t capacity,
                                                    std::uint32_t* count, XrViewConfigurationView* views) {
  return call("xrEnumerateViewConfigurationViews", [&](State& s) {
    live(instance);
    require_system(system);
    require_stereo(type);
    const Script& script = s.control.script;
    return fill(capacity, count, views, std::vector{0, 1}, [&](XrViewConfigurationView& to, int) {
      to.recommendedImageRectWidth = script.recommended_width;
      to.recommendedImageRectHeight = script.recommended_height;
      to.maxImageRectWidth = script.max_width;
      to.maxImageRectHeight = script.max_height;
      to.recommendedSwapchainSampleCount = script.recommended_samples;
      to.maxSwapchainSampleCount = script.max_samples;
    });
  });
}

}  // namespace xr
}  // namespace gearshift::xr_test
