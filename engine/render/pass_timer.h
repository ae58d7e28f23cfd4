// When the passes of a frame began and ended on the GPU.
#pragma once

#include <array>

#include "engine/gpu/commands.h"
#include "engine/render/renderer.h"

namespace gearshift {

class PassTimer {
 public:
  explicit PassTimer(Gpu& gpu);

  // At the start of a frame: takes the times of the frame that used the slot before, which is finished.
  void begin(VkCommandBuffer commands, int slot);
  void stamp(VkCommandBuffer commands);  // the end of a pass: shadow, depth, mirror, main, overlay
  // A stamp that nobody reads: see Renderer::State::shade_soon(). Does nothing where a frame has too many.
  void nudge(VkCommandBuffer commands);
  const PassTimes& times() const noexcept { return times_; }

 private:
  static constexpr std::uint32_t kStamps = 6, kNudges = 122, kQueries = kStamps + kNudges;
  void read(std::uint32_t first);
  Gpu& gpu_;
  QueryPool queries_;
  std::array<bool, kFramesInFlight> written_{};
  std::uint32_t next_ = 0, next_nudge_ = 0, end_ = 0;
  PassTimes times_;
};

}  // namespace gearshift
