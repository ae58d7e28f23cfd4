// State of a runtime, private to this library.
#pragma once

#include "engine/xr/headset_runtime.h"
#include "engine/xr/openxr.h"

namespace gearshift::engine {

inline constexpr XrViewConfigurationType kTwoEyes = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

struct HeadsetRuntime::State {
  State();
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  XrInstance instance = XR_NULL_HANDLE;
  XrSystemId system = XR_NULL_SYSTEM_ID;
  XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  std::vector<std::string> extensions;  // enabled
  bool timespec = false;                // the runtime can convert our clock's times to its own clock
  HeadsetTraits traits;

 private:
  void make_instance();
  void find_headset();
  void check_vulkan() const;
};

}  // namespace gearshift::engine
