// What a wall makes chatter is told from what a hand does.
#include "haptics/contact/reversal_limiter.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

constexpr double kPeriod = 0.001;
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
  for (int n = 0; n < static_cast<int>(seconds / kPeriod); ++n) {
    const double x = 0.5 * span * std::sin(2.0 * std::numbers::pi * frequency * n * kPeriod);
    count += limiter.update({0.0, x}, touches, wanted);
  }
  return count;
}

}  // namespace

TEST_CASE("a fast rattle in a wall lowers it by a quarter, within a quarter of a second of its beginning") {
  DeviceSpec spec = paper_spec();
  spec.delay = 3;
  ReversalLimiter limiter(spec, kPeriod);
  CHECK(lowered(limiter, 40.0, 6.0 * kCount, 0.10) == 1);
  CHECK(limiter.share() == doctest::Approx(0.75));
  CHECK(lowered(limiter, 40.0, 6.0 * kCount, 0.16) == 2);
  CHECK(limiter.share() == doctest::Approx(0.75 * 0.75 * 0.75));
  limiter.reset();
  CHECK(limiter.share() == 1.0);
}

TEST_CASE("not a hand's own shaking, not the encoder's counts, not what happens in free space") {
  ReversalLimiter limiter(paper_spec(), kPeriod);
  CHECK(lowered(limiter, 8.0, 0.02, 5.0) == 0);            // 16 reversals a second: the fastest of hands
  CHECK(lowered(limiter, 100.0, 3.0 * kCount, 5.0) == 0);  // less than 4 counts
  CHECK(limiter.share() == 1.0);
  ReversalLimiter free(paper_spec(), kPeriod);
  CHECK(lowered(free, 40.0, 0.002, 5.0, false) == 0);  // no wall
}

TEST_CASE("it stops at 0.3 m / tau^2 and then says that softening does not help") {
  DeviceSpec spec = paper_spec();
  spec.delay = 3;  // tau = 4 ms: 0.3 * 0.086 / 16e-6 = 1612.5 N/m
  ReversalLimiter limiter(spec, kPeriod);
  lowered(limiter, 40.0, 0.002, 0.3);
  CHECK_FALSE(limiter.exhausted());
  lowered(limiter, 40.0, 0.002, 3.0);
  CHECK(limiter.exhausted());
  CHECK(limiter.share() * 5000.0 == doctest::Approx(1612.5));
  limiter.reset();
  CHECK_FALSE(limiter.exhausted());
  ReversalLimiter paused(spec, kPeriod);  // at the floor, but each time it calms: nothing is beyond softening
  for (int i = 0; i < 100; ++i) {
    lowered(paused, 40.0, 0.002, 0.1);
    lowered(paused, 1.0, 0.0, 0.5);
  }
  CHECK(paused.share() * 5000.0 == doctest::Approx(1612.5));
  CHECK_FALSE(paused.exhausted());
  ReversalLimiter soft(spec, kPeriod);  // wanted below the floor: nothing to take
  lowered(soft, 40.0, 0.002, 3.0, true, 1000.0);
  CHECK(soft.share() == 1.0);
  CHECK(soft.exhausted());
}
