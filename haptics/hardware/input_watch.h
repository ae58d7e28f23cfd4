// A stick that lies about its place: one that jumps, and one that is frozen.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/hardware/pid_wish.h"
#include "haptics/hid/lever_report.h"

namespace gearshift {

inline constexpr double kJump = 0.25;         // [1] of the range between two reports: no hand is that fast
inline constexpr double kJumpTime = 0.020;    // [s] at most between the two
inline constexpr double kUnwatched = 0.1;     // [s] between two reports: nobody has looked meanwhile
inline constexpr double kFrozenTime = 2.0;    // [s] under force in one place, to the count,
inline constexpr double kFrozenForce = 0.30;  // [1] of the full force, by which the force varied meanwhile
inline constexpr double kYieldForce = 0.05;   // [1] of the full force: less is none
inline constexpr double kForgets = 0.2;       // [s] of that in a second without force: one that alternates is one
inline constexpr double kYieldTime = 1.0;     // [s] in which a force yields to nothing,
inline constexpr double kReturnTime = 0.05;   // [s] and in which it is back

// Pure, report by report; each axis by itself, for one sensor may be dead and the other alive.
//
// A force that does not change shows nothing of a sensor. So one of more than kYieldForce on an axis that has stood in one
// place, to the count, for kFrozenTime yields: a lever that lives moves under the hand that leans on it, and the force is
// back after a count or two; under a dead sensor it ends. A spring of the device counts, where the lever is beyond its dead
// band, as its coefficient does: what it pushes with is the device's to know.
class InputWatch {
 public:
  // Where X and Y lie among the report's axes.
  InputWatch(const LeverReport& report, std::array<std::size_t, 2> axes);

  // Constant forces and springs as the device has them, in shares.
  void see(const LeverCounts& counts, std::array<double, 2> force, std::array<PidSpring, 2> springs,
           std::int64_t time_ns) noexcept;
  void forget_force() noexcept;  // the motors are off: what comes next is another story

  double jump() const noexcept { return jump_; }  // [1] of the range, of the newest report; 0: none
  bool is_frozen() const noexcept { return axis_[0].frozen || axis_[1].frozen; }
  // [1] 0 to 1: what an axis may get of the force wished.
  double force_share(std::size_t axis) const noexcept { return axis_[axis].share; }
  bool has_yielded() const noexcept { return axis_[0].share == 0.0 || axis_[1].share == 0.0; }

 private:
  struct Span {
    double least = 0.0, most = 0.0;
    void begin(double value) noexcept { least = most = value; }
    void add(double value) noexcept;
    double width() const noexcept { return most - least; }
  };
  struct Axis {
    double middle = 0.0, half_range = 1.0;  // [counts]
    std::int64_t place = 0;                 // [counts] newest
    double forced = 0.0;                    // [s] under force in that place
    Span force, spring;                     // in that place
    double share = 1.0;
    bool frozen = false;
  };

  void watch_jump(const LeverCounts& counts, std::int64_t time_ns) noexcept;
  static void watch_still(Axis& axis, std::int64_t place, double force, double spring, double passed) noexcept;

  std::array<std::size_t, 2> axes_;
  std::array<Axis, 2> axis_{};
  bool started_ = false;
  std::int64_t time_ns_ = 0;    // of the newest report
  std::int64_t unsure_ns_ = 0;  // until then a report may be older than it looks
  double jump_ = 0.0;
};

}  // namespace gearshift
