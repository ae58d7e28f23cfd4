// Command buffers: a ring for the frames in flight, and one-off submissions.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "engine/gpu/gpu.h"

namespace gearshift::engine {

inline constexpr int kFramesInFlight = 2;

class FrameRing {
 public:
  explicit FrameRing(Gpu& gpu);
  ~FrameRing();  // waits for all submitted frames

  // Moves to the next slot, waits for the frame that last used it, and begins recording. slot() is then the index (0 to
  // kFramesInFlight - 1) of the buffers that the new frame may write.
  VkCommandBuffer begin();
  int slot() const noexcept { return slot_; }
  std::uint64_t end(VkSemaphore wait_for = VK_NULL_HANDLE, VkSemaphore then_signal = VK_NULL_HANDLE);
  void wait();  // waits for all submitted frames

 private:
  Gpu& gpu_;
  CommandPool pool_;
  std::array<VkCommandBuffer, kFramesInFlight> commands_{};
  std::array<std::uint64_t, kFramesInFlight> done_{};
  int slot_ = kFramesInFlight - 1;
};

// Records and submits a command buffer, then waits for it.
void run_once(Gpu& gpu, const std::function<void(VkCommandBuffer)>& record);

}  // namespace gearshift::engine
