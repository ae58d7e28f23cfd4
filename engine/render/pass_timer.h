// Measures when the passes of a frame begin and end on the GPU.
#pragma once

#include <array>

#include "engine/gpu/commands.h"
#include "engine/render/renderer.h"

namespace gearshift::engine {

class PassTimer {
 public:
  explicit PassTimer(Gpu& gpu);

  // Call at the start of a frame. Reads the times of the previous, completed frame that used this slot.
  void begin(VkCommandBuffer commands, int slot);
  // Marks the end of a pass. Must be called for the passes in this order: shadow, depth, mirror, main, overlay.
  void stamp(VkCommandBuffer commands);
  // Writes a timestamp that is never read, which makes a software driver start shading: see
  // Renderer::State::flush_collected_triangles(). Does nothing after kFlushStamps calls in one frame.
  void stamp_to_flush(VkCommandBuffer commands);
  void end(int slot);  // call once the frame is submitted
  const PassTimes& times() const noexcept { return times_; }

 private:
  static constexpr std::uint32_t kStamps = 6, kFlushStamps = 122, kQueries = kStamps + kFlushStamps;
  void read(std::uint32_t first);
  Gpu& gpu_;
  QueryPool queries_;
  // A frame that failed half-way was not submitted, so its timestamps must not be read; the times of an earlier frame
  // are then kept.
  std::array<bool, kFramesInFlight> submitted_{};
  std::uint32_t next_ = 0, next_flush_stamp_ = 0, end_ = 0;
  PassTimes times_;
};

}  // namespace gearshift::engine
