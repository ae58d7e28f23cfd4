#include "tests/support/stick/stick_state.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "haptics/files/range_check.h"

namespace gearshift::test {
namespace {

constexpr double kDamperSpeed = 1.0;        // [m/s] speed at which the maximum damper coefficient makes the full force
constexpr std::uint64_t kJumpEvery = 50;    // reports
constexpr double kJump = 0.6;               // [1] fraction of the full deflection
constexpr std::uint8_t kHatCentred = 0x08;  // not pressed: outside the hat's range of 0 to 7

// Away from the user, Y increases on the gate but decreases on a stick.
glm::dvec2 flip_y(glm::dvec2 v) {
  return {v.x, -v.y};
}

EmulatedStickConfig checked(const EmulatedStickConfig& config) {
  haptics::require_between("EmulatedStick: half_travel", config.half_travel, 1e-3, 0.95 * config.lever.yoke.radius,
                           "m");
  haptics::require_between("EmulatedStick: full_force", config.full_force, 0.1, 1e4, "N");
  haptics::require_between("EmulatedStick: spring_stiffness", config.spring_stiffness, 0.0, 1e6, "N/m");
  haptics::require_between("EmulatedStick: plant_period", config.plant_period, 1e-6, 0.1, "s");
  haptics::require_between("EmulatedStick: input_interval", config.input_interval, 1e-4, 0.255, "s");
  haptics::require_between("EmulatedStick: delay", config.delay, 0.0, 1.0, "s");
  haptics::require_between("EmulatedStick: blocks", config.blocks, 0, 100);
  return config;
}

std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

haptics::SimulatedLeverConfig mechanism(const EmulatedStickConfig& config) {
  haptics::SimulatedLeverConfig lever = config.lever;
  lever.delay = 0;
  lever.encoder_counts = 0.0;
  lever.yoke.theta_limit = lever.yoke.phi_limit = std::asin(config.half_travel / lever.yoke.radius);
  lever.actuator.peak_force = lever.actuator.continuous_force = config.full_force;
  return lever;
}

// The lowest `bits` bits of the value, as in a report.
std::int64_t masked(std::int64_t value, int bits) {
  return value & ((std::int64_t{1} << bits) - 1);
}

}  // namespace

EmulatedStick::State::State(const EmulatedStickConfig& wanted, haptics::HandDriver& hand, const EmulatedFaults& wrong,
                            const std::uint64_t& held)
    : config(checked(wanted)),
      family(stick_family(config.family)),
      descriptor(stick_report_descriptor(config.family)),
      period_ns(nanoseconds(config.plant_period)),
      interval_ns(nanoseconds(config.input_interval)),
      delay_ns(nanoseconds(config.delay)),
      faults(wrong),
      held_buttons(held),
      lever(mechanism(config), period_ns, hand),
      firmware(family, config.habits, config.blocks, config.finite_refused) {}

bool EmulatedStick::State::accept_output(std::span<const std::uint8_t> report) {
  if (!firmware.accepts_output(report)) return false;
  outputs_.push_back({now_ns + delay_ns, {report.begin(), report.end()}});
  apply_due_outputs();
  apply_force();
  return true;
}

void EmulatedStick::State::apply_all_outputs() {
  for (Pending& output : outputs_) output.due_ns = plant_ns;
  apply_due_outputs();
  apply_force();
}

// Without a delay, output reports act at the caller's time. With a delay, they act when the simulated lever has reached
// their due time.
void EmulatedStick::State::apply_due_outputs() {
  const std::int64_t at_ns = delay_ns == 0 ? now_ns : plant_ns;
  while (!outputs_.empty() && outputs_.front().due_ns <= at_ns) {
    firmware.output(outputs_.front().report, plant_ns);
    outputs_.pop_front();
  }
}

void EmulatedStick::State::advance(std::int64_t to_ns) {
  if (!started_) begin(to_ns);
  now_ns = std::max(now_ns, to_ns);
  while (plant_ns + period_ns <= now_ns) step();
}

void EmulatedStick::State::begin(std::int64_t at_ns) {
  started_ = true;
  for (Pending& output : outputs_) output.due_ns += at_ns;
  now_ns = plant_ns = sample_ns_ = fetched_ns = at_ns;
  firmware.set_clock(at_ns);
  reading_ = lever.read(at_ns);
}

void EmulatedStick::State::step() {
  apply_force();
  reading_ = lever.read(plant_ns + period_ns);
  plant_ns += period_ns;
  apply_due_outputs();
  firmware.advance(plant_ns);
  firmware.set_supply(!faults.no_power, !faults.open_switch);
  apply_force();
  if (plant_ns - sample_ns_ < interval_ns) return;
  sample_ns_ += interval_ns * ((plant_ns - sample_ns_) / interval_ns);
  sample();
}

void EmulatedStick::State::power_off() {
  outputs_.clear();
  firmware.power_off();
  pending_report.reset();
  sent.clear();
  configuration = idle = 0;
  apply_force();
}

void EmulatedStick::State::on_bus_reset() {
  if (unplugged) power_off();
  unplugged = false;
}

DeviceMotion EmulatedStick::State::motion() const {
  return {flip_y(lever.true_position()) / config.half_travel, flip_y(lever.true_velocity()) / kDamperSpeed,
          config.spring_stiffness * config.half_travel / config.full_force};
}

// Applies the force of the effects to the simulated lever.
void EmulatedStick::State::apply_force() {
  const EffectForces effect_forces = firmware.forces(motion(), plant_ns);
  const glm::dvec2 constant = faults.constants * glm::dvec2(config.constant_sign) * effect_forces.constant;
  const glm::dvec2 spring = faults.conditions * glm::dvec2(config.spring_sign) * effect_forces.spring;
  const glm::dvec2 damper = faults.conditions * glm::dvec2(config.damper_sign) * effect_forces.damper;
  force = config.full_force * flip_y(glm::clamp(constant + spring + damper + effect_forces.centring, -1.0, 1.0));
  lever.write(force);
}

void EmulatedStick::State::sample() {
  ++samples_;
  if (faults.silent) return;
  const bool jumps = faults.jump && samples_ % kJumpEvery == 0;
  const double error = motion().deflection.x > 0.0 ? -kJump : kJump;
  StickReport report = with_faults(lever_report(jumps ? error : 0.0));
  if (config.reports_only_changes && report == sent && !pending_report) return;
  pending_report = std::move(report);
}

StickReport EmulatedStick::State::lever_report(double error) const {
  const LeverBytes& bytes = family.lever;
  const glm::dvec2 deflection = motion().deflection + glm::dvec2(error, 0.0);
  const auto counts = [&](double fraction) {
    const double value = bytes.low + 0.5 * (fraction + 1.0) * (bytes.high - bytes.low);
    return masked(static_cast<std::int64_t>(std::floor(std::clamp(value, bytes.low, bytes.high) + 0.5)), bytes.bits);
  };
  StickReport report(bytes.size, 0);
  report[0] = bytes.id;
  write_number(report, bytes.x, counts(deflection.x));
  write_number(report, bytes.y, counts(deflection.y));
  if (bytes.hat_at != 0) report[bytes.hat_at] = kHatCentred;
  const std::uint64_t hand = (reading_.pressed_down ? 1U : 0U) | (reading_.lifted ? 2U : 0U);
  report[bytes.buttons_at] = static_cast<std::uint8_t>(hand | held_buttons);  // buttons 1 to 8, which all families have
  const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(bytes.size) + config.habits.longer_input;
  report.resize(static_cast<std::size_t>(size));
  return report;
}

StickReport EmulatedStick::State::with_faults(StickReport report) {
  if (!faults.stuck) {
    stuck_.clear();
  } else if (stuck_.empty()) {
    stuck_ = report;
  }
  if (faults.stuck) report = stuck_;
  if (faults.wrong_length) report.pop_back();
  return report;
}

}  // namespace gearshift::test
