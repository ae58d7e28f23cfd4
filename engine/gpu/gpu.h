// One Vulkan 1.3 device with one queue: instance, device, validation, memory, pipeline cache, submission. Uses dynamic
// rendering, synchronization2 and timeline semaphores. Not thread-safe: only one thread may draw.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/gpu_error.h"
#include "engine/gpu/handle.h"

namespace gearshift::engine {

// Creates the Vulkan instance and device for the Gpu: an XR runtime adds the extensions that its compositor needs and
// selects the device that the headset is connected to. Must outlive the Gpu.
struct GpuFactory {
  virtual ~GpuFactory() = default;
  virtual VkResult make_instance(const VkInstanceCreateInfo& info, VkInstance* instance) = 0;
  virtual VkPhysicalDevice choose(VkInstance instance) = 0;  // may throw any exception
  virtual VkResult make_device(VkPhysicalDevice physical, const VkDeviceCreateInfo& info, VkDevice* device) = 0;
};

struct GpuConfig {
  std::vector<const char*> instance_extensions;  // extensions required by the window
  bool swapchain = false;                        // VK_KHR_swapchain
  GpuFactory* factory = nullptr;                 // null: the Gpu creates instance and device itself
  bool validation = false;                       // core and synchronization validation, if the layer is installed
  std::function<void(std::string_view)> on_validation;  // called with each validation message, which is never empty
  std::filesystem::path pipeline_cache;                 // file name; empty: no cache
};

struct GpuTraits {
  std::string name;    // device name
  std::string driver;  // driver name and version, as reported
  // Software driver. Gets no anisotropic filtering: with it, lavapipe takes 25 times as long in Mesa 22.3, and more than
  // a second for a picture in 25.0, which also leaves pixels black.
  bool is_cpu = false;
  bool layered_vertex = false;       // a vertex shader can select the layer, so one pass can draw both eyes
  bool four_samples = false;         // 4x multisampling of colour and depth
  bool depth_clamp = false;          // pipelines can clamp the depth of geometry in front of the near plane
  float max_anisotropy = 1.0f;       // 1: no anisotropic filtering
  double tick_ns = 1.0;              // duration of one timestamp tick
  std::uint32_t timestamp_bits = 0;  // 0: no timestamps
};

struct MemoryBlock;
struct Allocation {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
  VkDeviceSize size = 0;
  void* mapped = nullptr;  // address of the byte at offset; null if not host-visible
  MemoryBlock* block = nullptr;
};
enum class MemoryKind { device, upload, read_back };  // upload and read_back are mapped and coherent
enum class MemoryUser { buffer, image };              // separate memory blocks, because of bufferImageGranularity

class Gpu {
 public:
  // Prefers a discrete device, then an integrated one, then a software one. GEARSHIFT_GPU=SUBSTRING in the environment
  // selects a device by name. A factory's choice overrides this order and this variable. Throws GpuError with one
  // sentence if there is no Vulkan 1.3 device; the sentence names the package that provides a software driver.
  explicit Gpu(const GpuConfig& config);
  ~Gpu();  // waits until idle and saves the pipeline cache (written atomically)
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  VkInstance instance() const noexcept;
  VkPhysicalDevice physical() const noexcept;
  VkDevice device() const noexcept;
  VkQueue queue() const noexcept;
  std::uint32_t queue_family() const noexcept;
  VkPipelineCache cache() const noexcept;
  const GpuTraits& traits() const noexcept;
  bool validates() const noexcept;                     // the validation layer is installed and enabled
  std::uint64_t validation_messages() const noexcept;  // errors and warnings reported so far

  // Allocates first-fit from blocks of 32 MiB; a larger allocation gets a block of its own. Throws GpuError if memory
  // runs out.
  Allocation allocate(const VkMemoryRequirements& needs, MemoryKind kind, MemoryUser user);
  void free(const Allocation& allocation) noexcept;
  VkDeviceSize allocated() const noexcept;  // [bytes] currently allocated

  // Submits to the queue and returns the timeline value that is signalled on completion. The two semaphores are binary
  // and are needed only for a swapchain.
  std::uint64_t submit(VkCommandBuffer commands, VkSemaphore wait_for = VK_NULL_HANDLE,
                       VkSemaphore then_signal = VK_NULL_HANDLE);
  void wait(std::uint64_t value);           // waits until the timeline semaphore reaches the value. Throws GpuLost
  bool is_done(std::uint64_t value) const;  // does not block
  void wait_idle() noexcept;                // also returns if the device is lost
  // Held by those who use the queue or wait_idle(), where an OpenXR runtime uses the queue on another thread.
  std::mutex& queue_mutex() noexcept;

  bool supports(VkFormat format, VkFormatFeatureFlags2 features) const;  // for optimal tiling

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::engine
