// Command buffers: a ring for frames in flight, and one-off work.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "engine/gpu/gpu.h"

namespace gearshift {

inline constexpr int kFramesInFlight = 2;

class FrameRing {
 public:
  explicit FrameRing(Gpu& gpu);
  ~FrameRing();  // waits for what it has submitted

  // Waits until the frame before last is done, then begins. slot(): which of the kFramesInFlight this is, for the
  // buffers that the frame writes.
  VkCommandBuffer begin();
  int slot() const noexcept { return slot_; }
  std::uint64_t end(VkSemaphore wait_for = VK_NULL_HANDLE, VkSemaphore then_signal = VK_NULL_HANDLE);
  void wait();  // for all frames

 private:
  Gpu& gpu_;
  CommandPool pool_;
  std::array<VkCommandBuffer, kFramesInFlight> commands_{};
  std::array<std::uint64_t, kFramesInFlight> done_{};
  int slot_ = kFramesInFlight - 1;
};

// Records, submits, waits.
void run_once(Gpu& gpu, const std::function<void(VkCommandBuffer)>& record);

}  // namespace gearshift
