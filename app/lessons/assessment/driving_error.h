// The errors that a learner can make with lever and pedals, and their severity.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gearshift::lessons {

enum class ErrorKind : std::uint8_t {
  stall,              // value: engine speed before it died [rad/s]
  over_rev,           // above the red line; value: highest engine speed [rad/s]
  lugging,            // high load at too low an engine speed; value: duration [s]
  clutch_dump,        // value: peak slip power [W]
  clutch_early,       // clutch up before the gear was in; value: how much earlier [s]
  clutch_late,        // clutch down after the lever began to move; value: how much later [s]
  no_clutch,          // shifted without clutch and without matched revs; value: speed difference [rad/s]
  riding_clutch,      // foot on the pedal without need; value: duration [s]
  riding_lever,       // hand pressing on the lever without need; value: duration [s]
  throttle_in_shift,  // engine speed rises while the clutch is down; value: rise [rad/s]
  rev_mismatch,       // value: speed difference when the clutch starts to transmit torque [rad/s]
  grind,              // value: energy lost at the dogs [J]
  blocked,            // pushing against a synchroniser that cannot finish; value: duration [s]
  missed_shift,       // lever pushed towards a gear and pulled back without engaging it; value: gear
  wrong_gear,         // a gear that was not asked for; value: gear
  wrong_column,       // lever entered slots off its path; value: number of slots
  over_push,          // value: largest push [N]
  step_order,         // pedals and lever not in the order taught; value: number of steps out of place
  rollback,           // value: distance [m]
  jerk,               // value: largest jerk [m/s^3]
  early_shift,      // upshift below the engine speed band, or below the step's road speed; value: engine speed [rad/s]
  late_shift,       // upshift above the band, or downshift far below the step's road speed; value: engine speed [rad/s]
  too_slow,         // value: duration of the shift [s]
  wrong_direction,  // e.g. reverse while rolling forward; value: road speed [m/s]
  slow_step,        // a step of the lesson took longer than allowed; value: duration [s]
  coasting,         // rolling in neutral or with the clutch down, neither shifting nor stopping; value: duration [s]
  early_downshift,  // lower gear at too high a speed; value: engine speed that the gear requires [rad/s]
  clutch_burn,      // the clutch slipped too long or at too high an engine speed; value: heat in the clutch [J]
};
inline constexpr int kErrorKindCount = 28;
std::string_view to_string(ErrorKind kind) noexcept;  // key in files and databases: "stall", "over_rev", ...
std::optional<ErrorKind> error_kind_of(std::string_view key) noexcept;

// The first mistake in the order of a shift's steps. Files store the value: append new ones at the end.
enum class OrderMistake : std::uint8_t {
  other,
  throttle_stayed,
  throttle_late,
  lever_first,
  clutch_before_gear,
  throttle_early
};

enum class Severity : std::uint8_t { note, minor, severe, very_severe };
std::string_view to_string(Severity severity) noexcept;

struct DrivingError {
  ErrorKind kind = ErrorKind::stall;
  Severity severity = Severity::minor;
  double time = 0.0;        // [s] on the loop's clock
  double value = 0.0;       // in the unit that ErrorKind gives
  std::int64_t shift = -1;  // number of the shift record that the error belongs to, or -1
  std::string step{};       // slow_step: the prompt of the step; else empty
  // slow_step: allowed time [s]; wrong_gear: the gear asked for; early_shift, late_shift, early_downshift: the road
  // speed that the lesson asks for, if any [m/s]; step_order: OrderMistake; else 0
  double wanted = 0.0;
};

// Feedback for the learner: "The clutch came up 0.12 s before the gear was in."
std::string error_sentence(const DrivingError& error);

// Verb phrase to complete "if you ...": "stall", "dump the clutch".
std::string_view error_action(ErrorKind kind) noexcept;

// One short sentence of advice: "Let the clutch up only once the gear is in."
std::string_view error_advice(ErrorKind kind) noexcept;

}  // namespace gearshift::lessons
