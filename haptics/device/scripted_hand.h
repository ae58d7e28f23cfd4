// A hand that follows minimum-jerk strokes through waypoints.
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

// Position and velocity on the minimum-jerk path from a to b that takes `duration` [s], at time t [s].
HandTarget minimum_jerk(glm::dvec2 a, glm::dvec2 b, double t, double duration) noexcept;

struct HandStroke {
  glm::dvec2 to{0.0};     // [m] point in the gate plane at which the stroke aims
  double duration = 0.3;  // [s] > 0, duration of the movement
  double dwell = 0.1;     // [s] time spent at the aim before the next stroke
  glm::dvec2 push{0.0};   // [N] steady push during stroke and dwell
  bool pressed_down = false;
  bool lifted = false;
};

struct ScriptedHandConfig {
  glm::dvec2 start{0.0};      // [m]
  double aim_noise = 0.0;     // [m] standard deviation of the aim, per axis; drawn once per stroke
  double effort_gain = 0.0;   // [N/(m s)] how fast the hand adds force while the lever lags behind the target
  double effort_limit = 0.0;  // [N] upper limit of the added force
  std::uint64_t seed = 1;
};

// Effort: a soft hand cannot pull through a detent by its stiffness only, so a human pushes harder the longer the lever
// stays behind. On each axis, with lag = target - lever:
//
//     effort' = gain lag              while |lag| > 1 mm, the effort at most effort_limit
//     effort' = ... - effort / 50 ms  once the lever has arrived (within 1 mm),
//                                     or while the effort points against the lag
//
// Effort persists through stroke and dwell and carries over into the next stroke, where the second term removes it
// while opposite effort grows; it never jumps.
class ScriptedHand final : public HandDriver {
 public:
  // period: time between calls of next() [s], 1e-6 to 1. Throws std::invalid_argument.
  ScriptedHand(const ScriptedHandConfig& config, std::vector<HandStroke> strokes, double period);

  // The hand stays at the start before the first stroke or if there is none, and at the last aim after the last dwell.
  HandTarget next(double time, glm::dvec2 lever) noexcept override;

  double duration() const noexcept;  // [s] duration of the whole script

 private:
  // A stroke with its aim noise applied.
  struct Segment {
    double begin = 0.0;  // [s]
    double end = 0.0;    // [s] end of the dwell
    glm::dvec2 from{0.0};
    HandStroke stroke;
  };

  const Segment& segment_at(double time) noexcept;
  glm::dvec2 effort(glm::dvec2 lag) noexcept;

  ScriptedHandConfig config_;
  double period_;        // [s]
  double effort_decay_;  // [1] factor on the effort per period once the lever has arrived
  std::vector<Segment> segments_;
  std::size_t current_ = 0;
  glm::dvec2 effort_{0.0};  // [N]
};

}  // namespace gearshift::haptics
