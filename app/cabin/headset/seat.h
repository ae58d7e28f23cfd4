// Determines the pose of the room (the headset's tracking space) in the cabin so that the real lever is where the lever
// is drawn.
//
// The room is rotated only about the vertical, since room and cabin share the direction of gravity.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "app/cabin/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift::cabin {

// Positions in cabin axes. [m]
struct SeatPlaces {
  glm::dvec3 eye{0.0};   // point between the eyes of a seated driver
  glm::dvec3 knob{0.0};  // centre of the knob with the lever in neutral
};

// Distances [m] from the eyes of a seated driver, who looks ahead, to the knob; positive to the right, down and ahead.
struct KnobDistance {
  double right = 0.0, down = 0.0, ahead = 0.0;
};

// Throws std::invalid_argument with a one-sentence message if the knob is on the wrong side: a driver on the left has
// the lever on the right, and vice versa.
void check_knob(const KnobDistance& knob, DriveSide drive);

// Returns the pose of the room in the cabin that puts the head at the driver's eyes, raised by `height` [m], looking
// ahead. `head`: pose in the room; the user may be looking ahead, down or up.
engine::EyePose seat_at_eyes(const engine::EyePose& head, const SeatPlaces& places, double height);

// Returns the pose of the room in the cabin that puts the real knob where the knob is drawn. The head then need not be
// at the driver's eye point. `knob`: distances measured from the user's eyes.
engine::EyePose seat_at_lever(const engine::EyePose& head, const SeatPlaces& places, const KnobDistance& knob);

// Touches of the real knob with the tip of a tracked controller, at several lever positions. Each touch pairs a point
// in the room (the tip) with a point in the cabin (the drawn knob).
class LeverTouches {
 public:
  // `tip`: position of the tip and orientation of the controller, in the room. `cabin`: position of the drawn knob.
  void add(const engine::EyePose& tip, glm::dvec3 cabin) { touches_.push_back({tip.position, cabin, tip.orientation}); }
  void forget() { touches_.clear(); }
  std::size_t count() const noexcept { return touches_.size(); }

  struct Fit {
    engine::EyePose cabin_from_room;
    double worst = 0.0;   // [m] largest distance between a touch and the drawn knob
    bool turned = false;  // the touches are far enough apart to determine the rotation too
  };
  // Least-squares rotation about the vertical and translation (Horn 1987, with a given axis). If the RMS distance of
  // the touches from their mean is below 20 mm, the rotation of `now` is used. Returns empty if there are no touches.
  std::optional<Fit> fit(const engine::EyePose& now) const;

  // [1] If the assumed position of the tip on the controller is wrong, only this fraction of the error appears in the
  // fit's RMS residual, for the direction of the error in which the fraction is smallest. 0 if the controller was
  // rotated about at most one axis or there are fewer than three touches.
  double tip_error_fraction() const;

 private:
  struct Touch {
    glm::dvec3 room, cabin;
    glm::dquat held;
  };
  std::vector<Touch> touches_;
};

}  // namespace gearshift::cabin
