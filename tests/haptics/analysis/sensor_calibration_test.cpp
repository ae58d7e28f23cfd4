// Tests the calibration of the paper's section 2.3: weights that pull in eight directions recover eq (7).
#include "haptics/analysis/sensor_calibration.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace gearshift::haptics;

namespace {

ForceSensorModel noisy() {
  ForceSensorModel sensor;
  sensor.noise_gw = 20.0;
  return sensor;
}

}  // namespace

TEST_CASE("offset 19.04 and gain 0.1551 come out within their uncertainty, through resolution and noise") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SensorCalibration found = calibrate_sensor(weigh(noisy(), noisy(), 20, seed));
    for (const SensorLine& line : {found.x, found.y}) {
      CHECK(std::abs(line.offset - 19.04) < 3.5 * line.offset_deviation);
      CHECK(std::abs(line.gain - 0.1551) < 3.5 * line.gain_deviation);
      CHECK(line.gain_deviation < 0.01 * 0.1551);
      CHECK(line.offset_deviation < 0.3);
      CHECK(line.nonlinearity < 30.0);
    }
    CHECK(found.direction_spread < 0.02);
    CHECK(found.cross_force < 30.0);
  }
}

TEST_CASE("a sensor without noise: errors of at most half a step of its resolution") {
  const SensorCalibration found = calibrate_sensor(weigh({}, {}, 1, 1));
  // The offset is exact: the weights pull equally in opposite directions and rounding is symmetric, so rounding errors
  // cancel.
  CHECK(std::abs(found.x.offset - 19.04) < 1e-9);
  CHECK(std::abs(found.x.gain - 0.1551) < 3.0 * found.x.gain_deviation);
  CHECK(found.x.nonlinearity < 25.0);
  ForceSensorModel fine;
  fine.resolution_gw = 0.0;
  const SensorCalibration exact = calibrate_sensor(weigh(fine, fine, 1, 1));
  CHECK(exact.y.gain == doctest::Approx(0.1551).epsilon(1e-12));
  CHECK(exact.y.offset == doctest::Approx(19.04).epsilon(1e-12));
  CHECK(exact.direction_spread < 1e-12);
  CHECK(exact.cross_force < 1e-9);
}

TEST_CASE("a gain error of 3 % and a nonlinear sensor are detected") {
  ForceSensorModel off = noisy();
  off.gain *= 1.03;
  const SensorCalibration found = calibrate_sensor(weigh(off, noisy(), 20, 1));
  CHECK(found.x.gain == doctest::Approx(1.03 * 0.1551).epsilon(0.01));
  CHECK(found.x.gain - 0.1551 > 3.0 * found.x.gain_deviation);
  CHECK(std::abs(found.y.gain - 0.1551) < 3.0 * found.y.gain_deviation);

  ForceSensorModel short_range = noisy();
  short_range.range_gw = 800.0;
  CHECK(calibrate_sensor(weigh(short_range, noisy(), 20, 1)).x.nonlinearity > 60.0);

  std::vector<Weighing> bent = weigh(noisy(), noisy(), 20, 1);
  for (Weighing& one : bent) {
    if (one.direction == 3) one.reading.y = 19.04 + 0.9 * (one.reading.y - 19.04);
  }
  CHECK(calibrate_sensor(bent).direction_spread > 0.03);
}

TEST_CASE("too few weights, or none, are rejected") {
  std::vector<Weighing> weighings = weigh({}, {}, 1, 1);
  weighings.resize(7);  // all along x
  CHECK_THROWS_AS(calibrate_sensor(weighings), std::invalid_argument);
  CHECK_THROWS_AS(calibrate_sensor({}), std::invalid_argument);
  CHECK_THROWS_AS(weigh({}, {}, 0, 1), std::invalid_argument);
}
