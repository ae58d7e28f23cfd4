#include "haptics/hardware/pid_lever.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>

#include "haptics/joystick/finite.h"

namespace gearshift {
namespace {

std::size_t index_of(const LeverReport& report, int usage) {
  for (std::size_t i = 0; i < report.axes.size(); ++i) {
    if (report.axes[i].usage.page == kGenericDesktop && report.axes[i].usage.id == usage) return i;
  }
  throw std::invalid_argument("the calibration speaks of an axis that this stick lacks: usage " +
                              std::to_string(usage) + " of the Generic Desktop page");
}

const DeviceCalibration& with_range(const DeviceCalibration& calibration) {
  if (!calibration.has_range())
    throw std::invalid_argument("the stick is not calibrated: where its stops are is not known");
  return calibration;
}

}  // namespace

LeverAxisMap::LeverAxisMap(const LeverAxisCalibration& axis, const BitField& field) noexcept
    : centre_(axis.centre),
      middle_(0.5 * static_cast<double>(field.min + field.max)),
      half_range_(0.5 * static_cast<double>(field.max - field.min)),
      below_(0.5 * axis.travel / (axis.centre - axis.low)),
      above_(0.5 * axis.travel / (axis.high - axis.centre)) {}

double LeverAxisMap::metres(double counts) const noexcept {
  const double away = counts - centre_;
  return away * (away * above_ > 0.0 ? above_ : below_);
}

double LeverAxisMap::counts(double metres) const noexcept {
  return centre_ + metres / (metres > 0.0 ? above_ : below_);
}

double LeverAxisMap::share(double metres) const noexcept {
  return std::clamp((counts(metres) - middle_) / half_range_, -1.0, 1.0);
}

PidLever::PidLever(const DeviceCalibration& calibration, PidDriver& driver, double period)
    : calibration_(with_range(calibration)),
      driver_(driver),
      spec_(spec_of(calibration, period)),
      session_(driver.see().session) {
  driver.expect_answer(answer_time(calibration.has_timing() ? calibration.timing : kUnmeasuredTiming));
  const bool has_motors = calibration.select.usage <= kUsageY.id && calibration.shift.usage <= kUsageY.id;
  if (!has_motors) spec_.max_force = spec_.continuous_force = spec_.own_stiffness = spec_.own_damping = glm::dvec2(0.0);
  axis_ = {make_axis(calibration.select, drives()), make_axis(calibration.shift, drives())};
  if (axis_[0].spring == 0.0 || axis_[1].spring == 0.0) {
    spec_.own_stiffness = glm::dvec2(0.0);
    axis_[0].spring = axis_[1].spring = 0.0;
  }
  if (axis_[0].damper == 0.0 || axis_[1].damper == 0.0) {
    spec_.own_damping = glm::dvec2(0.0);
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
  axis.sign = calibration.constant_sign;
  axis.spring =
      coefficient(PidEffect::spring, calibration.spring_sign, own_wall_stiffness(spec_), calibration.spring_stiffness);
  axis.damper =
      coefficient(PidEffect::damper, calibration.damper_sign, own_wall_damping(spec_), calibration.damper_strength);
  return axis;
}

// Of a condition that makes as much of its strongest as wanted. One that works the other way is turned round, where the
// device can say so. 0: it has none.
double PidLever::coefficient(PidEffect effect, int sign, double wanted, double strongest) const noexcept {
  const PidSetCondition& set = driver_.layout().set_condition;
  if (wanted == 0.0 || !set.exists() || !driver_.layout().makes(effect)) return 0.0;
  if (sign < 0 && set.positive_coefficient.min >= set.positive_coefficient.zero) return 0.0;
  return sign * wanted / strongest;
}

LeverReading PidLever::read(std::int64_t) noexcept {
  const PidSight sight = driver_.see();
  halted_ = sight.session != session_;
  session_ = sight.session;
  const auto place = [&](const Axis& axis) {
    return axis.map.metres(static_cast<double>(sight.counts.axis[axis.report]));
  };
  LeverReading reading;
  reading.sequence = sight.sequence;
  reading.time_ns = sight.time_ns;
  if (sight.sequence > 0) reading.position = {place(axis_[0]), place(axis_[1])};
  position_ = reading.position;
  reading.actuator_force = motor_force(sight, reading.position);
  reading.pressed_down = has_button(sight.counts, calibration_.press_button);
  reading.lifted = has_button(sight.counts, calibration_.lift_button);
  reading.stop = (sight.sequence > 0 && stop_held(sight.counts)) || halted_;
  return reading;
}

glm::dvec2 PidLever::motor_force(const PidSight& sight, glm::dvec2 position) const noexcept {
  glm::dvec2 force{0.0};
  if (!sight.actuators) return force;
  const glm::dvec2 depth = position - glm::clamp(position, walls_.low, walls_.high);
  for (int i = 0; i < 2; ++i) {
    const Axis& axis = axis_[static_cast<std::size_t>(i)];
    const bool walled = axis.spring != 0.0 && sight.spring[axis.motor].coefficient != 0.0;
    const double wall = walled ? walls_.share * spec_.own_stiffness[i] * depth[i] : 0.0;
    force[i] =
        std::clamp(axis.sign * sight.sent[axis.motor] * axis.full_force - wall, -axis.full_force, axis.full_force);
  }
  return force;
}

bool PidLever::has_button(const LeverCounts& counts, int button) const noexcept {
  return button > 0 && button <= static_cast<int>(kMostButtons) && (counts.buttons >> (button - 1) & 1) != 0;
}

bool PidLever::stop_held(const LeverCounts& counts) noexcept {
  const bool held = has_button(counts, calibration_.stop_button);
  stop_was_free_ = stop_was_free_ || !held;
  return held && stop_was_free_;
}

void PidLever::write(glm::dvec2 force) noexcept {
  if (!drives() || !is_finite(force)) force = glm::dvec2(0.0);
  for (int i = 0; i < 2; ++i) {
    const Axis& axis = axis_[static_cast<std::size_t>(i)];
    if (axis.full_force == 0.0) continue;
    wish_.constant[axis.motor] = axis.sign * std::clamp(force[i] / axis.full_force, -1.0, 1.0);
    if (force[i] != 0.0) wish_.enabled = true;
  }
  damp_in_walls();
  tell();
}

void PidLever::hold_walls(const LeverWalls& walls) noexcept {
  const bool is_sound =
      is_finite(walls.low) && is_finite(walls.high) && std::isfinite(walls.share) && std::isfinite(walls.damping);
  walls_ = is_sound ? walls : LeverWalls{};
  const double share = std::clamp(walls_.share, 0.0, 1.0);
  for (int i = 0; i < 2; ++i) {
    const Axis& axis = axis_[static_cast<std::size_t>(i)];
    if (axis.spring == 0.0) continue;
    const double low = axis.map.share(walls_.low[i]), high = axis.map.share(walls_.high[i]);
    PidSpring& spring = wish_.spring[axis.motor];
    spring = {0.5 * (low + high), 0.5 * std::abs(high - low), share * axis.spring, 1.0};
    if (spring.coefficient != 0.0) wish_.enabled = true;
  }
  tell();
}

// A damper knows no walls: it is turned on where the lever is in one, axis by axis.
void PidLever::damp_in_walls() noexcept {
  for (int i = 0; i < 2; ++i) {
    const Axis& axis = axis_[static_cast<std::size_t>(i)];
    const bool in_wall = position_[i] < walls_.low[i] || position_[i] > walls_.high[i];
    const double share = in_wall ? std::clamp(walls_.damping, 0.0, 1.0) : 0.0;
    if (axis.full_force > 0.0) wish_.damper[axis.motor] = share * axis.damper;
  }
}

// What the loop says in the cycle in which it learns of a new session was meant for the old one.
void PidLever::tell() noexcept {
  if (halted_) wish_ = {};
  driver_.wish(wish_);
}

void PidLever::release() noexcept {
  wish_ = {};
  walls_ = {};
  driver_.release();
}

}  // namespace gearshift
