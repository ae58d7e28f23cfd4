#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/base/colours.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "haptics/analysis/sensor_calibration.h"

namespace gearshift::lab {
namespace {

constexpr int kSamples = 1000;  // samples averaged per reading

// Deviation of a reading from the fitted line of one axis. [gw] (gram-weight)
double residual(const haptics::SensorLine& line, double reading, double force) {
  return (reading - line.offset) / line.gain - force;
}

void write_weighings(const Study& study, const std::vector<haptics::Weighing>& weighings,
                     const haptics::SensorCalibration& fit) {
  CsvFile csv(study, "calibration",
              "weight_gw,direction_deg,force_x_gw,force_y_gw,reading_x_raw,reading_y_raw,residual_x_gw,residual_y_gw");
  for (const haptics::Weighing& one : weighings) {
    const double degrees = one.direction * 360.0 / haptics::kCalibrationDirections;
    const double angle = degrees * std::numbers::pi / 180.0;
    const glm::dvec2 force = one.weight * glm::dvec2(std::cos(angle), std::sin(angle));
    csv.row({one.weight, degrees, force.x, force.y, one.reading.x, one.reading.y,
             residual(fit.x, one.reading.x, force.x), residual(fit.y, one.reading.y, force.y)});
  }
  csv.finish();
}

void draw_calibration(const Study& study, const haptics::SensorCalibration& fit) {
  draw(study,
       {"calibration", 1100, 480,
        fmt::format(R"gp(set multiplot layout 1,2 margins 0.07, 0.98, 0.13, 0.9 spacing 0.09
set xrange [-1100:1100]
set xlabel "weight along the axis f_e [gw]"
set ylabel "reading f_s [raw]"
set key left top Left reverse
plot {offset} + {gain} * x with lines linecolor "{ink}" title "fitted line, X", \
  "calibration.csv" using "force_x_gw":"reading_x_raw" with points pointtype 1 linecolor "{red}" title "X", \
  "calibration.csv" using "force_y_gw":"reading_y_raw" with points pointtype 2 linecolor "{blue}" title "Y"
set ylabel "reading minus fitted line [gw]"
set key right top
set yrange [-40:40]
plot "calibration.csv" using "force_x_gw":"residual_x_gw" with points pointtype 1 linecolor "{red}" title "X", \
  "calibration.csv" using "force_y_gw":"residual_y_gw" with points pointtype 2 linecolor "{blue}" title "Y"
unset multiplot
)gp",
                    fmt::arg("offset", fit.x.offset), fmt::arg("gain", fit.x.gain), fmt::arg("ink", base::kSoftInk),
                    fmt::arg("red", base::kLockoutColour), fmt::arg("blue", base::kGearColour))});
}

Finding line_finding(const char* axis, const haptics::SensorLine& line) {
  return {"(7): f_e = (f_s - 19.04) / 0.1551 gw",
          fmt::format("{}: offset {:.2f} ± {:.2f}, gain {:.5f} ± {:.5f} per gw", axis, line.offset,
                      line.offset_deviation, line.gain, line.gain_deviation),
          fmt::format("offset {}, gain {}", relative(line.offset, 19.04), relative(line.gain, 0.1551))};
}

Finding directions(const haptics::SensorCalibration& fit) {
  return {"Section 2.3: the readings are consistent in all directions",
          fmt::format("in the worst direction, the gain is off by {:.1f} %; the sensor reads at most {:.0f} gw "
                      "perpendicular to the weight",
                      100.0 * fit.direction_spread, fit.cross_force),
          "explained by the resolution"};
}

Finding linearity(const haptics::ForceSensorModel& sensor, const haptics::SensorCalibration& fit) {
  const double worst = std::max(fit.x.nonlinearity, fit.y.nonlinearity);
  return {"Section 2.3: the readings are linearly proportional, with a sensitivity of 0.044 kgf in X and Y",
          fmt::format("the worst reading is {:.1f} gw away from the line", worst),
          fmt::format("{:.2f} times the resolution of {:g} gw; rounding explains up to 0.5 times",
                      worst / sensor.resolution_gw, sensor.resolution_gw)};
}

}  // namespace

Section calibration_section(const Study& study) {
  const haptics::ForceSensorModel& sensor = study.preset.lever.force_sensor;
  const std::vector<haptics::Weighing> weighings = haptics::weigh(sensor, sensor, kSamples, study.preset.lever.seed);
  const haptics::SensorCalibration fit = haptics::calibrate_sensor(weighings);
  write_weighings(study, weighings, fit);
  draw_calibration(study, fit);
  return {
      "calibration",
      "(7): calibration of the force sensor",
      fmt::format(
          "The preset's sensor (offset {:g}, gain {:g} per gw, resolution {:g} gw, noise {:g} gw) is read without load "
          "and with weights of 100, 200, 300, 500, 750 and 1000 g in eight directions. Each reading is the mean of {} "
          "samples. The simulated sensor follows (7); the calibration does not use (7), but recovers it within the "
          "resolution.",
          sensor.offset, sensor.gain, sensor.resolution_gw, sensor.noise_gw, kSamples),
      {line_finding("X", fit.x), line_finding("Y", fit.y), directions(fit), linearity(sensor, fit)},
      {{"calibration",
        "Left: sensor reading of each weight against its component along the axis. Right: residuals of the fitted "
        "line."}}};
}

}  // namespace gearshift::lab
