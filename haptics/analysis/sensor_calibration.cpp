#include "haptics/analysis/sensor_calibration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "haptics/device/gaussian_noise.h"
#include "haptics/files/range_check.h"

namespace gearshift::haptics {
namespace {

glm::dvec2 direction_of(const Weighing& weighing) {
  const double angle = weighing.direction * (2.0 * std::numbers::pi / kCalibrationDirections);
  return {std::cos(angle), std::sin(angle)};
}

double mean_reading(const ForceSensorModel& sensor, double gw, int samples, GaussianNoise& noise) {
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double disturbed = sensor.noise_gw > 0.0 ? sensor.noise_gw * noise.next() : 0.0;
    sum += sensor_reading(sensor, gw * kNewtonPerGramWeight, disturbed);
  }
  return sum / samples;
}

SensorLine fit_line(std::span<const Weighing> weighings, int axis) {
  const double n = static_cast<double>(weighings.size());
  double mean_force = 0.0, mean_reading = 0.0;
  std::set<long> forces;  // [1/1000 gw]
  for (const Weighing& weighing : weighings) {
    const double force = weighing.weight * direction_of(weighing)[axis];
    forces.insert(std::lround(1e3 * force));
    mean_force += force / n;
    mean_reading += weighing.reading[axis] / n;
  }
  if (forces.size() < 3) throw std::invalid_argument("calibrate_sensor: an axis needs at least 3 different forces");

  double ff = 0.0, fr = 0.0;
  for (const Weighing& weighing : weighings) {
    const double force = weighing.weight * direction_of(weighing)[axis] - mean_force;
    ff += force * force;
    fr += force * (weighing.reading[axis] - mean_reading);
  }
  SensorLine line;
  line.gain = fr / ff;
  line.offset = mean_reading - line.gain * mean_force;

  double squares = 0.0;
  for (const Weighing& weighing : weighings) {
    const double residual =
        weighing.reading[axis] - line.offset - line.gain * weighing.weight * direction_of(weighing)[axis];
    squares += residual * residual;
    line.nonlinearity = std::max(line.nonlinearity, std::abs(residual / line.gain));
  }
  const double variance = squares / (n - 2.0);
  line.gain_deviation = std::sqrt(variance / ff);
  line.offset_deviation = std::sqrt(variance * (1.0 / n + mean_force * mean_force / ff));
  return line;
}

}  // namespace

std::vector<Weighing> weigh(const ForceSensorModel& x, const ForceSensorModel& y, int samples, std::uint64_t seed) {
  require_between("weigh: samples", samples, 1, 100'000);
  GaussianNoise noise(seed);
  std::vector<Weighing> weighings;
  for (int direction = 0; direction < kCalibrationDirections; ++direction) {
    for (const double weight : kCalibrationWeights) {
      Weighing weighing{weight, direction, {}};
      const glm::dvec2 force = weight * direction_of(weighing);
      weighing.reading = {mean_reading(x, force.x, samples, noise), mean_reading(y, force.y, samples, noise)};
      weighings.push_back(weighing);
    }
  }
  return weighings;
}

SensorCalibration calibrate_sensor(std::span<const Weighing> weighings) {
  SensorCalibration calibration{fit_line(weighings, 0), fit_line(weighings, 1)};
  const SensorLine &x = calibration.x, &y = calibration.y;
  for (int direction = 0; direction < kCalibrationDirections; ++direction) {
    double along_sum = 0.0, weight_sum = 0.0;  // sums for the slope of a line through the origin
    for (const Weighing& weighing : weighings) {
      if (weighing.direction != direction) continue;
      const glm::dvec2 force{(weighing.reading.x - x.offset) / x.gain, (weighing.reading.y - y.offset) / y.gain};
      const glm::dvec2 along = direction_of(weighing);
      along_sum += weighing.weight * glm::dot(along, force);
      weight_sum += weighing.weight * weighing.weight;
      const double across = along.x * force.y - along.y * force.x;
      calibration.cross_force = std::max(calibration.cross_force, std::abs(across));
    }
    if (weight_sum == 0.0) continue;
    calibration.direction_spread = std::max(calibration.direction_spread, std::abs(along_sum / weight_sum - 1.0));
  }
  return calibration;
}

}  // namespace gearshift::haptics
