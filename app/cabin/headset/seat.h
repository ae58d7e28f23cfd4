// The pose of the room (the headset's tracking space) in the cabin, such that the real lever is where it is drawn.
//
// The room is only turned about the vertical, since both share the direction of gravity.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "app/cabin/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift::cabin {

// Positions in cabin axes. [m]
struct SeatPlaces {
  glm::dvec3 eye{0.0};   // of a seated driver
  glm::dvec3 knob{0.0};  // centre of the knob, lever in neutral
};

// From the eyes of a seated driver, looking ahead, to the knob. [m] positive to the right, down and ahead
struct KnobDistance {
  double right = 0.0, down = 0.0, ahead = 0.0;
};

// Throws std::invalid_argument with one sentence if the knob is on the wrong side: a driver on the left has the lever
// on the right, and vice versa.
void check_knob(const KnobDistance& knob, DriveSide drive);

// Cabin from room, with the head at the driver's eyes, raised by `height` [m], looking ahead. head: in the room;
// upright or looking down or up.
engine::EyePose seat_at_eyes(const engine::EyePose& head, const SeatPlaces& places, double height);

// Cabin from room, with the knob at its drawn position instead of the head at the driver's eyes.
engine::EyePose seat_at_lever(const engine::EyePose& head, const SeatPlaces& places, const KnobDistance& knob);

// Touches of the knob at several lever positions: tracked controller tip against the drawn knob.
class LeverTouches {
 public:
  // tip: position of the tip in the room and orientation of the controller.
  void add(const engine::EyePose& tip, glm::dvec3 cabin) { touches_.push_back({tip.position, cabin, tip.orientation}); }
  void forget() { touches_.clear(); }
  std::size_t count() const noexcept { return touches_.size(); }

  struct Fit {
    engine::EyePose cabin_from_room;
    double worst = 0.0;   // [m] largest distance of a touch from the drawn knob
    bool turned = false;  // the touches are far enough apart to determine the direction, too
  };
  // Least-squares rotation about the vertical and translation (Horn 1987, with a given axis). If the touches are less
  // than 20 mm RMS apart, the direction of `now` is kept. Empty without touches.
  std::optional<Fit> fit(const engine::EyePose& now) const;

  // [1] Smallest fraction of an error in the tip's assumed position on the controller that shows up in the residual
  // (RMS, worst direction). 0 if the controller was turned about at most one axis, or with fewer than three touches.
  double tip_error_fraction() const;

 private:
  struct Touch {
    glm::dvec3 room, cabin;
    glm::dquat held;
  };
  std::vector<Touch> touches_;
};

}  // namespace gearshift::cabin
