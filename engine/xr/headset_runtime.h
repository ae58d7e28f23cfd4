// An OpenXR runtime with its headset; creates the Vulkan instance and device that both can use.
#pragma once

#include <memory>
#include <string>

#include <glm/vec2.hpp>

#include "engine/gpu/gpu.h"
#include "engine/xr/headset_error.h"

namespace gearshift::engine {

struct HeadsetTraits {
  std::string runtime;    // name and version
  std::string headset;    // name
  glm::ivec2 eye{0};      // [px] recommended size per eye
  glm::ivec2 largest{0};  // [px] maximum size per eye
  bool depth = false;     // the runtime accepts depth images, for reprojection
};

class HeadsetRuntime final : public GpuFactory {
 public:
  // Throws HeadsetAbsent if no headset is connected to the runtime now. Throws HeadsetError with one sentence if there
  // is no runtime (XR_RUNTIME_JSON, or the system's active runtime), if its service does not run, or if it lacks a
  // requirement: two eyes, Vulkan 1.3. Runtime and loader may print to stderr.
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

}  // namespace gearshift::engine
