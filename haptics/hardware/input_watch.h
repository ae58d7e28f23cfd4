// Detects faulty position sensors: readings that jump, and readings that are frozen.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/hardware/stick_command.h"
#include "haptics/hid/lever_report.h"

namespace gearshift::haptics {

inline constexpr double kMinJump = 0.25;       // [1] jump between two reports, of the range; no hand is that fast
inline constexpr double kMaxJumpTime = 0.020;  // [s] reports further apart than this are not compared
inline constexpr double kMaxReportGap = 0.1;   // [s] if the gap is longer, the program was not reading
inline constexpr double kFrozenTime = 2.0;     // [s] time under force without motion of a single count: frozen
inline constexpr double kFrozenForce = 0.30;   // [1] variation of the force during that time, of the full force
inline constexpr double kMinPushForce = 0.05;  // [1] fraction of the full force; less counts as no force
inline constexpr double kStillnessDecay =
    0.2;                                     // [s/s] rate at which time under force decays without force; slow enough
                                             // that an alternating force still counts
inline constexpr double kFadeOutTime = 1.0;  // [s] in which a force fades to zero
inline constexpr double kFadeInTime = 0.05;  // [s] in which a force returns

// The result depends only on the reports. Each axis is judged separately, because one sensor may fail while the other
// works.
//
// A constant force proves nothing about a sensor. So a force above kMinPushForce is faded out once its axis has not
// moved by a single count for kFrozenTime. With a working sensor the lever then moves under the hand, and the force is
// back after a count or two; with a dead sensor the force ends. A device spring counts with its coefficient while the
// lever is outside its dead band, because only the device knows the spring's actual force.
class InputWatch {
 public:
  // axes: indices of X and Y among the report's axes.
  InputWatch(const LeverReport& report, std::array<std::size_t, 2> axes);

  // force and springs: what the device renders now, as fractions of full force and full deflection.
  void update(const LeverCounts& counts, std::array<double, 2> force, std::array<PidSpring, 2> springs,
              std::int64_t time_ns) noexcept;
  void reset_force() noexcept;  // call it when the motors are switched off

  double jump() const noexcept { return jump_; }  // [1] jump in the newest report as a fraction of the range; 0: none
  bool is_frozen() const noexcept { return axis_[0].frozen || axis_[1].frozen; }
  // [1] 0 to 1: fraction of the commanded force that the axis may get.
  double force_fraction(std::size_t axis) const noexcept { return axis_[axis].force_fraction; }
  bool is_faded_out() const noexcept { return axis_[0].force_fraction == 0.0 || axis_[1].force_fraction == 0.0; }

 private:
  struct Span {
    double min = 0.0, max = 0.0;
    void begin(double value) noexcept { min = max = value; }
    void add(double value) noexcept;
    double width() const noexcept { return max - min; }
  };
  struct Axis {
    double middle = 0.0, half_range = 1.0;  // [counts]
    std::int64_t place = 0;                 // [counts] newest position
    double forced_time = 0.0;               // [s] time under force at that position
    Span force, spring;                     // range of values seen at that position
    double force_fraction = 1.0;
    bool frozen = false;
  };

  void watch_jump(const LeverCounts& counts, std::int64_t time_ns) noexcept;
  static void watch_still(Axis& axis, std::int64_t place, double force, double spring, double passed) noexcept;

  std::array<std::size_t, 2> axes_;
  std::array<Axis, 2> axis_{};
  bool started_ = false;
  std::int64_t time_ns_ = 0;    // time of the newest report
  std::int64_t unsure_ns_ = 0;  // reports before this time may be older than their time stamp
  double jump_ = 0.0;
};

}  // namespace gearshift::haptics
