// Problems of a streaming stick: raised on one thread, reported on a different thread, each kind once.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace gearshift::haptics {

enum class StickProblem : std::uint8_t {
  wrong_length,    // a: bytes received, b: bytes declared by the descriptor
  unknown_report,  // a: report ID
  frozen,          // a: seconds
  faded_out,       // a: seconds
  position_jump,   // a: percent of the range
  switched_off,    // the device switched its motors off
  effect_stopped,  // the device stopped an effect
  no_power,        // the motors have no power
  safety_switch,   // the safety switch is open
  output_stuck,    // an output report does not complete
  slow_output,     // a: milliseconds per output, b: answer time from the calibration [ms]
  no_commands      // a: milliseconds; the haptic side is late or dead, not the stick's fault
};
inline constexpr std::size_t kStickProblems = 12;

class StickProblems {
 public:
  // Real-time safe.
  void raise(StickProblem problem, std::int64_t a = 0, std::int64_t b = 0) noexcept;
  void reset() noexcept;  // every kind may be reported again

  // The next unreported problem as one sentence; empty if there is none. Any thread.
  std::optional<std::string> take();

 private:
  struct Detail {
    std::atomic<std::int64_t> a{0}, b{0};
  };
  std::atomic<std::uint64_t> raised_and_reported_{
      0};  // one bit per kind in each half: raised in the low half, reported in the high half
  std::array<Detail, kStickProblems> detail_;
};

}  // namespace gearshift::haptics
