// One Vulkan 1.3 device with one queue: instance, device, validation, memory, pipeline cache, submission.
// Dynamic rendering, synchronization2, timeline semaphore. Not thread-safe: one thread draws.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/gpu_error.h"
#include "engine/gpu/handle.h"

namespace gearshift {

// Who makes the Vulkan objects in place of us: an XR runtime adds what its compositor needs, and says which device the
// headset is at. Outlives the Gpu.
struct GpuMaker {
  virtual ~GpuMaker() = default;
  virtual VkResult make_instance(const VkInstanceCreateInfo& info, VkInstance* instance) = 0;
  virtual VkPhysicalDevice choose(VkInstance instance) = 0;  // throws what it likes
  virtual VkResult make_device(VkPhysicalDevice physical, const VkDeviceCreateInfo& info, VkDevice* device) = 0;
};

struct GpuConfig {
  std::vector<const char*> instance_extensions;  // what a window asks for
  bool swapchain = false;                        // VK_KHR_swapchain
  GpuMaker* maker = nullptr;                     // null: ourselves
  bool validation = false;                       // core and synchronization validation, where the layer is installed
  std::function<void(std::string_view)> on_validation;  // each message; never empty text
  std::filesystem::path pipeline_cache;                 // file; empty: none
};

struct GpuTraits {
  std::string name;                  // of the device
  std::string driver;                // its name and version, as it tells them
  bool is_cpu = false;               // a software driver: no anisotropy there (frames of seconds)
  bool layered_vertex = false;       // a vertex shader may choose the layer: both eyes in one pass
  bool four_samples = false;         // colour and depth
  bool depth_clamp = false;          // a pipeline may keep what lies before the near plane
  float most_anisotropy = 1.0f;      // 1: none
  double tick_ns = 1.0;              // of a timestamp
  std::uint32_t timestamp_bits = 0;  // 0: no timestamps
};

// A piece of device memory.
struct MemoryBlock;
struct Allocation {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
  VkDeviceSize size = 0;
  void* mapped = nullptr;  // of host-visible memory, at offset
  MemoryBlock* block = nullptr;
};
enum class MemoryKind { device, upload, read_back };  // upload and read_back are mapped and coherent
enum class MemoryUser { buffer, image };              // they never share a block: bufferImageGranularity

class Gpu {
 public:
  // A discrete device before an integrated before a software one; GEARSHIFT_GPU=substring of a name chooses; a maker's
  // choice goes before both. Throws GpuError with one sentence where there is no Vulkan 1.3 device (and names the package
  // that brings a software one).
  explicit Gpu(const GpuConfig& config);
  ~Gpu();  // waits idle and writes the pipeline cache (whole or not at all; a foreign or torn cache is ignored)
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  VkInstance instance() const noexcept;
  VkPhysicalDevice physical() const noexcept;
  VkDevice device() const noexcept;
  VkQueue queue() const noexcept;
  std::uint32_t queue_family() const noexcept;
  VkPipelineCache cache() const noexcept;
  const GpuTraits& traits() const noexcept;
  bool validates() const noexcept;                     // the layer is there and on
  std::uint64_t validation_messages() const noexcept;  // errors and warnings so far

  // First fit in blocks of 32 MiB; larger ones have a block of their own. Throws GpuError when memory is out.
  Allocation allocate(const VkMemoryRequirements& needs, MemoryKind kind, MemoryUser user);
  void free(const Allocation& allocation) noexcept;
  VkDeviceSize allocated() const noexcept;  // [bytes] in use

  // Submits to the queue. Returns the timeline value that stands when it is done. The binary semaphores are those of a
  // swapchain.
  std::uint64_t submit(VkCommandBuffer commands, VkSemaphore wait_for = VK_NULL_HANDLE,
                       VkSemaphore then_signal = VK_NULL_HANDLE);
  void wait(std::uint64_t value);           // on the host. Throws GpuLost
  bool is_done(std::uint64_t value) const;  // never waits
  void wait_idle() noexcept;                // whatever became of the device

  bool supports(VkFormat format, VkFormatFeatureFlags2 features) const;  // optimal tiling

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
