#include "app/lessons/assessment/driving_error.h"

#include <algorithm>
#include <array>
#include <limits>
#include <variant>

#include <fmt/core.h>

#include "app/lessons/assessment/lever_path_text.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lessons {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

constexpr double kShortStep = 3.0;  // [s] times are shown to 0.01 s if the step's time limit is shorter than this

using MeasuredMember = std::variant<std::optional<double> DrivingError::*, std::optional<int> DrivingError::*>;

// How a sentence shows the measured value: value * scale in this unit, with this many decimals.
struct Shown {
  double scale = 1.0;
  int digits = 0;
  std::string_view unit;
};
constexpr Shown kNumber{1.0, 0, ""}, kInNewtons{1.0, 0, "N"}, kInJoules{1.0, 1, "J"}, kInMetres{1.0, 2, "m"},
    kInTenths{1.0, 1, "s"}, kInHundredths{1.0, 2, "s"}, kAsJerk{1.0, 0, "m/s^3"},
    kInRpm{1.0 / haptics::kTurnPerMinute, 0, "rpm"}, kInKilojoules{1e-3, 1, "kJ"}, kInKilowatts{1e-3, 1, "kW"};

struct ErrorDescription {
  ErrorKind kind;
  std::string_view key;
  MeasuredMember measured;  // the value that the rule judges and the sentence names
  Shown shown;
  ErrorRule rule;
  std::string_view action;    // verb phrase for "You fail if you ..."
  std::string_view sentence;  // {} is replaced by the measured value
  std::string_view advice;
};

using E = DrivingError;

constexpr haptics::OverPushConfig kOverPush{};

// The columns of a rule are `raise`, `clear`, `grave` and `severity`. Rows are in the order of ErrorKind. All thresholds
// are engineering values that still have to be checked with people, unless the row gives a source.
constexpr std::array<ErrorDescription, kErrorKindCount> kErrors{{
    {ErrorKind::stall, "stall", &E::engine_speed, kInRpm, ErrorRule{0.0, 0.0, kNever, Severity::severe}, "stall",
     "The engine stalled: it fell from {} rpm within a second.",
     "Use more throttle at the bite point. When you stop, press the clutch in time."},
    // Relative to the red line.
    {ErrorKind::over_rev, "over_rev", &E::engine_speed, kInRpm, ErrorRule{1.0, 0.98, 1.1, Severity::severe},
     "rev above the red line", "You revved the engine to {} rpm, above its red line.",
     "Release the throttle or shift up before the red line."},
    {ErrorKind::lugging, "lugging", &E::duration, kInTenths, ErrorRule{1.0, 0.0, 4.0, Severity::minor},
     "let the engine labour", "The engine laboured for {} s because the gear was too high for the speed.",
     "Shift down before the engine labours."},
    // From measurements, see README.md.
    {ErrorKind::clutch_dump, "clutch_dump", &E::slip_power, kInKilowatts, ErrorRule{12e3, 0.0, 50e3, Severity::severe},
     "dump the clutch", "You let the clutch up abruptly (it had to absorb {} kW).",
     "Let the clutch up slowly through the bite point."},
    // 0.03 s is two frames of pedal data.
    {ErrorKind::clutch_early, "clutch_early", &E::too_early_by, kInHundredths,
     ErrorRule{0.03, 0.0, 0.3, Severity::minor}, "let the clutch up before the gear is in",
     "The clutch came up {} s before the gear was in.", "Let the clutch up only once the gear is in."},
    {ErrorKind::clutch_late, "clutch_late", &E::too_early_by, kInHundredths, ErrorRule{0.05, 0.0, 0.3, Severity::minor},
     "move the lever before the clutch is down", "The lever moved {} s before the clutch was down.",
     "Press the clutch all the way down before you move the lever."},
    // 70 rpm is the widest window in which the BonusFFB project counts revs as matched. It applies only to gears that
    // did not go in, see ErrorDetector::judge_clutch().
    {ErrorKind::no_clutch, "no_clutch", &E::speed_difference, kInRpm,
     ErrorRule{70 * haptics::kTurnPerMinute, 0.0, 1000 * haptics::kTurnPerMinute, Severity::severe},
     "shift without the clutch", "You shifted without the clutch; engine and gearbox were {} rpm apart.",
     "Press the clutch for every gear change."},
    {ErrorKind::riding_clutch, "riding_clutch", &E::duration, kInTenths, ErrorRule{2.0, 0.0, 10.0, Severity::minor},
     "rest your foot on the clutch", "You rested your foot on the clutch for {} s.",
     "Take your foot off the clutch once the shift is done."},
    {ErrorKind::riding_lever, "riding_lever", &E::duration, kInTenths, ErrorRule{2.0, 0.0, 10.0, Severity::minor},
     "lean on the lever", "You leaned on the lever for {} s.", "Take your hand off the lever once the gear is in."},
    {ErrorKind::throttle_in_shift, "throttle_in_shift", &E::rev_rise, kInRpm,
     ErrorRule{400 * haptics::kTurnPerMinute, 0.0, 1500 * haptics::kTurnPerMinute, Severity::minor},
     "press the throttle during a shift", "The engine revved up by {} rpm while the clutch was down.",
     "Release the throttle before you press the clutch."},
    {ErrorKind::rev_mismatch, "rev_mismatch", &E::speed_difference, kInRpm,
     ErrorRule{300 * haptics::kTurnPerMinute, 0.0, 1200 * haptics::kTurnPerMinute, Severity::minor},
     "let the clutch up at the wrong revs", "Engine and gearbox were {} rpm apart when the clutch took hold.",
     "Bring the engine to the speed that the new gear needs before you let the clutch up."},
    {ErrorKind::grind, "grind", &E::heat, kInJoules, ErrorRule{0.5, 0.0, 30.0, Severity::minor}, "grind a gear",
     "The gears ground ({} J).", "Press the clutch all the way down, and wait a moment before shifting into reverse."},
    // 1 s is a little longer than synchronising from second to first gear with 30 N at the knob, which takes 0.84 s.
    {ErrorKind::blocked, "blocked", &E::duration, kInHundredths, ErrorRule{1.0, 0.0, 4.0, Severity::minor},
     "force the synchroniser", "You pushed against the synchroniser for {} s.",
     "Choose a gear that fits the speed, and push steadily until it goes in."},
    {ErrorKind::missed_shift, "missed_shift", &E::gear, kNumber, ErrorRule{-kNever, 0.0, kNever, Severity::minor},
     "miss a gear", "You missed {}.", "Push the lever all the way in before you let go."},
    {ErrorKind::wrong_gear, "wrong_gear", &E::gear, kNumber, ErrorRule{-kNever, 0.0, kNever, Severity::minor},
     "engage the wrong gear", "You engaged {}, which the lesson did not ask for.",
     "Check where the gear is before you move the lever."},
    {ErrorKind::wrong_column, "wrong_column", &E::wrong_slots, kNumber, ErrorRule{1.0, 0.0, 3.0, Severity::minor},
     "enter the wrong slot", "The lever entered {} wrong slots.",
     "Pass through neutral, and let the springs guide the lever."},
    {ErrorKind::over_push, "over_push", &E::force, kInNewtons,
     ErrorRule{kOverPush.warn_above, kOverPush.clear_below, 100.0, Severity::minor}, "push the lever too hard",
     "You pushed the lever too hard ({} N).", "Push lightly, and wait until the gear goes in."},
    {ErrorKind::step_order, "step_order", &E::steps_out_of_place, kNumber, ErrorRule{1.0, 0.0, 4.0, Severity::minor},
     "shift out of order", "You did the steps of the shift in the wrong order ({} out of place).",
     "The order is: off the throttle, clutch down, move the lever, clutch up, throttle."},
    {ErrorKind::rollback, "rollback", &E::distance, kInMetres, ErrorRule{0.10, 0.0, 0.5, Severity::minor}, "roll back",
     "The car rolled back {} m.", "Hold the car with the brake until the clutch holds it."},
    // Relative to jerk_limit() in clutch_release.h.
    {ErrorKind::jerk, "jerk", &E::jerk, kAsJerk, ErrorRule{1.0, 0.0, 2.0, Severity::minor}, "jerk the car",
     "The car jerked ({} m/s³).", "Let the clutch up more slowly through the bite point."},
    // ErrorDetector itself compares with the rev band, here and in the next row.
    {ErrorKind::early_shift, "early_shift", &E::engine_speed, kInRpm, ErrorRule{-kNever, 0.0, kNever, Severity::minor},
     "shift up too early", "You shifted too early, at {} rpm.", "Stay in gear until the revs are higher."},
    {ErrorKind::late_shift, "late_shift", &E::engine_speed, kInRpm, ErrorRule{-kNever, 0.0, kNever, Severity::minor},
     "shift too late", "You shifted too late, at {} rpm.", "Shift earlier."},
    {ErrorKind::too_slow, "too_slow", &E::duration, kInTenths, ErrorRule{2.5, 0.0, 6.0, Severity::minor},
     "take too long to shift", "The shift took too long ({} s).",
     "Press the clutch, move the lever and release the clutch in one smooth motion."},
    {ErrorKind::wrong_direction, "wrong_direction", &E::road_speed, kNumber, ErrorRule{1.0, 0.0, 5.0, Severity::severe},
     "engage a gear while the car rolls the other way",
     "You engaged a gear while the car was rolling the other way at {}.", "Stop before you change direction."},
    // Relative to the allowed time.
    {ErrorKind::slow_step, "slow_step", &E::duration, kInTenths, ErrorRule{1.0, 0.0, 2.0, Severity::minor},
     "take too long for a step", "A step took too long ({} s).",
     "React at once when you are told to, and do not hesitate."},
    // 3 s is three times a normal shift.
    {ErrorKind::coasting, "coasting", &E::duration, kInTenths, ErrorRule{3.0, 0.0, 10.0, Severity::minor}, "coast",
     "You coasted for {} s (out of gear or with the clutch down).",
     "Stay in gear with the clutch up until just before you stop."},
    // Relative to max_downshift_speed() in error_detector.h.
    {ErrorKind::early_downshift, "early_downshift", &E::engine_speed, kInRpm, ErrorRule{1.0, 0.0, 1.5, Severity::minor},
     "shift down too early", "You shifted down too early: the lower gear needs {} rpm at that speed.",
     "Slow down first, then shift down."},
    // Relative to burn_limit() in clutch_release.h.
    {ErrorKind::clutch_burn, "clutch_burn", &E::heat, kInKilojoules, ErrorRule{1.0, 0.0, 2.0, Severity::minor},
     "burn the clutch", "The clutch slipped too long and overheated ({} kJ).",
     "Use less throttle, and hold the clutch at the bite point only until the car rolls."},
}};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kErrors.size(); ++i) {
    if (kErrors[i].kind != static_cast<ErrorKind>(i)) return false;
  }
  return true;
}
static_assert(is_in_order());

constexpr std::array<std::string_view, 4> kSeverities{"note", "minor", "severe", "very_severe"};

// Key and sentence, in the order of OrderMistake.
constexpr std::array<std::array<std::string_view, 2>, 6> kOrderMistakes{{
    {"", ""},
    {"throttle_stayed", "You kept the throttle on through the shift."},
    {"throttle_late", "You released the throttle only after the clutch was down."},
    {"lever_first", "The lever moved before the clutch was down."},
    {"clutch_before_gear", "The clutch came up before the gear was in."},
    {"throttle_early", "You pressed the throttle before the clutch was up."},
}};

const ErrorDescription& description_of(ErrorKind kind) noexcept {
  return kErrors[static_cast<std::size_t>(kind)];
}

// The measured value; 0 if it is missing, which can happen if the error was read from a file.
double measured(const DrivingError& error) {
  return std::visit([&](auto figure) { return static_cast<double>((error.*figure).value_or(0)); },
                    description_of(error.kind).measured);
}

std::string format_speed(vehicle::SpeedUnit unit, double speed) {
  return fmt::format("{:.0f} {}", vehicle::in_unit(unit, speed), to_string(unit));
}

std::string format_measured(const DrivingError& error) {
  const MeasuredMember& figure = description_of(error.kind).measured;
  const Shown& shown = description_of(error.kind).shown;
  if (figure == MeasuredMember(&DrivingError::gear)) return gear_word(error.gear.value_or(haptics::kNeutralGear));
  if (figure == MeasuredMember(&DrivingError::road_speed)) return format_speed(error.speed_unit, measured(error));
  return fmt::format("{:.{}f}", shown.scale * measured(error), shown.digits);
}

}  // namespace

std::string_view to_string(ErrorKind kind) noexcept {
  return description_of(kind).key;
}

std::optional<ErrorKind> error_kind_of(std::string_view key) noexcept {
  const auto found =
      std::find_if(kErrors.begin(), kErrors.end(), [&](const ErrorDescription& error) { return error.key == key; });
  return found == kErrors.end() ? std::nullopt : std::optional(found->kind);
}

std::optional<MeasuredValue> measured_value(const DrivingError& error) noexcept {
  const ErrorDescription& description = description_of(error.kind);
  const bool is_missing = std::visit([&](auto figure) { return !(error.*figure).has_value(); }, description.measured);
  if (is_missing || description.measured == MeasuredMember(&DrivingError::gear)) return std::nullopt;
  if (description.measured == MeasuredMember(&DrivingError::road_speed))
    return MeasuredValue{vehicle::in_unit(error.speed_unit, measured(error)), to_string(error.speed_unit)};
  return MeasuredValue{description.shown.scale * measured(error), description.shown.unit};
}

std::string_view to_string(OrderMistake mistake) noexcept {
  return kOrderMistakes[static_cast<std::size_t>(mistake)][0];
}

std::string_view to_string(Severity severity) noexcept {
  return kSeverities[static_cast<std::size_t>(severity)];
}

DrivingError make_driving_error(ErrorKind kind, Severity severity, double time, double measured, std::int64_t shift) {
  DrivingError error{kind, severity, time, shift};
  std::visit(
      [&](auto figure) {
        using Value = typename std::remove_reference_t<decltype(error.*figure)>::value_type;
        error.*figure = static_cast<Value>(measured);
      },
      description_of(kind).measured);
  return error;
}

const ErrorRule& error_rule(ErrorKind kind) noexcept {
  return description_of(kind).rule;
}

Severity error_severity(ErrorKind kind, double value) noexcept {
  const ErrorRule& rule = error_rule(kind);
  if (value < rule.grave || rule.severity == Severity::very_severe) return rule.severity;
  return static_cast<Severity>(static_cast<int>(rule.severity) + 1);
}

std::string_view error_action(ErrorKind kind) noexcept {
  return description_of(kind).action;
}

std::string_view error_advice(ErrorKind kind) noexcept {
  return description_of(kind).advice;
}

std::string error_sentence(const DrivingError& error) {
  if (error.mistake != OrderMistake::other)
    return std::string(kOrderMistakes[static_cast<std::size_t>(error.mistake)][1]);
  if (error.target_speed) {
    const bool late = error.kind == ErrorKind::late_shift, down = error.kind == ErrorKind::early_downshift;
    return fmt::format("You shifted {}too {}: the target was {}.", down ? "down " : "", late ? "late" : "early",
                       format_speed(error.speed_unit, *error.target_speed));
  }
  if (error.wrong_slots == 1) return "The lever entered the wrong slot.";
  if (error.time_limit)
    return fmt::format("You took {1:.{3}f} s for this step (limit {2:.{3}f} s): \"{0}\"", error.step,
                       error.duration.value_or(0.0), *error.time_limit, *error.time_limit < kShortStep ? 2 : 1);
  if (error.wanted_gear)
    return fmt::format("You engaged {} instead of {}.", format_measured(error), gear_word(*error.wanted_gear));
  return fmt::format(fmt::runtime(description_of(error.kind).sentence), format_measured(error));
}

}  // namespace gearshift::lessons
