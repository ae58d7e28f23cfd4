#include "app/lessons/assessment/error_rules.h"

#include <array>
#include <cstddef>
#include <limits>

namespace gearshift::lessons {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRpm = 6.283185307179586 / 60.0;  // [rad/s]

// Columns: `kind`, `raise`, `clear`, `grave`, `severity`. Rows are in the order of ErrorKind. Engineering values still
// have to be checked with drives of the simulated driver.
constexpr std::array<ErrorRule, kErrorKindCount> kRules{{
    {ErrorKind::stall, 0.0, 0.0, kNever, Severity::severe},
    {ErrorKind::over_rev, 1.0, 0.98, 1.1, Severity::severe},      // relative to the red line; 1.1: engineering value
    {ErrorKind::lugging, 1.0, 0.0, 4.0, Severity::minor},         // engineering values
    {ErrorKind::clutch_dump, 12e3, 0.0, 50e3, Severity::severe},  // engineering values from measurements, see README.md
    // Engineering values; 0.03 s is two frames of pedal data.
    {ErrorKind::clutch_early, 0.03, 0.0, 0.3, Severity::minor},
    {ErrorKind::clutch_late, 0.05, 0.0, 0.3, Severity::minor},  // engineering values
    // 70 rpm is the widest window in which the BonusFFB project counts revs as matched.
    {ErrorKind::no_clutch, 70 * kRpm, 0.0, 1000 * kRpm, Severity::severe},
    {ErrorKind::riding_clutch, 2.0, 0.0, 10.0, Severity::minor},                    // engineering values
    {ErrorKind::riding_lever, 2.0, 0.0, 10.0, Severity::minor},                     // engineering values
    {ErrorKind::throttle_in_shift, 400 * kRpm, 0.0, 1500 * kRpm, Severity::minor},  // engineering values
    {ErrorKind::rev_mismatch, 300 * kRpm, 0.0, 1200 * kRpm, Severity::minor},       // engineering values
    {ErrorKind::grind, 0.5, 0.0, 30.0, Severity::minor},                            // engineering values
    // Engineering values. 1 s is a little longer than synchronising from second to first gear with 30 N at the knob,
    // which takes 0.84 s.
    {ErrorKind::blocked, 1.0, 0.0, 4.0, Severity::minor},
    {ErrorKind::missed_shift, -kNever, 0.0, kNever, Severity::minor},
    {ErrorKind::wrong_gear, -kNever, 0.0, kNever, Severity::minor},
    {ErrorKind::wrong_column, 1.0, 0.0, 3.0, Severity::minor},
    // 60 N and 50 N are the limits of HapticConfig at which an over-push begins and ends. 100 N is an engineering
    // value.
    {ErrorKind::over_push, 60.0, 50.0, 100.0, Severity::minor},
    {ErrorKind::step_order, 1.0, 0.0, 4.0, Severity::minor},
    {ErrorKind::rollback, 0.10, 0.0, 0.5, Severity::minor},           // engineering values
    {ErrorKind::jerk, 1.0, 0.0, 2.0, Severity::minor},                // relative to jerk_limit() in clutch_release.h
    {ErrorKind::early_shift, -kNever, 0.0, kNever, Severity::minor},  // ErrorDetector itself compares with the rev band
    {ErrorKind::late_shift, -kNever, 0.0, kNever, Severity::minor},   // ErrorDetector itself compares with the rev band
    {ErrorKind::too_slow, 2.5, 0.0, 6.0, Severity::minor},            // engineering values
    {ErrorKind::wrong_direction, 1.0, 0.0, 5.0, Severity::severe},    // engineering values
    {ErrorKind::slow_step, 1.0, 0.0, 2.0, Severity::minor},  // engineering values, relative to the allowed time
    {ErrorKind::coasting, 3.0, 0.0, 10.0, Severity::minor},  // engineering values; 3 s is three times a normal shift
    // Relative to max_downshift_speed() in error_detector.h; 1.5 is an engineering value.
    {ErrorKind::early_downshift, 1.0, 0.0, 1.5, Severity::minor},
    // Relative to burn_limit() in clutch_release.h; 2.0 is an engineering value.
    {ErrorKind::clutch_burn, 1.0, 0.0, 2.0, Severity::minor},
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
