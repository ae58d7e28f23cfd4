// Checks the estimated motion and the rejection of bad readings.
#include "haptics/contact/lever_estimator.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <doctest/doctest.h>

using namespace gearshift::haptics;
using glm::dvec2;

namespace {

constexpr double kCycle = 0.001;
constexpr std::int64_t kCycleNs = 1'000'000;

LeverReading reading(std::uint64_t sequence, dvec2 position) {
  LeverReading r;
  r.sequence = sequence;
  r.time_ns = static_cast<std::int64_t>(sequence) * kCycleNs;
  r.position = position;
  return r;
}

LeverEstimator moving_estimator(double speed, int samples) {
  LeverEstimator estimator({}, kCycle);
  for (int i = 1; i <= samples; ++i)
    estimator.update(reading(static_cast<std::uint64_t>(i), {speed * kCycle * i, 0.0}));
  return estimator;
}

}  // namespace

TEST_CASE("constant speed is measured exactly; the smooth one follows 1 - exp(-t / tau)") {
  LeverEstimator estimator({}, kCycle);
  estimator.update(reading(1, {0.0, 0.0}));
  for (int i = 1; i <= 40; ++i) {
    const LeverMotion m = estimator.update(reading(static_cast<std::uint64_t>(i) + 1, {0.3 * kCycle * i, 0.0}));
    CHECK(m.velocity.x == doctest::Approx(0.3));
    CHECK(m.smooth_velocity.x == doctest::Approx(0.3 * (1.0 - std::exp(-i * kCycle / 0.004))));
  }
}

// A restart counts as a fresh reading. If the estimator restarted before the guard's stale time had passed, the guard
// would never react to the faulty sensor.
TEST_CASE("with a faulty sensor the estimator restarts 30 ms after the guard's stale time, 50 ms at the earliest") {
  for (const double stale_time : {0.0, 0.02, 0.06, 1.0}) {
    LeverEstimator estimator({}, kCycle, 0.0, stale_time);
    CHECK(estimator.update(reading(1, {0.0, 0.0})).fresh);
    int silent = 0;  // [cycles]
    while (
        silent < 2000 &&
        !estimator.update(reading(static_cast<std::uint64_t>(silent) + 2, {silent % 2 == 0 ? 1.0 : -1.0, 0.0})).fresh)
      ++silent;
    // [s] delay of the restart after the expected time: at most one cycle, because cycles are counted as a whole
    const double late = silent * kCycle - std::max(0.05, stale_time + 0.03);
    CHECK(late > -1e-9);
    CHECK(late < kCycle + 1e-9);
  }
}

// When a lever rests on the edge between two encoder counts, the reading flips between them. This is not a motion
// (found by campaign seed 1, case 3394).
TEST_CASE("a jump by one count is accepted at any rate, one by two counts above the speed limit is not") {
  constexpr double kCount = 1e-4, kFastCycle = 2.5e-4;  // [m], [s]: one count per cycle is 0.4 m/s
  EstimatorConfig config;
  config.speed_limit = 0.1;
  for (const dvec2 edge : {dvec2{kCount, 0.0}, dvec2{0.0, -kCount}, dvec2{kCount, kCount}}) {
    for (const double counts : {1.0, 2.0}) {
      LeverEstimator estimator(config, kFastCycle, kCount);
      LeverReading first = reading(1, {0.0, 0.0}), second = reading(2, counts * edge);
      first.time_ns = 250'000, second.time_ns = 500'000;
      CHECK(estimator.update(first).fresh);
      CHECK(estimator.update(second).fresh == (counts == 1.0));
    }
  }
}

TEST_CASE("a device with its own clock: with faster, slower or late samples the speed is still correct") {
  const auto sample = [](std::uint64_t sequence, std::int64_t time_ns) {
    LeverReading r;
    r.sequence = sequence;
    r.time_ns = time_ns;
    r.position = {0.3e-9 * static_cast<double>(time_ns), 0.0};
    return r;
  };
  LeverEstimator fast_loop({}, kCycle / 4.0);  // 1 kHz device, 4 kHz loop: three of four readings are repeats
  for (int cycle = 0; cycle < 100; ++cycle) {
    const LeverMotion m = fast_loop.update(sample(static_cast<std::uint64_t>(cycle / 4) + 1, (cycle / 4) * kCycleNs));
    if (m.fresh && cycle > 4) CHECK(m.velocity.x == doctest::Approx(0.3));
  }
  LeverEstimator slow_loop({}, kCycle);  // 2 kHz device, 1 kHz loop: every second sample is read
  for (int cycle = 0; cycle < 100; ++cycle) {
    const LeverMotion m = slow_loop.update(sample(2 * static_cast<std::uint64_t>(cycle) + 1, cycle * kCycleNs));
    if (cycle > 1) CHECK(m.velocity.x == doctest::Approx(0.3));
  }
  LeverEstimator late({}, kCycle);  // one sample is late by a millisecond
  late.update(sample(1, 0));
  late.update(sample(2, kCycleNs));
  CHECK(late.update(sample(3, 3 * kCycleNs)).velocity.x == doctest::Approx(0.3));
}

TEST_CASE("a dropped sample does not double the speed") {
  LeverEstimator estimator = moving_estimator(0.3, 10);
  CHECK(estimator.update(reading(12, {0.3 * kCycle * 12, 0.0})).velocity.x == doctest::Approx(0.3));
}

TEST_CASE("repeated, backward, impossible and not finite readings are not fresh and change nothing") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const dvec2 last{0.3 * kCycle * 10, 0.0};
  LeverReading backward = reading(11, last);
  backward.time_ns = 5 * kCycleNs;
  for (const LeverReading& bad : {reading(10, last), backward, reading(9, last), reading(11, {0.06, 0.0}),
                                  reading(11, {nan, 0.0}), reading(11, {0.0, inf})}) {
    LeverEstimator estimator = moving_estimator(0.3, 10);
    const LeverMotion m = estimator.update(bad);
    CHECK_FALSE(m.fresh);
    CHECK(m.position == last);
    CHECK(m.velocity.x == doctest::Approx(0.3));
  }
}

TEST_CASE("after 50 ms without samples it restarts at the next: a replugged device counts from one again") {
  for (const std::uint64_t restarted : {std::uint64_t{1}, std::uint64_t{500}}) {
    LeverEstimator estimator = moving_estimator(0.3, 10);
    for (int i = 0; i < 60; ++i) estimator.update(reading(10, {0.003, 0.0}));
    const LeverMotion m = estimator.update(reading(restarted, {0.012, 0.0}));
    CHECK(m.fresh);
    CHECK(m.position == dvec2{0.012, 0.0});
    CHECK(m.velocity == dvec2{0.0, 0.0});  // the move of 9 mm took an unknown time, so the speed is unknown
  }
}

TEST_CASE("a lever that really has moved elsewhere is accepted there after 50 ms, at rest") {
  LeverEstimator estimator = moving_estimator(0.3, 10);
  LeverMotion m;
  std::uint64_t sequence = 11;
  int cycles = 0;
  do {
    m = estimator.update(reading(sequence++, {0.06, 0.0}));
    ++cycles;
  } while (!m.fresh && cycles < 1000);
  CHECK(cycles == doctest::Approx(51).epsilon(0.02));
  CHECK(m.position == dvec2{0.06, 0.0});
  CHECK(m.velocity == dvec2{0.0, 0.0});
}

TEST_CASE("a longer window: the difference over it, over fewer samples at first, and none from before a restart") {
  EstimatorConfig config;
  config.window = 5;
  LeverEstimator estimator(config, kCycle);
  const auto at = [](int n) { return 1e-6 * n * n; };  // [m] not linear, so every window has a different speed
  for (int n = 1; n <= 30; ++n) {
    const LeverMotion m = estimator.update(reading(static_cast<std::uint64_t>(n), {at(n), 0.0}));
    const int back = std::min(5, n - 1);
    if (back > 0) CHECK(m.velocity.x == doctest::Approx((at(n) - at(n - back)) / (back * kCycle)));
  }
  for (int n = 0; n < 60; ++n) estimator.update(reading(30, {at(30), 0.0}));  // no new samples for 60 ms: a restart
  CHECK(estimator.update(reading(91, {0.03, 0.0})).velocity.x == 0.0);
  CHECK(estimator.update(reading(92, {0.0301, 0.0})).velocity.x == doctest::Approx(0.1));
}
