// A hand that is told where to go and sees where the lever is: each stroke begins when the last has arrived.
#pragma once

#include <cstddef>
#include <vector>

#include "haptics/device/scripted_hand.h"

namespace gearshift {

// Minimum-jerk strokes as ScriptedHand's, and its effort; but what blocks the lever holds the strokes up. Without
// strokes the hand has let go: it follows the lever and leans on it with `lean` alone.
class LearnerHand {
 public:
  explicit LearnerHand(double period) noexcept;  // [s] of the calls to next()

  void go(std::vector<HandStroke> strokes, glm::dvec2 from, double time);
  void let_go() noexcept { strokes_.clear(); }
  void set_lean(glm::dvec2 push) noexcept { lean_ = push; }    // [N] while it has let go
  void set_extra(glm::dvec2 push) noexcept { extra_ = push; }  // [N] on top of a stroke
  void set_feeble(double push) noexcept { feeble_ = push; }    // [N] no more than that; 0: as it needs
  HandTarget next(double time, glm::dvec2 lever) noexcept;

  bool has_let_go() const noexcept { return strokes_.empty(); }
  bool in_last_stroke() const noexcept { return !strokes_.empty() && current_ + 1 == strokes_.size(); }
  bool is_at_end(double time) const noexcept;  // of its last stroke, whether or not the lever is
  double waited(double time) const noexcept;   // [s] at the end of a stroke for a lever that does not come

 private:
  glm::dvec2 effort(glm::dvec2 lag) noexcept;

  double period_;
  double effort_decay_;
  std::vector<HandStroke> strokes_;
  std::size_t current_ = 0;
  glm::dvec2 from_{0.0};
  double begin_ = 0.0;  // [s]
  glm::dvec2 effort_{0.0}, lean_{0.0}, extra_{0.0};
  double feeble_ = 0.0;
};

}  // namespace gearshift
