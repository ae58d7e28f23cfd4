// Headset data shown in the panel, and the panel's requests to the headset.
#pragma once

#include <optional>
#include <string>

#include <glm/vec2.hpp>

#include "app/cabin/headset/seat_file.h"
#include "engine/xr/frame_times.h"

namespace gearshift::cabin {

struct HeadsetReport {
  std::string headset, runtime, state;
  glm::ivec2 eye{0};  // [px]
  engine::HeadsetTiming timing;
  bool is_tracked = false;
  bool orientation_only = false;  // orientation is tracked, position is not known yet
  SeatSettings seat;
  bool is_touched = false;   // the lever's position comes from touches
  double touch_error = 0.0;  // [m] distance of real and drawn lever
  bool touching = false;     // the next trigger pulls count as touches of the knob
  std::size_t touches = 0;
  double worst_touch = 0.0;  // [m]
};

struct HeadsetRequests {
  bool recentre = false;
  bool touch = false, touched = false;  // start touching; save the touches
  bool forget_touches = false;          // discard the current touches, or those in use
  std::optional<double> height;         // [m]
  std::optional<KnobDistance> knob;     // [m]
  bool forget_knob = false;
};

}  // namespace gearshift::cabin
