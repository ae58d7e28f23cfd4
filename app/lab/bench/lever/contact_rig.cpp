#include "app/lab/bench/lever/contact_rig.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "haptics/gate/plain_aisle.h"
#include "haptics/loop/haptic_event.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

constexpr double kWall = 0.005;      // [m] the wall; this near the centre, plane and arc positions agree within 0.1 %
constexpr double kApproach = 0.015;  // [s] duration of steady motion before the contact
constexpr double kStill = 0.100;     // [s] rest before the motion, during which the loop arms and its filters settle

// Moves the lever to the wall at a steady speed, then stops there and pushes.
class CarryingHand final : public haptics::HandDriver {
 public:
  CarryingHand(const ContactCase& contact) : contact_(contact) {}
  haptics::HandTarget next(double, dvec2 lever) noexcept override {
    haptics::HandTarget target;
    target.position = lever;
    if (moving && !arrived && lever.x >= kWall) arrived = true;
    if (arrived) {
      target.position = {kWall, 0.0};
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
};

haptics::SimulatedRunConfig rig(const ContactCase& contact, double start) {
  haptics::SimulatedRunConfig config;
  config.haptics = contact.haptics;
  config.haptics.guard.ramp_time = 0.001;
  config.lever = contact.lever;
  config.lever.force_sensor.resolution_gw = 0.0;
  config.gate = haptics::plain_aisle(0.060, 0.030);
  config.gate.select_max = kWall;
  config.start = {start, 0.0};
  return config;
}

// Adds up energies during the lever's first contact with the wall.
class FirstContact {
 public:
  explicit FirstContact(const ContactCase& contact) : contact_(contact) {}

  void update(haptics::SimulatedRun& run, ContactResult& result) {
    const double x = run.lever().true_position().x, v = run.lever().true_velocity().x;
    if (began_ && !over_) {
      const double force = -run.loop().snapshot().f_a.x;
      result.energy += force * (x - x_);
      result.damped += contact_.lever.axis_x.damping * (x - x_) * (x - x_) / run.period();
    }
    if (!began_ && x > kWall) {
      began_ = true;
      const double mass = contact_.lever.axis_x.mass + contact_.lever.hand.mass;
      result.impact = 0.5 * mass * v_ * v_;
      speed_ = v_;
    }
    if (began_ && !over_ && x <= kWall && x_ > kWall) over_ = true, result.restitution = std::max(0.0, -v / speed_);
    x_ = x;
    v_ = v;
  }

 private:
  const ContactCase& contact_;
  bool began_ = false, over_ = false;
  double x_ = 0.0, v_ = 0.0, speed_ = 1.0;
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

}  // namespace

ContactResult run_contact(const ContactCase& contact) {
  CarryingHand hand(contact);
  const double period = haptics::period_s(contact.haptics);
  const double start = kWall - contact.speed * (kApproach + contact.phase * period);
  haptics::SimulatedRun run(rig(contact, start), hand);
  while (run.time() < kStill) run.step();
  hand.moving = true;
  run.lever().place({run.lever().true_position().x, 0.0}, {contact.speed, 0.0});

  ContactResult result;
  FirstContact first(contact);
  haptics::EventDetector detector;
  std::vector<haptics::HapticEvent> events;
  std::vector<double> position, motor, command;
  const double end = run.time() + kApproach + contact.duration;
  while (run.time() < end) {
    const haptics::HapticSnapshot& now = run.step();
    first.update(run, result);
    if (!command.empty()) result.force_step = std::max(result.force_step, std::abs(now.commanded.x - command.back()));
    position.push_back(run.lever().true_position().x);
    motor.push_back(now.f_a.x);
    command.push_back(now.commanded.x);
    detector.update(run.loop().published(), events);
    result.stiffness = now.wall_stiffness;
  }
  result.lowered = static_cast<int>(std::count_if(events.begin(), events.end(), [](const haptics::HapticEvent& event) {
    return event.kind == haptics::EventKind::stiffness_lowered;
  }));
  const auto samples = [&](double seconds) { return static_cast<std::size_t>(std::lround(seconds / period)); };
  result.stopped = run.loop().snapshot().fault == haptics::GuardFault::chatter;
  result.peak = *std::max_element(position.begin(), position.end()) - kWall;
  result.ripple = span(position, samples(0.2));
  result.force_ripple = span(command, samples(0.2));
  result.delivered = mean(motor, samples(0.05));
  result.displayed = result.delivered / (mean(position, samples(0.05)) - kWall);
  return result;
}

}  // namespace gearshift::lab
