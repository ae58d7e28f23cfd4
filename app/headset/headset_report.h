// What the panel shows of a headset, and what is asked of it there.
#pragma once

#include <optional>
#include <string>

#include <glm/vec2.hpp>

#include "app/headset/seat_file.h"
#include "engine/xr/frame_times.h"

namespace gearshift {

struct HeadsetReport {
  std::string headset, runtime, state;
  glm::ivec2 eye{0};  // [px]
  HeadsetTiming timing;
  bool is_tracked = false;
  bool turns_alone = false;  // it tells where it looks, and has not told where it is
  SeatSettings seat;
  bool is_touched = false;   // the lever stands where it was touched
  double touch_error = 0.0;  // [m] between it and where it is seen
  bool touching = false;     // the next triggers are touches of the knob
  std::size_t touches = 0;
  double worst_touch = 0.0;  // [m]
};

struct HeadsetRequests {
  bool recentre = false;
  bool touch = false, touched = false;  // begin, keep
  bool forget_touches = false;          // those that are made, or the ones that are in use
  std::optional<double> height;         // [m]
  std::optional<KnobDistance> knob;     // [m]
  bool forget_knob = false;
};

}  // namespace gearshift
