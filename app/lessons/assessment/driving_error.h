// The errors that a learner can make with lever and pedals: kinds, thresholds, severity and sentences. One table in
// driving_error.cpp describes every kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/lessons/assessment/record_field.h"
#include "app/vehicle/speed_unit.h"

namespace gearshift::lessons {

enum class ErrorKind : std::uint8_t {
  stall,
  over_rev,           // engine above the red line
  lugging,            // high load at too low an engine speed
  clutch_dump,        // clutch released too fast
  clutch_early,       // clutch released before the gear was engaged
  clutch_late,        // clutch pressed after the lever began to move
  no_clutch,          // shift without the clutch and with unmatched revs
  riding_clutch,      // foot on the pedal without need
  riding_lever,       // hand pressing on the lever without need
  throttle_in_shift,  // engine speed rises while the clutch is down
  rev_mismatch,       // engine and gearbox at different speeds when the clutch starts to bite
  grind,              // gear engaged with teeth grinding
  blocked,            // pushing against a blocking synchroniser with the clutch down
  missed_shift,       // lever pushed towards a gear and pulled back without engaging it
  wrong_gear,         // a gear that the lesson did not ask for
  wrong_column,       // the lever entered slots off its path
  over_push,          // the hand pushed too hard
  step_order,         // the steps of a shift were not in the taught order
  rollback,
  jerk,
  early_shift,      // upshift below the rev band or the step's road speed
  late_shift,       // upshift above the rev band, or shift far past the step's road speed
  too_slow,         // a shift took too long
  wrong_direction,  // for example reverse while rolling forward
  slow_step,        // a step of the lesson took longer than allowed
  coasting,         // rolling in neutral or with the clutch down, without shifting or stopping
  early_downshift,  // downshift at too high a road speed
  clutch_burn,      // the clutch slipped too long or at too high an engine speed
};
inline constexpr int kErrorKindCount = 28;
std::string_view to_string(ErrorKind kind) noexcept;  // key in files and databases: "stall", "over_rev", ...
std::optional<ErrorKind> error_kind_of(std::string_view key) noexcept;

// First deviation of a shift's steps from the taught order. The history stores these values as numbers, so append new
// values at the end.
enum class OrderMistake : std::uint8_t {
  other,
  throttle_stayed,
  throttle_late,
  lever_first,
  clutch_before_gear,
  throttle_early
};
std::string_view to_string(OrderMistake mistake) noexcept;  // "throttle_stayed", ...; empty for `other`
constexpr OrderMistake last_value(OrderMistake) noexcept {
  return OrderMistake::throttle_early;
}

enum class Severity : std::uint8_t { note, minor, severe, very_severe };
std::string_view to_string(Severity severity) noexcept;
constexpr Severity last_value(Severity) noexcept {
  return Severity::very_severe;
}

struct DrivingError {
  ErrorKind kind = ErrorKind::stall;
  Severity severity = Severity::minor;
  double time = 0.0;        // [s] on the haptic loop's clock
  std::int64_t shift = -1;  // number of the shift in which the error was made; -1: none
  double points = 0.0;      // [1] deducted from the grade of 10; set by grade_result()

  // Measured. Each kind of error sets the value that its row of the table names; others are empty.
  std::optional<double> engine_speed{};      // [rad/s] highest, at the shift, or required by the lower gear
  std::optional<double> speed_difference{};  // [rad/s] between engine and gearbox
  std::optional<double> rev_rise{};          // [rad/s] rise of the engine speed while the clutch was down
  std::optional<double> duration{};          // [s]
  std::optional<double> too_early_by{};      // [s] by which clutch or lever moved too early
  std::optional<double> slip_power{};        // [W] peak, in the clutch
  std::optional<double> heat{};              // [J] in the clutch or at the gear's teeth
  std::optional<double> force{};             // [N] largest hand force
  std::optional<double> distance{};          // [m] rolled back
  std::optional<double> jerk{};              // [m/s^3] largest
  std::optional<double> road_speed{};        // [m/s] against the direction of the gear
  std::optional<int> gear{};                 // missed or engaged
  std::optional<int> wrong_slots{};          // number of slots entered off the path
  std::optional<int> steps_out_of_place{};   // edit distance to the taught order

  // Requested by the lesson.
  std::optional<int> wanted_gear{};      // in place of `gear`
  std::optional<double> target_speed{};  // [m/s] road speed at which to shift
  std::optional<double> time_limit{};    // [s] for the step
  std::string step{};                    // prompt of the step that took too long; else empty
  OrderMistake mistake = OrderMistake::other;
  vehicle::SpeedUnit speed_unit = vehicle::SpeedUnit::km_per_h;  // of the sentence: the car's
};

constexpr void each_field(FieldsOf<DrivingError> auto&& error, auto&& visit) {
  visit(RecordField{"kind"}, error.kind);
  visit(RecordField{"severity"}, error.severity);
  visit(RecordField{"points"}, error.points);
  visit(RecordField{"time_s"}, error.time);
  visit(RecordField{"shift"}, error.shift);
  visit(RecordField{"engine_speed_rad_per_s"}, error.engine_speed);
  visit(RecordField{"speed_difference_rad_per_s"}, error.speed_difference);
  visit(RecordField{"rev_rise_rad_per_s"}, error.rev_rise);
  visit(RecordField{"duration_s"}, error.duration);
  visit(RecordField{"too_early_by_s"}, error.too_early_by);
  visit(RecordField{"slip_power_w"}, error.slip_power);
  visit(RecordField{"heat_j"}, error.heat);
  visit(RecordField{"force_n"}, error.force);
  visit(RecordField{"distance_m"}, error.distance);
  visit(RecordField{"jerk_m_per_s3"}, error.jerk);
  visit(RecordField{"road_speed_m_per_s"}, error.road_speed);
  visit(RecordField{"gear", "", 0, true}, error.gear);
  visit(RecordField{"wrong_slots"}, error.wrong_slots);
  visit(RecordField{"steps_out_of_place"}, error.steps_out_of_place);
  visit(RecordField{"wanted_gear", "", 0, true}, error.wanted_gear);
  visit(RecordField{"target_speed_m_per_s"}, error.target_speed);
  visit(RecordField{"time_limit_s"}, error.time_limit);
  visit(RecordField{"step"}, error.step);
  visit(RecordField{"mistake"}, error.mistake);
  visit(RecordField{"speed_unit"}, error.speed_unit);
}

// Makes an error whose measured value, the one that the table names for this kind, is `measured`.
DrivingError make_driving_error(ErrorKind kind, Severity severity, double time, double measured,
                                std::int64_t shift = -1);

// The value that the table names for the error's kind, in the unit of its sentence. Empty if it is a gear, or missing.
struct MeasuredValue {
  double value = 0.0;
  std::string_view unit;  // "rpm", "kW", ...; empty for a count
};
std::optional<MeasuredValue> measured_value(const DrivingError& error) noexcept;

// Thresholds of a kind of error. They have the unit of the measured value, except for relative values: `over_rev` is
// relative to the car's red line, `slow_step` to the step's allowed time, `jerk` to jerk_limit() and `clutch_burn` to
// burn_limit() (clutch_release.h), `early_downshift` to max_downshift_speed() (error_detector.h).
struct ErrorRule {
  double raise = 0.0;  // smallest value that is an error
  double clear = 0.0;  // an error in progress ends below this value (hysteresis)
  double grave = 0.0;  // smallest value at which the error is one severity class higher
  Severity severity = Severity::minor;
};
const ErrorRule& error_rule(ErrorKind kind) noexcept;

// Returns the severity of an error. `value`: measured value, in the unit of `error_rule(kind).raise`.
Severity error_severity(ErrorKind kind, double value) noexcept;

// Feedback for the learner, for example "The clutch came up 0.12 s before the gear was in."
std::string error_sentence(const DrivingError& error);

// Verb phrase that completes "You fail if you ...", for example "stall" or "dump the clutch".
std::string_view error_action(ErrorKind kind) noexcept;

// One short sentence of advice, for example "Let the clutch up only once the gear is in."
std::string_view error_advice(ErrorKind kind) noexcept;

}  // namespace gearshift::lessons
