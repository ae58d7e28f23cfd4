// Headset data shown in the panel.
#pragma once

#include <string>

#include <glm/vec2.hpp>

#include "app/cabin/headset/seat_file.h"
#include "engine/xr/frame_times.h"

namespace gearshift::cabin {

struct HeadsetReport {
  std::string headset, runtime, state;
  glm::ivec2 eye{0};  // [px] size of the image for one eye
  engine::HeadsetTiming timing;
  bool is_tracked = false;
  bool orientation_only = false;  // the head's orientation is tracked, but its position is not known yet
  bool has_controller = true;     // false: the program gets input, but from no controller or hand that it knows
  SeatSettings seat;
  bool is_touched = false;   // the lever's position was determined by touches
  double touch_error = 0.0;  // [m] distance between real and drawn lever
  bool touching = false;     // a touch calibration is running: trigger pulls count as touches of the knob
  std::size_t touches = 0;   // number of touches so far
  double worst_touch = 0.0;  // [m] largest distance of a touch from the drawn knob
};

}  // namespace gearshift::cabin
