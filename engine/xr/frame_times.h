// What a headset's frames cost, and whether they came in time.
#pragma once

#include <cstdint>

#include "engine/xr/headset_session.h"

namespace gearshift {

// Of the newest frame; the counts are since the session began.
struct HeadsetTiming {
  double period_ms = 0.0;
  double cpu_ms = 0.0;  // from when the runtime asked for it until it was handed over
  double gpu_ms = 0.0;
  double spare_ms = 0.0;  // from when it was drawn until it was to be seen; negative: too late for that
  // From when it was to be seen to when it could be: the first display period after it was drawn. OpenXR tells no more.
  double late_ms = 0.0;
  std::uint64_t frames = 0;
  std::uint64_t dropped = 0;  // display periods without a new frame
  std::uint64_t late = 0;     // frames that were not drawn in time
};

class FrameTimes {
 public:
  // A frame that was waited for and handed over at handed_ns; on the GPU it took gpu_ms from then on.
  void take(const HeadsetFrame& frame, std::int64_t handed_ns, double gpu_ms);
  void pause() { last_display_ns_ = 0; }  // frames are not paced for a while: what passes is not dropped
  const HeadsetTiming& timing() const noexcept { return timing_; }

 private:
  HeadsetTiming timing_;
  std::int64_t last_display_ns_ = 0;
};

}  // namespace gearshift
