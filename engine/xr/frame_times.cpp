#include "engine/xr/frame_times.h"

#include <algorithm>
#include <cmath>

namespace gearshift::engine {

void FrameTimes::add(const HeadsetFrame& frame, std::int64_t submit_ns, double gpu_ms) {
  const double period_ns = 1e9 * frame.period;
  ++timing_.frames;
  timing_.period_ms = 1e3 * frame.period;
  timing_.gpu_ms = gpu_ms;
  if (last_display_ns_ != 0 && period_ns > 0.0) {
    const long periods = std::lround(static_cast<double>(frame.display_ns - last_display_ns_) / period_ns);
    timing_.dropped += static_cast<std::uint64_t>(std::max(0l, periods - 1));
  }
  last_display_ns_ = frame.display_ns;
  if (frame.wait_end_ns == 0 || submit_ns == 0) return;  // the runtime's clock is not available
  timing_.cpu_ms = 1e-6 * static_cast<double>(submit_ns - frame.wait_end_ns);
  timing_.spare_ms = 1e-6 * static_cast<double>(frame.display_ns - submit_ns) - gpu_ms;
  timing_.late_ms =
      timing_.spare_ms >= 0.0 ? 0.0 : timing_.period_ms * std::ceil(-timing_.spare_ms / timing_.period_ms);
  timing_.late += timing_.spare_ms < 0.0;
}

}  // namespace gearshift::engine
