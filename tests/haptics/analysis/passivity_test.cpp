// Compares the paper's passivity conditions with their closed forms, and eq (13) with a search over many frequencies.
// Checks the theorem itself: a passive environment is stable with every passive hand.
#include "haptics/analysis/passivity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace gearshift::haptics;

namespace {

using Complex = std::complex<double>;

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Eq (13) exactly as printed in the paper, evaluated at 100,000 frequencies.
double demand_by_search(const Environment& environment, double period) {
  constexpr int kAngles = 100000;
  double largest = -1e300;
  for (int i = 1; i <= kAngles; ++i) {
    const double angle = std::numbers::pi * i / kAngles;
    const Complex z = std::polar(1.0, angle);
    const double factor = 0.5 * period / (1.0 - std::cos(angle));
    largest = std::max(largest, factor * ((1.0 - std::conj(z)) * environment(z)).real());
  }
  return largest;
}

// Damping demanded by a spring and damper that are delayed by one sample. With stiffness K, damping B, period T,
// angular frequency w and c = cos(w T), eq (13) of the paper becomes K T/2 (1 + 2 c) - B (2 c^2 - 1). The
// function returns the maximum of this expression over c.
double demand_one_late(double stiffness, double damping, double period) {
  const double kt = stiffness * period;
  if (kt >= 4.0 * damping) return 1.5 * kt - damping;
  return 0.5 * kt + damping + kt * kt / (8.0 * damping);
}

}  // namespace

TEST_CASE("(14): a spring up to 2 b / T, for the paper's axes 600 and 580 N/m at 100 Hz") {
  CHECK(passive_stiffness_limit(kPaperAxisX.damping, 0.0, 0.0, 0, 0.01) == doctest::Approx(600.0).epsilon(1e-9));
  CHECK(passive_stiffness_limit(kPaperAxisY.damping, 0.0, 0.0, 0, 0.01) == doctest::Approx(580.0).epsilon(1e-9));
  CHECK(passive_stiffness_limit(3.0, 0.0, 0.0, 0, 0.001) == doctest::Approx(6000.0).epsilon(1e-9));
}

TEST_CASE("(16), (18), (20): damper, mass and impedance") {
  for (const double period : {0.01, 0.001, 0.00025}) {
    CHECK(damping_demand(impedance(0.0, 2.9, 0.0, period), period) == doctest::Approx(2.9).epsilon(1e-9));
    CHECK(damping_demand(impedance(0.0, 0.0, 0.015, period), period) ==
          doctest::Approx(2.0 * 0.015 / period).epsilon(1e-9));
    CHECK(damping_demand(impedance(150.0, 1.2, 0.004, period), period) ==
          doctest::Approx(75.0 * period + 1.2 + 0.008 / period).epsilon(1e-9));
  }
  CHECK(passive_stiffness_limit(3.0, 1.0, 0.005, 0, 0.01) == doctest::Approx(200.0).epsilon(1e-9));
  CHECK(passive_stiffness_limit(3.0, 3.0, 0.0, 0, 0.01) == 0.0);
  CHECK(passive_stiffness_limit(3.0, 0.0, 0.016, 0, 0.01) == 0.0);
  CHECK(passive_stiffness_limit(0.0, 0.0, 0.0, 0, 0.01) == 0.0);
}

TEST_CASE("d samples late: a spring up to b / (T/2 + d T), a damper still up to b") {
  for (int delay = 0; delay <= kMaxLoopDelay; ++delay) {
    CAPTURE(delay);
    CHECK(passive_stiffness_limit(3.0, 0.0, 0.0, delay, 0.001) ==
          doctest::Approx(3.0 / (0.0005 + delay * 0.001)).epsilon(1e-9));
    CHECK(damping_demand(delayed(impedance(0.0, 2.5, 0.0, 0.001), delay), 0.001) == doctest::Approx(2.5).epsilon(1e-9));
  }
}

TEST_CASE("spring and damper together, one sample late") {
  for (const double damping : {0.1, 0.5, 1.0, 2.0, 2.9}) {
    CAPTURE(damping);
    for (const double stiffness : {20.0, 300.0, 1500.0, 4000.0}) {
      CHECK(damping_demand(delayed(impedance(stiffness, damping, 0.0, 0.001), 1), 0.001) ==
            doctest::Approx(demand_one_late(stiffness, damping, 0.001)).epsilon(1e-9));
    }
    const double limit = passive_stiffness_limit(3.0, damping, 0.0, 1, 0.001);
    CHECK(demand_one_late(limit, damping, 0.001) == doctest::Approx(3.0).epsilon(1e-8));
  }
}

TEST_CASE("any impedance, any delay: the damping demand equals the largest over 100,000 frequencies") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 40; ++i) {
    const double period = std::exp(between(random, std::log(1e-4), std::log(1e-2)));
    const double damping = between(random, 0.0, 10.0);
    const int delay = i % (kMaxLoopDelay + 1);
    const Environment environment = delayed(
        impedance(between(random, 0.0, 10.0 / period), damping, between(random, 0.0, 3.0 * period), period), delay);
    const double searched = demand_by_search(environment, period), found = damping_demand(environment, period);
    CAPTURE(period);
    CAPTURE(delay);
    CHECK(found >= searched - 1e-9 * std::abs(searched));
    CHECK(found <= searched + 1e-4 * std::abs(searched));
  }
}

TEST_CASE("at its limit the wall demands exactly the device's damping") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 40; ++i) {
    ContactLaw law;
    law.hold = i % 2 == 0 ? ContactHold::zero_order : ContactHold::half_sample;
    law.damping = between(random, 0.0, 3.0);
    law.free_damping = i % 3 == 0 ? between(random, 0.0, 1.0) : 0.0;
    law.window = 1 + i % 17;
    law.delay = i % 5;
    const double period = std::exp(between(random, std::log(2.5e-4), std::log(1e-2)));
    law.stiffness = passive_stiffness_limit(5.0, law, period);
    CAPTURE(i);
    REQUIRE(law.stiffness > 0.0);
    CHECK(damping_demand(contact_environment(law, period), period) == doctest::Approx(5.0).epsilon(1e-8));
  }
}

TEST_CASE("the half-sample hold is a spring and a damper of K (T/2 + d T), all of it late") {
  ContactLaw law;
  law.stiffness = 800.0;
  law.damping = 1.5;
  for (const int delay : {0, 1, 4}) {
    law.delay = delay;
    const Environment same = delayed(impedance(800.0, 1.5 + 800.0 * (0.0005 + 0.001 * delay), 0.0, 0.001), delay);
    for (const double angle : {0.01, 0.7, 2.0, 3.1}) {
      const Complex z = std::polar(1.0, angle);
      CHECK(std::abs(contact_environment(law, 0.001)(z) - same(z)) < 1e-9 * std::abs(same(z)));
    }
  }
}

// The theorem of Colgate and Schenkel, checked with sampled_loop.h. That code and passivity.h have only the control law
// in common.
TEST_CASE("a passive environment is stable in every passive hand") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    const AxisModel handle{between(random, 0.02, 0.5), between(random, 0.5, 8.0), between(random, 0.0, 50.0)};
    const HandImpedance hand{between(random, 0.0, 5.0), i % 3 == 0 ? 0.0 : between(random, 0.0, 20.0),
                             between(random, 0.0, 2000.0)};
    const double period = std::exp(between(random, std::log(2.5e-4), std::log(1e-2)));
    ContactLaw law;
    law.hold = ContactHold::zero_order;
    law.damping = between(random, 0.0, 0.9) * handle.damping;
    law.delay = i % 9;
    law.window = 1 + i % 5;
    law.stiffness = 0.999 * passive_stiffness_limit(handle.damping, law, period);
    CAPTURE(i);
    CHECK(law.stiffness > 0.0);
    CHECK(spectral_radius(handle, hand, law, period) < 1.0);
  }
}

TEST_CASE("passivity is a tight bound: in a heavy hand a spring just above 2 b / T is unstable") {
  ContactLaw law;
  law.hold = ContactHold::zero_order;
  const double limit = stiffness_limit({0.095, 3.0, 0.0}, {100.0, 0.0, 0.0}, law, 0.001);
  CHECK(limit > 6000.0);
  CHECK(limit < 6000.1);
}

TEST_CASE("invalid arguments are rejected") {
  CHECK_THROWS_AS(passive_stiffness_limit(-1.0, 0.0, 0.0, 0, 0.001), std::invalid_argument);
  CHECK_THROWS_AS(passive_stiffness_limit(3.0, 0.0, 0.0, -1, 0.001), std::invalid_argument);
  CHECK_THROWS_AS(passive_stiffness_limit(3.0, 0.0, 0.0, 0, 0.0), std::invalid_argument);
  ContactLaw observed;
  observed.hold = ContactHold::observer;
  CHECK_THROWS_AS(contact_environment(observed, 0.001), std::invalid_argument);
  CHECK_THROWS_AS(damping_demand(impedance(1.0, 0.0, 0.0, 0.001), std::nan("")), std::invalid_argument);
}
