// Tests of the force guard: its output is finite, stays within the slew limit and the limits of the device, and is zero
// soon after any fault.
#include "haptics/safety/force_guard.h"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace gearshift::haptics;
using glm::dvec2;

namespace {

constexpr double kPeriod = 0.001;

DeviceSpec paper_spec() {
  DeviceSpec spec;
  spec.workspace = {0.077, 0.069};
  return spec;
}

GuardInput wanting(dvec2 force) {
  GuardInput in;
  in.force = force;
  in.fresh = true;
  return in;
}

ForceGuard running_guard(dvec2 force = {5.0, 0.0}) {
  ForceGuard guard({}, paper_spec(), kPeriod);
  guard.arm();
  for (int i = 0; i < 600; ++i) guard.guard(wanting(force));
  return guard;
}

}  // namespace

TEST_CASE("no force before a person arms it") {
  ForceGuard guard({}, paper_spec(), kPeriod);
  for (int i = 0; i < 100; ++i) CHECK(guard.guard(wanting({5.0, 5.0})).force == dvec2{0.0, 0.0});
  CHECK(guard.state() == GuardState::idle);
}

TEST_CASE("the ramp is linear and takes its stated time") {
  ForceGuard guard({}, paper_spec(), kPeriod);
  guard.arm();
  for (int i = 1; i <= 500; ++i) {
    CHECK(guard.guard(wanting({10.0, 0.0})).force.x == doctest::Approx(10.0 * i * kPeriod / 0.5));
  }
  CHECK(guard.state() == GuardState::running);
}

TEST_CASE("the output's ramp: rising while ramping, then 1, and 0 in every other state") {
  ForceGuard guard({}, paper_spec(), kPeriod);
  CHECK(guard.guard(wanting({1.0, 0.0})).ramp == 0.0);
  guard.arm();
  GuardInput stale = wanting({1.0, 0.0});
  stale.fresh = false;
  CHECK(guard.guard(stale).ramp == 0.0);  // armed, waiting
  for (int i = 1; i <= 500; ++i) CHECK(guard.guard(wanting({0.0, 0.0})).ramp == doctest::Approx(i * kPeriod / 0.5));
  CHECK(guard.guard(wanting({0.0, 0.0})).ramp == 1.0);
  guard.damp();
  CHECK(guard.guard(wanting({1.0, 0.0})).ramp == 0.0);
  guard.stop();
  CHECK(guard.guard(wanting({1.0, 0.0})).ramp == 0.0);
}

TEST_CASE("whatever is wanted, the command is finite, within the device and within the slew") {
  ForceGuard guard = running_guard();
  const GuardConfig config;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> force(-200.0, 200.0);
  dvec2 last = guard.guard(wanting({5.0, 0.0})).force;
  for (int i = 0; i < 100000; ++i) {
    const dvec2 now = guard.guard(wanting({force(random), force(random)})).force;
    REQUIRE(std::abs(now.x) <= 31.7);
    REQUIRE(std::abs(now.y) <= 31.7);
    REQUIRE(std::abs(now.x - last.x) <= config.slew + 1e-12);
    REQUIRE(std::abs(now.y - last.y) <= config.slew + 1e-12);
    last = now;
  }
}

TEST_CASE("saturation is reported for each force beyond the device") {
  ForceGuard guard = running_guard();
  CHECK_FALSE(guard.guard(wanting({31.6, -31.6})).saturated);
  CHECK(guard.guard(wanting({0.0, 31.8})).saturated);
  GuardInput in = wanting({0.0, 28.0});
  in.beside = {0.0, 3.0};  // of the device's springs
  CHECK_FALSE(guard.guard(in).saturated);
  in.beside = {0.0, 4.0};
  CHECK(guard.guard(in).saturated);
  in.beside = {0.0, -4.0};
  CHECK_FALSE(guard.guard(in).saturated);
  in = wanting({0.0, 0.0});
  in.beside = {0.0, -32.0};
  CHECK(guard.guard(in).saturated);
}

TEST_CASE(
    "the motors and the device's springs together stay within the device, and the motors never push against them") {
  ForceGuard guard = running_guard();
  const auto settled = [&](double force, double spring) {
    GuardInput in = wanting({0.0, force});
    in.beside = {0.0, spring};
    for (int i = 0; i < 10; ++i) guard.guard(in);
    return guard.guard(in).force.y;
  };
  CHECK(settled(31.7, 0.0) == 31.7);
  CHECK(settled(31.7, 5.0) == doctest::Approx(26.7));
  CHECK(settled(40.0, 31.7) == 0.0);
  CHECK(settled(40.0, 50.0) == 0.0);   // not -18.3
  CHECK(settled(31.7, -5.0) == 31.7);  // the motors against a spring that pushes the other way
  CHECK(settled(20.0, 5.0) == 20.0);
  CHECK(settled(-40.0, -5.0) == doctest::Approx(-26.7));
}

TEST_CASE("frozen reading: damped after 20 ms, force zero within 20 ms more") {
  ForceGuard guard = running_guard({10.0, -8.0});
  GuardInput frozen = wanting({10.0, -8.0});
  frozen.fresh = false;
  frozen.velocity = {1.0, 1.0};  // the velocity of a stale reading must not cause damping
  for (int ms = 1; ms <= 20; ++ms) guard.guard(frozen);
  CHECK(guard.state() == GuardState::running);
  double last = 10.0;
  for (int ms = 21; ms <= 41; ++ms) {
    const double now = glm::length(guard.guard(frozen).force);
    CHECK(now <= last * 1.3);
    last = now;
  }
  CHECK(guard.state() == GuardState::damped);
  CHECK(guard.fault() == GuardFault::stale_reading);
  CHECK(last == 0.0);
}

TEST_CASE("not finite, or outside the workspace: motors off in the same cycle") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const dvec2 bad : {dvec2{nan, 0.0}, dvec2{0.0, inf}, dvec2{-inf, nan}}) {
    ForceGuard guard = running_guard();
    CHECK(guard.guard(wanting(bad)).force == dvec2{0.0, 0.0});
    CHECK(guard.state() == GuardState::released);
    CHECK(guard.fault() == GuardFault::not_finite);
  }
  ForceGuard guard = running_guard();
  GuardInput far = wanting({5.0, 0.0});
  far.position = {0.2, 0.0};
  CHECK(guard.guard(far).force == dvec2{0.0, 0.0});
  CHECK(guard.fault() == GuardFault::limit_broken);
}

TEST_CASE("outside on either axis and either side, or a speed that is not finite: motors off in the same cycle") {
  for (const dvec2 outside : {dvec2{0.1, 0.0}, dvec2{-0.1, 0.0}, dvec2{0.0, 0.092}, dvec2{0.0, -0.092}}) {
    ForceGuard guard = running_guard();
    GuardInput in = wanting({5.0, 0.0});
    in.position = outside;
    CHECK(guard.guard(in).force == dvec2{0.0, 0.0});
    CHECK(guard.state() == GuardState::released);
  }
  ForceGuard guard = running_guard();
  GuardInput in = wanting({5.0, 0.0});
  in.velocity = {0.0, std::numeric_limits<double>::infinity()};
  CHECK(guard.guard(in).force == dvec2{0.0, 0.0});
  CHECK(guard.fault() == GuardFault::not_finite);
}

TEST_CASE("arming clears old faults: a fault that is over has no further effect") {
  ForceGuard guard = running_guard();
  GuardInput late = wanting({5.0, 0.0});
  late.skipped = 1;
  for (int i = 0; i < 8; ++i) guard.guard(late);
  REQUIRE(guard.state() == GuardState::damped);
  guard.arm();
  for (int i = 0; i < 7; ++i) guard.guard(late);
  CHECK(guard.state() == GuardState::ramping);
  CHECK(guard.fault() == GuardFault::none);
}

TEST_CASE("one overrun is counted, eight in a row are damped") {
  ForceGuard guard = running_guard();
  GuardInput late = wanting({5.0, 0.0});
  late.skipped = 1;
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 7; ++i) guard.guard(late);
    guard.guard(wanting({5.0, 0.0}));
  }
  CHECK(guard.state() == GuardState::running);
  for (int i = 0; i < 8; ++i) guard.guard(late);
  CHECK(guard.state() == GuardState::damped);
  CHECK(guard.fault() == GuardFault::overruns);
}

TEST_CASE("0.1 s without a timely cycle, in one gap or several: motors off on a real device, not a simulated one") {
  const auto is_released = [](ForceGuard guard, std::initializer_list<int> skipped) {
    GuardOutput out;
    for (const int cycles : skipped) {
      GuardInput late = wanting({5.0, 0.0});
      late.skipped = cycles;
      out = guard.guard(late);
    }
    CHECK((out.force == dvec2{0.0, 0.0}) == (guard.state() == GuardState::released));
    return guard.state() == GuardState::released && guard.fault() == GuardFault::overruns;
  };
  CHECK_FALSE(is_released(running_guard(), {100}));
  CHECK(is_released(running_guard(), {101}));
  CHECK(is_released(running_guard(), {2999}));
  CHECK(is_released(running_guard(), {60, 60}));
  CHECK_FALSE(is_released(running_guard(), {60, 0, 60}));
  DeviceSpec simulated = paper_spec();
  simulated.simulated = true;
  ForceGuard guard(GuardConfig{}, simulated, kPeriod);
  guard.arm();
  for (int i = 0; i < 1000; ++i) guard.guard(wanting({5.0, 0.0}));
  CHECK_FALSE(is_released(guard, {2999}));
}

TEST_CASE("a reading's age counts elapsed time, not executed cycles") {
  ForceGuard guard = running_guard();
  GuardInput stale = wanting({5.0, 0.0});
  stale.fresh = false;
  stale.skipped = 10;
  // Cycles that were skipped before the first stale reading do not count towards its age. The thread that reads the
  // stick may have been stopped, too.
  guard.guard(stale);
  guard.guard(stale);  // 12 ms
  CHECK(guard.state() == GuardState::running);
  guard.guard(stale);  // 23 ms
  CHECK(guard.state() == GuardState::damped);
  CHECK(guard.fault() == GuardFault::stale_reading);
}

TEST_CASE("any number of skipped cycles in a trace: a real device is released, a simulated one continues") {
  for (const bool simulated : {false, true}) {
    DeviceSpec spec = paper_spec();
    spec.simulated = simulated;
    ForceGuard guard(GuardConfig{}, spec, kPeriod);
    guard.arm();
    for (int i = 0; i < 1000; ++i) guard.guard(wanting({5.0, 0.0}));
    GuardInput late = wanting({5.0, 0.0});
    late.skipped = std::numeric_limits<std::int64_t>::max();
    for (int i = 0; i < 5; ++i) guard.guard(late);
    CHECK(guard.state() == (simulated ? GuardState::running : GuardState::released));
    late.fresh = false;
    for (int i = 0; i < 2; ++i) guard.guard(late);
    CHECK(guard.state() == (simulated ? GuardState::damped : GuardState::released));
  }
}

TEST_CASE("damped: the old force fades and the rest opposes motion") {
  ForceGuard guard = running_guard();
  GuardInput late = wanting({5.0, 0.0});
  late.skipped = 1;
  late.velocity = {0.2, -0.1};
  GuardOutput out;
  for (int i = 0; i < 100; ++i) out = guard.guard(late);
  const GuardConfig config;
  CHECK(out.force.x == doctest::Approx(-config.damped_damping * 0.2));
  CHECK(out.force.y == doctest::Approx(config.damped_damping * 0.1));
}

TEST_CASE("entering damped never raises the force, at any ramp and slew, and it is zero after the fade time") {
  for (const double slew : {0.2, 2.0, 25.0}) {
    for (const int ramped : {1, 60, 250, 499, 600}) {
      CAPTURE(slew);
      CAPTURE(ramped);
      GuardConfig config;
      config.slew = slew;
      ForceGuard guard(config, paper_spec(), kPeriod);
      guard.arm();
      double last = 0.0;
      for (int i = 0; i < ramped; ++i) last = guard.guard(wanting({30.0, 0.0})).force.x;
      GuardInput frozen = wanting({30.0, 0.0});
      frozen.fresh = false;
      for (int i = 0; i < 20; ++i) last = guard.guard(frozen).force.x;  // for 20 ms, ramp and slew continue
      for (int i = 0; i < 21; ++i) {
        const double now = guard.guard(frozen).force.x;
        CHECK(now <= last + 1e-12);
        last = now;
      }
      CHECK(last == 0.0);
    }
  }
}

TEST_CASE("armed: no force while it waits for the first reading, and damped if none comes within 200 ms") {
  ForceGuard guard({}, paper_spec(), kPeriod);
  guard.arm();
  GuardInput no_reading = wanting({5.0, 0.0});
  no_reading.fresh = false;
  for (int i = 0; i < 200; ++i) CHECK(guard.guard(no_reading).force == dvec2{0.0, 0.0});
  CHECK(guard.state() == GuardState::armed);
  ForceGuard late = guard;
  guard.guard(wanting({5.0, 0.0}));
  CHECK(guard.state() == GuardState::ramping);
  late.guard(no_reading);  // the 201st cycle without a reading
  CHECK(late.state() == GuardState::damped);
  CHECK(late.guard(wanting({5.0, 0.0})).force == dvec2{0.0, 0.0});
}

TEST_CASE("a released guard stays released until it is armed; arming starts from zero force") {
  ForceGuard guard = running_guard();
  guard.stop();
  for (int i = 0; i < 1000; ++i) CHECK(guard.guard(wanting({5.0, 0.0})).force == dvec2{0.0, 0.0});
  CHECK(guard.state() == GuardState::released);
  CHECK(guard.fault() == GuardFault::stopped);
  guard.arm();
  CHECK(guard.guard(wanting({5.0, 0.0})).force.x < 0.02);
}

TEST_CASE("a fault never makes the state less severe: released does not become damped") {
  ForceGuard guard = running_guard();
  guard.stop();
  GuardInput stale = wanting({5.0, 0.0});
  stale.fresh = false;
  for (int i = 0; i < 100; ++i) guard.guard(stale);
  CHECK(guard.state() == GuardState::released);
}
