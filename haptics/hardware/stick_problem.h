// Problems of a streaming stick: raised on the port's and the haptic thread, reported on a third one, each kind once.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace gearshift::haptics {

// The comment on a problem lists the detail values that raise() takes for it, or explains a problem without details.
enum class StickProblem : std::uint8_t {
  wrong_length,    // number of bytes received, number of bytes declared by the descriptor
  unknown_report,  // report ID
  frozen,          // [s] time under force without motion
  faded_out,       // [s] time until the force had faded out
  position_jump,   // jump [%] of the range
  switched_off,    // the device switched its motors off
  effect_stopped,
  no_power,
  safety_switch,  // the safety switch is open
  output_stuck,   // an output report does not complete
  slow_output,    // [ms] time per output, [ms] answer time from the calibration
  reversed,       // its forces move the lever against their direction
  silent,         // the lever does not follow its forces
  overpowered,    // [mm] that the lever moved against nearly the full force; the motors stay on
  no_commands     // [ms] time without a command, because the haptic side is late or dead
};
inline constexpr std::size_t kStickProblems = 15;

class StickProblems {
 public:
  // Real-time safe.
  void raise(StickProblem problem, std::int64_t a = 0, std::int64_t b = 0) noexcept;
  void raise_again(StickProblem problem) noexcept;  // also if this kind was reported before; for kinds without details
  void reset() noexcept;                            // every kind may be reported again

  // The next unreported problem as one sentence; empty if there is none. Any thread.
  std::optional<std::string> take();

 private:
  struct Detail {
    std::atomic<std::int64_t> a{0}, b{0};
  };
  // One bit per kind in each half: the low half holds the raised problems, the high half the reported problems.
  std::atomic<std::uint64_t> raised_and_reported_{0};
  std::array<Detail, kStickProblems> detail_;
};

}  // namespace gearshift::haptics
