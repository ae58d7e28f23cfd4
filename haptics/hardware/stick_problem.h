// What a stick does wrong while it streams: raised by one thread, told by another, each kind once.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace gearshift {

enum class StickProblem : std::uint8_t {
  wrong_length,     // a, b: bytes of a report, and what its descriptor says
  unknown_report,   // a: its ID
  frozen,           // a: seconds
  yields,           // a: seconds
  jumps,            // a: percent of the range
  switched_off,     // its motors, by itself
  effect_stopped,   // by itself
  no_power,         // for its motors
  safety_switch,    // open
  takes_no_output,  // none arrives
  slower,           // a, b: milliseconds that an output takes, and the answer that it was calibrated with
  nobody_commands   // a: milliseconds; no fault of the stick: the program's other side is late or dead
};
inline constexpr std::size_t kStickProblems = 12;

class StickProblems {
 public:
  // Real-time safe.
  void raise(StickProblem problem, std::int64_t a = 0, std::int64_t b = 0) noexcept;
  void forget() noexcept;  // each may be told again

  // One sentence; nothing where all that was raised has been told. Any thread.
  std::optional<std::string> take();

 private:
  struct Detail {
    std::atomic<std::int64_t> a{0}, b{0};
  };
  std::atomic<std::uint64_t> raised_and_told_{0};  // a bit each: raised in the low half, told in the high one
  std::array<Detail, kStickProblems> detail_;
};

}  // namespace gearshift
