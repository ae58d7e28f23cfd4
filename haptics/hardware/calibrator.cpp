// Calibration steps in which the user moves the lever. Measurements without a hand are in calibrator_forces.cpp.
#include "haptics/hardware/calibrator.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "haptics/files/number_text.h"

namespace gearshift::haptics {
namespace {

constexpr double kStartTime = 0.5, kEndTime = 0.3;  // [s] averaging time before the push, and at its end
constexpr double kMinMotion = 0.20;                 // [1] fraction of the axis's logical range
constexpr double kMaxCrossMotion = 0.5;             // [1] motion of another axis divided by the pushed axis's motion
constexpr double kMaxCorrelation = 0.9;             // [1] correlation of the two axes' positions
constexpr double kReleaseTime = 1.0;                // [s] last part of the range measurement, after the release

std::string format_percent(double fraction) {
  return number_text(100.0 * fraction, 0) + " %";
}

double middle_of_three(double a, double b, double c) noexcept {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Returns the running median of three readings, which removes single outliers.
std::vector<double> without_jumps(const std::vector<double>& positions) {
  std::vector<double> smooth;
  for (std::size_t i = 2; i < positions.size(); ++i)
    smooth.push_back(middle_of_three(positions[i - 2], positions[i - 1], positions[i]));
  return smooth;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

double require_within(double value, double min, double max, const std::string& what, const std::string& unit) {
  if (value >= min && value <= max) return value;
  throw CalibrationRefused(what + " of " + number_text(value, 4) + " " + unit +
                           " is not possible; it must be between " + number_text(min, 4) + " and " +
                           number_text(max, 4) + " " + unit);
}

std::string counts_text(const LeverAxisCalibration& axis) {
  return number_text(axis.low, 0) + " to " + number_text(axis.high, 0) + " counts, at rest " +
         number_text(axis.centre, 0);
}

}  // namespace

std::vector<CalibrationStep> missing_steps(const DeviceCalibration& calibration, bool springs, bool dampers) {
  std::vector<CalibrationStep> missing;
  if (!calibration.has_stops()) missing.push_back(CalibrationStep::range);
  if (!calibration.has_travel() || !calibration.has_force()) missing.push_back(CalibrationStep::numbers);
  if (!calibration.has_polarity() || calibration.effects_at_once == 0) missing.push_back(CalibrationStep::polarity);
  if (!calibration.has_timing()) missing.push_back(CalibrationStep::timing);
  if (!calibration.has_strength()) missing.push_back(CalibrationStep::strength);
  if (!calibration.has_handle()) missing.push_back(CalibrationStep::handle);
  const bool has_cross_talk = calibration.select.spring_cross_talk >= 0.0 && calibration.shift.spring_cross_talk >= 0.0;
  const bool lacks_springs = springs && (!calibration.has_springs() || !has_cross_talk);
  const bool has_dampers = calibration.select.damper_sign != 0 && calibration.shift.damper_sign != 0;
  const bool lacks_dampers = !springs && dampers && !has_dampers && calibration.dampers_refused.empty();
  if (!calibration.select_by_position && (lacks_springs || lacks_dampers)) missing.push_back(CalibrationStep::springs);
  return missing;
}

Calibrator::Calibrator(PidDriver& driver, CalibrationTick tick, const DeviceCalibration& known, bool has_springs)
    : driver_(driver), tick_(std::move(tick)), has_springs_(has_springs), calibration_(known) {
  if (!known.has_stops()) return;
  found_[0] = {known.select.usage, known.select.high > known.select.low ? 1 : -1};
  found_[1] = {known.shift.usage, known.shift.high > known.shift.low ? 1 : -1};
}

std::size_t Calibrator::report_axis(int usage) const {
  const std::vector<HidAxis>& axes = driver_.lever_report().axes;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].usage.page == kGenericDesktop && axes[i].usage.id == usage) return i;
  }
  throw CalibrationRefused("the calibration names an axis that the stick does not have");
}

std::string Calibrator::find_axis(bool select, double seconds) {
  const std::vector<HidAxis>& axes = driver_.lever_report().axes;
  StickRig rig(driver_, tick_);
  std::vector<std::vector<double>> before(axes.size()), after(axes.size());
  const std::int64_t begin = rig.step().now_ns;
  for (double time = 0.0; time < seconds; time = 1e-9 * static_cast<double>(rig.step().now_ns - begin)) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (time < kStartTime) before[i].push_back(rig.position(i));
      if (time > seconds - kEndTime) after[i].push_back(rig.position(i));
    }
  }
  std::size_t largest = 0;
  std::vector<double> moved(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].usage.page != kGenericDesktop) continue;
    moved[i] = (mean_of(after[i]) - mean_of(before[i])) / rig.range(i);
    if (std::abs(moved[i]) > std::abs(moved[largest])) largest = i;
  }
  if (std::abs(moved[largest]) < kMinMotion)
    throw CalibrationRefused("no axis moved by more than " + format_percent(std::abs(moved[largest])) +
                             " of its range, but at least " + format_percent(kMinMotion) +
                             " is needed. Push the lever all the way and hold it there");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (i != largest && std::abs(moved[i]) > kMaxCrossMotion * std::abs(moved[largest]))
      throw CalibrationRefused("two axes moved together. Push the lever straight");
  }
  const int usage = axes[largest].usage.id;
  if (found_[select ? 1 : 0].usage == usage) {
    if (!select)
      throw CalibrationRefused("the same axis moved as when you pushed to the right. Push the lever forward");
    found_[1] = {};  // discards the result of an earlier run with the axes swapped
  }
  found_[select ? 0 : 1] = {usage, moved[largest] > 0.0 ? 1 : -1};
  return std::string("pushing ") + (select ? "right" : "forward") + " moves axis " + std::to_string(largest + 1) +
         " of the stick " + (moved[largest] > 0.0 ? "up" : "down");
}

std::string Calibrator::measure_range(double seconds) {
  if (found_[0].usage == 0 || found_[1].usage == 0)
    throw CalibrationRefused("the lever's axes are not known yet. Find the axes first");
  const std::size_t select = report_axis(found_[0].usage), shift = report_axis(found_[1].usage);
  StickRig rig(driver_, tick_);
  std::vector<double> x, y;
  const std::int64_t begin = rig.step().now_ns;
  while (1e-9 * static_cast<double>(rig.latest().now_ns - begin) < seconds - kReleaseTime) {
    x.push_back(rig.position(select));
    y.push_back(rig.position(shift));
    rig.step();
  }
  x = without_jumps(x);
  y = without_jumps(y);
  const double rest_x = rig.rest(select), rest_y = rig.rest(shift);
  LeverAxisCalibration new_select = range_of("select", found_[0], x, rest_x, rig.range(select));
  LeverAxisCalibration new_shift = range_of("shift", found_[1], y, rest_y, rig.range(shift));
  if (std::abs(correlation(x, y)) > kMaxCorrelation)
    throw CalibrationRefused("the two axes moved together. Move the lever left and right, then forward and back");
  new_select.travel = calibration_.select.travel;
  new_select.full_force = calibration_.select.full_force;
  new_shift.travel = calibration_.shift.travel;
  new_shift.full_force = calibration_.shift.full_force;
  calibration_.select = new_select;
  calibration_.shift = new_shift;
  return "select from " + counts_text(new_select) + "; shift from " + counts_text(new_shift);
}

// Returns an axis with its direction, stops and rest position. Its other values are not set, because values measured
// with the old range are no longer valid.
LeverAxisCalibration Calibrator::range_of(const std::string& name, const FoundAxis& found,
                                          const std::vector<double>& positions, double centre, double range) {
  if (positions.empty()) throw CalibrationRefused("the time was too short to move the lever at all");
  const auto [low, high] = std::minmax_element(positions.begin(), positions.end());
  const double lowest = *low, highest = *high;
  if (highest - lowest < kMinMotion * range)
    throw CalibrationRefused(name + " moved by only " + format_percent((highest - lowest) / range) +
                             " of its range. Move the lever to all its stops");
  const double rest_fraction = (centre - lowest) / (highest - lowest);
  if (rest_fraction < 0.25 || rest_fraction > 0.75)
    throw CalibrationRefused(name + " rests at " + format_percent(rest_fraction) +
                             " of the way between its stops. Let go of the lever so that it returns to the middle");
  LeverAxisCalibration axis;
  axis.usage = found.usage;
  axis.low = found.sign > 0 ? lowest : highest;
  axis.high = found.sign > 0 ? highest : lowest;
  axis.centre = centre;
  return axis;
}

std::string Calibrator::set_numbers(glm::dvec2 travel, glm::dvec2 full_force) {
  for (int i = 0; i < 2; ++i) {
    require_within(travel[i], 0.02, 0.5, "a travel", "m");
    require_within(full_force[i], 0.5, 100.0, "a full force", "N");
  }
  calibration_.select.travel = travel.x;
  calibration_.shift.travel = travel.y;
  calibration_.select.full_force = full_force.x;
  calibration_.shift.full_force = full_force.y;
  const std::string shift_force = full_force.x == full_force.y ? "" : " and " + number_text(full_force.y, 2) + " N";
  return "travel " + millimetres_text(travel.x) + " and " + millimetres_text(travel.y) + ", full force " +
         number_text(full_force.x, 2) + " N" + shift_force;
}

std::string Calibrator::find_button(LeverButton button, double seconds) {
  std::array<int*, 3> numbers{&calibration_.buttons.press, &calibration_.buttons.lift, &calibration_.buttons.stop};
  StickRig rig(driver_, tick_);
  const std::int64_t begin = rig.step().now_ns;
  std::uint64_t held = rig.latest().state.counts.buttons, pressed = 0;
  while (pressed == 0) {
    const std::uint64_t now = rig.step().state.counts.buttons;
    pressed = now & ~held;
    held &= now;
    if (1e-9 * static_cast<double>(rig.latest().now_ns - begin) > seconds)
      throw CalibrationRefused("no button was pressed");
  }
  if (std::popcount(pressed) > 1) throw CalibrationRefused("more than one button was pressed at once");
  const int number = std::countr_zero(pressed) + 1;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i != static_cast<std::size_t>(button) && *numbers[i] == number)
      throw CalibrationRefused("button " + std::to_string(number) + " is already assigned");
  }
  *numbers[static_cast<std::size_t>(button)] = number;
  return "button " + std::to_string(number);
}

}  // namespace gearshift::haptics
