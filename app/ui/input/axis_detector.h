// Detects an axis while the user moves one control: which axis it is, its end values, its rest position and the noise
// there. The detector reads no clock and opens no device: the caller passes the sticks frame by frame.
//
//   AxisDetector detector(AxisDetector::Control::pedal);
//   detector.record_move(list)   each frame, while the pedal is pressed all the way and released; a lever is moved to
//                               the left (or back), then to the right (or forward), and released
//   detector.record_rest(list)   each frame of a second in which the control is not touched
//   bindings.clutch = detector.result();
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/ui/input/axis.h"

namespace gearshift::ui {

class AxisDetector {
 public:
  enum class Control { lever, pedal };
  static constexpr int kMinRestFrames = 8;  // minimum number of frames recorded at rest
  explicit AxisDetector(Control control) : control_(control) {}

  void record_move(const std::vector<engine::Controller>& sticks);
  // The axis that has moved most; empty while nothing has moved far enough to be a control.
  struct MovingAxis {
    std::string name;                                     // "axis 2 of Wheel"
    double rest = 0.0, low = 0.0, high = 0.0, now = 0.0;  // raw values; rest: the first one
  };
  std::optional<MovingAxis> moving() const;

  void record_rest(const std::vector<engine::Controller>& sticks);

  // The binding identifies the stick by name, or by GUID if the name cannot be written to a file. Throws
  // std::invalid_argument with one sentence on what was wrong and what to do: no motion, two axes moved, too little
  // motion, motion to one side only, not recorded at rest, or a stick plugged in or unplugged meanwhile.
  AxisBinding result() const;

 private:
  struct AxisRange {                                       // recorded motion of one axis
    double first = 0.0, low = 0.0, high = 0.0, now = 0.0;  // raw values
    int low_at = 0, high_at = 0;                           // numbers of the frames in which low and high were reached
    double rest_low = 0.0, rest_high = 0.0, rest_sum = 0.0;
    int rests = 0;
    bool is_reported = false;  // false: `first` may be what the kernel holds until the first report
    double span() const { return high - low; }
    double rest() const { return rest_sum / rests; }
  };
  struct Stick {
    engine::Controller controller;
    std::vector<AxisRange> axes;
    const std::string& name() const { return controller.name; }
  };

  struct Place {  // identifies an axis
    std::size_t stick = 0, axis = 0;
  };

  bool check_sticks(const std::vector<engine::Controller>& sticks);
  const AxisRange& range_of(const Place& at) const { return sticks_[at.stick].axes[at.axis]; }
  std::string name_of(const Place& at) const;
  std::string describe_axis(const Place& at) const;
  std::vector<Place> places_by_travel() const;
  Place axis_with_max_travel() const;
  AxisBinding binding_of(const Place& at) const;
  AxisBinding pedal(const Place& at) const;
  AxisBinding lever(const Place& at) const;

  Control control_;
  std::vector<Stick> sticks_;
  int frames_ = 0;
  bool changed_ = false;  // a stick was plugged in or unplugged
};

}  // namespace gearshift::ui
