#include "haptics/analysis/frequency_sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "haptics/files/range_check.h"
#include "haptics/joystick/finite.h"
#include "haptics/joystick/plane_pose.h"

namespace gearshift::haptics {
namespace {

using Complex = std::complex<double>;

constexpr double kTau = 2.0 * std::numbers::pi;
constexpr double kMinWindowTime = 1.0;  // [s]
constexpr double kMinRampTime = 0.3;    // [s]
constexpr int kMaxWindows = 60;         // after this number of windows a frequency is reported as `never_settled`
constexpr double kAgreement = 1e-3;     // [1] two windows agree if they differ by less than this fraction or the noise
constexpr double kMinDeviation = 1e-6;  // [1] lower bound of the reported relative uncertainty
constexpr double kStopFraction = 0.9;   // [1] the sweep ends beyond this fraction of the distance to the stop
constexpr double kMaxOvershoot = 1.15;  // [1] beyond this multiple of the requested stroke the amplitude is halved

int axis_index(LeverAxis axis) {
  return axis == LeverAxis::x ? 0 : 1;
}

const SweepConfig& validated(const SweepConfig& config, const DeviceSpec& spec, int axis, double period) {
  require_between("FrequencySweep: period", period, 1e-5, 0.02, "s");
  require_between("FrequencySweep: highest", config.highest, 0.01, 0.4 / period, "Hz");
  require_between("FrequencySweep: lowest", config.lowest, 0.01, config.highest, "Hz");
  require_between("FrequencySweep: points", config.points, 1, 200);
  require_between("FrequencySweep: force_fraction", config.force_fraction, 0.001, 1.0);
  require_between("FrequencySweep: stroke_fraction", config.stroke_fraction, 0.05, 0.7);
  require_between("max_force of the device", spec.max_force[axis], 1e-3, 1e4, "N");
  require_between("workspace of the device", spec.workspace[axis], 1e-4, 10.0, "m");
  require_between("delay of the device", spec.delay, 0, kMaxLoopDelay, "cycles");
  if (config.literal && !spec.simulated) {
    throw std::invalid_argument(
        "FrequencySweep: the option literal drives the lever to its stop, so the option is allowed only with a "
        "simulated device");
  }
  return config;
}

double stop_on_arc(const DeviceSpec& spec, int axis) {
  const double radius = spec.yoke_radius, reach = spec.workspace[axis];
  return radius > 0.0 ? radius * std::asin(std::min(1.0, reach / radius)) : reach;
}

std::string_view fault_text(GuardFault fault) {
  switch (fault) {
    case GuardFault::stale_reading:
      return "no fresh reading for 20 ms";
    case GuardFault::limit_broken:
      return "the lever is outside its workspace";
    default:
      return to_string(fault);
  }
}

// Returns the complex ratio between the fundamental of a sampled-and-held sinusoid, which is a staircase, and the
// original sinusoid.
Complex hold(double omega, double period) {
  const Complex jwt{0.0, omega * period};
  return (1.0 - std::exp(-jwt)) / jwt;
}

// Standard deviation of a sinusoid's amplitude due to encoder quantisation. For amplitude A and quantum q, rounding adds
// (2 q / pi) sum over n of J1(2 pi n A / q) / n cos(2 pi n c) to the fundamental, where c is the place of the swing's centre
// in its count. J1 is about sqrt(q / (pi^2 n A)) cos(2 pi n A / q - 3 pi / 4), whose mean square is q / (2 pi^2 n A) over
// all amplitudes. With the centre on an edge or in the middle of a count, the sum's RMS is q sqrt(q / A) sqrt(2 zeta(3)) /
// pi^2; over all places of the centre it is smaller by sqrt 2.
double rounding_deviation(double amplitude, double quantum) {
  return amplitude > 0.0 ? 0.157 * quantum * std::sqrt(quantum / amplitude) : 0.0;
}

}  // namespace

const char* to_string(LeverAxis axis) noexcept {
  return axis == LeverAxis::x ? "x" : "y";
}

double FrequencySweep::Envelope::at(double time) const noexcept {
  const double s = std::clamp((time - start) / length, 0.0, 1.0);
  return from + (to - from) * (0.5 - 0.5 * std::cos(std::numbers::pi * s));
}

FrequencySweep::FrequencySweep(const SweepConfig& config, HapticDevice& device, LeverAxis axis, double period)
    : config_(validated(config, device.spec(), axis_index(axis), period)),
      device_(device),
      guard_({}, device.spec(), period),
      axis_(axis_index(axis)),
      period_(period),
      stop_(stop_on_arc(device.spec(), axis_)),
      max_amplitude_(config.force_fraction * device.spec().max_force[axis_]) {
  const double ratio = config.lowest / config.highest;
  for (int i = 0; i < config.points; ++i) {
    const double fraction = config.points > 1 ? i / (config.points - 1.0) : 0.0;
    tones_.push_back(make_tone(config.highest * std::pow(ratio, fraction), period));
  }
  response_.axis = axis;
  response_.period = period;
  response_.points.reserve(tones_.size());
  guard_.arm();
}

FrequencySweep::Tone FrequencySweep::make_tone(double frequency, double period) {
  const int periods = std::max(2, static_cast<int>(std::ceil(frequency * kMinWindowTime)));
  int samples = static_cast<int>(std::lround(periods / (frequency * period)));
  while (std::gcd(samples, periods) != 1) ++samples;
  return {periods / (samples * period), samples};
}

double FrequencySweep::progress() const noexcept {
  const auto seconds = [this](std::size_t tones) {
    double sum = 0.0;
    for (std::size_t i = 0; i < tones; ++i) sum += 2.0 * tones_[i].samples * period_ + 3.0 / tones_[i].frequency;
    return sum;
  };
  return done_ ? 1.0 : seconds(current_) / seconds(tones_.size());
}

bool FrequencySweep::step(std::int64_t now_ns) noexcept {
  if (done_) return false;
  const LeverReading reading = device_.read(now_ns);
  const bool fresh = is_fresh(reading);
  if (!is_finite(reading.position) || !is_finite(reading.hand_force)) {
    finish("a reading is not a number");
  } else if (fresh && guard_.state() == GuardState::running) {
    process_sample(reading);
  } else {
    send(commands_[cycles_ % commands_.size()], reading, fresh);  // repeats the newest command; it is 0 at first
  }
  return !done_;
}

bool FrequencySweep::is_fresh(const LeverReading& reading) noexcept {
  const bool fresh = cycles_ == 0 || reading.sequence != sequence_;
  sequence_ = reading.sequence;
  return fresh;
}

void FrequencySweep::process_sample(const LeverReading& reading) noexcept {
  update_time(reading.time_ns);
  const ArcSample here = locate(reading.position);
  check_stroke(here.position);
  if (!done_) send(wanted_force(here), reading, true);
  if (!done_) measure(here, reading);
}

void FrequencySweep::update_time(std::int64_t time_ns) noexcept {
  if (!started_) origin_ns_ = time_ns;
  time_ = 1e-9 * static_cast<double>(time_ns - origin_ns_);
  if (!started_) next_tone();
  started_ = true;
}

// Sends the force to the device through the guard. Passes no velocity to the guard, because the guard uses it only to
// damp the lever after a fault, and a fault ends the sweep.
void FrequencySweep::send(glm::dvec2 force, const LeverReading& reading, bool fresh) noexcept {
  GuardInput in;
  in.force = force;
  in.position = reading.position;
  in.fresh = fresh;
  const glm::dvec2 guarded = guard_.guard(in).force;
  if (guard_.state() >= GuardState::damped) return finish(fault_text(guard_.fault()));
  device_.write(guarded);
  commands_[++cycles_ % commands_.size()] = guarded;
}

FrequencySweep::ArcSample FrequencySweep::locate(glm::dvec2 plane) const noexcept {
  glm::dvec2 unit{0.0};
  unit[axis_] = 1.0;
  const double radius = device_.spec().yoke_radius;
  if (radius <= 0.0) return {plane[axis_], unit, unit};
  const double z = std::sqrt(std::max(1e-6 * radius * radius, radius * radius - glm::dot(plane, plane)));
  const PlanePose pose = plane_pose(plane.x / z, -plane.y / z);
  const glm::dvec2 arc = radius * glm::dvec2(std::atan(pose.a), -std::atan(pose.b));
  const glm::dvec2 to_arc{arc_force(pose, {1.0, 0.0})[axis_], arc_force(pose, {0.0, 1.0})[axis_]};
  return {arc[axis_], plane_force(pose, unit), to_arc};
}

void FrequencySweep::check_stroke(double position) noexcept {
  const double distance = std::abs(position);
  if (config_.literal) {
    if (distance >= stop_ - device_.spec().position_step && stage_ != Stage::fade) {
      record_point({tones_[current_].frequency, max_amplitude_}, PointEnd::hit_stop);
    }
    return;
  }
  if (distance > kStopFraction * stop_) {
    finish("the lever came too close to its stop");
  } else if (distance > kMaxOvershoot * config_.stroke_fraction * stop_ && !is_decreasing()) {
    is_reduced_ = true;
    ramp_to(0.5 * envelope_.at(time_));
  }
}

bool FrequencySweep::is_decreasing() const noexcept {
  return stage_ == Stage::fade || (stage_ == Stage::ramp && envelope_.to < envelope_.from);
}

// The force in the gate plane that drives only this axis: it acts along the arc of this axis and does no work on the
// other axis.
glm::dvec2 FrequencySweep::wanted_force(const ArcSample& here) const noexcept {
  const double phase = kTau * tones_[current_].frequency * (time_ - tone_start_);
  return envelope_.at(time_) * std::sin(phase) * here.plane_per_arc;
}

// In a window, adds the sample to the fit, with the command that was sent `delay` samples ago: the motors apply that
// command until the next sample. Otherwise starts the next stage once the ramp or fade has ended.
void FrequencySweep::measure(const ArcSample& here, const LeverReading& reading) noexcept {
  if (stage_ == Stage::window) {
    const DeviceSpec& spec = device_.spec();
    const std::uint64_t due = cycles_ + commands_.size() - static_cast<std::uint64_t>(spec.delay);
    const double held = glm::dot(here.arc_per_plane, commands_[due % commands_.size()]);
    const double hand = spec.measures_hand_force ? glm::dot(here.arc_per_plane, reading.hand_force) : 0.0;
    fit_.add(time_, {here.position, held, hand});
    if (fit_.samples() == tones_[current_].samples) end_window();
  } else if (time_ >= envelope_.start + envelope_.length) {
    if (stage_ == Stage::ramp) {
      begin_window();
    } else if (++current_ < tones_.size()) {
      next_tone();
    } else {
      finish({});
    }
  }
}

void FrequencySweep::end_window() noexcept {
  FrequencyPoint window = evaluate();
  const double difference = std::abs(window.response / last_window_.response - 1.0);
  const double noise =
      3.0 * std::hypot(window.deviation, last_window_.deviation, std::max(window.rounding, last_window_.rounding));
  const bool is_consistent = windows_ > 0 && difference <= std::max(kAgreement, noise);
  last_window_ = window;
  // A difference that noise does not explain shows that the response still changes.
  if (difference > noise) window.deviation = std::max(window.deviation, 0.5 * difference);
  window.deviation = std::max(window.deviation, kMinDeviation);
  if (is_consistent) {
    record_point(window, PointEnd::measured);
  } else if (++windows_ == kMaxWindows) {
    record_point(window, PointEnd::never_settled);
  } else {
    begin_window();
  }
}

FrequencyPoint FrequencySweep::evaluate() const noexcept {
  const double frequency = tones_[current_].frequency;
  const auto position = fit_.phasor(0), sent = fit_.phasor(1), hand = fit_.phasor(2);
  const Complex held = hold(kTau * frequency, period_) * sent.value;
  const Complex force = held + hand.value;  // eq (4)
  const double size = std::abs(position.value);
  const double rounding = rounding_deviation(size, device_.spec().position_step);
  FrequencyPoint point;
  point.frequency = frequency;
  point.amplitude = std::abs(sent.value);
  point.motion = size;
  point.bounded_by_stroke = is_reduced_ || envelope_.to < max_amplitude_;
  point.response = position.value / force;
  point.rounding = rounding / size;
  point.deviation = std::hypot(position.deviation / size, hand.deviation / std::abs(force));
  point.held = held / force;
  return point;
}

void FrequencySweep::record_point(FrequencyPoint point, PointEnd end) noexcept {
  point.end = end;
  response_.points.push_back(point);
  fade();
}

void FrequencySweep::next_tone() noexcept {
  const double omega = kTau * tones_[current_].frequency;
  tone_start_ = time_;
  is_reduced_ = false;
  envelope_ = {};
  ramp_to(config_.literal ? max_amplitude_ : std::min(max_amplitude_, amplitude_for_stroke(omega)));
}

// Predicts the force amplitude that produces the requested stroke at this frequency. The two frequencies measured last
// determine mass m, damping b and stiffness k in 1/G = k - m w^2 + j b w. If only one frequency has been measured, the
// response is assumed to grow with the square of the period, as it does above all resonances.
double FrequencySweep::amplitude_for_stroke(double omega) const noexcept {
  const double stroke = config_.stroke_fraction * stop_;
  const std::size_t known = response_.points.size();
  if (known == 0) return max_amplitude_;
  const FrequencyPoint& nearest = response_.points[known - 1];
  const double w1 = kTau * nearest.frequency;
  const Complex z1 = 1.0 / nearest.response;
  if (known == 1) return stroke * std::abs(z1) * omega * omega / (w1 * w1);
  const FrequencyPoint& second = response_.points[known - 2];
  const double w0 = kTau * second.frequency;
  const double mass = (z1.real() - (1.0 / second.response).real()) / (w0 * w0 - w1 * w1);
  const double spring = z1.real() + mass * w1 * w1;
  return stroke * std::abs(Complex(spring - mass * omega * omega, z1.imag() * omega / w1));
}

void FrequencySweep::ramp_to(double amplitude) noexcept {
  stage_ = Stage::ramp;
  windows_ = 0;
  envelope_ = {envelope_.length > 0.0 ? envelope_.at(time_) : 0.0, amplitude, time_,
               std::max(kMinRampTime, 2.0 / tones_[current_].frequency)};
}

void FrequencySweep::fade() noexcept {
  const bool at_stop = response_.points.back().end == PointEnd::hit_stop;
  stage_ = Stage::fade;
  envelope_ = {at_stop ? 0.0 : envelope_.at(time_), 0.0, time_,
               std::max(kMinRampTime, 1.0 / tones_[current_].frequency)};
}

void FrequencySweep::begin_window() noexcept {
  const Tone& tone = tones_[current_];
  stage_ = Stage::window;
  fit_.begin(kTau * tone.frequency, time_, tone.samples * period_);
}

void FrequencySweep::finish(std::string_view problem) noexcept {
  device_.release();
  response_.problem = problem;
  done_ = true;
}

FrequencyResponse sweep_frequencies(const SweepConfig& config, HapticDevice& device, LeverAxis axis, double period,
                                    std::int64_t& now_ns, const SweepProgress& progress) {
  constexpr int kStepsPerReport = 4096;
  const std::int64_t period_ns = std::llround(1e9 * period);
  FrequencySweep sweep(config, device, axis, period);
  for (int n = 0; sweep.step(now_ns); now_ns += period_ns) {
    if (progress && ++n % kStepsPerReport == 0) progress(sweep.progress());
  }
  now_ns += period_ns;
  return sweep.response();
}

}  // namespace gearshift::haptics
