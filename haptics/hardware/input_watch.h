// A stick that lies about its place: one that jumps, and one that is frozen.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/hid/lever_report.h"

namespace gearshift {

inline constexpr double kJump = 0.25;         // [1] of the range between two reports: no hand is that fast
inline constexpr double kJumpTime = 0.020;    // [s] at most between the two
inline constexpr double kFrozenTime = 2.0;    // [s] in one place, to the count,
inline constexpr double kFrozenForce = 0.30;  // [1] of the full force, by which the force varied meanwhile
inline constexpr double kYieldForce = 0.05;   // [1] of the full force: less yields to nobody
inline constexpr double kYieldTime = 1.0;     // [s] in which a force yields to nothing,
inline constexpr double kReturnTime = 0.05;   // [s] and in which it is back

// Pure, report by report.
//
// A force that does not change shows nothing of a sensor. So one of more than kYieldForce on a lever that has stood in one
// place, to the count, for kFrozenTime yields: a lever that lives moves under the hand that leans on it, and the force is
// back after a count or two; a dead sensor ends in silence, and is called frozen where the force varied enough for it.
class InputWatch {
 public:
  // Where X and Y lie among the report's axes.
  InputWatch(const LeverReport& report, std::array<std::size_t, 2> axes);

  // force: constant forces as the device has them, in shares of the full one.
  void see(const LeverCounts& counts, std::array<double, 2> force, std::int64_t time_ns) noexcept;

  double jump() const noexcept { return jump_; }  // [1] of the range, of the newest report; 0: none
  bool is_frozen() const noexcept { return frozen_; }
  double force_share() const noexcept { return share_; }  // [1] 0 to 1: what the lever may get of the force wished

 private:
  std::array<std::int64_t, 2> place(const LeverCounts& counts) const noexcept;
  void watch_jump(std::array<std::int64_t, 2> now, std::int64_t time_ns) noexcept;
  void watch_still(std::array<double, 2> force, std::int64_t passed_ns) noexcept;

  std::array<std::size_t, 2> axes_;
  std::array<double, 2> range_{};  // [counts]
  bool started_ = false;
  std::array<std::int64_t, 2> place_{};  // [counts] newest
  std::int64_t time_ns_ = 0;             // of it
  std::int64_t still_since_ns_ = 0;
  std::array<double, 2> least_{}, most_{};  // force since then
  double share_ = 1.0;
  double jump_ = 0.0;
  bool frozen_ = false;
};

}  // namespace gearshift
