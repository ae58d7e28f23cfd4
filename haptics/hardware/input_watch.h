// Detects faulty position sensors: readings that jump, and readings that are frozen.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/hardware/stick_command.h"
#include "haptics/hid/lever_report.h"

namespace gearshift::haptics {

inline constexpr double kMinJump = 0.25;  // [1] jump between two reports, fraction of the range; no hand is that fast
inline constexpr double kMaxJumpTime = 0.020;  // [s] reports further apart than this are not compared
inline constexpr double kMaxReportGap = 0.1;  // [s] a longer gap between reports means that the program was not reading
inline constexpr double kFrozenTime = 2.0;  // [s] a force fades out if its axis does not move by a count for this time
// [1] Fraction of the full force. The sensor of an axis is frozen if it reported no motion for kFrozenTime although the
// force on the axis changed by more than this fraction.
inline constexpr double kFrozenForce = 0.30;
inline constexpr double kMinPushForce = 0.05;  // [1] fraction of the full force; weaker forces count as no force
// [s/s] rate at which the accumulated time under force decreases while there is no force. The rate is so low that an
// alternating force still accumulates time.
inline constexpr double kStillnessDecay = 0.2;
inline constexpr double kFadeOutTime = 1.0;  // [s] time in which a force fades to zero
inline constexpr double kFadeInTime = 0.05;  // [s] time in which a faded force returns

// Each axis is judged separately, because one sensor may fail while the other works.
//
// While the force is constant, a lever that does not move may be held by a hand or have a dead sensor. So the force is
// faded out if it exceeds kMinPushForce and its axis has not moved by a single count for kFrozenTime. With a working
// sensor, the lever then moves under the hand and the force returns after a count or two; with a dead sensor, the force
// stays off. For a device spring, its coefficient is compared with kMinPushForce while the lever is outside the
// spring's dead band, because only the device knows the actual force.
class InputWatch {
 public:
  // `axes`: indices of X and Y in the report's list of axes.
  InputWatch(const LeverReport& report, std::array<std::size_t, 2> axes);

  // `force` and `springs` are those that the device renders now, as fractions of full force and full deflection.
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
    double forced_time = 0.0;               // [s] time under force at `place`
    Span force, spring;                     // range of values while the axis was at `place`
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
