// Statistics of headset frames: CPU and GPU time, delays, dropped frames.
#pragma once

#include <cstdint>

#include "engine/xr/headset_session.h"

namespace gearshift::engine {

// Times of the newest frame; counts since the session began.
struct HeadsetTiming {
  double period_ms = 0.0;
  double cpu_ms = 0.0;  // from the runtime's request for the frame to its submission
  double gpu_ms = 0.0;
  double spare_ms = 0.0;  // from the end of drawing to the display time; negative if drawing ended too late
  // Estimated delay of the display: from the planned display time to the first display period that begins after drawing
  // ended. OpenXR does not report the actual display time.
  double late_ms = 0.0;
  std::uint64_t frames = 0;
  std::uint64_t dropped = 0;  // display periods without a new frame
  std::uint64_t late = 0;     // frames whose drawing ended too late for their planned display time
};

class FrameTimes {
 public:
  // Adds a frame that was submitted at `submit_ns` and then took `gpu_ms` on the GPU.
  void add(const HeadsetFrame& frame, std::int64_t submit_ns, double gpu_ms);
  void pause() { last_display_ns_ = 0; }  // frames are not paced for a while: do not count this time as dropped frames
  const HeadsetTiming& timing() const noexcept { return timing_; }

 private:
  HeadsetTiming timing_;
  std::int64_t last_display_ns_ = 0;
};

}  // namespace gearshift::engine
