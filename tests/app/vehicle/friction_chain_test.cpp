// The friction chain's motion satisfies a minimum principle. The test searches for the minimum independently.
#include "app/vehicle/friction_chain.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>

using namespace gearshift;
using namespace gearshift::vehicle;

namespace {

// The sum of Gauss' constraint and the rate of friction dissipation, for the case that no contact slips yet. The sum is
// strictly convex in `rate`.
double cost(const FrictionChain& chain, const ChainLoads& loads, const PerBody& rate) {
  double sum = 0.0;
  for (std::size_t b = 0; b < 3; ++b) {
    sum += 0.5 * chain.inertia[b] * rate[b] * rate[b] - loads.push[b] * rate[b];
    sum += loads.ground[b] * std::abs(rate[b]);
  }
  sum += loads.clutch * std::abs(rate[0] - rate[1]);
  if (chain.link == GearLink::cone) sum += loads.cone * std::abs(rate[1] - chain.per_road * rate[2]);
  return sum;
}

struct Draw {
  FrictionChain chain;
  ChainLoads loads;
};

Draw draw(std::mt19937& random) {
  const auto number = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  const auto scale = [&] { return std::pow(10.0, number(-1.0, 1.0)); };
  const auto limit = [&] { return number(0.0, 1.0) < 0.2 ? 0.0 : number(0.0, 30.0); };
  Draw d;
  d.chain.inertia = {scale(), scale(), scale()};
  d.chain.link = std::array{GearLink::open, GearLink::cone, GearLink::dogs}[random() % 3];
  d.chain.per_road = (random() % 2 == 0 ? 1.0 : -1.0) * scale();
  d.loads.push = {number(-30.0, 30.0), number(-30.0, 30.0), number(-30.0, 30.0)};
  d.loads.ground = {limit(), limit(), limit()};
  d.loads.clutch = limit();
  d.loads.cone = limit();
  return d;
}

}  // namespace

TEST_CASE("bodies at rest start to move so that Gauss' constraint plus friction dissipation is minimal") {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  int held = 0, moved = 0;
  for (int i = 0; i < 3000; ++i) {
    const Draw d = draw(random);
    const Solution s = solve_modes(d.chain, d.loads, {}, {});
    REQUIRE(s.motion.violation == 0.0);
    const double min_cost = cost(d.chain, d.loads, s.motion.rate);
    (s.motion.rate == PerBody{} ? held : moved) += 1;
    for (const double size : {1.0, 1e-3}) {
      for (int n = 0; n < 20; ++n) {
        PerBody other = s.motion.rate;
        for (double& r : other) r += size * normal(random);
        // Also samples rates at which a contact sticks, because the cost has its kinks there.
        if (n % 4 == 0) other[0] = other[1];
        if (n % 4 == 1) other[1] = d.chain.per_road * other[2];
        if (d.chain.link == GearLink::dogs) other[1] = d.chain.per_road * other[2];
        CHECK(cost(d.chain, d.loads, other) >= min_cost - 1e-9);
      }
    }
  }
  CHECK(held > 100);
  CHECK(moved > 1000);
}

TEST_CASE("inertia times acceleration is the sum of the contact torques and the push, for each body") {
  std::mt19937 random(2);
  for (int i = 0; i < 3000; ++i) {
    Draw d = draw(random);
    d.chain.efficiency = i % 2 == 0 ? 1.0 : 0.9;
    const ChainMotion m = solve_modes(d.chain, d.loads, {}, {}).motion;
    REQUIRE(m.violation == 0.0);
    CHECK(std::abs(d.loads.push[0] + m.ground[0] - m.clutch - d.chain.inertia[0] * m.rate[0]) < 1e-9);
    CHECK(std::abs(d.loads.push[1] + m.ground[1] + m.clutch - m.gear - d.chain.inertia[1] * m.rate[1]) < 1e-9);
    CHECK(std::abs(d.loads.push[2] + m.ground[2] + m.drive - d.chain.inertia[2] * m.rate[2]) < 1e-9);
    CHECK(std::abs(m.clutch) <= d.loads.clutch * (1.0 + 1e-9));
    if (d.chain.link == GearLink::cone) CHECK(std::abs(m.gear) <= d.loads.cone * (1.0 + 1e-9));
    if (d.chain.link == GearLink::open) CHECK(m.gear == 0.0);
  }
}

TEST_CASE("an initial guess does not change the solution") {
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    const Draw d = draw(random);
    const PerBody rate = solve_modes(d.chain, d.loads, {}, {}).motion.rate;
    for (const FrictionMode& guess :
         {FrictionMode{1, -1, {1, 1, -1}}, FrictionMode{-1, 1, {-1, -1, 1}}, FrictionMode{0, 0, {-1, -1, -1}}}) {
      const PerBody guessed = solve_modes(d.chain, d.loads, {}, guess).motion.rate;
      for (std::size_t b = 0; b < 3; ++b) CHECK(std::abs(rate[b] - guessed[b]) < 1e-9);
    }
  }
}

// If the engine drives, the wheels get 0.9 of its torque. If the wheels drive the engine, they must supply 1 / 0.9 of
// the torque that the engine takes.
TEST_CASE("gear losses depend on the direction of the power") {
  FrictionChain chain{{0.2, 0.01, 1000.0}, GearLink::dogs, 10.0, 0.9};
  ChainLoads loads;
  loads.push = {50.0, 0.0, 0.0};
  loads.clutch = 200.0;
  const FrictionMode ahead{0, 0, {1, 1, 1}};
  const ChainMotion pulls = motion_in_mode(chain, loads, ahead);
  CHECK(pulls.rate[2] == doctest::Approx(0.9 * 10.0 * 50.0 / (1000.0 + 0.9 * 100.0 * 0.21)).epsilon(1e-12));
  CHECK(pulls.drive == doctest::Approx(0.9 * 10.0 * pulls.gear).epsilon(1e-12));
  loads.push = {-50.0, 0.0, 0.0};
  const ChainMotion drags = motion_in_mode(chain, loads, ahead);
  CHECK(drags.rate[2] == doctest::Approx(-10.0 * 50.0 / 0.9 / (1000.0 + 100.0 * 0.21 / 0.9)).epsilon(1e-12));
}

TEST_CASE("an impact that brings bodies to one speed conserves their momentum, with or without gear losses") {
  const FrictionChain chain{{0.2, 0.01, 50.0}, GearLink::dogs, -8.0, 0.8};
  const PerBody before{100.0, 40.0, 3.0}, after = collide(chain, before, {0, 0, {1, 1, -1}});
  CHECK(after[0] == after[1]);
  CHECK(after[1] == -8.0 * after[2]);
  const auto momentum = [&](const PerBody& v) { return 0.2 * v[0] + 0.01 * v[1] + 50.0 * v[2] / -8.0; };
  CHECK(momentum(after) == doctest::Approx(momentum(before)).epsilon(1e-14));
}
