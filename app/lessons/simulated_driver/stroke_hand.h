// A hand that moves the lever along a list of strokes. Each stroke begins when the lever has arrived at the end of the
// previous stroke.
#pragma once

#include <cstddef>
#include <vector>

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// Strokes from `from` [m] to `gear`, by way of neutral if the gate locks the direct way. `engaged`: the gear that is
// in now. `pace`: mean speed [m/s].
std::vector<haptics::HandStroke> strokes_to_gear(const haptics::Gate& gate, glm::dvec2 from, int engaged, int gear,
                                                 double pace);

// Makes minimum-jerk strokes as ScriptedHand does, but waits while something blocks the lever. Without strokes, the
// hand has released the lever: its target follows the lever, and the lever feels only the push of set_lean().
class StrokeHand {
 public:
  explicit StrokeHand(double period) noexcept;  // period: time between two calls of next() [s]

  void start(std::vector<haptics::HandStroke> strokes, glm::dvec2 from, double time);
  void release_lever() noexcept { strokes_.clear(); }
  void set_lean(glm::dvec2 push) noexcept { lean_ = push; }          // [N] push while the hand has released the lever
  void set_extra(glm::dvec2 push) noexcept { extra_ = push; }        // [N] push added to a stroke
  void set_push_limit(double push) noexcept { push_limit_ = push; }  // [N] constant weak push; 0: as hard as needed
  haptics::HandTarget next(double time, glm::dvec2 lever) noexcept;

  bool in_last_stroke() const noexcept { return !strokes_.empty() && current_ + 1 == strokes_.size(); }
  bool is_at_end(double time) const noexcept;       // the last stroke is over, even if the lever did not follow
  double time_waiting(double time) const noexcept;  // [s] time since the planned end of the current stroke; 0 before

 private:
  glm::dvec2 effort(glm::dvec2 lag) noexcept;

  double period_;
  double effort_decay_;
  std::vector<haptics::HandStroke> strokes_;
  std::size_t current_ = 0;
  glm::dvec2 from_{0.0};
  double begin_ = 0.0;  // [s]
  glm::dvec2 effort_{0.0}, lean_{0.0}, extra_{0.0};
  double push_limit_ = 0.0;
};

}  // namespace gearshift::lessons
