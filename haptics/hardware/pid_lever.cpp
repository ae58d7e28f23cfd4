#include "haptics/hardware/pid_lever.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "haptics/joystick/finite.h"

namespace gearshift::haptics {
namespace {

constexpr double kNearlyFull = 0.9;    // [1] of the full force
constexpr double kFarAgainst = 0.006;  // [m]
constexpr double kStrong = 10.0;       // [N] a hand often overpowers a weaker stick
constexpr int kDoubtfulPushes = 2;     // in a row

std::size_t index_of(const LeverReport& report, int usage) {
  for (std::size_t i = 0; i < report.axes.size(); ++i) {
    if (report.axes[i].usage.page == kGenericDesktop && report.axes[i].usage.id == usage) return i;
  }
  throw std::invalid_argument("the calibration names an axis that this stick does not have (usage " +
                              std::to_string(usage) + " of the Generic Desktop page)");
}

const DeviceCalibration& with_range(const DeviceCalibration& calibration) {
  if (!calibration.has_range())
    throw std::invalid_argument("the stick is not calibrated, because its stops are not known");
  return calibration;
}

const DeviceTiming& timing_of(const DeviceCalibration& calibration) noexcept {
  return calibration.has_timing() ? calibration.timing : kUnmeasuredTiming;
}

ForceWatch watch_of(const DeviceCalibration& calibration, DeviceSpec spec) noexcept {
  spec.axis_x.stiffness += calibration.select.own_spring;
  spec.axis_y.stiffness += calibration.shift.own_spring;
  return {spec, calibration.timing.delay};
}

StickProblem problem_of(ForceFault fault, StickFault doubt) noexcept {
  if (fault != ForceFault::silent) return StickProblem::reversed;
  if (doubt == StickFault::no_power) return StickProblem::no_power;
  return doubt == StickFault::safety_switch ? StickProblem::safety_switch : StickProblem::silent;
}

}  // namespace

LeverAxisMap::LeverAxisMap(const LeverAxisCalibration& axis, const BitField& field) noexcept
    : centre_(axis.centre),
      middle_(0.5 * static_cast<double>(field.min + field.max)),
      half_range_(0.5 * static_cast<double>(field.max - field.min)),
      below_(0.5 * axis.travel / (axis.centre - axis.low)),
      above_(0.5 * axis.travel / (axis.high - axis.centre)) {}

double LeverAxisMap::metres(double counts) const noexcept {
  const double offset = counts - centre_;
  return offset * (offset * above_ > 0.0 ? above_ : below_);
}

double LeverAxisMap::counts(double metres) const noexcept {
  return centre_ + metres / (metres > 0.0 ? above_ : below_);
}

double LeverAxisMap::deflection(double metres) const noexcept {
  return std::clamp((counts(metres) - middle_) / half_range_, -1.0, 1.0);
}

double LeverAxisMap::position(double deflection) const noexcept {
  return metres(middle_ + deflection * half_range_);
}

PidLever::PidLever(const DeviceCalibration& calibration, PidDriver& driver, double period, StopButton* stop)
    : calibration_(with_range(calibration)),
      driver_(driver),
      spec_(spec_of(calibration, period)),
      coupling_(force_coupling(calibration)),
      uncoupling_(glm::inverse(coupling_)),
      session_(driver.state().session),
      watch_(watch_of(calibration, spec_)),
      stop_(stop != nullptr ? *stop : own_stop_) {
  driver.set_style(calibration.style);
  driver.expect_answer(answer_time(timing_of(calibration)));
  const bool has_motors = calibration.select.usage <= kUsageY.id && calibration.shift.usage <= kUsageY.id;
  if (!has_motors)
    spec_.max_force = spec_.continuous_force = spec_.device_wall_stiffness = spec_.device_wall_damping =
        glm::dvec2(0.0);
  axis_ = {make_axis(calibration.select, drives() && !calibration.select_by_position),
           make_axis(calibration.shift, drives())};
  if (axis_[0].spring == 0.0 || axis_[1].spring == 0.0) {
    spec_.device_wall_stiffness = glm::dvec2(0.0);
    axis_[0].spring = axis_[1].spring = 0.0;
  }
  if (axis_[0].damper == 0.0 || axis_[1].damper == 0.0) {
    spec_.device_wall_damping = glm::dvec2(0.0);
    axis_[0].damper = axis_[1].damper = 0.0;
  }
}

PidLever::Axis PidLever::make_axis(const LeverAxisCalibration& calibration, bool drives) const {
  Axis axis;
  axis.report = index_of(driver_.lever_report(), calibration.usage);
  axis.map = LeverAxisMap(calibration, driver_.lever_report().axes[axis.report].field);
  if (!drives) return axis;
  axis.motor = calibration.usage == kUsageX.id ? 0 : 1;
  axis.full_force = calibration.full_force;
  axis.per_magnitude = calibration.force_per_magnitude();
  axis.limit = calibration.max_magnitude();
  axis.sign = calibration.constant_sign;
  axis.spring = coefficient(PidEffect::spring, calibration.spring_sign, usable_wall_stiffness(spec_),
                            calibration.spring_stiffness);
  if (calibration.spring_dead_band > 0.0) axis.dead_band = calibration.spring_dead_band;
  axis.spring_strength = calibration.spring_sign * calibration.spring_stiffness;
  axis.damper_strength = calibration.damper_sign * calibration.damper_strength;
  axis.damper =
      coefficient(PidEffect::damper, calibration.damper_sign, usable_wall_damping(spec_), calibration.damper_strength);
  return axis;
}

// Signed coefficient for a stiffness or damping of `wanted`; `strongest` is the value at coefficient 1. An effect with
// inverted polarity needs a negative coefficient. Returns 0 if the device cannot encode this coefficient or lacks the
// effect.
double PidLever::coefficient(PidEffect effect, int sign, double wanted, double strongest) const noexcept {
  const PidSetCondition& set = driver_.layout().set_condition;
  if (wanted == 0.0 || !set.exists() || !driver_.layout().has_effect(effect)) return 0.0;
  if (sign < 0 && set.positive_coefficient.min >= set.positive_coefficient.zero) return 0.0;
  return sign * wanted / strongest;
}

LeverReading PidLever::read(std::int64_t) noexcept {
  const StickState state = driver_.state();
  halted_ = state.session != session_;
  session_ = state.session;
  const auto position_of = [&](const Axis& axis) {
    return axis.map.metres(static_cast<double>(state.counts.axis[axis.report]));
  };
  LeverReading reading;
  reading.sequence = state.sequence;
  reading.time_ns = state.time_ns;
  if (state.sequence > 0) reading.position = {position_of(axis_[0]), position_of(axis_[1])};
  reading.actuator_force = motor_force(state, reading.position);
  if (state.doubt == StickFault::none) watch_full_force(reading.position - position_, reading.actuator_force);
  position_ = reading.position;
  reading.pressed_down = has_button(state.counts, calibration_.buttons.press);
  reading.lifted = has_button(state.counts, calibration_.buttons.lift);
  reading.stop = (state.sequence > 0 && is_stop_pressed(state.counts)) || halted_;
  if (drives_otherwise(state, reading)) {
    driver_.report(problem_of(watch_.fault(state.doubt != StickFault::none), state.doubt));
    release();
    watch_.reset();
    reading.stop = true;
  }
  return reading;
}

bool PidLever::drives_otherwise(const StickState& state, const LeverReading& reading) noexcept {
  // With a wrong delay, forces and motion do not belong together.
  if (!state.actuators || state.sequence == 0 || !calibration_.has_timing()) {
    watch_.pause();
    return false;
  }
  watch_.on_output(forces_of(state), state.sent_ns);
  watch_.on_reading(reading.position, reading.time_ns);
  return watch_.fault(state.doubt != StickFault::none) != ForceFault::none;
}

glm::dvec2 PidLever::constant_force(const StickState& state) const noexcept {
  const auto force = [&](const Axis& axis) { return axis.sign * state.sent[axis.motor] * axis.per_magnitude; };
  return coupling_ * glm::dvec2(force(axis_[0]), force(axis_[1]));
}

// A stick without power may not say so, and a hand that is stronger than the stick moves the lever in nearly the same way,
// so this only asks whether the force was felt: if the watch finds it likely in two pushes in a row that no motor acts.
void PidLever::watch_full_force(glm::dvec2 moved, glm::dvec2 force) noexcept {
  for (int i = 0; i < 2; ++i) {
    const bool is_full = spec_.max_force[i] >= kStrong && std::abs(force[i]) > kNearlyFull * spec_.max_force[i];
    if (is_full && moved[i] * force[i] < 0.0) against_[i] += std::abs(moved[i]);
    const bool is_far = against_[i] > kFarAgainst;
    bool& is_doubtful = is_doubtful_[static_cast<std::size_t>(i)];
    is_doubtful = is_doubtful || (is_full && is_far && watch_.may_be_silent());
    const int doubtful_pushes = is_doubtful ? doubtful_pushes_ + 1 : 0;
    if (is_far && (doubtful_pushes >= kDoubtfulPushes || !calibration_.has_timing()))
      driver_.report_once(StickProblem::overpowered, std::lround(1e3 * against_[i]));
    if (is_full) continue;
    if (is_far) doubtful_pushes_ = doubtful_pushes;
    against_[i] = 0.0;
    is_doubtful = false;
  }
}

StickForces PidLever::forces_of(const StickState& state) const noexcept {
  StickForces forces;
  const glm::dvec2 constant = constant_force(state);
  for (std::size_t i = 0; i < 2; ++i) {
    const Axis& axis = axis_[i];
    const PidSpring& spring = state.spring[axis.motor];
    const double half_width = axis.dead_band * spring.dead_band;
    const double a = axis.map.position(spring.centre - half_width), b = axis.map.position(spring.centre + half_width);
    forces[i] = {constant[static_cast<int>(i)], std::min(a, b), std::max(a, b),
                 axis.spring_strength * spring.coefficient, axis.damper_strength * state.damper[axis.motor]};
  }
  return forces;
}

glm::dvec2 PidLever::motor_force(const StickState& state, glm::dvec2 position) const noexcept {
  glm::dvec2 force{0.0};
  if (!state.actuators) return force;
  const glm::dvec2 depth = position - glm::clamp(position, walls_.low, walls_.high), constant = constant_force(state);
  for (int i = 0; i < 2; ++i) {
    const Axis& axis = axis_[static_cast<std::size_t>(i)];
    const bool has_wall = axis.spring != 0.0 && state.spring[axis.motor].coefficient != 0.0;
    const double wall = has_wall ? walls_.stiffness_fraction * spec_.device_wall_stiffness[i] * depth[i] : 0.0;
    force[i] = std::clamp(constant[i] - wall, -axis.full_force, axis.full_force);
  }
  return force;
}

bool PidLever::has_button(const LeverCounts& counts, int button) const noexcept {
  return button > 0 && button <= static_cast<int>(kMaxButtons) && (counts.buttons >> (button - 1) & 1) != 0;
}

bool PidLever::is_stop_pressed(const LeverCounts& counts) noexcept {
  const bool held = has_button(counts, calibration_.buttons.stop);
  stop_.was_released = stop_.was_released || !held;
  return held && stop_.was_released;
}

void PidLever::write(glm::dvec2 force) noexcept {
  if (!drives() || !is_finite(force)) force = glm::dvec2(0.0);
  const glm::dvec2 pushed = uncoupling_ * force;
  for (int i = 0; i < 2; ++i) {
    const Axis& axis = axis_[static_cast<std::size_t>(i)];
    if (axis.full_force == 0.0) continue;
    command_.constant[axis.motor] = axis.sign * std::clamp(pushed[i] / axis.per_magnitude, -axis.limit, axis.limit);
    if (pushed[i] != 0.0) command_.enabled = true;
  }
  damp_in_walls();
  send();
}

void PidLever::set_device_walls(const LeverWalls& walls) noexcept {
  const bool is_valid = is_finite(walls.low) && is_finite(walls.high) && std::isfinite(walls.stiffness_fraction) &&
                        std::isfinite(walls.damping_fraction);
  walls_ = is_valid ? walls : LeverWalls{};
  const double stiffness_fraction = std::clamp(walls_.stiffness_fraction, 0.0, 1.0);
  for (int i = 0; i < 2; ++i) {
    const Axis& axis = axis_[static_cast<std::size_t>(i)];
    if (axis.spring == 0.0) continue;
    const double low = axis.map.deflection(walls_.low[i]), high = axis.map.deflection(walls_.high[i]);
    PidSpring& spring = command_.spring[axis.motor];
    spring = {0.5 * (low + high), 0.5 * std::abs(high - low) / axis.dead_band, stiffness_fraction * axis.spring, 1.0};
    if (spring.coefficient != 0.0) command_.enabled = true;
  }
  send();
}

// A device damper acts at every position, so each axis's damper is switched on only while the lever is inside a wall.
void PidLever::damp_in_walls() noexcept {
  for (int i = 0; i < 2; ++i) {
    const Axis& axis = axis_[static_cast<std::size_t>(i)];
    const bool in_wall = position_[i] < walls_.low[i] || position_[i] > walls_.high[i];
    const double damping_fraction = in_wall ? std::clamp(walls_.damping_fraction, 0.0, 1.0) : 0.0;
    if (axis.full_force > 0.0) command_.damper[axis.motor] = damping_fraction * axis.damper;
  }
}

// Sends the command. If the session has changed in this cycle (halted_), the loop computed the command for the old
// session, so an empty command is sent instead.
void PidLever::send() noexcept {
  command_.holds_spring = calibration_.holds_spring;
  if (calibration_.select_by_position) command_.pushes[1 - axis_[1].motor] = false;
  if (halted_) command_ = {};
  driver_.command(command_);
}

void PidLever::release() noexcept {
  command_ = {};
  walls_ = {};
  against_ = {};
  is_doubtful_ = {};
  driver_.release();
}

}  // namespace gearshift::haptics
