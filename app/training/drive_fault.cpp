#include "app/training/drive_fault.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/core.h>

#include "haptics/gate/gate.h"

namespace gearshift {
namespace {

constexpr double kInRpm = 60.0 / 6.283185307179586;  // per rad/s

constexpr double kShortStep = 3.0;  // [s] told to a hundredth

struct FaultWords {
  std::string_view key;
  std::string_view name;  // as part of a sentence
  std::string_view says;  // {}: the value, scaled
  std::string_view advises;
  double scale = 1.0;
  int digits = 0;
};

// In the order of FaultKind.
constexpr std::array<FaultWords, kFaultKinds> kWords{{
    {"stall", "a stall", "The engine stalled, from {} rpm.",
     "More throttle, and hold the clutch at the bite point; to stop, press it in time.", kInRpm, 0},
    {"over_rev", "revs above the red line", "The engine was turned to {} rpm, above its red line.",
     "Lift the throttle, or shift up, before the red line.", kInRpm, 0},
    {"lugging", "labouring", "The engine laboured for {} s: too high a gear for that speed.",
     "Shift down before the engine labours.", 1.0, 1},
    {"clutch_dump", "a dumped clutch", "The clutch came up with a bang ({} kW of slip).",
     "Let the clutch up slowly through the bite point.", 1e-3, 1},
    {"clutch_early", "the clutch up before the gear is in", "The clutch came up {} s before the gear was in.",
     "Let the clutch up only once the gear is in.", 1.0, 2},
    {"clutch_late", "the lever before the clutch", "The lever moved {} s before the clutch was down.",
     "Press the clutch all the way down before the lever moves.", 1.0, 2},
    {"no_clutch", "a gear without the clutch", "The gear was changed without the clutch, {} rpm apart.",
     "Press the clutch for every change of gear.", kInRpm, 0},
    {"riding_clutch", "a foot that rests on the clutch", "The foot rested on the clutch for {} s.",
     "Take the foot off the clutch once the shift is done.", 1.0, 1},
    {"riding_lever", "a hand that leans on the lever", "The hand leaned on the lever for {} s.",
     "Take the hand off the lever once the gear is in.", 1.0, 1},
    {"throttle_in_shift", "throttle in a shift", "The engine flared by {} rpm while the clutch was down.",
     "Lift the throttle before you press the clutch.", kInRpm, 0},
    {"rev_mismatch", "revs that do not fit", "Engine and gearbox were {} rpm apart when the clutch took hold.",
     "Bring the engine to the speed that the new gear needs before the clutch comes up.", kInRpm, 0},
    {"grind", "a gear that grinds", "The gear ground, {} J.",
     "Clutch all the way down, and wait a moment before reverse.", 1.0, 1},
    {"blocked", "pushing against the synchroniser", "The lever was pushed against the synchroniser for {} s.",
     "Choose a gear that fits the speed, and push steadily until it goes in.", 1.0, 2},
    {"missed_shift", "a gear that is missed", "Gear {} was not reached.",
     "Push the lever all the way in, and only then let it go.", 1.0, 0},
    {"wrong_gear", "a wrong gear", "That was gear {}; another one was meant.",
     "Look where the gear lies before the hand moves.", 1.0, 0},
    {"wrong_column", "a wrong slot", "The lever entered {} wrong slots.",
     "Go by the middle, and let the springs guide the lever.", 1.0, 0},
    {"over_push", "pushing too hard", "The lever was pushed hard ({} N).",
     "A light hand: wait until the gear goes in by itself.", 1.0, 0},
    {"step_order", "a shift out of order", "The shift was out of order: {} steps.",
     "Off the throttle, clutch down, lever, clutch up, throttle.", 1.0, 0},
    {"rollback", "rolling back", "The car rolled back {} m.", "Hold the car with the brake until the clutch holds it.",
     1.0, 2},
    {"jerk", "a jerk", "The car jerked, {} m/s³.", "Let the clutch up more slowly where it takes hold.", 1.0, 0},
    {"early_shift", "shifting up too early", "Shifted at {} rpm: too early.",
     "Stay in the gear until the engine turns faster.", kInRpm, 0},
    {"late_shift", "shifting too late", "Shifted at {} rpm: too late.", "Shift earlier.", kInRpm, 0},
    {"too_slow", "a shift that takes too long", "The shift took {} s.", "Clutch, lever, clutch in one go.", 1.0, 1},
    {"wrong_direction", "a gear against the way the car rolls", "That gear was chosen at {} km/h the other way.",
     "Stop before you change the direction.", kKmhPerMps, 0},
    {"slow_step", "too slow a step", "A step took {} s: too long.",
     "Begin the step as soon as it is said, and do it in one go, with all there is.", 1.0, 1},
    {"coasting", "coasting", "The car rolled without drive for {} s: out of gear, or with the clutch down.",
     "Stay in gear with the clutch up until just before you stop.", 1.0, 1},
    {"early_downshift", "shifting down too early", "Shifted down too early: at that speed the gear asks for {} rpm.",
     "Slow down first, then shift down.", kInRpm, 0},
    {"clutch_burn", "a burnt clutch", "The clutch slipped for so long that it smells ({} kJ of heat).",
     "Less throttle, and hold the clutch at the bite point only until the car rolls.", 1e-3, 1},
}};

constexpr std::array<std::string_view, 4> kSeverities{"note", "minor", "severe", "very_severe"};

// In the order of StepSlip.
constexpr std::array<std::string_view, 6> kSlips{
    "",
    "The throttle stayed on through the shift.",
    "The throttle came off only after the clutch was down.",
    "The lever moved before the clutch was down.",
    "The clutch came up before the gear was in.",
    "The throttle came before the clutch was up.",
};

const FaultWords& words_of(FaultKind kind) noexcept {
  return kWords[static_cast<std::size_t>(kind)];
}

// A file may say anything.
StepSlip slip_of(const DriveFault& fault) noexcept {
  const bool is_one = fault.wanted >= 0.0 && fault.wanted < static_cast<double>(kSlips.size());
  return is_one ? static_cast<StepSlip>(fault.wanted) : StepSlip::other;
}

constexpr double kMostGear = 99.0;  // beyond any box

int gear_of(double value) noexcept {
  return std::abs(value) <= kMostGear ? static_cast<int>(value) : kNeutralGear;
}

bool has_speed(const DriveFault& fault) noexcept {
  const bool may = fault.kind == FaultKind::early_shift || fault.kind == FaultKind::late_shift ||
                   fault.kind == FaultKind::early_downshift;
  return may && fault.wanted > 0.0;
}

}  // namespace

std::string_view fault_key(FaultKind kind) noexcept {
  return words_of(kind).key;
}

std::optional<FaultKind> fault_of(std::string_view key) noexcept {
  const auto found =
      std::find_if(kWords.begin(), kWords.end(), [&](const FaultWords& words) { return words.key == key; });
  if (found == kWords.end()) return std::nullopt;
  return static_cast<FaultKind>(found - kWords.begin());
}

std::string_view severity_key(Severity severity) noexcept {
  return kSeverities[static_cast<std::size_t>(severity)];
}

std::string_view fault_name(FaultKind kind) noexcept {
  return words_of(kind).name;
}

std::string_view fault_advice(FaultKind kind) noexcept {
  return words_of(kind).advises;
}

std::string fault_sentence(const DriveFault& fault) {
  const FaultWords& words = words_of(fault.kind);
  if (fault.kind == FaultKind::step_order && slip_of(fault) != StepSlip::other)
    return std::string(kSlips[static_cast<std::size_t>(slip_of(fault))]);
  if (has_speed(fault)) {
    const bool late = fault.kind == FaultKind::late_shift, down = fault.kind == FaultKind::early_downshift;
    return fmt::format("Shifted {}too {}: it was to be at {:.0f} km/h.", down ? "down " : "", late ? "late" : "early",
                       kKmhPerMps * fault.wanted);
  }
  if (fault.kind == FaultKind::wrong_column && fault.value == 1.0) return "The lever entered a wrong slot.";
  if (!fault.step.empty())
    return fmt::format("\"{0}\" took {1:.{3}f} s; {2:.{3}f} s is wanted.", fault.step, fault.value, fault.wanted,
                       fault.wanted < kShortStep ? 2 : 1);
  const int meant = gear_of(fault.wanted);
  if (fault.kind == FaultKind::wrong_gear && meant != kNeutralGear)
    return fmt::format("Gear {} instead of {}.", gear_name(gear_of(fault.value)), gear_name(meant));
  if (fault.kind == FaultKind::missed_shift || fault.kind == FaultKind::wrong_gear)
    return fmt::format(fmt::runtime(words.says), gear_name(gear_of(fault.value)));
  return fmt::format(fmt::runtime(words.says), fmt::format("{:.{}f}", words.scale * fault.value, words.digits));
}

}  // namespace gearshift
