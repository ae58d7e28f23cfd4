#include "app/lab/contact/contact_rig.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <utility>

#include "haptics/analysis/harmonic_fit.h"
#include "haptics/gate/plain_aisle.h"
#include "haptics/loop/haptic_event.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

constexpr double kWall = 0.005;    // [m] the wall; this near the centre, plane and arc positions agree within 0.1 %
constexpr double kNoForce = 1e-9;  // [N]
constexpr double kRise = 0.005;    // [s] window of the rate-hardness
constexpr double kPulseGain = 0.8, kOffWall = 0.030, kMinEntry = 0.03;  // [1], [s], [m/s] of an entry with a pulse
constexpr double kMaxDepth = 0.003,
                 kMaxSwing = 0.001;  // [m] mean depth and amplitude of the motion in the wall, and ...
constexpr double kDepthForce = 0.48,
                 kSwingForce = 0.16;               // [1] ... the fraction of the motors' force that each may need
constexpr double kPressed = 0.2;                   // [s] final part of a contact in which the pressed lever is measured
constexpr double kSettle = 1.0, kMinWindow = 2.0;  // [s]
constexpr double kMinPeriods = 4.0;                // [1] of a window
constexpr double kApproach = 0.015;                // [s] duration of steady motion before the contact
constexpr double kStill = 0.100;  // [s] rest before the motion, during which the loop arms and its filters settle

double wall_of(const ContactCase& contact) {
  const double counts = contact.lever.encoder_counts;
  return kWall + (counts > 0.0 ? contact.place * contact.lever.yoke.radius * std::numbers::pi / 180.0 / counts : 0.0);
}

// Moves the lever to the wall at a steady speed, then stops there and pushes.
class CarryingHand final : public haptics::HandDriver {
 public:
  explicit CarryingHand(const ContactCase& contact) : contact_(contact), wall_(wall_of(contact)) {}
  haptics::HandTarget next(double, dvec2 lever) noexcept override {
    haptics::HandTarget target;
    target.position = lever;
    if (moving && !arrived && lever.x >= wall_) arrived = true;
    if (arrived) {
      target.position = {wall_, 0.0};
      target.push = {contact_.push, 0.0};
    } else if (moving) {
      const haptics::AxisModel& axis = contact_.lever.axis_x;
      target.velocity = {contact_.speed, 0.0};
      target.push = {axis.damping * contact_.speed + axis.stiffness * lever.x, 0.0};
    } else {
      target.push = {contact_.lever.axis_x.stiffness * lever.x, 0.0};
    }
    return target;
  }

  bool moving = false;
  bool arrived = false;

 private:
  const ContactCase& contact_;
  double wall_;
};

// Presses the lever into the wall with a force that varies with time.
class SwingingHand final : public haptics::HandDriver {
 public:
  SwingingHand(double wall, double push) : mean(push), wall_(wall) {}
  haptics::HandTarget next(double time, dvec2) noexcept override {
    haptics::HandTarget target;
    target.position = {wall_, 0.0};
    target.push = {mean + amplitude * std::sin(2.0 * std::numbers::pi * frequency * time), 0.0};
    return target;
  }

  double mean, amplitude = 0.0;  // [N]
  double frequency = 0.0;        // [Hz]

 private:
  double wall_;
};

haptics::SimulatedRunConfig rig(const ContactCase& contact, double start) {
  haptics::SimulatedRunConfig config;
  config.haptics = contact.haptics;
  config.haptics.guard.ramp_time = 0.001;
  config.lever = contact.lever;
  config.lever.force_sensor.resolution_gw = 0.0;
  config.gate = haptics::plain_aisle(0.060, 0.030);
  config.gate.select_max = wall_of(contact);
  config.start = {start, 0.0};
  return config;
}

// Adds a force on each entry into the wall, in proportion to the momentum that it must stop:
// Katherine Kuchenbecker, Jonathan Fiene, Guenter Niemeyer. Improving Contact Realism through Event-Based Haptic Feedback.
// 2006
class EventPulse final : public haptics::LeverLoad {
 public:
  explicit EventPulse(const ContactCase& contact) : mass_(contact.lever.axis_x.mass), decay_(contact.pulse) {}
  haptics::LeverOutput step(const haptics::LeverInput& in, double period) noexcept override {
    const bool inside = in.position.x > in.proxy.x, enters = inside && off_wall_ > kOffWall;
    const double speed =
        period > 0.0 ? (in.position.x - position_) / period : 0.0;  // the smooth velocity would be late
    position_ = in.position.x;
    off_wall_ = inside ? 0.0 : off_wall_ + period;
    strength_ *= decay_ > 0.0 ? std::exp(-period / decay_) : 0.0;
    if (decay_ > 0.0 && enters && speed > kMinEntry) strength_ = kPulseGain * mass_ * speed / decay_;
    haptics::LeverOutput out;
    if (speed > 0.0) out.force.x = -strength_;
    return out;
  }
  const char* replay_parameters() const noexcept override { return "event pulse"; }

 private:
  double mass_, decay_;
  double position_ = 0.0, off_wall_ = 0.0, strength_ = 0.0;
};

// Fastest rise within kRise of a force that is sampled every period. [N/s]
double fastest_rise(const std::vector<double>& force, double period) {
  const auto at = [&](double sample) {
    const auto below = static_cast<std::size_t>(std::min(sample, static_cast<double>(force.size() - 1)));
    const std::size_t above = std::min(below + 1, force.size() - 1);
    return std::lerp(force[below], force[above], sample - static_cast<double>(below));
  };
  double fastest = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i)
    fastest = std::max(fastest, (at(static_cast<double>(i) + kRise / period) - force[i]) / kRise);
  return fastest;
}

// Measures the lever's first contact with the wall. It lasts from the first force of the motors to the last, also where
// they act outside the wall, because they hold a force for a period and may be late.
class FirstContact {
 public:
  explicit FirstContact(const ContactCase& contact) : contact_(contact), wall_(wall_of(contact)) {}

  void update(haptics::SimulatedRun& run, ContactResult& result) {
    const double x = run.lever().true_position().x, v = run.lever().true_velocity().x;
    const double force = -run.loop().snapshot().f_a.x;  // held since the last update
    const bool enters = x > wall_ && x_ <= wall_, leaves = x <= wall_ && x_ > wall_;
    over_ = over_ || (left_ && (enters || std::abs(force) < kNoForce));
    if (over_) return;
    entered_ = entered_ || enters;
    left_ = left_ || (entered_ && leaves);
    result.energy += force * (x - x_);
    if (entered_) result.damped += contact_.lever.axis_x.damping * (x - x_) * (x - x_) / run.period();
    if (left_) result.restitution = std::max(0.0, -v / contact_.speed);
    if (!left_) rise_.push_back(-force);
    x_ = x;
  }

  double hardness(double period) const { return rise_.empty() ? 0.0 : fastest_rise(rise_, period) / contact_.speed; }

 private:
  const ContactCase& contact_;
  double wall_;
  bool entered_ = false, left_ = false, over_ = false;
  double x_ = 0.0;
  std::vector<double> rise_;  // [N] until the lever leaves the wall
};

double span(const std::vector<double>& sample, std::size_t last) {
  const auto from = sample.end() - static_cast<std::ptrdiff_t>(std::min(last, sample.size()));
  const auto [low, high] = std::minmax_element(from, sample.end());
  return *high - *low;
}

double mean(const std::vector<double>& sample, std::size_t last) {
  double sum = 0.0;
  for (std::size_t i = sample.size() - last; i < sample.size(); ++i) sum += sample[i];
  return sum / static_cast<double>(last);
}

double rms_change(const std::vector<double>& sample, std::size_t last, double period) {
  double sum = 0.0;
  for (std::size_t i = sample.size() - last; i < sample.size(); ++i)
    sum += (sample[i] - sample[i - 1]) * (sample[i] - sample[i - 1]);
  return std::sqrt(sum / static_cast<double>(last)) / period;
}

}  // namespace

haptics::AdmittedTuning admitted_wall(const ContactCase& contact) {
  haptics::IdleHand nobody;
  return haptics::SimulatedRun(rig(contact, 0.0), nobody).loop().admitted();
}

namespace {

// The same contact with the tuning that the program admits on this lever, and without what is not the wall's: errors of
// the device, the reversal limiter and the damping that acts everywhere.
ContactCase wall_alone(ContactCase contact) {
  contact.lever.model_error = contact.lever.period_jitter = 0.0;
  const haptics::AdmittedTuning admitted = admitted_wall(contact);
  contact.haptics.tuning = admitted.tuning;
  contact.haptics.contact.hold = admitted.hold;
  contact.haptics.tuning.aisle_damping = contact.haptics.tuning.limit_damping = 0.0;
  contact.haptics.contact.allow_unstable = true;
  contact.haptics.contact.reversal_limiter = false;
  return contact;
}

// Depth [m] at which this wall needs `fraction` of the motors' force.
double depth_at(const ContactCase& contact, double fraction) {
  return fraction * contact.lever.actuator.peak_force / contact.haptics.tuning.wall_stiffness;
}

// Amplitude of the push that swings lever and hand in the wall by `swing` [m]. [N]
double swinging_push(const ContactCase& contact, double swing, double frequency) {
  const haptics::AxisModel& axis = contact.lever.axis_x;
  const haptics::HandImpedance& hand = contact.lever.hand;
  const double omega = 2.0 * std::numbers::pi * frequency;
  const double spring = contact.haptics.tuning.wall_stiffness + axis.stiffness + hand.stiffness;
  return swing * std::abs(std::complex<double>(spring - omega * omega * (axis.mass + hand.mass),
                                               omega * (axis.damping + hand.damping)));
}

// Fits motion and motor force of a run whose hand swings. A force is recorded at the end of the period over which it was
// held, so its wave is half a period earlier, and weaker by sin(u)/u with u = omega T / 2.
DynamicStiffness fit_swing(haptics::SimulatedRun& run, double frequency) {
  const double omega = 2.0 * std::numbers::pi * frequency, half = 0.5 * omega * run.period();
  const double periods = std::max(kMinPeriods, std::ceil(kMinWindow * frequency)), length = periods / frequency;
  const double settled = run.time() + kSettle;
  while (run.time() < settled) run.step();
  const double start = run.time();
  haptics::HarmonicFit fit;
  fit.begin(omega, start, length);
  double cycles = 0.0, saturated = 0.0;
  while (run.time() < start + length - 0.5 * run.period()) {
    const haptics::HapticSnapshot& now = run.step();
    const double force = now.f_a.x;
    saturated += (now.flags & haptics::kFlagSaturated) != 0 ? 1.0 : 0.0;
    cycles += 1.0;
    fit.add(run.time(), {run.lever().true_position().x, force, 0.0});
  }
  const std::complex<double> force = fit.phasor(1).value * std::polar(std::sin(half) / half, half);
  const std::complex<double> z = force / fit.phasor(0).value;
  return {frequency, z.real(), z.imag() / omega, saturated / cycles};
}

}  // namespace

std::vector<DynamicStiffness> dynamic_stiffness(const ContactCase& wanted, std::span<const double> frequencies) {
  const ContactCase contact = wall_alone(wanted);
  const double wall = wall_of(contact), spring = contact.haptics.tuning.wall_stiffness + contact.lever.hand.stiffness;
  const double depth = std::min(kMaxDepth, depth_at(contact, kDepthForce));
  const double swing = std::min(kMaxSwing, depth_at(contact, kSwingForce));
  std::vector<DynamicStiffness> found;
  for (const double frequency : frequencies) {
    SwingingHand hand(wall, depth * spring + contact.lever.axis_x.stiffness * (wall + depth));
    haptics::SimulatedRun run(rig(contact, wall), hand);
    while (run.time() < kSettle) run.step();
    // A whole number of sampling periods per swing.
    hand.frequency = 1.0 / (run.period() * std::round(1.0 / (frequency * run.period())));
    hand.amplitude = swinging_push(contact, swing, hand.frequency);
    found.push_back(fit_swing(run, hand.frequency));
    found.back().frequency = frequency;
  }
  return found;
}

ContactResult run_contact(const ContactCase& contact) {
  CarryingHand hand(contact);
  const double period = haptics::period_s(contact.haptics);
  const double wall = wall_of(contact), start = wall - contact.speed * (kApproach + contact.phase * period);
  EventPulse pulse(contact);
  haptics::SimulatedRun run(rig(contact, start), hand, &pulse);
  while (run.time() < kStill) run.step();
  hand.moving = true;
  run.lever().place({run.lever().true_position().x, 0.0}, {contact.speed, 0.0});

  ContactResult result;
  result.impact = 0.5 * (contact.lever.axis_x.mass + contact.lever.hand.mass + contact.lever.hand.finger_mass) *
                  contact.speed * contact.speed;
  FirstContact first(contact);
  haptics::EventDetector detector;
  std::vector<haptics::HapticEvent> events;
  std::vector<double> position, velocity, motor, command;
  const double end = run.time() + kApproach + contact.duration;
  while (run.time() < end) {
    const haptics::HapticSnapshot& now = run.step();
    first.update(run, result);
    // A free lever is let go at the first force, which the half-sample and observer holds render before the wall.
    if (contact.push == 0.0 && std::abs(now.f_a.x) > kNoForce) hand.arrived = true;
    if (!command.empty()) result.force_step = std::max(result.force_step, std::abs(now.commanded.x - command.back()));
    position.push_back(run.lever().true_position().x);
    velocity.push_back(run.lever().true_velocity().x);
    motor.push_back(now.f_a.x);
    command.push_back(now.commanded.x);
    detector.update(run.loop().published(), events);
    result.stiffness = now.wall_stiffness;
    result.saturated = result.saturated || (run.time() > end - kPressed && (now.flags & haptics::kFlagSaturated) != 0);
  }
  result.lowered = static_cast<int>(std::count_if(events.begin(), events.end(), [](const haptics::HapticEvent& event) {
    return event.kind == haptics::EventKind::stiffness_lowered;
  }));
  const auto samples = [&](double seconds) { return static_cast<std::size_t>(std::lround(seconds / period)); };
  result.hardness = first.hardness(period);
  result.stopped = run.loop().snapshot().fault == haptics::GuardFault::chatter;
  result.peak = *std::max_element(position.begin(), position.end()) - wall;
  result.ripple = span(position, samples(kPressed));
  result.force_ripple = span(command, samples(kPressed));
  result.delivered = mean(motor, samples(0.05));
  result.displayed = result.delivered / (mean(position, samples(0.05)) - wall);
  result.tremble = rms_change(velocity, samples(kPressed), period);
  return result;
}

}  // namespace gearshift::lab
