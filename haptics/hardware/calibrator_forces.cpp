// What the stick does by itself, with the hands off.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>

#include "haptics/files/number_text.h"
#include "haptics/hardware/calibrator.h"
#include "haptics/hardware/pid_lever.h"

namespace gearshift {
namespace {

constexpr double kMoved = 0.02, kLeastMoved = 0.01;        // [1] of the range
constexpr std::int64_t kPushTime = 250'000'000;            // [ns] at most
constexpr double kSpringOffset = 0.25;                     // [1] of the full deflection
constexpr double kLoadForce = 0.05, kLoadFrequency = 5.0;  // [1] of the full force, [Hz]
constexpr double kLoadNews = 0.01;                         // [1] up and down, so that there is something new to tell
constexpr std::int64_t kLoadTime = 2'100'000'000, kLoadStart = 100'000'000;  // [ns] all of it, and what does not count
constexpr std::size_t kLeastReadings = 50;
constexpr double kPulseForce = 0.05, kMostPulseForce = 0.4;  // [1] of the full force
constexpr double kDampedPulseForce = 0.2;                    // [1] against a strong damper
constexpr std::int64_t kPulseTime = 60'000'000, kCoastTime = 400'000'000, kNoForceTime = 1'000'000'000;  // [ns]
constexpr std::int64_t kSettingTime = 20'000'000;                // [ns] in which what holds is told
constexpr double kPulseMotion = 0.06, kLeastPulseMotion = 0.03;  // [1] of the range
constexpr double kMostResidual = 0.2;                            // [1]
constexpr double kAlike = 0.25;                                  // [1] what two pairs of pulses may differ by,
constexpr double kAlikeDamping = 2.0, kAlikeDelay = 0.002;       // [1/s], [s] or so much
constexpr std::size_t kMostPairs = 5;
constexpr double kMostDelayMeasured = 0.1;  // [s]
constexpr double kMostBalance = 0.4;        // [1] of the full force, against a spring
constexpr double kLeastBalance = 0.01;      // [1] of the range
constexpr double kDamper = 0.5;             // [1] of the greatest coefficient: enough to measure
constexpr double kMostOwnSpring = 0.3;      // [1] of the full force, at a stop: else a hand's
constexpr double kLeastBraking = 0.3;       // [N s/m] that tells the way of a damper

PidWish idle_wish() noexcept {
  PidWish wish;
  wish.enabled = true;
  return wish;
}

std::string newtons_per_metre(double stiffness) {
  return number_text(stiffness, 0) + " N/m";
}

bool are_alike(const PulseFit& a, const PulseFit& b) noexcept {
  if (std::max(a.residual, b.residual) > kMostResidual) return false;
  const auto within = [](double x, double y, double least) {
    return std::abs(x - y) <= std::max(least, kAlike * std::max(std::abs(x), std::abs(y)));
  };
  return within(a.gain, b.gain, 0.0) && within(a.damping, b.damping, kAlikeDamping) &&
         within(a.delay, b.delay, kAlikeDelay);
}

double share_of(std::vector<double>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

void Calibrator::require_range() const {
  if (!calibration_.has_stops()) throw CalibrationRefused("where the lever's ends are is not known yet");
}

void Calibrator::require_polarity() const {
  require_range();
  if (!calibration_.has_polarity()) throw CalibrationRefused("which way its forces push is not known yet");
}

Calibrator::AxisPlace Calibrator::place_of(const LeverAxisCalibration& axis) const {
  if (axis.usage > kUsageY.id) throw CalibrationRefused("the lever moves an axis that has no motor: X and Y have");
  return {report_axis(axis.usage), axis.usage == kUsageY.id ? std::size_t{1} : std::size_t{0},
          axis.high > axis.low ? 1.0 : -1.0};
}

std::string Calibrator::measure_polarity() {
  require_range();
  StickRig rig(driver_, tick_);
  DeviceCalibration found = calibration_;
  std::string sentence;
  for (LeverAxisCalibration* axis : {&found.select, &found.shift}) {
    const std::string name = axis == &found.select ? "select" : "shift";
    const AxisPlace place = place_of(*axis);
    axis->constant_sign = constant_sign(rig, place, name);
    axis->spring_sign = spring_sign(rig, place);
    sentence += (sentence.empty() ? "" : "; ") + name + ": plus pushes " +
                (axis == &found.select ? (axis->constant_sign > 0 ? "right" : "left")
                                       : (axis->constant_sign > 0 ? "forward" : "back")) +
                (axis->spring_sign == 0  ? ", springs do not move it"
                 : axis->spring_sign > 0 ? ", springs pull to their centre"
                                         : ", springs push away from their centre");
  }
  calibration_ = found;
  return sentence;
}

// Both ways, and with as little force as moves it.
int Calibrator::constant_sign(StickRig& rig, const AxisPlace& place, const std::string& name) const {
  for (const double magnitude : {0.25 * kCautious, 0.5 * kCautious, kCautious}) {
    PidWish wish = idle_wish();
    wish.constant[place.motor] = magnitude;
    const double there = push(rig, place, wish);
    if (std::abs(there) < kLeastMoved) continue;
    wish.constant[place.motor] = -magnitude;
    const double back = push(rig, place, wish);
    if (std::abs(back) < kLeastMoved || (there > 0.0) == (back > 0.0))
      throw CalibrationRefused(name + " did not move one way and then the other: take the hands off the lever");
    return there > 0.0 ? 1 : -1;
  }
  throw CalibrationRefused(name + " does not move by " + number_text(100.0 * kCautious, 0) +
                           " % of the full force: is the stick powered, and free to move?");
}

// [1] of the range to the right or forward, under that wish from rest.
double Calibrator::push(StickRig& rig, const AxisPlace& place, const PidWish& wish) const {
  const std::size_t other = report_axis(place.motor == 0 ? kUsageY.id : kUsageX.id);
  const double from = rig.rest(place.report, idle_wish()), beside = rig.position(other);
  const std::int64_t begin = rig.look().now_ns;
  double moved = 0.0, strayed = 0.0;
  while (std::abs(moved) < kMoved && rig.look().now_ns - begin < kPushTime) {
    rig.step(wish);
    moved = (rig.position(place.report) - from) / rig.range(place.report);
    strayed = (rig.position(other) - beside) / rig.range(other);
    if (std::abs(strayed) > kMoved) throw CalibrationRefused("a force along one axis moves the other one");
  }
  rig.step(idle_wish());
  return moved * place.sign;
}

// A spring whose centre lies beside the lever pulls it there, or pushes it away. Its saturation is the cap.
int Calibrator::spring_sign(StickRig& rig, const AxisPlace& place) const {
  const PidLayout& pid = driver_.layout();
  if (!pid.makes(PidEffect::spring) || !pid.set_condition.exists()) return 0;
  const bool is_capped = pid.set_condition.positive_saturation.exists();
  for (const double coefficient : {0.1, 0.4, 1.0}) {
    if (!is_capped && coefficient * kSpringOffset > kCautious) break;
    rig.rest(place.report, idle_wish());
    const double here = rig.share(place.report), offset = here < 0.0 ? kSpringOffset : -kSpringOffset;
    PidWish wish = idle_wish();
    wish.spring[place.motor] = {here + offset, 0.0, coefficient, kCautious};
    const double moved = push(rig, place, wish) * place.sign;  // as the counts go
    if (std::abs(moved) < kLeastMoved) continue;
    return (moved > 0.0) == (offset > 0.0) ? 1 : -1;
  }
  return 0;
}

std::string Calibrator::measure_timing() {
  require_polarity();
  StickRig rig(driver_, tick_);
  DeviceTiming timing = measure_intervals(rig);
  for (const LeverAxisCalibration* axis : {&calibration_.select, &calibration_.shift}) {
    const PulseFit found = fit(rig, *axis, axis == &calibration_.select ? "select" : "shift");
    timing.delay = std::max({timing.delay, found.delay, 0.0});
  }
  calibration_.timing = timing;
  return "a reading every " + number_text(1e3 * timing.input_interval, 2) + " ms (jitter " +
         number_text(1e3 * timing.jitter, 2) + " ms), a force every " + number_text(1e3 * timing.output_interval, 2) +
         " ms, delay " + number_text(1e3 * timing.delay, 2) + " ms: it answers after " +
         number_text(1e3 * answer_time(timing), 1) + " ms";
}

// While it moves and both axes are told a new force every time: a stick has more time when it stands still.
DeviceTiming Calibrator::measure_intervals(StickRig& rig) const {
  const AxisPlace select = place_of(calibration_.select), shift = place_of(calibration_.shift);
  const double from_x = rig.rest(select.report, idle_wish()), from_y = rig.rest(shift.report, idle_wish());
  const std::int64_t begin = rig.look().now_ns;
  StickRig::Look first = rig.look(), last = first;
  std::vector<double> intervals;
  double news = kLoadNews;
  while (last.now_ns - begin < kLoadTime) {
    if (last.now_ns - begin < kLoadStart) first = last;
    const double phase = 2e-9 * std::numbers::pi * kLoadFrequency * static_cast<double>(last.now_ns - begin);
    news = -news;
    PidWish wish = idle_wish();
    wish.constant = {kLoadForce * std::cos(phase) + news, kLoadForce * std::sin(phase) + news};
    const StickRig::Look now = rig.step(wish);
    const std::uint64_t readings = now.sight.sequence - last.sight.sequence;
    if (readings > 0 && last.sight.time_ns > 0)
      intervals.push_back(1e-9 * static_cast<double>(now.sight.time_ns - last.sight.time_ns) /
                          static_cast<double>(readings));
    last = now;
    rig.watch_runaway(select.report, from_x);
    rig.watch_runaway(shift.report, from_y);
  }
  const std::uint64_t outputs = last.sight.outputs - first.sight.outputs;
  if (intervals.size() < kLeastReadings) throw CalibrationRefused("the stick tells too seldom where it is");
  if (outputs < kLeastReadings) throw CalibrationRefused("the stick takes a force too seldom");
  DeviceTiming timing;
  timing.input_interval = share_of(intervals, 0.5);
  timing.jitter = std::max(0.0, share_of(intervals, 0.99) - timing.input_interval);
  timing.output_interval =
      1e-9 * static_cast<double>(last.sight.sent_ns - first.sight.sent_ns) / static_cast<double>(outputs);
  return timing;
}

// rest: what holds before, during and after it. It comes to rest without: a damped lever takes seconds.
Pulse Calibrator::pulse(StickRig& rig, const AxisPlace& place, const PidWish& rest, double magnitude) const {
  const double from = rig.rest(place.report, idle_wish());
  for (const std::int64_t now = rig.look().now_ns; rig.look().now_ns < now + kSettingTime;) rig.step(rest);
  const std::int64_t begin = rig.look().now_ns;
  PidWish on = rest;
  on.constant[place.motor] = magnitude;
  Pulse seen;
  seen.magnitude = magnitude;
  std::int64_t on_ns = 0, off_ns = 0;
  bool pushing = true;
  while (off_ns == 0 || rig.look().now_ns - off_ns < kCoastTime) {
    const StickRig::Look& look = rig.step(pushing ? on : rest);
    const bool pushed = look.sight.sent[place.motor] != 0.0;
    if (pushed && on_ns == 0) on_ns = look.sight.sent_ns;
    if (!pushed && on_ns != 0 && off_ns == 0) off_ns = look.sight.sent_ns;
    const double moved = rig.position(place.report) - from;
    if (on_ns != 0 && look.fresh)
      seen.samples.push_back({1e-9 * static_cast<double>(look.sight.time_ns - on_ns), moved});
    const bool enough = std::abs(moved) > kPulseMotion * rig.range(place.report);
    pushing = pushing && !enough && look.now_ns - begin < kPulseTime;
    rig.watch_runaway(place.report, from);
    if (off_ns == 0 && look.now_ns - begin > kNoForceTime) throw CalibrationRefused("the stick takes no force");
  }
  seen.length = 1e-9 * static_cast<double>(off_ns - on_ns);
  return seen;
}

// One way and the other, with a force that moves it far enough: it begins with that magnitude, and leaves it there.
std::array<Pulse, 2> Calibrator::pulses(StickRig& rig, const AxisPlace& place, const PidWish& rest,
                                        double& magnitude) const {
  while (true) {
    std::array<Pulse, 2> pair = {pulse(rig, place, rest, magnitude), pulse(rig, place, rest, -magnitude)};
    double farthest = 0.0;
    for (const PulseSample& sample : pair.front().samples) farthest = std::max(farthest, std::abs(sample.position));
    if (farthest > kLeastPulseMotion * rig.range(place.report) || magnitude >= kMostPulseForce) return pair;
    magnitude *= 2.0;
  }
}

// In counts, under a damper of that coefficient: by the first two pairs of pulses that say the same. One alone cannot
// tell a nudge, or a machine that was late, from what the lever is.
PulseFit Calibrator::fit(StickRig& rig, const LeverAxisCalibration& axis, const std::string& name,
                         double damper) const {
  const AxisPlace place = place_of(axis);
  PidWish rest = idle_wish();
  rest.damper[place.motor] = damper;
  double magnitude = std::abs(damper) > kCautious ? kDampedPulseForce : kPulseForce;
  std::vector<std::array<Pulse, 2>> pairs;
  std::vector<PulseFit> fits;
  while (fits.size() < kMostPairs) {
    pairs.push_back(pulses(rig, place, rest, magnitude));
    rig.step();  // motors off: the sum takes longer than a wish counts
    fits.push_back(fit_of(pairs.back(), name));
    for (std::size_t i = 0; i + 1 < fits.size(); ++i) {
      if (!are_alike(fits[i], fits.back())) continue;
      const Pulse four[] = {pairs[i][0], pairs[i][1], pairs.back()[0], pairs.back()[1]};
      return checked(fit_of(four, name), axis, name);
    }
  }
  checked(fits.back(), axis, name);
  throw CalibrationRefused(name + " answers each push differently: take the hands off the lever");
}

PulseFit Calibrator::fit_of(std::span<const Pulse> pulses, const std::string& name) {
  try {
    return fit_pulses(pulses);
  } catch (const std::invalid_argument& error) {
    throw CalibrationRefused(name + ": " + error.what());
  }
}

PulseFit Calibrator::checked(const PulseFit& found, const LeverAxisCalibration& axis, const std::string& name) {
  if (found.residual > kMostResidual)
    throw CalibrationRefused(name +
                             " does not answer a push as a mass with damping does: take the hands off the lever");
  if (found.gain * axis.constant_sign * (axis.high - axis.low) < 0.0)
    throw CalibrationRefused(name + " moves the other way than its polarity says: measure the polarity again");
  if (found.delay > kMostDelayMeasured)
    throw CalibrationRefused(name + " answers a push after " + number_text(1e3 * found.delay, 0) +
                             " ms: too late to feel anything by it");
  return found;
}

std::string Calibrator::measure_handle() {
  require_polarity();
  if (!calibration_.has_range() || !calibration_.has_force())
    throw CalibrationRefused("the lever's travel and its full force are not known yet");
  StickRig rig(driver_, tick_);
  std::array<AxisModel, 2> handle;
  std::string sentence;
  for (const bool select : {true, false}) {
    const LeverAxisCalibration& axis = select ? calibration_.select : calibration_.shift;
    const PulseFit found = fit(rig, axis, select ? "select" : "shift");
    const double metre = axis.travel / std::abs(axis.high - axis.low);  // of a count
    const double mass = axis.full_force / (std::abs(found.gain) * metre);
    if (!(mass >= 0.005 && mass <= 20.0))
      throw CalibrationRefused("a handle of " + number_text(mass, 4) +
                               " kg: the full force or the travel is not right");
    const double half_way = 0.5 * found.stiffness * mass * axis.travel;  // [N] that its own spring takes at a stop
    if (half_way > kMostOwnSpring * axis.full_force)
      throw CalibrationRefused((select ? "select has a spring of " : "shift has a spring of ") +
                               newtons_per_metre(found.stiffness * mass) +
                               ", more than its motors are for: take the hands off the lever");
    handle[select ? 0 : 1] = {mass, found.damping * mass, found.stiffness * mass};
    sentence += (select ? "select: " : "; shift: ") + number_text(mass, 3) + " kg, " +
                number_text(found.damping * mass, 2) + " N s/m, " + newtons_per_metre(found.stiffness * mass);
  }
  calibration_.select.handle = handle[0];
  calibration_.shift.handle = handle[1];
  return sentence;
}

std::string Calibrator::measure_springs() {
  require_polarity();
  if (!calibration_.has_range() || !calibration_.has_force())
    throw CalibrationRefused("the lever's travel and its full force are not known yet");
  StickRig rig(driver_, tick_);
  const double select = spring_stiffness(rig, calibration_.select);
  const double shift = spring_stiffness(rig, calibration_.shift);
  calibration_.select.spring_stiffness = select;
  calibration_.shift.spring_stiffness = shift;
  const bool useful = std::min(select, shift) >= kLeastSpring;
  const std::string springs = "the strongest springs: select " + newtons_per_metre(select) + ", shift " +
                              newtons_per_metre(shift) + (useful ? "" : ": too weak to be used");
  return driver_.layout().makes(PidEffect::damper) ? springs + "; " + measure_dampers() : springs;
}

// The way first, with as little of it as kCautious; then the strength.
std::string Calibrator::measure_dampers() {
  DeviceCalibration found = calibration_;
  if (!found.has_handle()) return "dampers are not measured: the handle is not known";
  StickRig rig(driver_, tick_);
  for (LeverAxisCalibration* axis : {&found.select, &found.shift}) {
    const std::string name = axis == &found.select ? "select" : "shift";
    const double braking = damping_by(rig, *axis, name, kCautious);
    if (std::abs(braking) < kLeastBraking) return "dampers: too weak to be used";
    axis->damper_sign = braking > 0.0 ? 1 : -1;
    axis->damper_strength = damping_by(rig, *axis, name, kDamper * axis->damper_sign) / kDamper;
    if (axis->damper_strength <= 0.0) throw CalibrationRefused(name + " is driven whichever way its damper is told");
  }
  calibration_ = found;
  return "dampers: select " + number_text(found.select.damper_strength, 1) + " N s/m, shift " +
         number_text(found.shift.damper_strength, 1) + " N s/m" +
         (found.select.damper_sign * found.shift.damper_sign > 0 ? "" : ", of different signs");
}

// [N s/m] that a damper of such a coefficient adds to the handle's own.
double Calibrator::damping_by(StickRig& rig, const LeverAxisCalibration& axis, const std::string& name,
                              double damper) const {
  return fit(rig, axis, name, damper).damping * axis.handle.mass - axis.handle.damping;
}

// The strongest spring against a known force, one way and the other: where it comes to rest.
double Calibrator::spring_stiffness(StickRig& rig, const LeverAxisCalibration& axis) const {
  const AxisPlace place = place_of(axis);
  const BitField& coefficient = driver_.layout().set_condition.positive_coefficient;
  if (axis.spring_sign == 0) throw CalibrationRefused("its springs do not move the lever");
  if (axis.spring_sign < 0 && coefficient.min >= coefficient.zero)
    throw CalibrationRefused("its springs push away from their centre and cannot be turned round");
  const LeverAxisMap map(axis, driver_.lever_report().axes[place.report].field);
  rig.rest(place.report, idle_wish());
  PidWish wish = idle_wish();
  wish.spring[place.motor] = {rig.share(place.report), 0.0, static_cast<double>(axis.spring_sign), 1.0};
  double magnitude = kPulseForce;
  while (true) {
    wish.constant[place.motor] = magnitude;
    const double there = rig.rest(place.report, wish);
    wish.constant[place.motor] = -magnitude;
    const double back = rig.rest(place.report, wish);
    const double width = std::abs(there - back) / rig.range(place.report);
    const bool is_fine = width > kLeastBalance || magnitude >= kMostBalance;
    if (is_fine && width == 0.0) throw CalibrationRefused("its springs do not yield to a force");
    if (is_fine) {
      const double metres = std::abs(map.metres(there) - map.metres(back));
      return std::max(0.0, 2.0 * magnitude * axis.full_force / metres - axis.handle.stiffness);
    }
    magnitude *= 2.0;
  }
}

}  // namespace gearshift
