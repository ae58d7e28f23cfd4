// An OpenXR runtime and the headset at it; makes the Vulkan objects that both can use.
#pragma once

#include <memory>
#include <string>

#include <glm/vec2.hpp>

#include "engine/gpu/gpu.h"
#include "engine/xr/headset_error.h"

namespace gearshift {

struct HeadsetTraits {
  std::string runtime;    // name and version
  std::string headset;    // name
  glm::ivec2 eye{0};      // [px] that the runtime recommends
  glm::ivec2 largest{0};  // [px] that it takes
  bool depth = false;     // it takes the depth of the picture, and projects with it
};

class HeadsetRuntime final : public GpuMaker {
 public:
  // Throws HeadsetAbsent where no headset is at the runtime now, HeadsetError with one sentence where there is no runtime
  // (XR_RUNTIME_JSON, or what the system has as its active one) or it cannot do what we need: two eyes, Vulkan 1.3.
  HeadsetRuntime();
  ~HeadsetRuntime() override;
  HeadsetRuntime(const HeadsetRuntime&) = delete;
  HeadsetRuntime& operator=(const HeadsetRuntime&) = delete;

  const HeadsetTraits& traits() const noexcept;

  VkResult make_instance(const VkInstanceCreateInfo& info, VkInstance* instance) override;
  VkPhysicalDevice choose(VkInstance instance) override;
  VkResult make_device(VkPhysicalDevice physical, const VkDeviceCreateInfo& info, VkDevice* device) override;

 private:
  friend class HeadsetSession;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
