#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/lab/identify/identify.h"
#include "app/lab/identify/table_2.h"

namespace gearshift::lab {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTau = 2.0 * std::numbers::pi;
constexpr double kMaxPlausibleMisfit = 3.0;  // [1] noise cannot explain a larger misfit between points and curve

struct Quantity {
  const char* name;
  const char* unit;
  const char* key;
  double haptics::AxisModel::*value;
};
constexpr std::array<Quantity, 3> kQuantities{
    {{"mass", "kg", "mass_kg", &haptics::AxisModel::mass},
     {"damping", "N s/m", "damping_n_s_per_m", &haptics::AxisModel::damping},
     {"stiffness", "N/m", "stiffness_n_per_m", &haptics::AxisModel::stiffness}}};

std::array<double, 2> pole_frequencies(const haptics::AxisModel& axis) {
  const auto pole = haptics::poles(axis);
  return {std::abs(pole[0]) / kTau, std::abs(pole[1]) / kTau};
}

// False if the stiffness is less than twice its standard deviation, so that it may be zero.
bool has_spring(const haptics::AxisFit& fit) {
  return fit.model.stiffness > 2.0 * fit.deviation.stiffness;
}

std::string poles_text(const haptics::AxisModel& axis) {
  const auto [slow, fast] = pole_frequencies(axis);
  return haptics::damping_ratio(axis) < 1.0 ? fmt::format("two poles at {:.2f} Hz", slow)
                                            : fmt::format("poles at {:.2f} and {:.2f} Hz", slow, fast);
}

double needed_stroke(const AxisIdentification& axis) {
  return axis.literal.amplitude * std::abs(haptics::compliance(axis.fit.model, axis.literal.frequency));
}

std::string axis_text(const AxisIdentification& axis) {
  const haptics::AxisFit& fit = axis.fit;
  std::string text = fmt::format("axis {:<10}{:>12}{:>14}{:>14}{:>10}\n", to_string(axis.response.axis), "found",
                                 "uncertainty", "nominal", "deviation");
  for (const Quantity& q : kQuantities) {
    const double found = fit.model.*q.value, nominal = axis.nominal.*q.value;
    const std::string off = nominal > 0.0 ? fmt::format("{:+.2f} %", 100.0 * (found / nominal - 1.0)) : "-";
    text += fmt::format("  {:<13}{:>12.5g}{:>14.2g}{:>14.5g}{:>10}  {}\n", q.name, found, fit.deviation.*q.value,
                        nominal, off, q.unit);
  }
  text += fmt::format("  {:<13}{:>12.2g}{:>14.2g}{:>14.5g}{:>10}  N\n", "dry friction", fit.friction,
                      fit.friction_deviation, axis.nominal_friction, "");
  text += has_spring(fit)
              ? fmt::format("  damping ratio {:.2f}, {}, bandwidth {:.2f} Hz\n", haptics::damping_ratio(fit.model),
                            poles_text(fit.model), haptics::bandwidth(fit.model))
              : "  the axis has no spring, so it has no damping ratio or bandwidth\n";
  text += fmt::format(
      "  {} points from {:.3g} to {:.3g} Hz, misfit {:.2g}{}\n", fit.points, axis.response.points.front().frequency,
      axis.response.points.back().frequency, fit.misfit,
      fit.misfit > kMaxPlausibleMisfit ? "; mass, damping, stiffness and friction alone do not explain them" : "");
  text += fmt::format("  at 1 Hz, one third of the maximum force ({:.1f} N) {} (the lever would move by {:.0f} mm)\n\n",
                      axis.literal.amplitude,
                      axis.literal.end == haptics::PointEnd::hit_stop ? "drives the lever to the stop"
                                                                      : "does not drive the lever to the stop",
                      1e3 * needed_stroke(axis));
  return text;
}

std::string bandwidths_text(const Identification& found) {
  std::vector<std::string> texts;
  for (const AxisIdentification& axis : found.axes) {
    texts.push_back(has_spring(axis.fit) ? fmt::format("{:.2f} Hz", haptics::bandwidth(axis.fit.model)) : "no spring");
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

// In Lin and Young's paper, X is an axis of rotation. Turning the lever about it moves the tip along our y.
std::string table2_text(const Identification& found) {
  const haptics::DeviceRow row = haptics::device_row(found.spec);
  constexpr const char* kLine = "{:<24}{:>22}{:>18}{:>14}{:>14}\n";
  std::string text = fmt::format(kLine, "Table 2", "this lever", "developed", "SideWinder", "Immersion");
  const auto line = [&](const char* what, const std::string& here, const PrintedLine& printed) {
    text += fmt::format(kLine, what, here, printed.developed, printed.sidewinder, printed.immersion);
  };
  line("range about X (shift)", fmt::format("{:.1f} deg", row.range_deg.y), kPrintedRangeX);
  line("range about Y (select)", fmt::format("{:.1f} deg", row.range_deg.x), kPrintedRangeY);
  line("continuous force (1)", fmt::format("{:.2f} N", row.continuous_force), kPrintedTorque);
  line("precision", fmt::format("{:.2f} counts/deg", row.counts_per_deg), kPrintedPrecision);
  line("  at the tip", fmt::format("{:.1f} um", 1e6 * row.step), {"", "", ""});
  line("bandwidth (2)", bandwidths_text(found), kPrintedBandwidth);
  text += "(1) printed in Nm, but actually a force at the tip in newtons: the motor's 1.3 N m divided by 0.12 m\n";
  text +=
      "(2) the printed bandwidth does not follow from (11) and (12), whose gain is 3 dB below the gain at rest at 0.92 "
      "and 1.02 Hz\n";
  if (row.step > 0.0) {
    const haptics::AxisModel& axis = found.axes.front().fit.model;
    text += fmt::format(
        "    One newton moves axis {} by at least one encoder count at up to {:.0f} Hz, and by at least 0.71 counts\n  "
        "  (-3 dB) at up to {:.0f} Hz. This may be why the paper's sweep ended at 65 Hz.\n",
        to_string(found.axes.front().response.axis), haptics::frequency_at_gain(axis, row.step),
        haptics::frequency_at_gain(axis, row.step / std::numbers::sqrt2));
  }
  return text + "\n";
}

std::string line_text(const char* axis, const haptics::SensorLine& line) {
  return fmt::format(
      "  {}: f_s = {:.2f} +- {:.2f} + ({:.5f} +- {:.5f}) f_e, largest deviation from the line: {:.1f} gw\n", axis,
      line.offset, line.offset_deviation, line.gain, line.gain_deviation, line.nonlinearity);
}

std::string calibration_text(const Identification& found) {
  const haptics::SensorCalibration& sensor = found.calibration;
  return fmt::format("force sensor, 7 weights in 8 directions; the preset has f_s = {:g} + {:g} f_e, in gw, eq (7)\n",
                     found.sensor.offset, found.sensor.gain) +
         line_text("x", sensor.x) + line_text("y", sensor.y) +
         fmt::format(
             "  directions agree within {:.2f} %; the sensor reads at most {:.1f} gw perpendicular to the weight\n",
             100.0 * sensor.direction_spread, sensor.cross_force);
}

Json point_json(const haptics::FrequencyPoint& point) {
  return {{"frequency_hz", point.frequency},
          {"amplitude_n", point.amplitude},
          {"bounded_by_stroke", point.bounded_by_stroke},
          {"gain_m_per_n", std::abs(point.response)},
          {"phase_deg", std::arg(point.response) * 360.0 / kTau},
          {"relative_uncertainty", std::hypot(point.deviation, point.rounding)},
          {"settled", point.end == haptics::PointEnd::measured}};
}

Json axis_json(const AxisIdentification& axis) {
  Json json{{"axis", to_string(axis.response.axis)}};
  for (const Quantity& q : kQuantities) {
    json[q.key] = {{"found", axis.fit.model.*q.value},
                   {"uncertainty", axis.fit.deviation.*q.value},
                   {"nominal", axis.nominal.*q.value}};
  }
  json["dry_friction_n"] = {
      {"found", axis.fit.friction}, {"uncertainty", axis.fit.friction_deviation}, {"nominal", axis.nominal_friction}};
  json["misfit"] = axis.fit.misfit;
  json["damping_ratio"] = has_spring(axis.fit) ? Json(haptics::damping_ratio(axis.fit.model)) : Json(nullptr);
  json["poles_hz"] = pole_frequencies(axis.fit.model);
  json["bandwidth_hz"] = has_spring(axis.fit) ? Json(haptics::bandwidth(axis.fit.model)) : Json(nullptr);
  json["literal_1_hz"] = {{"amplitude_n", axis.literal.amplitude},
                          {"hit_stop", axis.literal.end == haptics::PointEnd::hit_stop},
                          {"needed_stroke_m", needed_stroke(axis)}};
  json["points"] = Json::array();
  for (const haptics::FrequencyPoint& point : axis.response.points) json["points"].push_back(point_json(point));
  return json;
}

Json line_json(const haptics::SensorLine& line) {
  return {{"offset", line.offset},
          {"offset_uncertainty", line.offset_deviation},
          {"gain_per_gw", line.gain},
          {"gain_uncertainty_per_gw", line.gain_deviation},
          {"nonlinearity_gw", line.nonlinearity}};
}

Json table2_json(const haptics::DeviceSpec& spec) {
  const haptics::DeviceRow row = haptics::device_row(spec);
  return {{"range_select_deg", row.range_deg.x},
          {"range_shift_deg", row.range_deg.y},
          {"continuous_force_n", row.continuous_force},
          {"counts_per_deg", row.counts_per_deg},
          {"step_at_tip_m", row.step}};
}

}  // namespace

std::string identification_table(const Identification& found) {
  std::string text;
  for (const AxisIdentification& axis : found.axes) text += axis_text(axis);
  return text + table2_text(found) + calibration_text(found);
}

std::string identification_json(const Identification& found) {
  Json json{{"rate_hz", found.rate}, {"axes", Json::array()}};
  for (const AxisIdentification& axis : found.axes) json["axes"].push_back(axis_json(axis));
  json["table2"] = table2_json(found.spec);
  json["force_sensor"] = {{"x", line_json(found.calibration.x)},
                          {"y", line_json(found.calibration.y)},
                          {"direction_spread", found.calibration.direction_spread},
                          {"crosswise_gw", found.calibration.cross_force}};
  return json.dump(2) + "\n";
}

}  // namespace gearshift::lab
