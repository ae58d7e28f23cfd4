#include "app/lessons/assessment/error_rules.h"

#include <array>
#include <cstddef>
#include <limits>

namespace gearshift::lessons {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRpm = 6.283185307179586 / 60.0;  // [rad/s]

// Columns: kind, raise, clear, grave, severity; rows in the order of ErrorKind. "E" marks engineering values, which are
// to be checked against drives of the simulated driver.
constexpr std::array<ErrorRule, kErrorKindCount> kRules{{
    {ErrorKind::stall, 0.0, 0.0, kNever, Severity::severe},
    {ErrorKind::over_rev, 1.0, 0.98, 1.1, Severity::severe},      // fractions of the car's red line; 1.1: E
    {ErrorKind::lugging, 1.0, 0.0, 4.0, Severity::minor},         // E
    {ErrorKind::clutch_dump, 12e3, 0.0, 50e3, Severity::severe},  // E, from the measurements in README.md
    {ErrorKind::clutch_early, 0.03, 0.0, 0.3, Severity::minor},   // E; 0.03 s: two frames of pedal data
    {ErrorKind::clutch_late, 0.05, 0.0, 0.3, Severity::minor},    // E
    // 70 rpm is the widest window for matched revs in BonusFFB.
    {ErrorKind::no_clutch, 70 * kRpm, 0.0, 1000 * kRpm, Severity::severe},
    {ErrorKind::riding_clutch, 2.0, 0.0, 10.0, Severity::minor},                    // E
    {ErrorKind::riding_lever, 2.0, 0.0, 10.0, Severity::minor},                     // E
    {ErrorKind::throttle_in_shift, 400 * kRpm, 0.0, 1500 * kRpm, Severity::minor},  // E
    {ErrorKind::rev_mismatch, 300 * kRpm, 0.0, 1200 * kRpm, Severity::minor},       // E
    {ErrorKind::grind, 0.5, 0.0, 30.0, Severity::minor},                            // E
    {ErrorKind::blocked, 1.0, 0.0, 4.0, Severity::minor},  // E; a shift from 2 to 1 takes 0.84 s with 30 N at the knob
    {ErrorKind::missed_shift, -kNever, 0.0, kNever, Severity::minor},
    {ErrorKind::wrong_gear, -kNever, 0.0, kNever, Severity::minor},
    {ErrorKind::wrong_column, 1.0, 0.0, 3.0, Severity::minor},
    {ErrorKind::over_push, 60.0, 50.0, 100.0,
     Severity::minor},  // 60: the paper's alarm level; 50: as in HapticConfig; 100: E
    {ErrorKind::step_order, 1.0, 0.0, 4.0, Severity::minor},
    {ErrorKind::rollback, 0.10, 0.0, 0.5, Severity::minor},           // E
    {ErrorKind::jerk, 1.0, 0.0, 2.0, Severity::minor},                // fractions of jerk_limit(): see README.md
    {ErrorKind::early_shift, -kNever, 0.0, kNever, Severity::minor},  // engine speed below the lesson's band
    {ErrorKind::late_shift, -kNever, 0.0, kNever, Severity::minor},   // engine speed above the lesson's band
    {ErrorKind::too_slow, 2.5, 0.0, 6.0, Severity::minor},            // E
    {ErrorKind::wrong_direction, 1.0, 0.0, 5.0, Severity::severe},    // E
    {ErrorKind::slow_step, 1.0, 0.0, 2.0, Severity::minor},           // fractions of the step's allowed time: E
    {ErrorKind::coasting, 3.0, 0.0, 10.0, Severity::minor},           // E; 3 s: three times a normal shift
    // fractions of max_downshift_speed() in error_detector.h; 1.5: E
    {ErrorKind::early_downshift, 1.0, 0.0, 1.5, Severity::minor},
    {ErrorKind::clutch_burn, 1.0, 0.0, 2.0, Severity::minor},  // fractions of burn_limit() in clutch_release.h; 2: E
}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kRules.size(); ++i) {
    if (kRules[i].kind != static_cast<ErrorKind>(i)) return false;
  }
  return true;
}
static_assert(in_order());

}  // namespace

const ErrorRule& error_rule(ErrorKind kind) noexcept {
  return kRules[static_cast<std::size_t>(kind)];
}

Severity error_severity(ErrorKind kind, double value) noexcept {
  const ErrorRule& rule = error_rule(kind);
  if (value < rule.grave || rule.severity == Severity::very_severe) return rule.severity;
  return static_cast<Severity>(static_cast<int>(rule.severity) + 1);
}

}  // namespace gearshift::lessons
