// The errors that a learner can make with lever and pedals, and their severity.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gearshift::lessons {

enum class ErrorKind : std::uint8_t {
  stall,              // value: highest engine speed in the last second before the stall [rad/s]
  over_rev,           // engine above the red line; value: highest engine speed [rad/s]
  lugging,            // high load at too low an engine speed; value: duration [s]
  clutch_dump,        // clutch released too fast; value: peak slip power [W]
  clutch_early,       // clutch released before the gear was engaged; value: how much earlier [s]
  clutch_late,        // clutch pressed after the lever began to move; value: how much later [s]
  no_clutch,          // shift without the clutch and with unmatched revs; value: speed difference [rad/s]
  riding_clutch,      // foot on the pedal without need; value: duration [s]
  riding_lever,       // hand pressing on the lever without need; value: duration [s]
  throttle_in_shift,  // engine speed rises while the clutch is down; value: rise [rad/s]
  rev_mismatch,       // value: absolute difference of engine and shaft speed when the clutch starts to bite [rad/s]
  grind,              // gear engaged with teeth grinding; value: energy lost at the gear teeth [J]
  blocked,            // pushing against a blocking synchroniser with the clutch down; value: duration [s]
  missed_shift,       // lever pushed towards a gear and pulled back without engaging it; value: gear
  wrong_gear,         // a gear that the lesson did not ask for; value: gear
  wrong_column,       // lever entered slots of neither the old nor the new gear; value: number of slots
  over_push,          // value: largest hand force [N]
  step_order,         // pedals and lever moved in a wrong order; value: number of steps out of place
  rollback,           // value: distance [m]
  jerk,               // value: largest jerk [m/s^3]
  early_shift,        // upshift below the rev band or the step's road speed; value: engine speed [rad/s]
  late_shift,       // upshift above the rev band, or shift far past the step's road speed; value: engine speed [rad/s]
  too_slow,         // value: duration of the shift [s]
  wrong_direction,  // for example reverse while rolling forward; value: road speed [m/s]
  slow_step,        // a step of the lesson took longer than allowed; value: duration [s]
  coasting,         // rolling in neutral or with the clutch down, without shifting or stopping; value: duration [s]
  early_downshift,  // downshift at too high a road speed; value: engine speed in the new gear [rad/s]
  clutch_burn,      // the clutch slipped too long or at too high an engine speed; value: heat in the clutch [J]
};
inline constexpr int kErrorKindCount = 28;
std::string_view to_string(ErrorKind kind) noexcept;  // key in files and databases: "stall", "over_rev", ...
std::optional<ErrorKind> error_kind_of(std::string_view key) noexcept;

// First deviation of a shift's steps from the taught order. Files store these values as numbers, so append new values
// at the end.
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
  double time = 0.0;        // [s] on the haptic loop's clock
  double value = 0.0;       // see ErrorKind for meaning and unit
  std::int64_t shift = -1;  // number of the shift in which the error was made; -1: none
  std::string step{};       // for slow_step: the step's prompt; else empty
  // For `slow_step`: allowed time [s]. For `wrong_gear`: requested gear. For `early_shift`, `late_shift` and
  // `early_downshift`: road speed that the lesson asks for [m/s]; 0 if none. For `step_order`: OrderMistake. For all
  // other kinds: 0.
  double wanted = 0.0;
};

// Feedback for the learner, for example "The clutch came up 0.12 s before the gear was in."
std::string error_sentence(const DrivingError& error);

// Verb phrase that completes "You fail if you ...", for example "stall" or "dump the clutch".
std::string_view error_action(ErrorKind kind) noexcept;

// One short sentence of advice, for example "Let the clutch up only once the gear is in."
std::string_view error_advice(ErrorKind kind) noexcept;

}  // namespace gearshift::lessons
