// Where the room, in which a headset is tracked, stands in the cabin: so that the lever is where it is seen.
//
// The room turns about the vertical alone: gravity is the same in both.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "app/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift {

// Of the cabin, in its axes. [m]
struct SeatPlaces {
  glm::dvec3 eye{0.0};   // of a driver who sits
  glm::dvec3 knob{0.0};  // middle of the knob, the lever in neutral
};

// From the eyes of who sits and looks ahead to the knob. [m] right, down, ahead +
struct KnobDistance {
  double right = 0.0, down = 0.0, ahead = 0.0;
};

// Throws std::invalid_argument with one sentence: a driver on the left has the lever to his right, and the other way round.
void check_knob(const KnobDistance& knob, DriveSide drive);

// The cabin from the room: the head comes to the driver's eyes, raised by `height` [m]; what it looks at comes ahead.
// head: in the room, upright or looking down or up.
EyePose seat_at_eyes(const EyePose& head, const SeatPlaces& places, double height);

// The same, but the knob comes to where it is: the head goes where it is then.
EyePose seat_at_lever(const EyePose& head, const SeatPlaces& places, const KnobDistance& knob);

// The knob was touched in several places of the lever: what a tracked tip says against where the knob is seen.
class LeverTouches {
 public:
  // tip: its place in the room, and how the controller is held.
  void add(const EyePose& tip, glm::dvec3 cabin) { touches_.push_back({tip.position, cabin, tip.orientation}); }
  void forget() { touches_.clear(); }
  std::size_t count() const noexcept { return touches_.size(); }

  struct Fit {
    EyePose cabin_from_room;
    double worst = 0.0;   // [m] between a touch and the knob as it is seen
    bool turned = false;  // the touches lie far enough apart to tell the direction, too
  };
  // The least squares' turn about the vertical and shift (Horn 1987, with the axis given); touches less than 20 mm RMS
  // apart leave the direction of `now`. Nothing touched: none.
  std::optional<Fit> fit(const EyePose& now) const;

  // [1] The least share of a tip's error, told beside where it is in the controller, that the misfit shows (RMS, worst
  // direction): 0 where the controller was turned about one axis at most, or had fewer than three touches.
  double tip_share() const;

 private:
  struct Touch {
    glm::dvec3 room, cabin;
    glm::dquat held;
  };
  std::vector<Touch> touches_;
};

}  // namespace gearshift
