#include "haptics/hardware/device_calibration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glm/matrix.hpp>

#include "haptics/files/number_text.h"

namespace gearshift::haptics {
namespace {

constexpr double kRounding = 1e-9;      // [1] fraction of a cycle, tolerance for rounding errors
constexpr double kSlowestLoop = 100.0;  // [Hz]

std::string describe_too_slow(double answer, double period) {
  const double max_delay = (1.0 + kMaxLoopDelay) * period, rate = std::floor((1.0 + kMaxLoopDelay) / answer);
  const std::string sentence = "the stick responds after " + number_text(1e3 * answer, 1) + " ms, but at " +
                               number_text(1.0 / period, 0) + " Hz the loop compensates at most " +
                               number_text(1e3 * max_delay, 1) + " ms; ";
  if (rate < kSlowestLoop) return sentence + "the stick is too slow for any rate from 100 Hz up";
  return sentence + "a rate of " + number_text(rate, 0) + " Hz would work";
}

// Distance [m] per count, on the coarser side of the centre.
double step_of(const LeverAxisCalibration& axis) noexcept {
  if (axis.low == axis.high) return 0.0;
  return 0.5 * axis.travel / std::min(std::abs(axis.high - axis.centre), std::abs(axis.centre - axis.low));
}

AxisModel handle_of(const LeverAxisCalibration& axis) noexcept {
  return axis.handle.mass > 0.0 ? axis.handle : kUnmeasuredHandle;
}

double max_force_of(const LeverAxisCalibration& axis) noexcept {
  return axis.force_per_magnitude() * axis.max_magnitude();
}

// The part of the motors' force that is left for the knob, whatever its direction, if they also cancel their coupling.
double uncoupled_part(const DeviceCalibration& calibration, glm::dvec2 max_force) noexcept {
  const glm::dmat2 inverse = glm::inverse(force_coupling(calibration));
  double part = 1.0;
  for (int i = 0; i < 2; ++i) {
    const double needed = std::abs(inverse[0][i]) * max_force.x + std::abs(inverse[1][i]) * max_force.y;
    if (needed > 0.0) part = std::min(part, max_force[i] / needed);
  }
  return part;
}

double usable_stiffness_of(const LeverAxisCalibration& axis) noexcept {
  const bool is_usable = axis.spring_sign != 0 && axis.spring_stiffness >= kMinSpring && axis.spring_dead_band > 0.0;
  return is_usable ? axis.spring_stiffness : 0.0;
}

double usable_damping_of(const LeverAxisCalibration& axis) noexcept {
  return axis.damper_sign != 0 && axis.damper_strength >= kMinDamper ? axis.damper_strength : 0.0;
}

}  // namespace

double answer_time(const DeviceTiming& timing) noexcept {
  return timing.input_interval + timing.jitter + timing.output_interval + timing.delay;
}

// An axis that moves more than the other one by the same force is lighter.
glm::dmat2 force_coupling(const DeviceCalibration& calibration) noexcept {
  const LeverAxisCalibration &select = calibration.select, &shift = calibration.shift;
  const double mass_ratio =
      calibration.has_handle() && !calibration.select_by_position ? shift.handle.mass / select.handle.mass : 1.0;
  return {1.0, select.constant_coupling * mass_ratio, shift.constant_coupling / mass_ratio, 1.0};
}

int delay_cycles(const DeviceTiming& timing, double period) {
  const double answer = answer_time(timing);
  const double cycles = std::max(0.0, std::ceil(answer / period - kRounding) - 1.0);
  if (!(cycles <= kMaxLoopDelay)) throw std::invalid_argument(describe_too_slow(answer, period));
  return static_cast<int>(cycles);
}

DeviceSpec spec_of(const DeviceCalibration& calibration, double period) {
  const LeverAxisCalibration &select = calibration.select, &shift = calibration.shift;
  DeviceSpec spec;
  spec.max_force = calibration.has_polarity() ? glm::dvec2{max_force_of(select), max_force_of(shift)} : glm::dvec2{0.0};
  if (calibration.select_by_position) spec.max_force.x = 0.0;
  spec.max_force *= uncoupled_part(calibration, spec.max_force);
  spec.continuous_force = spec.max_force;  // not below max_force, because the firmware protects the motors
  spec.workspace = 0.5 * glm::dvec2{select.travel, shift.travel};
  spec.position_step = std::max(step_of(select), step_of(shift));
  spec.delay = delay_cycles(calibration.has_timing() ? calibration.timing : kUnmeasuredTiming, period);
  spec.axis_x = handle_of(select);
  spec.axis_y = handle_of(shift);
  if (!calibration.has_polarity()) return spec;
  spec.device_wall_stiffness = glm::dvec2(std::min(usable_stiffness_of(select), usable_stiffness_of(shift)));
  spec.device_wall_damping = glm::dvec2(std::min(usable_damping_of(select), usable_damping_of(shift)));
  return spec;
}

}  // namespace gearshift::haptics
