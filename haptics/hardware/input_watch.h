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

// Pure, report by report.
class InputWatch {
 public:
  // Where X and Y lie among the report's axes.
  InputWatch(const LeverReport& report, std::array<std::size_t, 2> axes);

  // force: constant forces as the device has them, in shares of the full one.
  void see(const LeverCounts& counts, std::array<double, 2> force, std::int64_t time_ns) noexcept;

  double jump() const noexcept { return jump_; }  // [1] of the range, of the newest report; 0: none
  bool is_frozen() const noexcept { return frozen_; }

 private:
  std::array<std::int64_t, 2> place(const LeverCounts& counts) const noexcept;
  void watch_jump(std::array<std::int64_t, 2> now, std::int64_t time_ns) noexcept;
  void watch_frozen(std::array<double, 2> force, std::int64_t time_ns) noexcept;

  std::array<std::size_t, 2> axes_;
  std::array<double, 2> range_{};  // [counts]
  bool started_ = false;
  std::array<std::int64_t, 2> place_{};  // [counts] newest
  std::int64_t time_ns_ = 0;             // of it
  std::int64_t still_since_ns_ = 0;
  std::array<double, 2> least_{}, most_{};  // force since then
  double jump_ = 0.0;
  bool frozen_ = false;
};

}  // namespace gearshift
