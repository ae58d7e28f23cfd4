#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/draw/gate_colours.h"
#include "app/reproduce/section.h"
#include "app/reproduce/study_files.h"
#include "haptics/analysis/sensor_calibration.h"

namespace gearshift {
namespace {

constexpr int kSamples = 1000;  // that a reading is the mean of

// Of one axis, in the direction of the weights. [gw]
double residual(const SensorLine& line, double reading, double force) {
  return (reading - line.offset) / line.gain - force;
}

void write_weighings(const Study& study, const std::vector<Weighing>& weighings, const SensorCalibration& fit) {
  CsvFile csv(study, "calibration",
              "weight_gw,direction_deg,force_x_gw,force_y_gw,reading_x_raw,reading_y_raw,residual_x_gw,residual_y_gw");
  for (const Weighing& one : weighings) {
    const double degrees = one.direction * 360.0 / kCalibrationDirections;
    const double angle = degrees * std::numbers::pi / 180.0;
    const glm::dvec2 force = one.weight * glm::dvec2(std::cos(angle), std::sin(angle));
    csv.row({one.weight, degrees, force.x, force.y, one.reading.x, one.reading.y,
             residual(fit.x, one.reading.x, force.x), residual(fit.y, one.reading.y, force.y)});
  }
  csv.finish();
}

void draw_calibration(const Study& study, const SensorCalibration& fit) {
  draw(study, {"calibration", 1100, 480,
               fmt::format(R"gp(set multiplot layout 1,2 margins 0.07, 0.98, 0.13, 0.9 spacing 0.09
set xrange [-1100:1100]
set xlabel "weight along the axis f_e [gw]"
set ylabel "reading f_s [raw]"
set key left top Left reverse
plot {offset} + {gain} * x with lines linecolor "{ink}" title "fitted line, X", \
  "calibration.csv" using "force_x_gw":"reading_x_raw" with points pointtype 1 linecolor "{red}" title "X", \
  "calibration.csv" using "force_y_gw":"reading_y_raw" with points pointtype 2 linecolor "{blue}" title "Y"
set ylabel "reading less the line [gw]"
set key right top
set yrange [-40:40]
plot "calibration.csv" using "force_x_gw":"residual_x_gw" with points pointtype 1 linecolor "{red}" title "X", \
  "calibration.csv" using "force_y_gw":"residual_y_gw" with points pointtype 2 linecolor "{blue}" title "Y"
unset multiplot
)gp",
                           fmt::arg("offset", fit.x.offset), fmt::arg("gain", fit.x.gain), fmt::arg("ink", kSoftInk),
                           fmt::arg("red", kLockoutColour), fmt::arg("blue", kGearColour))});
}

Finding line_finding(const char* axis, const SensorLine& line) {
  return {"(7): f_e = (f_s - 19.04) / 0.1551 gw",
          fmt::format("{}: offset {:.2f} ± {:.2f}, gain {:.5f} ± {:.5f} per gw", axis, line.offset,
                      line.offset_deviation, line.gain, line.gain_deviation),
          fmt::format("offset {}, gain {}", relative(line.offset, 19.04), relative(line.gain, 0.1551))};
}

Finding directions(const SensorCalibration& fit) {
  return {"Section 2.3: consistent readings in all those directions",
          fmt::format("the gain of the worst direction is {:.1f} % off; across the weight at most {:.0f} gw are read",
                      100.0 * fit.direction_spread, fit.crosswise),
          "by the resolution alone"};
}

Finding linearity(const ForceSensorModel& sensor, const SensorCalibration& fit) {
  const double worst = std::max(fit.x.nonlinearity, fit.y.nonlinearity);
  return {"Section 2.3: linearly proportional; sensitivity 0.044 kgf in X and Y",
          fmt::format("the farthest reading from the line is {:.1f} gw off", worst),
          fmt::format("{:.2f} of the resolution of {:g} gw; rounding alone makes up to 0.5",
                      worst / sensor.resolution_gw, sensor.resolution_gw)};
}

}  // namespace

Section calibration_section(const Study& study) {
  const ForceSensorModel& sensor = study.preset.lever.force_sensor;
  const std::vector<Weighing> weighings = weigh(sensor, sensor, kSamples, study.preset.lever.seed);
  const SensorCalibration fit = calibrate_sensor(weighings);
  write_weighings(study, weighings, fit);
  draw_calibration(study, fit);
  return {
      "calibration",
      "(7): calibration of the force sensor",
      fmt::format(
          "No load and weights of 100, 200, 300, 500, 750 and 1000 g in eight directions on the preset's "
          "sensor: offset {:g}, gain {:g} per gw, resolution {:g} gw, noise {:g} gw. Each reading is the mean of {} "
          "samples. The sensor is made of (7); the calibration does not know that and finds it again through the "
          "resolution.",
          sensor.offset, sensor.gain, sensor.resolution_gw, sensor.noise_gw, kSamples),
      {line_finding("X", fit.x), line_finding("Y", fit.y), directions(fit), linearity(sensor, fit)},
      {{"calibration",
        "Left: what the sensor reads of each weight, by its component along the axis. Right: what the line leaves."}}};
}

}  // namespace gearshift
