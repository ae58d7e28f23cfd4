// Calibration measurements without a hand on the lever.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include <glm/matrix.hpp>

#include "haptics/files/number_text.h"
#include "haptics/hardware/calibrator.h"
#include "haptics/hardware/pid_lever.h"

namespace gearshift::haptics {
namespace {

constexpr double kMoved = 0.02, kMinMoved = 0.01;  // [1] fraction of the axis's range
constexpr std::int64_t kPushTime = 250'000'000;    // [ns] longest push
constexpr std::int64_t kStyleTime = 250'000'000;   // [ns] for the effects' settings to be sent
constexpr double kBand = 0.2, kBandOffset = 0.12;  // [1] dead band and centre, fractions of the full deflection
constexpr std::int64_t kLeakTime = 400'000'000;    // [ns] inside the dead band
constexpr double kMinBandRatio = 0.5, kMaxBandRatio = 2.0, kMaxBandSkew = 0.2;  // [1] measured over commanded
constexpr double kSpringOffset = 0.25;                                          // [1] fraction of the full deflection
constexpr double kLoadForce = 0.05, kLoadFrequency = 5.0;                       // [1] fraction of the full force; [Hz]
constexpr double kLoadDither = 0.01;  // [1] added with alternating sign, so that the force changes in every tick
constexpr std::int64_t kLoadTime = 2'100'000'000, kLoadStart = 100'000'000;  // [ns] total time; initial part, ignored
constexpr std::size_t kMinReadings = 50;
constexpr double kPulseForce = 0.05, kMaxPulseForce = 0.4;  // [1] fraction of the full force
constexpr double kDampedPulseForce = 0.2;                   // [1] replaces kPulseForce if the damper is strong
constexpr std::int64_t kPulseTime = 60'000'000, kCoastTime = 400'000'000, kNoForceTime = 1'000'000'000;  // [ns]
constexpr std::int64_t kSettingTime = 20'000'000;              // [ns] time for the damper setting to reach the stick
constexpr double kPulseMotion = 0.06, kMinPulseMotion = 0.03;  // [1] fraction of the axis's range
constexpr double kMaxResidual = 0.2;                           // [1]
// Two fits agree if each parameter differs by no more than its relative or its absolute limit.
constexpr double kMaxDifference = 0.25;                                     // [1] relative
constexpr double kMaxDampingDifference = 2.0, kMaxDelayDifference = 0.002;  // [1/s], [s] absolute
constexpr std::size_t kMaxPairs = 5;
constexpr double kMaxMeasuredDelay = 0.1;  // [s]
constexpr double kMaxBalanceForce = 0.4;   // [1] fraction of the full force; largest push against a spring
constexpr double kMinBalance = 0.01;       // [1] fraction of the axis's range
constexpr double kDamper = 0.5;            // [1] damper coefficient in the measurement, fraction of the maximum
// [1] largest plausible force of the handle's own spring at a stop, as a fraction of the full force. A stronger spring
// means that a hand is on the lever.
constexpr double kMaxHandleSpringForce = 0.3;
constexpr double kMinOwnSpringForce = 0.05;  // [1] weaker springs at a stop are assumed to be mechanical
constexpr double kMinFriction = 0.02;        // [N] less is not reported
constexpr double kMinOwnFraction = 0.25;     // [1] of the handle's stiffness
constexpr std::int64_t kReturnTime = 60'000'000, kPushedTime = 50'000'000, kPeakTime = 100'000'000;  // [ns]
constexpr std::int64_t kOffTime = 100'000'000;  // [ns] for all effects to be stopped
constexpr double kMinGap = 0.0003;              // [s] shorter gaps are within the noise
constexpr double kMinBraking = 0.3;             // [N s/m] smallest damping whose sign can be determined

constexpr int kBesidePushes = 5;
constexpr double kOften = 0.02, kOftenOutputs = 12.0;  // [s]; [1] output intervals: of renewals
constexpr double kBeside = 0.8;  // [1] least distance pushed beside more effects, over that beside fewer
constexpr double kWeak = 0.01, kWeakBand = 0.5;     // [1] of springs and dampers that only have to play
constexpr int kCrossTalkTries = 3;                  // of dampers, because one touch or a late cycle refuses nothing
constexpr double kMaxCrossTalk = 0.12;              // [1]
constexpr double kMaxCoupling = 0.6;                // [1] stronger cross-talk would leave little force if cancelled
constexpr std::array kLevels{0.05, 0.2, 0.6, 1.0};  // [1] magnitudes of constant forces that are compared
constexpr std::array kLowerLevels{0.5, 0.4, 0.3};   // [1] tried if the force at 60 % is wrong
constexpr double kEven = 0.15;                      // [1] largest difference of the force per magnitude
constexpr double kSameGain = 0.04;           // [1] difference of two pushes over their sum, if a third is not needed
constexpr double kDoublePushMotion = 0.10;   // [1] of a push and a push back, fraction of the axis's range
constexpr std::size_t kDoublePushSteps = 3;  // there, back, and off; fewer were seen if the thread was late
constexpr double kMinPushTime = 0.006, kMaxPushTime = 0.04;  // [s]
constexpr std::int64_t kDoubleCoastTime = 200'000'000;       // [ns]

constexpr std::array kNames{"select", "shift"};

// The result of a fit to the motion of this axis. Throws CalibrationRefused if it cannot be fitted.
auto fitted(const std::string& name, const auto& fit) {
  try {
    return fit();
  } catch (const std::invalid_argument& error) {
    throw CalibrationRefused(name + " cannot be measured, because " + error.what());
  }
}

class OneSided : public EffectsRefused {
  using EffectsRefused::EffectsRefused;
};
class NoMotion : public EffectsRefused {
  using EffectsRefused::EffectsRefused;
};

// [s] often enough to show a gap, and seldom enough to leave the force three of four outputs
double restart_interval(const DeviceTiming& timing) noexcept {
  return std::max(0.004, 4.0 * timing.output_interval);
}

std::string newtons_per_metre(double stiffness) {
  return number_text(stiffness, 0) + " N/m";
}

bool fits_agree(const PulseFit& a, const PulseFit& b) noexcept {
  if (std::max(a.residual, b.residual) > kMaxResidual) return false;
  const auto within = [](double x, double y, double min_difference) {
    return std::abs(x - y) <= std::max(min_difference, kMaxDifference * std::max(std::abs(x), std::abs(y)));
  };
  return within(a.gain, b.gain, 0.0) && within(a.damping, b.damping, kMaxDampingDifference) &&
         within(a.delay, b.delay, kMaxDelayDifference);
}

double quantile(std::vector<double>& values, double q) {
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

void Calibrator::require_range() const {
  if (!calibration_.has_stops())
    throw CalibrationRefused("the lever's stops are not known yet. Measure the range first");
}

void Calibrator::require_polarity() const {
  require_range();
  if (!calibration_.has_polarity())
    throw CalibrationRefused("the force direction is not known yet. Measure the force direction first");
}

Calibrator::AxisPlace Calibrator::axis_place(const LeverAxisCalibration& axis) const {
  if (axis.usage > kUsageY.id)
    throw CalibrationRefused("the lever moves an axis without a motor; only X and Y have motors");
  return {report_axis(axis.usage), axis.usage == kUsageY.id ? std::size_t{1} : std::size_t{0},
          axis.high > axis.low ? 1.0 : -1.0};
}

// Switches the motors on, without a force.
StickCommand Calibrator::idle_command() const {
  StickCommand command;
  command.enabled = true;
  command.holds_spring = calibration_.holds_spring;
  if (calibration_.select_by_position) command.pushes[places()[0].motor] = false;
  return command;
}

std::span<const std::size_t> Calibrator::motors() const noexcept {
  static constexpr std::array<std::size_t, 2> kBoth{0, 1};
  return std::span(kBoth).subspan(calibration_.select_by_position ? 1 : 0);
}

// A command with which only one constant force plays.
StickCommand Calibrator::only(std::size_t motor) const {
  StickCommand command = idle_command();
  command.pushes[1 - motor] = false;
  return command;
}

// A command with which a spring or a damper plays, too, but hardly makes a force.
StickCommand Calibrator::with_weak(bool spring, bool damper) const {
  StickCommand command = idle_command();
  if (spring) command.spring.fill({0.0, kWeakBand, kWeak, kWeak});
  if (damper) command.damper.fill(kWeak);
  return command;
}

// Sends the effects' settings again, if the style differs, and waits until the stick reports that its motors are off
// afterwards. Some sticks report no state, so the wait ends after kStyleTime. The motors stay off.
void Calibrator::apply(StickStyle style) {
  driver_.set_style(style);
  StickRig rig(driver_, tick_);
  const std::int64_t begin = rig.step().now_ns;
  const auto is_set = [&](const StickState& state) { return state.style == style && state.off_ns > state.style_ns; };
  while (!is_set(rig.step().state) && rig.latest().now_ns - begin < kStyleTime) continue;
}

std::string Calibrator::measure_polarity() {
  require_range();
  calibration_.select_by_position = false;
  const Signs found = constant_signs();
  calibration_.style = found.style;
  calibration_.select_by_position = !found.only_shift.empty();
  calibration_.select.constant_sign = calibration_.select_by_position ? 0 : found.sign[0];
  calibration_.shift.constant_sign = found.sign[1];
  calibration_.select.constant_coupling = calibration_.select_by_position ? 0.0 : found.coupling[0];
  calibration_.shift.constant_coupling = calibration_.select_by_position ? 0.0 : found.coupling[1];
  calibration_.select.constant_cross_talk = found.cross_talk[0];
  calibration_.shift.constant_cross_talk = found.cross_talk[1];
  calibration_.effects_at_once = calibration_.select_by_position ? 1 : std::max(calibration_.effects_at_once, 2);
  const std::string shift =
      std::string("in shift, a positive force pushes ") + (found.sign[1] > 0 ? "forward" : "back");
  if (calibration_.select_by_position)
    return shift + "; " + found.only_shift +
           ", so only forces along shift are used: walls of select are not felt, and the position chooses the slot";
  const auto percent = [](double fraction) { return number_text(100.0 * std::abs(fraction), 0) + " %"; };
  const std::string cancelled = found.coupling == std::array{0.0, 0.0}
                                    ? ""
                                    : "; each force also acts along the other axis, with " +
                                          percent(found.coupling[0]) + " and " + percent(found.coupling[1]) +
                                          " of its strength, which is cancelled, but " + percent(found.cross_talk[0]) +
                                          " and " + percent(found.cross_talk[1]) + " remain";
  return std::string("in select, a positive force pushes ") + (found.sign[0] > 0 ? "right" : "left") + "; " + shift +
         cancelled;
}

// Tries each way of naming an axis until the constant forces move the right axes, alone and together. If a force does
// not change its sign, the sign is tried as a direction, too.
Calibrator::Signs Calibrator::constant_signs() {
  std::string reason;
  bool keeps_sign = false, moves = true;
  std::optional<Signs> shift_only, coupled;
  for (const SignStyle signs : {SignStyle::magnitude, SignStyle::direction}) {
    if (signs == SignStyle::direction && (!keeps_sign || !driver_.layout().set_effect.direction[0].exists())) break;
    for (const AxisStyle style : {AxisStyle::direction, AxisStyle::both, AxisStyle::bits}) {
      try {
        Signs found = constant_signs_by({style, calibration_.style.conditions, signs});
        if (!found.only_shift.empty()) {
          if (!shift_only) shift_only = found;
        } else if (found.coupling == std::array{0.0, 0.0}) {
          return found;
        } else if (!coupled) {
          coupled = found;
        }
      } catch (const EffectsRefused& refused) {
        keeps_sign = keeps_sign || dynamic_cast<const OneSided*>(&refused) != nullptr;
        if (reason.empty()) moves = dynamic_cast<const NoMotion*>(&refused) == nullptr;
        if (reason.empty()) reason = refused.what();
      }
    }
  }
  for (const std::optional<Signs>& second_best : {coupled, shift_only}) {
    if (!second_best) continue;
    apply(second_best->style);
    return *second_best;
  }
  if (!moves && keeps_forces())
    reason = "the stick does not change a force while it acts, and a lever needs forces that change";
  driver_.set_style(calibration_.style);
  throw CalibrationRefused(reason);
}

Calibrator::Signs Calibrator::constant_signs_by(StickStyle style) {
  apply(style);
  StickRig rig(driver_, tick_);
  Signs found;
  found.style = style;
  for (std::size_t i = 0; i < 2; ++i) found.sign[i] = constant_sign(rig, i, found);
  if (found.sign[0] == 0 && found.sign[1] == 0)
    throw NoMotion("the lever does not move with " + number_text(100.0 * kCautiousForce, 0) +
                   " % of the full force. Check that the stick has power and can move freely");
  if (found.sign[1] == 0)
    throw EffectsRefused(
        "the stick has a motor for select, but none for shift, and a lever needs one there. Calibrate it again with "
        "--again, and when you are asked to push forward, move the axis that has the motor");
  cancel_cross_talk(rig, found);
  for (std::size_t i = 0; i < 2; ++i) check_cross_talk("force", i, found.cross_talk[i]);
  if (found.sign[0] == 0)
    found.only_shift = "the stick has a motor for shift, but none for select";
  else if (!acts_beside(rig, places()[0], only(places()[0].motor), idle_command()) ||
           !acts_beside(rig, places()[1], only(places()[1].motor), idle_command()))
    found.only_shift = "the stick renders one force at a time";
  return found;
}

// True if a constant force of zero pushes the lever, because it keeps the strength that it was set with.
bool Calibrator::keeps_forces() {
  StickRig rig(driver_, tick_);
  for (const AxisPlace& place : places()) {
    StickCommand zero = idle_command();
    zero.pushes[1 - place.motor] = false;
    const double off = rig.rest(place.report), on = rig.rest(place.report, zero);
    if (std::abs(on - off) > kMinMoved * rig.range(place.report)) return true;
  }
  return false;
}

// Finds the sign of the only constant force that plays; 0 if the axis does not move. Pushes the lever in both
// directions, with the smallest of three forces that moves it.
int Calibrator::constant_sign(StickRig& rig, std::size_t axis, Signs& found) const {
  const AxisPlace place = places()[axis];
  StickCommand idle = idle_command();
  idle.pushes[1 - place.motor] = false;
  for (const double magnitude : {0.25 * kCautiousForce, 0.5 * kCautiousForce, kCautiousForce}) {
    StickCommand command = idle;
    command.constant[place.motor] = magnitude;
    const Motion there = push(rig, place, idle, command);
    if (std::abs(there.moved) < kMinMoved) continue;
    command.constant[place.motor] = -magnitude;
    const Motion back = push(rig, place, idle, command);
    if (std::abs(back.moved) < kMinMoved || (there.moved > 0.0) == (back.moved > 0.0))
      throw OneSided(std::string(kNames[axis]) + " did not move in both directions. Take your hands off the lever");
    found.magnitude = std::max(found.magnitude, magnitude);
    found.cross_talk[axis] = cross_talk(there, back);
    found.coupling[axis] = coupling(axis, there, back);
    return there.moved > 0.0 ? 1 : -1;
  }
  return 0;
}

// If a force also moves the other axis, tries whether forces along both axes can move one only. The axes are assumed to be
// equally heavy until the handle is measured.
void Calibrator::cancel_cross_talk(StickRig& rig, Signs& found) const {
  const double strongest = std::max(found.cross_talk[0], found.cross_talk[1]);
  if (found.sign[0] == 0 || found.sign[1] == 0 || strongest <= kMaxCrossTalk || strongest > kMaxCoupling) {
    found.coupling = {};
    return;
  }
  const std::array<AxisPlace, 2> place = places();
  const glm::dmat2 coupled(1.0, found.coupling[0], found.coupling[1], 1.0), inverse = glm::inverse(coupled);
  const double magnitude = std::min(found.magnitude, kCautiousForce * glm::determinant(coupled));
  for (std::size_t i = 0; i < 2; ++i) {
    const auto pushed = [&](double direction) {
      StickCommand command = idle_command();
      for (std::size_t j = 0; j < 2; ++j)
        command.constant[place[j].motor] =
            direction * magnitude * found.sign[j] * inverse[static_cast<int>(i)][static_cast<int>(j)];
      return push(rig, place[i], idle_command(), command);
    };
    const Motion there = pushed(1.0), back = pushed(-1.0);
    if (std::abs(there.moved - back.moved) > kMinMoved) found.cross_talk[i] = cross_talk(there, back);
  }
}

// With sign, and in metres.
double Calibrator::coupling(std::size_t axis, const Motion& there, const Motion& back) const {
  const auto travel = [&](std::size_t i) {
    const LeverAxisCalibration& one = axis_of(i);
    const BitField& field = driver_.lever_report().axes[axis_place(one).report].field;
    return one.travel * static_cast<double>(field.max - field.min) / std::abs(one.high - one.low);
  };
  const double ratio = places()[1 - axis].sign * (there.other - back.other) / (there.moved - back.moved);
  return calibration_.has_travel() ? ratio * travel(1 - axis) / travel(axis) : ratio;
}

// True if a force acts as well beside more effects as beside fewer. A stick that plays only some of its effects stops
// one at each renewal of another. So all effects are started one after the other and renewed often, so that the first is
// stopped soon after each renewal; before the stick's timing is known, the weakest push of several at different times
// after a renewal is taken. One touch refuses nothing.
bool Calibrator::acts_beside(StickRig& rig, const AxisPlace& axis, const StickCommand& fewer,
                             const StickCommand& more) const {
  const DeviceTiming& timing = calibration_.timing;
  const double interval = calibration_.has_timing() ? std::max(kOften, kOftenOutputs * timing.output_interval) : 0.0;
  const auto weakest = [&](StickCommand beside, int pushes) {
    beside.restart_interval = interval;
    double least = std::numeric_limits<double>::infinity();
    for (const std::int64_t now = rig.latest().now_ns; rig.latest().now_ns < now + kOffTime;) rig.step();
    for (int i = 0; i < pushes; ++i) {
      const std::int64_t wait = static_cast<std::int64_t>(1e9 * kRenewAfter) * i / pushes;
      for (const std::int64_t now = rig.latest().now_ns; rig.latest().now_ns < now + wait;) rig.step(beside);
      least = std::min(least, distance_pushed(rig, axis, beside).moved);
    }
    return least;
  };
  const int pushes = interval > 0.0 ? 2 : kBesidePushes;
  const double alone = weakest(fewer, 2);
  return weakest(more, pushes) >= kBeside * alone || weakest(more, pushes) >= kBeside * alone;
}

void Calibrator::check_cross_talk(const char* effect, std::size_t axis, double cross_talk) {
  if (cross_talk > kMaxCrossTalk)
    throw EffectsRefused(std::string("a ") + effect + " along " + kNames[axis] + " also acts along " +
                         kNames[1 - axis] + ", with " + number_text(100.0 * cross_talk, 0) + " % of its strength");
}

// The motion of the other axis over that of the pushed one, from pushes in both directions, so that a slow drift cancels
// out.
double Calibrator::cross_talk(const Motion& there, const Motion& back) noexcept {
  return std::abs((there.other - back.other) / (there.moved - back.moved));
}

// Applies the command to the lever at rest. The motion is positive to the right or forward.
Calibrator::Motion Calibrator::push(StickRig& rig, const AxisPlace& place, const StickCommand& idle,
                                    const StickCommand& command) const {
  const std::size_t other = report_axis(place.motor == 0 ? kUsageY.id : kUsageX.id);
  const double from = rig.rest(place.report, idle, other), other_from = rig.position(other);
  const std::int64_t begin = rig.latest().now_ns;
  double moved = 0.0, other_moved = 0.0;
  while (std::abs(moved) < kMoved && rig.latest().now_ns - begin < kPushTime) {
    rig.step(command);
    moved = (rig.position(place.report) - from) / rig.range(place.report);
    other_moved = (rig.position(other) - other_from) / rig.range(other);
    if (std::abs(other_moved) > kMoved) {
      rig.step(idle);
      if (std::abs(moved) < kMinMoved) return {};  // it moves the other axis instead
      throw EffectsRefused("a force along one axis also moves the other axis");
    }
  }
  rig.step(idle);
  return {moved * place.sign, other_moved};
}

std::string Calibrator::measure_timing() {
  require_polarity();
  StickRig rig(driver_, tick_);
  DeviceTiming timing = measure_intervals(rig);
  for (const std::size_t i : motors()) {
    known_[i] = fit(rig, axis_of(i), kNames[i]);
    timing.delay = std::max({timing.delay, known_[i]->delay, 0.0});
  }
  timing.restart_gap = restart_gap(rig, timing);
  calibration_.timing = timing;
  return "a reading every " + number_text(1e3 * timing.input_interval, 2) + " ms (jitter " +
         number_text(1e3 * timing.jitter, 2) + " ms), a force every " + number_text(1e3 * timing.output_interval, 2) +
         " ms, delay " + number_text(1e3 * timing.delay, 2) + " ms; the stick responds after " +
         number_text(1e3 * answer_time(timing), 1) + " ms" +
         (timing.restart_gap == 0.0
              ? ""
              : "; each renewal interrupts a force for " + number_text(1e3 * timing.restart_gap, 1) +
                    " ms, which makes forces weaker by " + number_text(100.0 * timing.restart_gap / kRenewAfter, 0) +
                    " %");
}

// Compares how far a force pushes the lever with and without frequent renewals.
double Calibrator::restart_gap(StickRig& rig, const DeviceTiming& timing) const {
  const AxisPlace place = axis_place(axis_of(motors().front()));
  const double interval = restart_interval(timing);
  StickCommand beside = only(place.motor);
  const double steady = distance_pushed(rig, place, beside).moved;
  beside.restart_interval = interval;
  const double restarted = distance_pushed(rig, place, beside).moved;
  const double gap = steady > 0.0 ? (1.0 - restarted / steady) * interval : 0.0;
  return gap < kMinGap ? 0.0 : std::min(gap, kRenewAfter);
}

// How far a small force of kPushedTime pushes the lever, and the other axis, beside the effects of another command;
// `before`: a command that is sent first.
Calibrator::Motion Calibrator::distance_pushed(StickRig& rig, const AxisPlace& place, StickCommand command,
                                               const StickCommand* before) const {
  const std::size_t other = report_axis(place.motor == 0 ? kUsageY.id : kUsageX.id);
  StickCommand undamped = command;
  const bool is_damped = std::max(std::abs(command.damper[0]), std::abs(command.damper[1])) > kWeak;
  if (is_damped) undamped.damper = {};  // under a damper, it would take seconds to come to rest
  const double from = rig.rest(place.report, undamped, other), other_from = rig.position(other);
  for (const StickCommand* setting : {before, static_cast<const StickCommand*>(&command)}) {
    const std::int64_t now = rig.latest().now_ns;
    while (setting != nullptr && rig.latest().now_ns < now + kSettingTime) rig.step(*setting);
  }
  const std::int64_t begin = rig.latest().now_ns;
  Motion farthest;  // at the peak, because readings may be rare; of the other axis, the last
  for (std::int64_t time = 0; time < kPushedTime + kPeakTime; time = rig.latest().now_ns - begin) {
    command.constant[place.motor] = time < kPushedTime ? 0.5 * kCautiousForce : 0.0;
    rig.step(command);
    farthest.moved = std::max(farthest.moved, std::abs(rig.position(place.report) - from) / rig.range(place.report));
    farthest.other = (rig.position(other) - other_from) / rig.range(other);
    rig.watch_runaway(place.report, from);
  }
  return farthest;
}

// Measures how often the stick sends readings and accepts forces. Meanwhile, moves the lever and changes the forces of
// both axes in every tick, because an idle stick would transfer reports faster.
DeviceTiming Calibrator::measure_intervals(StickRig& rig) const {
  const AxisPlace select = axis_place(calibration_.select), shift = axis_place(calibration_.shift);
  const double from_x = rig.rest(select.report, idle_command()), from_y = rig.rest(shift.report, idle_command());
  const std::int64_t begin = rig.latest().now_ns;
  StickRig::Tick first = rig.latest(), last = first;
  std::vector<double> intervals;
  double dither = kLoadDither;
  while (last.now_ns - begin < kLoadTime) {
    if (last.now_ns - begin < kLoadStart) first = last;
    const double phase = 2e-9 * std::numbers::pi * kLoadFrequency * static_cast<double>(last.now_ns - begin);
    dither = -dither;
    StickCommand command = idle_command();
    command.constant = {kLoadForce * std::cos(phase) + dither, kLoadForce * std::sin(phase) + dither};
    const StickRig::Tick now = rig.step(command);
    const std::uint64_t readings = now.state.sequence - last.state.sequence;
    if (readings > 0 && last.state.time_ns > 0)
      intervals.push_back(1e-9 * static_cast<double>(now.state.time_ns - last.state.time_ns) /
                          static_cast<double>(readings));
    last = now;
    rig.watch_runaway(select.report, from_x);
    rig.watch_runaway(shift.report, from_y);
  }
  const std::uint64_t outputs = last.state.outputs - first.state.outputs;
  if (intervals.size() < kMinReadings) throw CalibrationRefused("the stick sends its position too rarely");
  if (outputs < kMinReadings) throw CalibrationRefused("the stick accepts forces too rarely");
  DeviceTiming timing;
  timing.input_interval = quantile(intervals, 0.5);
  timing.jitter = std::max(0.0, quantile(intervals, 0.99) - timing.input_interval);
  timing.output_interval =
      1e-9 * static_cast<double>(last.state.sent_ns - first.state.sent_ns) / static_cast<double>(outputs);
  return timing;
}

// Measures the response to one pulse, which adds the force `magnitude` to the command `rest`. The lever first comes to
// rest under the idle command, because under a damper that would take seconds.
Pulse Calibrator::pulse(StickRig& rig, const AxisPlace& place, const StickCommand& rest, double magnitude) const {
  const double from = rig.rest(place.report, idle_command());
  for (const std::int64_t now = rig.latest().now_ns; rig.latest().now_ns < now + kSettingTime;) rig.step(rest);
  const std::int64_t begin = rig.latest().now_ns;
  StickCommand on = rest;
  on.constant[place.motor] = magnitude;
  on.push_time = 1e-9 * kPulseTime;
  Pulse measured;
  std::int64_t on_ns = 0, off_ns = 0;
  bool pushing = true;
  while (off_ns == 0 || rig.latest().now_ns - off_ns < kCoastTime) {
    const StickRig::Tick& tick = rig.step(pushing ? on : rest);
    const bool pushed = tick.state.sent[place.motor] != 0.0;
    if (pushed && on_ns == 0) on_ns = tick.state.sent_ns;
    if (!pushed && on_ns != 0 && off_ns == 0) off_ns = tick.state.sent_ns;
    const double moved = rig.position(place.report) - from;
    if (on_ns != 0 && tick.fresh)
      measured.samples.push_back({1e-9 * static_cast<double>(tick.state.time_ns - on_ns), moved});
    const bool has_moved_enough = std::abs(moved) > kPulseMotion * rig.range(place.report);
    pushing = pushing && !has_moved_enough && tick.now_ns - begin < kPulseTime;
    rig.watch_runaway(place.report, from);
    if (off_ns == 0 && tick.now_ns - begin > kNoForceTime) throw CalibrationRefused("the stick accepts no forces");
  }
  measured.steps = {{0.0, magnitude}, {1e-9 * static_cast<double>(off_ns - on_ns), 0.0}};
  return measured;
}

// Measures one pulse in each direction. Doubles `magnitude` until the lever moves far enough.
std::array<Pulse, 2> Calibrator::pulses(StickRig& rig, const AxisPlace& place, const StickCommand& rest,
                                        double& magnitude) const {
  while (true) {
    std::array<Pulse, 2> pair = {pulse(rig, place, rest, magnitude), pulse(rig, place, rest, -magnitude)};
    double farthest = 0.0;
    for (const PulseSample& sample : pair.front().samples) farthest = std::max(farthest, std::abs(sample.position));
    if (farthest > kMinPulseMotion * rig.range(place.report) || magnitude >= kMaxPulseForce) return pair;
    magnitude *= 2.0;
  }
}

// Fits the lever's dynamics, in counts, under a device damper of coefficient `damper`. Pairs of pulses are measured
// until two pairs agree, because a nudge or a late cycle can spoil a single pair.
PulseFit Calibrator::fit(StickRig& rig, const LeverAxisCalibration& axis, const std::string& name,
                         double damper) const {
  const AxisPlace place = axis_place(axis);
  StickCommand rest = idle_command();
  rest.damper[place.motor] = damper;
  double magnitude = std::abs(damper) > kCautiousForce ? kDampedPulseForce : kPulseForce;
  std::vector<std::array<Pulse, 2>> pairs;
  std::vector<PulseFit> fits;
  while (fits.size() < kMaxPairs) {
    pairs.push_back(pulses(rig, place, rest, magnitude));
    rig.step();  // switches the motors off, because a command would expire during the fit
    fits.push_back(fitted(name, [&] { return fit_pulses(pairs.back()); }));
    for (std::size_t i = 0; i + 1 < fits.size(); ++i) {
      if (!fits_agree(fits[i], fits.back())) continue;
      const Pulse four[] = {pairs[i][0], pairs[i][1], pairs.back()[0], pairs.back()[1]};
      return validated(fitted(name, [&] { return fit_pulses(four); }), axis, name);
    }
  }
  validated(fits.back(), axis, name);
  throw CalibrationRefused(name + " responds differently to each push. Take your hands off the lever");
}

PulseFit Calibrator::validated(const PulseFit& found, const LeverAxisCalibration& axis, const std::string& name) {
  if (found.residual > kMaxResidual)
    throw CalibrationRefused(name + " does not respond to a push like a damped mass. Take your hands off the lever");
  if (found.gain * axis.constant_sign * (axis.high - axis.low) < 0.0)
    throw CalibrationRefused(name + " moves against the measured force direction. Measure the force direction again");
  if (found.delay > kMaxMeasuredDelay)
    throw CalibrationRefused(name + " responds to a push after " + number_text(1e3 * found.delay, 0) +
                             " ms, which is too late for force feedback");
  return found;
}

std::string Calibrator::measure_strength() {
  require_polarity();
  StickRig rig(driver_, tick_);
  std::array<Strength, 2> found;
  for (const std::size_t i : motors()) found[i] = strength(rig, i);
  std::string sentence;
  for (const std::size_t i : motors()) {
    axis_of(i).constant_limit = found[i].limit;
    axis_of(i).constant_slope = found[i].slope;
    sentence +=
        (sentence.empty() ? "in " : "; in ") + std::string(kNames[i]) + ", magnitudes of 5, 20, 60 and 100 % give ";
    for (std::size_t level = 0; level < kLevels.size(); ++level)
      sentence += (level == 0                   ? ""
                   : level + 1 < kLevels.size() ? ", "
                                                : " and ") +
                  number_text(100.0 * found[i].measured[level], 0);
    sentence += " % of the full force";
    if (found[i].limit < 1.0)
      sentence += ", so only magnitudes up to " + number_text(100.0 * found[i].limit, 0) +
                  " % are used, and no force exceeds " + number_text(100.0 * found[i].limit * found[i].slope, 0) +
                  " % of the full one";
  }
  return sentence;
}

// The largest magnitude up to which the force is even, and the force there.
Calibrator::Strength Calibrator::strength(StickRig& rig, std::size_t axis) {
  if (!known_[axis]) known_[axis] = fit(rig, axis_of(axis), kNames[axis]);
  std::array<double, kLevels.size()> gain{};
  for (std::size_t i = 0; i < gain.size(); ++i) gain[i] = gain_at(rig, axis, kLevels[i]);
  const double weak = gain[1], full = gain.back();
  const auto is_even = [&](double found) { return std::abs(found / weak - 1.0) < kEven; };
  Strength found;
  for (std::size_t i = 0; i < gain.size(); ++i) found.measured[i] = kLevels[i] * gain[i] / full;
  if (is_even(gain[2]) && is_even(full)) return found;
  found.slope = weak / full;
  found.limit = is_even(gain[2]) ? kLevels[2] : kLevels[1];
  for (std::size_t i = 0; found.limit == kLevels[1] && i < kLowerLevels.size(); ++i)
    if (is_even(gain_at(rig, axis, kLowerLevels[i]))) found.limit = kLowerLevels[i];
  return found;
}

// Acceleration per magnitude [counts/s^2] at this magnitude, the mean of both directions. As the pushes are short, a late
// report spoils one; so they are repeated until the medians of the two directions agree.
double Calibrator::gain_at(StickRig& rig, std::size_t axis, double magnitude) {
  std::array<std::vector<double>, 2> gains;
  for (std::size_t tries = 0; tries < kMaxPairs; ++tries) {
    for (std::size_t i = 0; i < 2; ++i) {
      Pulse pushed = double_push(rig, axis, i == 0 ? magnitude : -magnitude);
      for (std::size_t late = 0; late < kMaxPairs && pushed.steps.size() < kDoublePushSteps; ++late)
        pushed = double_push(rig, axis, i == 0 ? magnitude : -magnitude);
      rig.step();  // switches the motors off, because a command would expire during the fit
      gains[i].push_back(fitted(kNames[axis], [&] { return gain_of(pushed, *known_[axis]); }));
    }
    const double there = quantile(gains[0], 0.5), back = quantile(gains[1], 0.5);
    const double tolerance = tries == 0 ? kSameGain : kEven;
    if (tries != 1 && std::abs(there - back) < tolerance * std::abs(there + back)) return 0.5 * (there + back);
  }
  throw CalibrationRefused(std::string(kNames[axis]) +
                           " is not pushed equally far in both directions. Take your hands off the lever");
}

// A push and a push back of the same length, so that the lever comes to rest soon. The length is chosen by the motion
// that is expected of a force in proportion.
Pulse Calibrator::double_push(StickRig& rig, std::size_t axis, double magnitude) {
  const AxisPlace place = places()[axis];
  const double from = rig.rest(place.report, idle_command()), expected = std::abs(known_[axis]->gain * magnitude);
  const double seconds = std::sqrt(kDoublePushMotion * rig.range(place.report) / expected);
  const auto length = static_cast<std::int64_t>(1e9 * std::clamp(seconds, kMinPushTime, kMaxPushTime));
  const std::int64_t begin = rig.latest().now_ns;
  StickCommand command = idle_command();
  command.push_time = 1e-9 * static_cast<double>(length);  // a full force must not last as long as this thread is late
  Pulse measured;
  std::int64_t first_ns = 0;
  double sent = 0.0;
  for (std::int64_t time = 0; time < 2 * length + kDoubleCoastTime; time = rig.latest().now_ns - begin) {
    command.constant[place.motor] = time < length ? magnitude : time < 2 * length ? -magnitude : 0.0;
    const StickRig::Tick& tick = rig.step(command);
    const double now_sent = tick.state.sent[place.motor];
    if (now_sent != sent && first_ns == 0) first_ns = tick.state.sent_ns;
    if (now_sent != sent)
      measured.steps.push_back({1e-9 * static_cast<double>(tick.state.sent_ns - first_ns), now_sent});
    sent = now_sent;
    if (first_ns != 0 && tick.fresh)
      measured.samples.push_back(
          {1e-9 * static_cast<double>(tick.state.time_ns - first_ns), rig.position(place.report) - from});
    rig.watch_runaway(place.report, from);
  }
  return measured;
}

std::string Calibrator::measure_handle() {
  require_polarity();
  if (!calibration_.has_range() || !calibration_.has_force())
    throw CalibrationRefused("the lever's travel and full force are not known yet. Enter these numbers first");
  StickRig rig(driver_, tick_);
  calibration_.holds_spring = false;
  std::array<PulseFit, 2> found;
  bool stiff = false;
  for (const std::size_t i : motors()) {
    const std::optional<PulseFit> known = std::exchange(known_[i], std::nullopt);
    found[i] = known ? *known : fit(rig, axis_of(i), kNames[i]);
    stiff = stiff || is_stiff(found[i], i);
  }
  calibration_.holds_spring = stiff && spring_helps(rig);
  for (const std::size_t i : motors())
    if (calibration_.holds_spring) found[i] = fit(rig, axis_of(i), kNames[i]);
  std::array<AxisModel, 2> handle;
  std::array<double, 2> own_spring{}, friction{};
  std::string sentence;
  for (const std::size_t i : motors()) {
    handle[i] = handle_of(found[i], i);
    const LeverAxisCalibration& axis = axis_of(i);
    const double own = is_stiff(found[i], i) ? own_fraction(rig, axis) : 0.0;
    const double stop_force = 0.5 * handle[i].stiffness * axis.travel;  // [N] of the handle's spring at a stop
    if ((1.0 - own) * stop_force > kMaxHandleSpringForce * axis.full_force)
      throw CalibrationRefused(std::string(kNames[i]) + " has a spring of " + newtons_per_metre(handle[i].stiffness) +
                               ", too stiff for the motors. Take your hands off the lever, or make the stick's own "
                               "centring weaker in its own software");
    own_spring[i] = own * handle[i].stiffness;
    sentence += (sentence.empty() ? "" : "; ") + std::string(kNames[i]) + " has " + number_text(handle[i].mass, 3) +
                " kg, " + number_text(handle[i].damping, 2) + " N s/m, " + newtons_per_metre(handle[i].stiffness);
    const double newtons = found[i].friction * axis.force_per_magnitude();
    if (newtons < kMinFriction) continue;
    friction[i] = newtons;
    sentence += ", " + number_text(newtons, 2) + " N of dry friction";
  }
  for (const std::size_t i : motors()) {
    axis_of(i).handle = handle[i];
    axis_of(i).own_spring = own_spring[i];
    axis_of(i).friction = friction[i];
  }
  if (calibration_.holds_spring)
    sentence += "; the stick pulls to its centre by itself unless a spring plays, so a spring without a force plays";
  if (own_spring[0] == 0.0 && own_spring[1] == 0.0) return sentence;
  return sentence + "; the stick pulls to its centre by itself, with " + newtons_per_metre(own_spring[0]) + " and " +
         newtons_per_metre(own_spring[1]) +
         " while its motors are on, so gates feel wrong by that much. Look for a setting in the stick's own software";
}

AxisModel Calibrator::handle_of(const PulseFit& found, std::size_t i) const {
  const LeverAxisCalibration& axis = axis_of(i);
  const double metre = axis.travel / std::abs(axis.high - axis.low);  // [m] per count
  const double mass = axis.force_per_magnitude() / (std::abs(found.gain) * metre);
  if (!(mass >= 0.005 && mass <= 20.0))
    throw CalibrationRefused("a handle of " + number_text(mass, 4) +
                             " kg is not plausible. Check the full force and the travel");
  return {mass, found.damping * mass, found.stiffness * mass};
}

// True if the handle's spring is so strong that motors may make it.
bool Calibrator::is_stiff(const PulseFit& found, std::size_t axis) const {
  return 0.5 * handle_of(found, axis).stiffness * axis_of(axis).travel > kMinOwnSpringForce * axis_of(axis).full_force;
}

// True if the lever returns to its centre less far while a spring without a force plays, and forces act beside it.
bool Calibrator::spring_helps(StickRig& rig) const {
  StickCommand held = idle_command();
  held.holds_spring = true;
  for (const std::size_t i : motors()) {
    const AxisPlace place = places()[i];
    if (!acts_beside(rig, place, idle_command(), held)) return false;
    const double alone = distance_returned(rig, place, idle_command()), beside = distance_returned(rig, place, held);
    if (alone > 0.0 && 1.0 - beside / alone > kMinOwnFraction) return true;
  }
  return false;
}

// Fraction of the handle's stiffness that disappears with the motors: deflects the lever and compares how it returns with
// the motors on, without a force, and with the motors off.
double Calibrator::own_fraction(StickRig& rig, const LeverAxisCalibration& axis) const {
  const AxisPlace place = axis_place(axis);
  const double on = distance_returned(rig, place, idle_command()), off = distance_returned(rig, place, {});
  const double fraction = on > 0.0 ? std::clamp(1.0 - off / on, 0.0, 1.0) : 0.0;
  return fraction < kMinOwnFraction ? 0.0 : fraction;
}

// [counts] that the lever returns in kReturnTime after a constant force ended, under this command.
double Calibrator::distance_returned(StickRig& rig, const AxisPlace& place, const StickCommand& under) const {
  StickCommand command = under.enabled ? under : idle_command();
  command.constant[place.motor] = kCautiousForce;
  const double from = rig.rest(place.report, command);
  const std::int64_t begin = rig.latest().now_ns;
  while (rig.latest().now_ns - begin < kReturnTime) rig.step(under);
  return std::abs(rig.position(place.report) - from);
}

std::string Calibrator::measure_springs() {
  require_polarity();
  if (!calibration_.has_range() || !calibration_.has_force())
    throw CalibrationRefused("the lever's travel and full force are not known yet. Enter these numbers first");
  const DeviceCalibration before = calibration_;
  try {
    return measure_springs_anew();
  } catch (const CalibrationRefused&) {
    calibration_ = before;
    throw;
  }
}

std::string Calibrator::measure_springs_anew() {
  for (LeverAxisCalibration* axis : {&calibration_.select, &calibration_.shift}) {
    axis->spring_sign = axis->damper_sign = 0;
    axis->spring_stiffness = axis->spring_dead_band = axis->damper_strength = 0.0;
    axis->spring_cross_talk = axis->damper_cross_talk = -1.0;
  }
  calibration_.springs_refused.clear();
  calibration_.dampers_refused.clear();
  calibration_.effects_at_once = std::min(calibration_.effects_at_once, 2);
  std::string sentence;
  try {
    if (calibration_.select_by_position) throw EffectsRefused("springs need forces along both axes");
    if (!has_springs_) throw EffectsRefused("the stick has no springs");
    sentence = measure_spring_strengths();
  } catch (const EffectsRefused& refused) {
    calibration_.springs_refused = refused.what();
    sentence = calibration_.springs_refused +
               ", so springs are not used, and walls are as soft as the stick's delay makes them";
  }
  if (!driver_.layout().has_effect(PidEffect::damper)) return sentence;
  try {
    if (calibration_.select_by_position) throw EffectsRefused("dampers need forces along both axes");
    return sentence + "; " + find_dampers();
  } catch (const EffectsRefused& refused) {
    calibration_.dampers_refused = refused.what();
    return sentence + "; " + refused.what() + ", so dampers are not used";
  }
}

std::string Calibrator::measure_spring_strengths() {
  const std::array<Spring, 2> found = find_springs();
  for (LeverAxisCalibration* axis : {&calibration_.select, &calibration_.shift}) {
    const Spring& spring = found[axis == &calibration_.select ? 0 : 1];
    axis->spring_sign = spring.sign;
    axis->spring_stiffness = spring.stiffness;
    axis->spring_dead_band = spring.dead_band;
    axis->spring_cross_talk = spring.cross_talk;
  }
  calibration_.effects_at_once = 3;
  const bool useful = std::min(found[0].stiffness, found[1].stiffness) >= kMinSpring;
  return "springs of up to " + newtons_per_metre(found[0].stiffness) + " in select and " +
         newtons_per_metre(found[1].stiffness) + " in shift" + (useful ? "" : ", too weak to be used");
}

// Tries each way of naming an axis until the springs of both axes pull to their centres and keep their dead bands.
std::array<Calibrator::Spring, 2> Calibrator::find_springs() {
  {
    StickRig rig(driver_, tick_);
    if (!acts_beside(rig, places()[0], idle_command(), with_weak(true, false)))
      throw EffectsRefused("the stick renders only two effects at a time, and a spring would be the third");
  }
  std::string reason;
  for (const AxisStyle style : {AxisStyle::bits, AxisStyle::direction}) {
    try {
      StickStyle tried = calibration_.style;
      tried.conditions = style;
      const std::array<Spring, 2> found = springs_twice(tried);
      calibration_.style = tried;
      return found;
    } catch (const EffectsRefused& refused) {
      if (reason.empty()) reason = refused.what();
    }
  }
  driver_.set_style(calibration_.style);
  throw EffectsRefused(reason);
}

// A single touch may spoil a measurement, so springs are refused only if it fails twice.
std::array<Calibrator::Spring, 2> Calibrator::springs_twice(StickStyle style) {
  try {
    return springs_by(style);
  } catch (const EffectsRefused&) {
    return springs_by(style);
  }
}

std::array<Calibrator::Spring, 2> Calibrator::springs_by(StickStyle style) {
  if (!driver_.layout().set_condition.dead_band.exists()) throw EffectsRefused("the stick's springs have no dead band");
  apply(style);
  StickRig rig(driver_, tick_);
  std::array<Spring, 2> found;
  for (std::size_t i = 0; i < 2; ++i) {
    const LeverAxisCalibration& axis = i == 0 ? calibration_.select : calibration_.shift;
    found[i] = spring_sign(rig, axis_place(axis));
    check_cross_talk("spring", i, found[i].cross_talk);
    found[i].stiffness = spring_stiffness(rig, axis, found[i].sign);
    found[i].dead_band = dead_band(rig, axis, found[i]);
  }
  check_springs_together(rig, found);
  return found;
}

// Finds a spring's sign and cross-talk: +1 if it pulls the lever to its centre, -1 if it pushes the lever away. The
// spring's saturation limits the force.
Calibrator::Spring Calibrator::spring_sign(StickRig& rig, const AxisPlace& place) const {
  const PidSetCondition& set = driver_.layout().set_condition;
  const bool is_capped = set.positive_saturation.exists();
  // Saturations may be ignored, and springs are up to four times as strong as commanded, so weak ones are tried first.
  for (const double coefficient : {0.02, 0.1, 0.4, 1.0}) {
    if (!is_capped && coefficient * kSpringOffset > kCautiousForce) break;
    const Motion there = pull(rig, place, coefficient, kSpringOffset);
    if (std::abs(there.moved) < kMinMoved) continue;
    Spring found;
    found.sign = there.moved > 0.0 ? 1 : -1;
    if (found.sign < 0 && set.positive_coefficient.min >= set.positive_coefficient.zero)
      throw EffectsRefused("the stick's springs push away from their centre and cannot be inverted");
    found.cross_talk = cross_talk(there, pull(rig, place, coefficient, -kSpringOffset));
    return found;
  }
  throw EffectsRefused("the stick's springs do not move the lever");
}

// Commands a spring whose centre is `offset` away from the lever. The motion is positive if the counts rise.
Calibrator::Motion Calibrator::pull(StickRig& rig, const AxisPlace& place, double coefficient, double offset) const {
  rig.rest(place.report, idle_command());
  StickCommand command = idle_command();
  command.spring[place.motor] = {rig.deflection(place.report) + offset, 0.0, coefficient, kCautiousForce};
  Motion motion = push(rig, place, idle_command(), command);
  motion.moved *= place.sign;
  return motion;
}

// Some sticks use the spring of one axis on the other unless both are set.
void Calibrator::check_springs_together(StickRig& rig, const std::array<Spring, 2>& springs) const {
  const std::array<AxisPlace, 2> place = places();
  std::array<double, 2> from{}, offset{}, moved{};
  StickCommand command = idle_command();
  for (std::size_t i = 0; i < 2; ++i) {
    from[i] = rig.rest(place[i].report, idle_command());
    const double here = rig.deflection(place[i].report);
    offset[i] = (here < 0.0) == (i == 0) ? kSpringOffset : -kSpringOffset;
    command.spring[place[i].motor] = {here + offset[i], 0.0, static_cast<double>(springs[i].sign), kCautiousForce};
  }
  const std::int64_t begin = rig.latest().now_ns;
  while (rig.latest().now_ns - begin < kPushTime && std::abs(moved[0]) < 2.0 * kMoved &&
         std::abs(moved[1]) < 2.0 * kMoved) {
    rig.step(command);
    for (std::size_t i = 0; i < 2; ++i)
      moved[i] = (rig.position(place[i].report) - from[i]) / rig.range(place[i].report);
  }
  rig.step(idle_command());
  for (std::size_t i = 0; i < 2; ++i) {
    if (moved[i] * offset[i] < 0.25 * kMinMoved * std::abs(offset[i]))
      throw EffectsRefused("the stick does not render the springs of both axes at the same time");
  }
}

// Measures the dead band of a spring whose centre is away from the lever's rest: inside it, the lever must stay where
// it is; then a constant force pushes it against both ends. Returns the measured width over the commanded one.
double Calibrator::dead_band(StickRig& rig, const LeverAxisCalibration& axis, const Spring& spring) const {
  const AxisPlace place = axis_place(axis);
  const LeverAxisMap map(axis, driver_.lever_report().axes[place.report].field);
  const double from = rig.rest(place.report, idle_command()), here = rig.deflection(place.report);
  const double centre = here + (here < 0.0 ? kBandOffset : -kBandOffset);
  StickCommand command = idle_command();
  command.spring[place.motor] = {centre, kBand, static_cast<double>(spring.sign), kCautiousForce};
  for (const std::int64_t begin = rig.latest().now_ns; rig.latest().now_ns - begin < kLeakTime;) {
    rig.step(command);
    if (std::abs(rig.position(place.report) - from) > kMinMoved * rig.range(place.report))
      throw EffectsRefused("the stick's springs push inside their dead band");
  }
  command.spring[place.motor].saturation = 1.0;
  const double half_range = 0.5 * rig.range(place.report);
  const double metre = std::abs(map.metres(from + half_range * kBand) - map.metres(from)) / kBand;  // per deflection
  const double middle = map.metres(from + (centre - here) * half_range);
  std::array<double, 2> width{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double direction = i == 0 ? 1.0 : -1.0, force = direction * kCautiousForce * axis.force_per_magnitude();
    command.constant[place.motor] = direction * axis.constant_sign * kCautiousForce;
    const double there = map.metres(rig.rest(place.report, command));
    width[i] = direction * (there - middle - (force - axis.handle.stiffness * there) / spring.stiffness) / metre;
  }
  const double mean = 0.5 * (width[0] + width[1]) / kBand, skew = 0.5 * std::abs(width[0] - width[1]) / kBand;
  if (mean < kMinBandRatio || mean > kMaxBandRatio || skew > kMaxBandSkew)
    throw EffectsRefused("the stick's springs do not keep their dead band");
  return mean;
}

// How the dampers name an axis is known from the springs; without springs, each way is tried.
std::string Calibrator::find_dampers() {
  if (calibration_.springs_refused.empty()) return measure_dampers_twice();
  const StickStyle known = calibration_.style;
  std::string reason;
  for (const AxisStyle style : {AxisStyle::bits, AxisStyle::direction}) {
    try {
      calibration_.style.conditions = style;
      apply(calibration_.style);
      return measure_dampers_twice();
    } catch (const EffectsRefused& refused) {
      if (reason.empty()) reason = refused.what();
    }
  }
  calibration_.style = known;
  driver_.set_style(known);
  throw EffectsRefused(reason);
}

// A damper that drives the lever away looks like a hand, so it is refused only if that happens twice.
std::string Calibrator::measure_dampers_twice() {
  try {
    return measure_dampers();
  } catch (const Runaway&) {
    try {
      return measure_dampers();
    } catch (const Runaway&) {
      throw EffectsRefused("the stick's dampers drive the lever away");
    }
  }
}

// Measures the sign of each damper first, with the small coefficient kCautiousForce, and then its strength.
std::string Calibrator::measure_dampers() {
  DeviceCalibration found = calibration_;
  if (!found.has_handle()) return "the dampers were not measured, because the handle has not been measured yet";
  StickRig rig(driver_, tick_);
  const bool has_spring = calibration_.springs_refused.empty();
  if (!acts_beside(rig, places()[0], with_weak(has_spring, false), with_weak(has_spring, true)))
    throw EffectsRefused(has_spring ? "the stick renders only three effects at a time, and a damper would be the fourth"
                                    : "the stick renders only two effects at a time, and a damper would be the third");
  for (LeverAxisCalibration* axis : {&found.select, &found.shift}) {
    const std::string name = axis == &found.select ? "select" : "shift";
    const double braking = damping_by(rig, *axis, name, kCautiousForce);
    if (std::abs(braking) < kMinBraking) throw EffectsRefused("the stick's dampers do not brake the lever");
    axis->damper_sign = braking > 0.0 ? 1 : -1;
    axis->damper_strength = damping_by(rig, *axis, name, kDamper * axis->damper_sign) / kDamper;
    if (axis->damper_strength <= 0.0)
      throw EffectsRefused("the damper of " + name + " accelerates the lever with either sign instead of braking it");
  }
  for (std::size_t i = 0; i < 2; ++i) {
    double& cross_talk = i == 0 ? found.select.damper_cross_talk : found.shift.damper_cross_talk;
    cross_talk = damper_cross_talk(rig, i, found);
    for (int tries = 1; cross_talk > kMaxCrossTalk && tries < kCrossTalkTries; ++tries)
      cross_talk = std::min(cross_talk, damper_cross_talk(rig, i, found));
    check_cross_talk("damper", i, cross_talk);
  }
  check_dampers_together(rig, found);
  found.effects_at_once = has_spring ? 4 : 3;
  calibration_ = found;
  return "dampers of up to " + number_text(found.select.damper_strength, 1) + " N s/m in select and " +
         number_text(found.shift.damper_strength, 1) + " N s/m in shift" +
         (found.select.damper_sign * found.shift.damper_sign > 0 ? "" : ", with opposite signs");
}

// How much the damper of one axis brakes or pushes the other one, over how much it brakes its own: pushes each with the
// damper and without.
double Calibrator::damper_cross_talk(StickRig& rig, std::size_t axis, const DeviceCalibration& found) const {
  const std::array<AxisPlace, 2> place = places();
  StickCommand damped = idle_command();
  damped.damper[place[axis].motor] = kDamper * (axis == 0 ? found.select : found.shift).damper_sign;
  std::array<double, 2> braked{}, pushed{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Motion free = distance_pushed(rig, place[i], idle_command()), slow = distance_pushed(rig, place[i], damped);
    braked[i] = (free.moved - slow.moved) / free.moved;
    pushed[i] = std::abs(slow.other - free.other) / free.moved;
  }
  return std::max(std::abs(braked[1 - axis]), pushed[axis]) / std::abs(braked[axis]);
}

// Some sticks use the damper of only that axis which was set last.
void Calibrator::check_dampers_together(StickRig& rig, const DeviceCalibration& found) const {
  const std::array<AxisPlace, 2> place = places();
  StickCommand both = idle_command();
  for (std::size_t i = 0; i < 2; ++i)
    both.damper[place[i].motor] = kDamper * (i == 0 ? found.select : found.shift).damper_sign;
  for (std::size_t i = 0; i < 2; ++i) {
    StickCommand alone = both;
    alone.damper[place[1 - i].motor] = 0.0;
    const double free = distance_pushed(rig, place[i], idle_command()).moved;
    const auto braked = [&](const StickCommand& damped) {
      return free - distance_pushed(rig, place[i], damped, &alone).moved;
    };
    const double least = 0.5 * braked(alone);
    if (braked(both) < least && braked(both) < least)  // one touch refuses nothing
      throw EffectsRefused("the stick does not render the dampers of both axes at the same time");
  }
}

// Damping [N s/m] that a damper of coefficient `damper` adds to the handle's own damping.
double Calibrator::damping_by(StickRig& rig, const LeverAxisCalibration& axis, const std::string& name,
                              double damper) const {
  return fit(rig, axis, name, damper).damping * axis.handle.mass - axis.handle.damping;
}

// Measures the stiffness [N/m] of the strongest device spring: pushes against it with a known force in each direction
// and compares where the lever comes to rest.
double Calibrator::spring_stiffness(StickRig& rig, const LeverAxisCalibration& axis, int sign) const {
  const AxisPlace place = axis_place(axis);
  const LeverAxisMap map(axis, driver_.lever_report().axes[place.report].field);
  rig.rest(place.report, idle_command());
  StickCommand command = idle_command();
  command.spring[place.motor] = {rig.deflection(place.report), 0.0, static_cast<double>(sign), 1.0};
  double magnitude = kPulseForce;
  while (true) {
    command.constant[place.motor] = magnitude;
    const double there = rig.rest(place.report, command);
    command.constant[place.motor] = -magnitude;
    const double back = rig.rest(place.report, command);
    const double width = std::abs(there - back) / rig.range(place.report);
    const bool is_fine = width > kMinBalance || magnitude >= std::min(kMaxBalanceForce, axis.max_magnitude());
    if (is_fine && width == 0.0) throw EffectsRefused("the stick's springs do not give way under a force");
    if (is_fine) {
      const double metres = std::abs(map.metres(there) - map.metres(back));
      return std::max(0.0, 2.0 * magnitude * axis.force_per_magnitude() / metres - axis.handle.stiffness);
    }
    magnitude *= 2.0;
  }
}

}  // namespace gearshift::haptics
