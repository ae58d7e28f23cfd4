#include "app/training/drive_fault.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <fmt/core.h>

#include "haptics/gate/gate.h"

namespace gearshift {
namespace {

constexpr double kRpm = 60.0 / 6.283185307179586;  // per rad/s

constexpr double kShortStep = 3.0;  // [s] told to a hundredth

struct FaultWords {
  std::string_view key;
  std::string_view says;  // {}: the value, scaled
  std::string_view advises;
  double scale = 1.0;
  int digits = 0;
};

// In the order of FaultKind.
constexpr std::array<FaultWords, kFaultKinds> kWords{{
    {"stall", "The engine stalled, from {} rpm.",
     "More throttle, and hold the clutch at the bite point; to stop, press it in time.", kRpm, 0},
    {"over_rev", "The engine was turned to {} rpm, above its red line.",
     "Lift the throttle, or shift up, before the red line.", kRpm, 0},
    {"lugging", "The engine laboured for {} s: too high a gear for that speed.",
     "Shift down before the engine labours.", 1.0, 1},
    {"clutch_dump", "The clutch came up too fast: it burnt {} kW.", "Let the clutch up slowly through the bite point.",
     1e-3, 1},
    {"clutch_early", "The clutch came up {} s before the gear was in.", "Let the clutch up only once the gear is in.",
     1.0, 2},
    {"clutch_late", "The lever moved {} s before the clutch was down.",
     "Press the clutch all the way down before the lever moves.", 1.0, 2},
    {"no_clutch", "The gear was changed without the clutch, {} rpm apart.",
     "Press the clutch for every change of gear.", kRpm, 0},
    {"riding_clutch", "The foot rested on the clutch for {} s.", "Take the foot off the clutch once the shift is done.",
     1.0, 1},
    {"riding_lever", "The hand leaned on the lever for {} s.", "Take the hand off the lever once the gear is in.", 1.0,
     1},
    {"throttle_in_shift", "The engine flared by {} rpm while the clutch was down.",
     "Lift the throttle before you press the clutch.", kRpm, 0},
    {"rev_mismatch", "Engine and gearbox were {} rpm apart when the clutch took hold.",
     "Bring the engine to the speed that the new gear needs before the clutch comes up.", kRpm, 0},
    {"grind", "The gear ground, {} J.", "Clutch all the way down, and wait a moment before reverse.", 1.0, 1},
    {"blocked", "The lever was pushed against the synchroniser for {} s.",
     "Choose a gear that fits the speed, and push steadily until it goes in.", 1.0, 2},
    {"missed_shift", "Gear {} was not reached.", "Push the lever all the way in, and only then let it go.", 1.0, 0},
    {"wrong_gear", "That was gear {}; another one was meant.", "Look where the gear lies before the hand moves.", 1.0,
     0},
    {"wrong_column", "The lever entered wrong slots: {}.", "Go by the middle, and let the springs guide the lever.",
     1.0, 0},
    {"over_push", "The lever was pushed with {} N.", "A light hand: wait until the gear goes in by itself.", 1.0, 0},
    {"step_order", "Steps of the shift out of order: {}.", "Off the throttle, clutch down, lever, clutch up, throttle.",
     1.0, 0},
    {"rollback", "The car rolled back {} m.", "Hold the car with the brake until the clutch holds it.", 1.0, 2},
    {"jerk", "The car jerked, {} m/s³.", "Let the clutch up more slowly where it takes hold.", 1.0, 0},
    {"early_shift", "Shifted at {} rpm: too early.", "Stay in the gear until the engine turns faster.", kRpm, 0},
    {"late_shift", "Shifted at {} rpm: too late.", "Shift up earlier.", kRpm, 0},
    {"too_slow", "The shift took {} s.", "Clutch, lever, clutch in one go.", 1.0, 1},
    {"wrong_direction", "That gear was chosen at {} km/h the other way.", "Stop before you change the direction.",
     kKmhPerMps, 0},
    {"slow_step", "A step took {} s: too long.", "Begin at once, and do it with all there is.", 1.0, 1},
    {"coasting", "The car rolled without drive for {} s: out of gear, or with the clutch down.",
     "Stay in gear with the clutch up until just before you stop.", 1.0, 1},
    {"early_downshift", "Shifted down too early: at that speed the gear asks for {} rpm.",
     "Slow down first, then shift down.", kRpm, 0},
    {"clutch_burn", "The clutch slipped until it had burnt {} kJ.",
     "Less throttle, and hold the clutch at the bite point only until the car rolls.", 1e-3, 1},
}};

constexpr std::array<std::string_view, 4> kSeverities{"note", "minor", "severe", "very_severe"};

const FaultWords& words_of(FaultKind kind) noexcept {
  return kWords[static_cast<std::size_t>(kind)];
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

std::string_view fault_advice(FaultKind kind) noexcept {
  return words_of(kind).advises;
}

std::string fault_sentence(const DriveFault& fault) {
  const FaultWords& words = words_of(fault.kind);
  if (!fault.step.empty())
    return fmt::format("\"{0}\" took {1:.{3}f} s; {2:.{3}f} s is wanted.", fault.step, fault.value, fault.wanted,
                       fault.wanted < kShortStep ? 2 : 1);
  const auto meant = static_cast<int>(fault.wanted);
  if (fault.kind == FaultKind::wrong_gear && meant != kNeutralGear)
    return fmt::format("Gear {} instead of {}.", gear_name(static_cast<int>(fault.value)), gear_name(meant));
  if (fault.kind == FaultKind::missed_shift || fault.kind == FaultKind::wrong_gear)
    return fmt::format(fmt::runtime(words.says), gear_name(static_cast<int>(fault.value)));
  return fmt::format(fmt::runtime(words.says), fmt::format("{:.{}f}", words.scale * fault.value, words.digits));
}

}  // namespace gearshift
