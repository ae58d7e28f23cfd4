#include "app/lessons/assessment/driving_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/core.h>

#include "app/lessons/assessment/lever_path_text.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {
namespace {

constexpr double kRpmPerRadPerS = 60.0 / 6.283185307179586;  // rpm per rad/s

constexpr double kShortStep = 3.0;  // [s] times are shown to 0.01 s if the step's time limit is shorter than this

struct ErrorText {
  std::string_view key;
  std::string_view action;    // verb phrase for "You fail if you ..."
  std::string_view sentence;  // {} is replaced by the error's value, scaled
  std::string_view advice;
  double scale = 1.0;
  int digits = 0;
};

// Entries are in the order of ErrorKind.
constexpr std::array<ErrorText, kErrorKindCount> kErrorTexts{{
    {"stall", "stall", "The engine stalled at {} rpm.",
     "Use more throttle at the bite point. When you stop, press the clutch in time.", kRpmPerRadPerS, 0},
    {"over_rev", "rev above the red line", "You revved the engine to {} rpm, above its red line.",
     "Release the throttle or shift up before the red line.", kRpmPerRadPerS, 0},
    {"lugging", "let the engine labour", "The engine laboured for {} s because the gear was too high for the speed.",
     "Shift down before the engine labours.", 1.0, 1},
    {"clutch_dump", "dump the clutch", "You let the clutch up abruptly (it had to absorb {} kW).",
     "Let the clutch up slowly through the bite point.", 1e-3, 1},
    {"clutch_early", "let the clutch up before the gear is in", "The clutch came up {} s before the gear was in.",
     "Let the clutch up only once the gear is in.", 1.0, 2},
    {"clutch_late", "move the lever before the clutch is down", "The lever moved {} s before the clutch was down.",
     "Press the clutch all the way down before you move the lever.", 1.0, 2},
    {"no_clutch", "shift without the clutch", "You shifted without the clutch; engine and gearbox were {} rpm apart.",
     "Press the clutch for every gear change.", kRpmPerRadPerS, 0},
    {"riding_clutch", "rest your foot on the clutch", "You rested your foot on the clutch for {} s.",
     "Take your foot off the clutch once the shift is done.", 1.0, 1},
    {"riding_lever", "lean on the lever", "You leaned on the lever for {} s.",
     "Take your hand off the lever once the gear is in.", 1.0, 1},
    {"throttle_in_shift", "press the throttle during a shift",
     "The engine revved up by {} rpm while the clutch was down.", "Release the throttle before you press the clutch.",
     kRpmPerRadPerS, 0},
    {"rev_mismatch", "let the clutch up at the wrong revs",
     "Engine and gearbox were {} rpm apart when the clutch took hold.",
     "Bring the engine to the speed that the new gear needs before you let the clutch up.", kRpmPerRadPerS, 0},
    {"grind", "grind a gear", "The gears ground ({} J).",
     "Press the clutch all the way down, and wait a moment before shifting into reverse.", 1.0, 1},
    {"blocked", "force the synchroniser", "You pushed against the synchroniser for {} s.",
     "Choose a gear that fits the speed, and push steadily until it goes in.", 1.0, 2},
    {"missed_shift", "miss a gear", "You missed {}.", "Push the lever all the way in before you let go.", 1.0, 0},
    {"wrong_gear", "engage the wrong gear", "You engaged {}, which the lesson did not ask for.",
     "Check where the gear is before you move the lever.", 1.0, 0},
    {"wrong_column", "enter the wrong slot", "The lever entered {} wrong slots.",
     "Pass through neutral, and let the springs guide the lever.", 1.0, 0},
    {"over_push", "push the lever too hard", "You pushed the lever too hard ({} N).",
     "Push lightly, and wait until the gear goes in.", 1.0, 0},
    {"step_order", "shift out of order", "You did the steps of the shift in the wrong order ({} out of place).",
     "The order is: off the throttle, clutch down, move the lever, clutch up, throttle.", 1.0, 0},
    {"rollback", "roll back", "The car rolled back {} m.", "Hold the car with the brake until the clutch holds it.",
     1.0, 2},
    {"jerk", "jerk the car", "The car jerked ({} m/s³).", "Let the clutch up more slowly through the bite point.", 1.0,
     0},
    {"early_shift", "shift up too early", "You shifted too early, at {} rpm.",
     "Stay in gear until the revs are higher.", kRpmPerRadPerS, 0},
    {"late_shift", "shift too late", "You shifted too late, at {} rpm.", "Shift earlier.", kRpmPerRadPerS, 0},
    {"too_slow", "take too long to shift", "The shift took too long ({} s).",
     "Press the clutch, move the lever and release the clutch in one smooth motion.", 1.0, 1},
    {"wrong_direction", "engage a gear while the car rolls the other way",
     "You engaged a gear while the car was rolling the other way at {} km/h.", "Stop before you change direction.",
     haptics::kKmhPerMps, 0},
    {"slow_step", "take too long for a step", "A step took too long ({} s).",
     "React at once when you are told to, and do not hesitate.", 1.0, 1},
    {"coasting", "coast", "You coasted for {} s (out of gear or with the clutch down).",
     "Stay in gear with the clutch up until just before you stop.", 1.0, 1},
    {"early_downshift", "shift down too early",
     "You shifted down too early: the lower gear needs {} rpm at that speed.", "Slow down first, then shift down.",
     kRpmPerRadPerS, 0},
    {"clutch_burn", "burn the clutch", "The clutch slipped too long and overheated ({} kJ).",
     "Use less throttle, and hold the clutch at the bite point only until the car rolls.", 1e-3, 1},
}};

constexpr std::array<std::string_view, 4> kSeverities{"note", "minor", "severe", "very_severe"};

// Entries are in the order of OrderMistake.
constexpr std::array<std::string_view, 6> kOrderMistakes{
    "",
    "You kept the throttle on through the shift.",
    "You released the throttle only after the clutch was down.",
    "The lever moved before the clutch was down.",
    "The clutch came up before the gear was in.",
    "You pressed the throttle before the clutch was up.",
};

const ErrorText& text_of(ErrorKind kind) noexcept {
  return kErrorTexts[static_cast<std::size_t>(kind)];
}

// Returns the mistake stored in `wanted`. Returns `other` if the value is out of range, which can happen if the error
// was read from a file.
OrderMistake order_mistake_of(const DrivingError& error) noexcept {
  const bool is_valid = error.wanted >= 0.0 && error.wanted < static_cast<double>(kOrderMistakes.size());
  return is_valid ? static_cast<OrderMistake>(error.wanted) : OrderMistake::other;
}

constexpr double kMaxGearShown = 99.0;  // larger than any real gear number

int gear_of(double value) noexcept {
  return std::abs(value) <= kMaxGearShown ? static_cast<int>(value) : haptics::kNeutralGear;
}

bool has_speed(const DrivingError& error) noexcept {
  const bool may_have_speed = error.kind == ErrorKind::early_shift || error.kind == ErrorKind::late_shift ||
                              error.kind == ErrorKind::early_downshift;
  return may_have_speed && error.wanted > 0.0;
}

}  // namespace

std::string_view to_string(ErrorKind kind) noexcept {
  return text_of(kind).key;
}

std::optional<ErrorKind> error_kind_of(std::string_view key) noexcept {
  const auto found =
      std::find_if(kErrorTexts.begin(), kErrorTexts.end(), [&](const ErrorText& text) { return text.key == key; });
  if (found == kErrorTexts.end()) return std::nullopt;
  return static_cast<ErrorKind>(found - kErrorTexts.begin());
}

std::string_view to_string(Severity severity) noexcept {
  return kSeverities[static_cast<std::size_t>(severity)];
}

std::string_view error_action(ErrorKind kind) noexcept {
  return text_of(kind).action;
}

std::string_view error_advice(ErrorKind kind) noexcept {
  return text_of(kind).advice;
}

std::string error_sentence(const DrivingError& error) {
  const ErrorText& text = text_of(error.kind);
  if (error.kind == ErrorKind::step_order && order_mistake_of(error) != OrderMistake::other)
    return std::string(kOrderMistakes[static_cast<std::size_t>(order_mistake_of(error))]);
  if (has_speed(error)) {
    const bool late = error.kind == ErrorKind::late_shift, down = error.kind == ErrorKind::early_downshift;
    return fmt::format("You shifted {}too {}: the target was {:.0f} km/h.", down ? "down " : "",
                       late ? "late" : "early", haptics::kKmhPerMps * error.wanted);
  }
  if (error.kind == ErrorKind::wrong_column && error.value == 1.0) return "The lever entered the wrong slot.";
  if (!error.step.empty())
    return fmt::format("You took {1:.{3}f} s for this step (limit {2:.{3}f} s): \"{0}\"", error.step, error.value,
                       error.wanted, error.wanted < kShortStep ? 2 : 1);
  const int meant = gear_of(error.wanted);
  if (error.kind == ErrorKind::wrong_gear && meant != haptics::kNeutralGear)
    return fmt::format("You engaged {} instead of {}.", gear_word(gear_of(error.value)), gear_word(meant));
  if (error.kind == ErrorKind::missed_shift || error.kind == ErrorKind::wrong_gear)
    return fmt::format(fmt::runtime(text.sentence), gear_word(gear_of(error.value)));
  return fmt::format(fmt::runtime(text.sentence), fmt::format("{:.{}f}", text.scale * error.value, text.digits));
}

}  // namespace gearshift::lessons
