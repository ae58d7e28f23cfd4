// The driveline compared with fourth-order Runge-Kutta at steps of 10 us. In the reference, each mode of motion was
// written out by hand.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/methods.h"
#include "tests/app/vehicle/cars.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::lab;
using namespace gearshift::test;

namespace {

struct DriveDeviation {
  double engine = 0.0, shaft = 0.0, road = 0.0;  // [rad/s], [rad/s] and [m/s]: largest error of all samples
  double end = 0.0;                              // [rad/s] error of the engine speed at the end
  double clutch = 0.0, cone = 0.0;               // [1] relative error of the heat in clutch and cone
};

DriveDeviation deviation(const Drive& drive, const DriveOutcome& actual, const DriveOutcome& expected, double step) {
  DriveDeviation worst;
  const std::size_t each = static_cast<std::size_t>(std::lround(step / 0.001));
  for (std::size_t i = 0; i < actual.samples.size(); ++i) {
    const ReferenceSample &a = actual.samples[i], &b = expected.samples[i * each];
    worst.engine = std::max(worst.engine, std::abs(a.engine - b.engine));
    worst.shaft = std::max(worst.shaft, std::abs(a.shaft - b.shaft));
    worst.road = std::max(worst.road, std::abs(a.road - b.road));
  }
  worst.end = std::abs(actual.samples.back().engine - expected.samples.back().engine);
  if (expected.slip_energy > 0.0) worst.clutch = std::abs(actual.slip_energy / expected.slip_energy - 1.0);
  if (expected.cone_energy > 0.0) worst.cone = std::abs(actual.cone_energy / expected.cone_energy - 1.0);
  REQUIRE(actual.samples.size() == static_cast<std::size_t>(std::lround(drive.duration / step)) + 1);
  return worst;
}

}  // namespace

TEST_CASE(
    "every hard drive matches the reference: at 1 ms to 0.01 rad/s and 0.005 % of the heat, at 4 ms to 0.06 rad/s") {
  std::vector<Drive> drives = all_drives();
  for (const Drive& drive : engine_drives()) drives.push_back(drive);
  drives.push_back(launch_of(shipped_car("hatchback")));  // the shipped cars also lose energy in the gear teeth
  drives.push_back(launch_of(shipped_car("diesel")));
  drives.push_back(pull_away(shipped_car("hatchback"), 1, 1.5));
  drives.push_back(pull_away(shipped_car("diesel"), 2, 3.0));
  for (const Drive& drive : drives) {
    CAPTURE(drive.name);
    const DriveOutcome expected = reference_of(drive);
    for (const double step : {0.001, 0.004}) {
      CAPTURE(step);
      const DriveOutcome actual = drive_by(DriveMethod::events, drive, step);
      const DriveDeviation worst = deviation(drive, actual, expected, step);
      CHECK(worst.engine < (step < 0.002 ? 0.01 : 0.06));
      CHECK(worst.shaft < (step < 0.002 ? 0.002 : 0.06));
      CHECK(worst.road < (step < 0.002 ? 1e-4 : 2e-4));
      CHECK(worst.end < 2.5e-3);
      CHECK(worst.clutch < (step < 0.002 ? 5e-5 : 1e-4));
      CHECK(worst.cone < (step < 0.002 ? 5e-5 : 1e-4));
      CHECK(actual.running == expected.running);
      CHECK(actual.temperature == doctest::Approx(expected.temperature).epsilon(1e-5));
    }
  }
}

// The reference locates every event, such as a clutch that locks, and the impulse method locates none. So the two agree
// only if both are right.
TEST_CASE("impulses without events converge to the reference as the step shrinks") {
  int counted = 0;
  for (const Drive& drive : all_drives()) {
    if (counted++ % 3 != 0 && !is_full_campaign()) continue;
    CAPTURE(drive.name);
    const DriveOutcome expected = reference_of(drive);
    const auto error = [&](double step) {
      const DriveOutcome actual = drive_by(DriveMethod::impulses, drive, step);
      return std::abs(actual.samples.back().road - expected.samples.back().road);
    };
    CHECK(error(1e-5) < 1e-5);
  }
}

TEST_CASE("each drive does what its name says") {
  for (const Drive& drive : {launch(), launch_of(shipped_car("hatchback"))}) {
    const DriveOutcome runs = reference_of(drive);
    CHECK(runs.running);
    CHECK(runs.samples.back().road > 1.0);
    CHECK(runs.samples.back().engine == runs.samples.back().shaft);  // the clutch has locked at the end
  }
  const DriveOutcome creeps = reference_of(pull_away(shipped_car("diesel"), 2, 3.0));
  CHECK(creeps.running);
  CHECK(creeps.samples.back().road > 3.0);
  const DriveOutcome stalls = reference_of(dump_at_idle());
  CHECK_FALSE(stalls.running);
  const DriveOutcome over = reference_of(money_shift());
  CHECK(over.engine_peak > hatchback().engine.limiter);
  const DriveOutcome hill = reference_of(rollback());
  const auto lowest =
      std::min_element(hill.samples.begin(), hill.samples.end(),
                       [](const ReferenceSample& a, const ReferenceSample& b) { return a.road < b.road; });
  CHECK(lowest->road < -0.1);
  CHECK(hill.samples.back().road > 0.5);
  CHECK(reference_of(reverse_ahead()).samples.back().road < -1.0);
  CHECK(reference_of(first_backwards()).samples.back().road > 1.0);
  const DriveOutcome rolled = reference_of(rolls_back_dead());
  CHECK_FALSE(rolled.running);
  CHECK(rolled.samples.back().engine < -50.0);
  CHECK(rolled.samples.back().engine == rolled.samples.back().shaft);
  CHECK(reference_of(bump_start()).running);
  CHECK(reference_of(cranking()).running);
  CHECK(reference_of(hot_launch()).temperature > 320.0);
}

// The separate program takes explicit Euler steps of 1 us. In its result, the clutch heat is 2.302 kJ, and the clutch
// locks after 1.322 s. While the larger of pedal and idle control opened the throttle, it gave 2.018 kJ and 1.304 s, and
// a third program, by Runge-Kutta, 2.02 kJ and 1.303 s.
TEST_CASE("the launch matches a separate program's result") {
  const DriveOutcome runs = reference_of(launch());
  CHECK(runs.slip_energy == doctest::Approx(2302.0).epsilon(0.001));
  const auto locks = std::find_if(runs.samples.begin() + 1, runs.samples.end(),
                                  [](const ReferenceSample& s) { return s.engine == s.shaft; });
  CHECK(static_cast<double>(locks - runs.samples.begin()) == doctest::Approx(1322.0).epsilon(0.001));
}

// Negative control: a clutch with tanh friction, the usual model, has larger errors than the tests above allow.
TEST_CASE("a tanh clutch exceeds these tolerances") {
  const Drive drive = launch();
  const DriveDeviation worst = deviation(drive, drive_by(DriveMethod::tanh, drive, 0.001), reference_of(drive), 0.001);
  CHECK(worst.engine > 1.0);
  CHECK(worst.clutch > 1e-3);
}
