// A simulated hand that moves through waypoints on minimum-jerk paths.
//
// This work is based on:
// Tamar Flash, Neville Hogan.
// The Coordination of Arm Movements: An Experimentally Confirmed Mathematical Model. 1985
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "haptics/device/hand.h"

namespace gearshift::haptics {

// Position and velocity at time t [s] on the minimum-jerk path from a to b, which takes `duration` [s].
HandTarget minimum_jerk(glm::dvec2 a, glm::dvec2 b, double t, double duration) noexcept;

struct HandStroke {
  glm::dvec2 to{0.0};     // [m] end point of the stroke in the gate plane
  double duration = 0.3;  // [s] > 0, duration of the movement
  double dwell = 0.1;     // [s] time at the end point before the next stroke
  glm::dvec2 push{0.0};   // [N] push at the end point; it grows from the previous stroke's as the hand moves
  bool pressed_down = false;
  bool lifted = false;
};

struct ScriptedHandConfig {
  glm::dvec2 start{0.0};      // [m]
  double aim_noise = 0.0;     // [m] standard deviation per axis of a stroke's end point; drawn once per stroke
  double effort_gain = 0.0;   // [N/(m s)] rate at which the hand adds force while the lever lags behind
  double effort_limit = 0.0;  // [N] upper limit of the added force
  std::uint64_t seed = 1;
};

// Effort: a soft hand cannot pull the lever through a detent by its stiffness alone. So, like a human, the hand pushes
// harder the longer the lever stays behind. On each axis, with lag = target - lever:
//
//     effort' = effort_gain lag                   while |lag| > 1 mm and the effort does not point against the lag
//     effort' = effort_gain lag - effort / 50 ms  while |lag| > 1 mm and the effort points against the lag
//     effort' = -effort / 50 ms                   once the lever has arrived (|lag| <= 1 mm)
//
// The effort is at most effort_limit. It lasts through stroke and dwell and continues in the next stroke, so it never
// jumps. If the next stroke is in the opposite direction, the second formula lets the old effort decay while effort in
// the new direction builds up.
class ScriptedHand final : public HandDriver {
 public:
  // `period`: time between calls of next() [s], 1e-6 to 1. Throws std::invalid_argument.
  ScriptedHand(const ScriptedHandConfig& config, std::vector<HandStroke> strokes, double period);

  // The hand stays at config.start before the first stroke, and if there are no strokes. It stays at the last end point
  // after the last dwell.
  HandTarget next(double time, glm::dvec2 lever) noexcept override;

  double duration() const noexcept;  // [s] duration of all strokes and dwells

 private:
  // A stroke whose end point already includes the aim noise.
  struct Segment {
    double begin = 0.0;  // [s]
    double end = 0.0;    // [s] end of the dwell
    glm::dvec2 from{0.0};
    glm::dvec2 push_from{0.0};  // [N]
    HandStroke stroke;
  };

  const Segment& segment_at(double time) noexcept;
  glm::dvec2 effort(glm::dvec2 lag) noexcept;

  ScriptedHandConfig config_;
  double period_;        // [s]
  double effort_decay_;  // [1] factor per period on the effort after the lever has arrived
  std::vector<Segment> segments_;
  std::size_t current_ = 0;
  glm::dvec2 effort_{0.0};  // [N]
};

}  // namespace gearshift::haptics
