// What a wall makes chatter is told from what a hand does.
#include "haptics/contact/reversal_limiter.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

constexpr double kLimiterPeriod = 0.001;
constexpr double kCount = 75e-6;  // [m]

DeviceSpec paper_spec() {
  DeviceSpec spec;
  spec.position_step = kCount;
  return spec;
}

// Times that the limiter lowered the wall in `seconds` of an oscillation. [Hz], [m] peak to peak
int lowered(ReversalLimiter& limiter, double frequency, double span, double seconds, bool touches = true,
            double wanted = 5000.0) {
  int count = 0;
  for (int n = 0; n < static_cast<int>(seconds / kLimiterPeriod); ++n) {
    const double x = 0.5 * span * std::sin(2.0 * std::numbers::pi * frequency * n * kLimiterPeriod);
    count += limiter.update({0.0, x}, touches, wanted, {0.0, 0.0});
  }
  return count;
}

// The same in a wall of 5000 N/m, while the world shakes the lever with a sine of that amplitude [N]. lag: of the lever
// [periods of the shake].
struct Shake {
  double frequency = 20.0, amplitude = 1.0, lag = 0.2;
};
int lowered_shaken(ReversalLimiter& limiter, const Shake& shake, double frequency, double span, double seconds) {
  const auto sine = [](double turns) { return std::sin(2.0 * std::numbers::pi * turns); };
  int count = 0;
  for (int n = 0; n < static_cast<int>(seconds / kLimiterPeriod); ++n) {
    const double time = n * kLimiterPeriod;
    const double y = 0.5 * span * sine(frequency * (time - shake.lag / shake.frequency));
    count += limiter.update({0.1 * y, y}, true, 5000.0, {0.0, shake.amplitude * sine(shake.frequency * time)});
  }
  return count;
}

// What a force of amplitude 1 N moves the paper's lever by at most, from turn to turn, where it stands in resonance with
// it [m]: 2 / (b w).
double resonant_span(double frequency) {
  return 2.0 / (kPaperAxisY.damping * 2.0 * std::numbers::pi * frequency);
}

}  // namespace

TEST_CASE("a fast rattle in a wall lowers it by a quarter, within a quarter of a second of its beginning") {
  DeviceSpec spec = paper_spec();
  spec.delay = 3;
  ReversalLimiter limiter(spec, kLimiterPeriod);
  CHECK(lowered(limiter, 40.0, 6.0 * kCount, 0.10) == 1);
  CHECK(limiter.share() == doctest::Approx(0.75));
  CHECK(lowered(limiter, 40.0, 6.0 * kCount, 0.16) == 2);
  CHECK(limiter.share() == doctest::Approx(0.75 * 0.75 * 0.75));
  limiter.reset();
  CHECK(limiter.share() == 1.0);
}

TEST_CASE("not a hand's own shaking, not the encoder's counts, not what happens in free space") {
  ReversalLimiter limiter(paper_spec(), kLimiterPeriod);
  CHECK(lowered(limiter, 8.0, 0.02, 5.0) == 0);            // 16 reversals a second: the fastest of hands
  CHECK(lowered(limiter, 12.0, 0.0007, 5.0) == 0);         // the fastest of tremors (Elble 2003)
  CHECK(lowered(limiter, 100.0, 3.0 * kCount, 5.0) == 0);  // less than 4 counts
  CHECK(limiter.share() == 1.0);
  ReversalLimiter free(paper_spec(), kLimiterPeriod);
  CHECK(lowered(free, 40.0, 0.002, 5.0, false) == 0);  // no wall
  ReversalLimiter wide(paper_spec(), kLimiterPeriod);
  CHECK(lowered(wide, 10.5, 0.001, 5.0) > 0);  // no tremor
  ReversalLimiter fast(paper_spec(), kLimiterPeriod);
  CHECK(lowered(fast, 13.0, 0.0007, 5.0) > 0);
}

TEST_CASE(
    "down to 0.3 m / tau^2 by quarters; what chatters on there by halves, and below 1/64 it says that it cannot") {
  DeviceSpec spec = paper_spec();
  spec.delay = 3;  // tau = 4 ms: 0.3 * 0.086 / 16e-6 = 1612.5 N/m
  for (const double frequency : {11.0, 40.0}) {
    CAPTURE(frequency);
    ReversalLimiter limiter(spec, kLimiterPeriod);
    for (double share = 0.75; share * 5000.0 > 1612.5; share *= 0.75) {
      while (lowered(limiter, frequency, 0.002, 1.0 / frequency) == 0) continue;
      CHECK(limiter.share() == doctest::Approx(share));
    }
    while (lowered(limiter, frequency, 0.002, 1.0 / frequency) == 0) continue;
    CHECK(limiter.share() * 5000.0 == doctest::Approx(1612.5));
    CHECK_FALSE(limiter.exhausted());
    lowered(limiter, frequency, 0.002, 15.0);
    CHECK(limiter.exhausted());
    CHECK(limiter.share() < 1.0 / 64.0);
    limiter.reset();
    CHECK_FALSE(limiter.exhausted());
    CHECK(limiter.share() == 1.0);
  }
}

TEST_CASE("at the floor a bounce that dies away takes nothing, however often it comes") {
  DeviceSpec spec = paper_spec();  // no delay: 0.3 m / T^2 is 25800 N/m, beyond the wall that is wanted
  ReversalLimiter limiter(spec, kLimiterPeriod);
  for (int i = 0; i < 100; ++i) {
    lowered(limiter, 40.0, 0.002, 0.2);  // sixteen reversals
    lowered(limiter, 1.0, 0.0, 1.0);
  }
  CHECK(limiter.share() == 1.0);
  CHECK_FALSE(limiter.exhausted());
  CHECK(lowered(limiter, 40.0, 0.002, 1.0) >= 1);  // one that does not
  CHECK(limiter.share() <= 0.5);
}

TEST_CASE("a lever that is shaken by the world turns with it: no wall is lowered for that, whatever it stands in") {
  for (const double frequency : {9.0, 12.0, 20.0, 25.0, 120.0}) {
    for (const double lag : {0.0, 0.1, 0.25, 0.4, 0.5}) {
      CAPTURE(frequency);
      CAPTURE(lag);
      ReversalLimiter limiter(paper_spec(), kLimiterPeriod);
      CHECK(lowered_shaken(limiter, {frequency, 1.0, lag}, frequency, resonant_span(frequency), 20.0) == 0);
      CHECK(limiter.share() == 1.0);
      ReversalLimiter blind(paper_spec(), kLimiterPeriod);
      if (frequency >= 12.0) CHECK(lowered(blind, frequency, resonant_span(frequency), 20.0) > 0);  // negative control
    }
  }
}

TEST_CASE("shaken or not, a wall is lowered for what turns oftener, or goes further than a passive wall lets it") {
  ReversalLimiter oftener(paper_spec(), kLimiterPeriod);
  CHECK(lowered_shaken(oftener, {20.0}, 45.0, 0.001, 1.0) > 0);
  CHECK(oftener.share() < 1.0);
  ReversalLimiter wider(paper_spec(), kLimiterPeriod);
  CHECK(lowered_shaken(wider, {20.0}, 20.0, 1.5 * resonant_span(20.0), 1.0) > 0);
  CHECK(wider.share() < 1.0);
  ReversalLimiter barely_shaken(paper_spec(), kLimiterPeriod);
  CHECK(lowered_shaken(barely_shaken, {20.0, 0.03}, 20.0, 6.0 * kCount, 1.0) > 0);
}

TEST_CASE("a shake that is over answers for nothing") {
  ReversalLimiter limiter(paper_spec(), kLimiterPeriod), fresh(paper_spec(), kLimiterPeriod);
  CHECK(lowered_shaken(limiter, {20.0}, 20.0, 0.001, 5.0) == 0);
  CHECK(lowered(limiter, 1.0, 0.0, 0.3) == 0);
  for (int n = 0; n < 400; ++n) {
    const double y = 0.001 * std::sin(2.0 * std::numbers::pi * 40.0 * n * kLimiterPeriod);
    const bool now = limiter.update({0.0, y}, true, 5000.0, {0.0, 0.0});
    CHECK(now == fresh.update({0.0, y}, true, 5000.0, {0.0, 0.0}));
  }
}
