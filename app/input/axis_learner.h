// Learns an axis from what a person does with one control: which one it is, where it ends, where it rests and how
// quietly. Asks no clock and opens nothing: it is shown the sticks, frame by frame.
//
//   AxisLearner learner(AxisLearner::Control::pedal);
//   learner.watch_move(list)   ... each frame, while the pedal is pressed all the way and let go; a lever is moved to the
//                              left (or back), then to the right (or forward), and let go
//   learner.watch_rest(list)   ... each frame of a second in which nobody touches it
//   bindings.clutch = learner.answer();
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/input/axis.h"

namespace gearshift {

class AxisLearner {
 public:
  enum class Control { lever, pedal };
  explicit AxisLearner(Control control) : control_(control) {}

  void watch_move(const std::vector<PadState>& sticks);
  void watch_rest(const std::vector<PadState>& sticks);

  // By the stick's name (its GUID where the name cannot stand in a file). Throws std::invalid_argument with one sentence
  // that says what was wrong and what to do: nothing moved, two axes together, too little, to one side only, no rest.
  AxisBinding answer() const;

 private:
  struct Way {                                  // of one axis
    double first = 0.0, low = 0.0, high = 0.0;  // raw
    int low_at = 0, high_at = 0;                // frames
    double rest_low = 0.0, rest_high = 0.0, rest_sum = 0.0;
    int rests = 0;
    double span() const { return high - low; }
    double rest() const { return rest_sum / rests; }
  };
  struct Stick {
    std::string name, guid;
    std::vector<Way> axes;
  };

  struct Place {  // of an axis
    std::size_t stick = 0, axis = 0;
  };

  bool meet(const std::vector<PadState>& sticks);
  const Way& way_of(const Place& at) const { return sticks_[at.stick].axes[at.axis]; }
  std::string words(const Place& at) const;
  Place moved_most() const;
  AxisBinding named(const Place& at) const;
  AxisBinding pedal(const Place& at) const;
  AxisBinding lever(const Place& at) const;

  Control control_;
  std::vector<Stick> sticks_;
  int frames_ = 0;
  bool changed_ = false;  // a stick came or went
};

}  // namespace gearshift
