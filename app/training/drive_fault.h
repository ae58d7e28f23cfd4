// What can be done wrong at lever and pedals, and how bad it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gearshift {

enum class FaultKind : std::uint8_t {
  stall,              // value: engine speed before it died [rad/s]
  over_rev,           // the engine above its red line; value: the most [rad/s]
  lugging,            // much load below the speed it can carry; value: how long [s]
  clutch_dump,        // value: slip power at its peak [W]
  clutch_early,       // up before the gear was in; value: how much earlier [s]
  clutch_late,        // down only after the lever had begun to move; value: how much later [s]
  no_clutch,          // shifted without it and without matched revs; value: difference [rad/s]
  riding_clutch,      // a foot on the pedal without need; value: how long [s]
  riding_lever,       // a hand that presses on the lever without need; value: how long [s]
  throttle_in_shift,  // revs flare while the clutch is down; value: flare [rad/s]
  rev_mismatch,       // value: difference at the clutch's first torque [rad/s]
  grind,              // value: energy of the dogs [J]
  blocked,            // pushed against a synchroniser that could not finish; value: how long [s]
  missed_shift,       // pushed to a gear and came back without it; value: gear
  wrong_gear,         // a gear that was not meant; value: gear
  wrong_column,       // entered a column off the way; value: how many
  over_push,          // value: the most [N]
  step_order,         // pedals and lever in another order than taught; value: steps out of place
  rollback,           // value: how far [m]
  jerk,               // value: the most [m/s^3]
  early_shift,        // up below the band of engine speed, or below the step's road speed; value: engine speed [rad/s]
  late_shift,         // above it; down: far below the step's road speed; value: engine speed [rad/s]
  too_slow,           // the shift took too long; value: [s]
  wrong_direction,    // reverse at forward speed, or the like; value: road speed [m/s]
  slow_step,          // a step of the lesson took longer than it may; value: [s]
  coasting,           // rolled in neutral or with the clutch down, neither shifting nor stopping; value: how long [s]
  early_downshift,    // a lower gear at a speed that is too high for it; value: engine speed that it asks for [rad/s]
  clutch_burn,        // the engine howls, or the clutch slips for long, until it holds; value: heat in the clutch [J]
};
inline constexpr int kFaultKinds = 28;

// What was out of its order in a shift, the first of it. Written to files: new ones come last.
enum class StepSlip : std::uint8_t {
  other,
  throttle_stayed,
  throttle_late,
  lever_first,
  clutch_before_gear,
  throttle_early
};

enum class Severity : std::uint8_t { note, minor, severe, very_severe };

struct DriveFault {
  FaultKind kind = FaultKind::stall;
  Severity severity = Severity::minor;
  double time = 0.0;        // [s] on the loop's clock
  double value = 0.0;       // in the kind's unit
  std::int64_t shift = -1;  // number of the shift record that it belongs to, or -1
  std::string step{};       // slow_step: the step's prompt; else empty
  // slow_step: within which it should be done [s]; wrong_gear: the gear that was meant; early_shift, late_shift,
  // early_downshift: the road speed that was, where the lesson says one [m/s]; step_order: StepSlip; else 0
  double wanted = 0.0;
};

// As files and databases write it: "stall", "over_rev", ...
std::string_view fault_key(FaultKind kind) noexcept;
std::optional<FaultKind> fault_of(std::string_view key) noexcept;
std::string_view severity_key(Severity severity) noexcept;

// What the coach says: "The clutch came up 0.12 s before the gear was in."
std::string fault_sentence(const DriveFault& fault);

// As part of a sentence: "a stall", "a dumped clutch".
std::string_view fault_name(FaultKind kind) noexcept;

// And what to do about it: "Let the clutch up only once the gear is in." One short sentence.
std::string_view fault_advice(FaultKind kind) noexcept;

}  // namespace gearshift
