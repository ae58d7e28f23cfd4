#include "app/training/fault_rules.h"

#include <array>
#include <cstddef>
#include <limits>

namespace gearshift {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRpm = 6.283185307179586 / 60.0;  // [rad/s]

// In the order of FaultKind. E: engineering value, to be judged against drives of the simulated learner.
// raise, clear, grave, severity.
constexpr std::array<FaultRule, kFaultKinds> kRules{{
    {FaultKind::stall, 0.0, 0.0, kNever, Severity::severe},
    {FaultKind::over_rev, 1.0, 0.98, 1.1, Severity::severe},      // shares of the car's red line; 10 % above: E
    {FaultKind::lugging, 1.0, 0.0, 4.0, Severity::minor},         // E
    {FaultKind::clutch_dump, 12e3, 0.0, 50e3, Severity::severe},  // E: as measured, see README.md
    {FaultKind::clutch_early, 0.03, 0.0, 0.3, Severity::minor},   // E: two frames of a pedal
    {FaultKind::clutch_late, 0.05, 0.0, 0.3, Severity::minor},    // E
    {FaultKind::no_clutch, 70 * kRpm, 0.0, 1000 * kRpm, Severity::severe},  // BonusFFB's widest window of matched revs
    {FaultKind::riding_clutch, 2.0, 0.0, 10.0, Severity::minor},            // E
    {FaultKind::riding_lever, 2.0, 0.0, 10.0, Severity::minor},             // E
    {FaultKind::throttle_in_shift, 400 * kRpm, 0.0, 1500 * kRpm, Severity::minor},  // E
    {FaultKind::rev_mismatch, 300 * kRpm, 0.0, 1200 * kRpm, Severity::minor},       // E
    {FaultKind::grind, 0.5, 0.0, 30.0, Severity::minor},                            // E
    {FaultKind::blocked, 1.0, 0.0, 4.0, Severity::minor},  // E; 2 to 1 with 30 N at the knob takes 0.84 s by the cone
    {FaultKind::missed_shift, -kNever, 0.0, kNever, Severity::minor},
    {FaultKind::wrong_gear, -kNever, 0.0, kNever, Severity::minor},
    {FaultKind::wrong_column, 1.0, 0.0, 3.0, Severity::minor},
    {FaultKind::over_push, 60.0, 50.0, 100.0,
     Severity::minor},  // the paper's alarm, cleared as by HapticConfig; 100: E
    {FaultKind::step_order, 1.0, 0.0, 4.0, Severity::minor},
    {FaultKind::rollback, 0.10, 0.0, 0.5, Severity::minor},           // E
    {FaultKind::jerk, 1.0, 0.0, 2.0, Severity::minor},                // shares of jerk_limit: see README.md
    {FaultKind::early_shift, -kNever, 0.0, kNever, Severity::minor},  // below the lesson's band
    {FaultKind::late_shift, -kNever, 0.0, kNever, Severity::minor},   // above it
    {FaultKind::too_slow, 2.5, 0.0, 6.0, Severity::minor},            // E
    {FaultKind::wrong_direction, 1.0, 0.0, 5.0, Severity::severe},    // E
    {FaultKind::slow_step, 1.0, 0.0, 2.0, Severity::minor},           // shares of the step's time: E
    {FaultKind::coasting, 3.0, 0.0, 10.0, Severity::minor},           // E: three times a usual shift
    {FaultKind::early_downshift, 1.0, 0.0, 1.5, Severity::minor},     // shares of what suits: fault_watch.h; 1.5: E
    {FaultKind::clutch_burn, 1.0, 0.0, 2.0, Severity::minor},         // shares of burn_limit: clutch_release.h; 2: E
}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kRules.size(); ++i) {
    if (kRules[i].kind != static_cast<FaultKind>(i)) return false;
  }
  return true;
}
static_assert(in_order());

}  // namespace

const FaultRule& fault_rule(FaultKind kind) noexcept {
  return kRules[static_cast<std::size_t>(kind)];
}

Severity fault_severity(FaultKind kind, double value) noexcept {
  const FaultRule& rule = fault_rule(kind);
  if (value < rule.grave || rule.severity == Severity::very_severe) return rule.severity;
  return static_cast<Severity>(static_cast<int>(rule.severity) + 1);
}

}  // namespace gearshift
