// Keyboard pedals, compared with their closed form for any time step and at low frame rates.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "app/vehicle/car_load.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::haptics;
using namespace gearshift::vehicle;

namespace {

constexpr PedalTiming kPace{.pedal_time = 0.25, .slip_time = 1.2};
constexpr ClutchSpec kClutch{.bite = 0.8, .closed = 0.2};

// [1] The position of a clutch pedal `time` seconds after its release from the floor (1). The pedal moves to 0.8 at 4
// per second, to 0.2 in 1.2 s, and then to 0 at 4 per second.
double let_up_for(double time) {
  if (time < 0.05) return 1.0 - 4.0 * time;
  if (time < 1.25) return 0.8 - 0.5 * (time - 0.05);
  return std::max(0.0, 0.2 - 4.0 * (time - 1.25));
}

// The clutch position after each cycle of `cycle` seconds. The clutch key is held from 0 s to 0.51 s, and is polled
// once per frame.
std::vector<double> clutch_path(double frames_per_second, double cycle) {
  KeyboardPedals feet(kPace, kClutch);
  PedalKeys keys;
  std::vector<double> path;
  double next_frame = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double time = i * cycle;
    if (time >= next_frame) {
      keys = {.clutch = time < 0.51};
      next_frame += 1.0 / frames_per_second;
    }
    path.push_back(feet.move(keys, cycle, 0.0, false).clutch);
  }
  return path;
}

}  // namespace

TEST_CASE("a released clutch follows its closed form, for any time steps") {
  for (const double part : {0.001, 0.0137, 0.1, 0.9}) {
    CAPTURE(part);
    KeyboardPedals feet(kPace, kClutch);
    CHECK(feet.move({.clutch = true}, 10.0, 0.0, false).clutch == 1.0);
    for (double time = part; time < 2.0; time += part)
      REQUIRE(feet.move({}, part, 0.0, false).clutch == doctest::Approx(let_up_for(time)).epsilon(1e-9));
  }
}

TEST_CASE("at 10, 30 and 144 frames per second the pedal follows the same path, up to a frame late, without jumps") {
  constexpr double kCycle = 0.001;  // [s]
  for (const double rate : {10.0, 30.0, 144.0}) {
    CAPTURE(rate);
    const std::vector<double> path = clutch_path(rate, kCycle);
    const double release = std::ceil(0.51 * rate - 1e-9) / rate;  // [s] time of the first frame after the release
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double time = static_cast<double>(i + 1) * kCycle;
      const double at = time <= release ? std::min(1.0, 4.0 * time) : let_up_for(time - release);
      REQUIRE(std::abs(path[i] - at) <= 4.0 * kCycle * 2.0);  // tolerance: movement in two cycles at 4 per second
      if (i > 0) REQUIRE(std::abs(path[i] - path[i - 1]) <= 4.0 * kCycle + 1e-12);
    }
  }
}

TEST_CASE("with full help the released clutch slips 1.5 times as long, and is as fast as ever elsewhere") {
  const auto time_between = [](double slow, double from, double to) {
    KeyboardPedals feet(kPace, kClutch);
    feet.place({.clutch = from});
    double time = 0.0;
    while (feet.move({.slow_clutch = slow}, 1e-4, 0.0, false).clutch > to) time += 1e-4;
    return time;
  };
  const double slip = time_between(0.0, kClutch.bite, kClutch.closed);
  CHECK(time_between(1.0, kClutch.bite, kClutch.closed) == doctest::Approx(1.5 * slip).epsilon(1e-3));
  CHECK(time_between(0.5, kClutch.bite, kClutch.closed) == doctest::Approx(1.25 * slip).epsilon(1e-3));
  CHECK(time_between(1.0, 1.0, kClutch.bite) == doctest::Approx(time_between(0.0, 1.0, kClutch.bite)));
}

TEST_CASE("light throttle takes a free engine to at most 1700 rpm; under load it is 0.2") {
  const auto throttle = [](double speed, bool coupled) {
    return KeyboardPedals(kPace, kClutch).move({.throttle_light = true}, 1.0, speed, coupled).throttle;
  };
  CHECK(throttle(84.0, false) == doctest::Approx(0.2));
  CHECK(throttle(155.0, false) == doctest::Approx(0.1));
  CHECK(throttle(200.0, false) == 0.0);
  CHECK(throttle(200.0, true) == doctest::Approx(0.2));
}

TEST_CASE(
    "a held throttle stays where it was put, keeps a free engine below a speed that grows with it, and is all there "
    "under load") {
  const auto throttle = [](double held, double speed, bool coupled) {
    return KeyboardPedals(kPace, kClutch).move({.held_throttle = held}, 1.0, speed, coupled).throttle;
  };
  CHECK(throttle(0.5, 84.0, false) == doctest::Approx(0.5));
  CHECK(throttle(0.5, 170.0, false) == doctest::Approx(0.25));  // 130 + 0.5 * 130 = 195 rad/s, half of 50 rad/s below
  CHECK(throttle(0.5, 195.0, false) == 0.0);
  CHECK(throttle(1.0, 235.0, false) == doctest::Approx(0.5));
  for (const double held : {0.1, 0.5, 1.0}) CHECK(throttle(held, 500.0, true) == doctest::Approx(held));
  CHECK(throttle(7.0, 84.0, true) == 1.0);
  CHECK(throttle(std::numeric_limits<double>::quiet_NaN(), 84.0, true) == 0.0);
}

TEST_CASE("once the clutch has gripped, the released pedal comes up at full speed, also in the bite zone") {
  KeyboardPedals feet(kPace, kClutch);
  feet.place({.clutch = 0.7});
  CHECK(feet.move({}, 0.1, 0.0, true).clutch == doctest::Approx(0.3));  // 0.1 s of the 0.25 s for the full travel
  feet.place({.clutch = 0.7});
  CHECK(feet.move({}, 0.1, 0.0, false).clutch == doctest::Approx(0.65));  // 0.1 s of the 1.2 s for 0.6 of the travel
}

TEST_CASE("invalid time steps do not move the pedals") {
  KeyboardPedals feet(kPace, kClutch);
  const PedalKeys all{.throttle = true, .brake = true, .clutch = true};
  for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), -HUGE_VAL, HUGE_VAL}) {
    const Pedals pedals = feet.move(all, seconds, 0.0, false);
    CHECK(pedals.throttle + pedals.brake + pedals.clutch == 0.0);
  }
}

TEST_CASE("pedals that continue from other positions move on from there") {
  KeyboardPedals feet(kPace, kClutch);
  feet.place({.brake = 0.4, .hand_brake = 0.7});
  const Pedals pedals = feet.move({.brake = true}, 0.050, 0.0, false);
  CHECK(pedals.brake == doctest::Approx(0.6));  // the full travel in 0.25 s
  CHECK(pedals.hand_brake == 0.7);
}

TEST_CASE("a pedal of the car is where the axis or the key has put it, whichever is further down") {
  const CarSpec car = gearshift::test::shipped_car("hatchback");
  CarLoad load(car, gearshift::test::gate_of(car), 75.0, {}, 1, kPace);
  const PedalKeys all{.throttle = true, .brake = true, .clutch = true};
  const Pedals keys = load.move_pedals({}, all, 0.1);  // 0.1 s of the 0.25 s for the full travel
  for (const double pedal : {keys.throttle, keys.brake, keys.clutch}) CHECK(pedal == doctest::Approx(0.4));
  CHECK(keys.hand_brake == 0.0);
  const Pedals axes{.throttle = 0.3, .brake = 0.8, .clutch = -0.2, .hand_brake = 0.6};
  const Pedals both = load.move_pedals(axes, all, 0.0);
  CHECK(both.throttle == doctest::Approx(0.4));
  CHECK(both.brake == 0.8);
  CHECK(both.clutch == doctest::Approx(0.4));
  CHECK(both.hand_brake == 0.6);
  CarLoad untouched(car, gearshift::test::gate_of(car), 75.0);
  CHECK(untouched.move_pedals(both, {}, 0.1).throttle == both.throttle);  // as in a replay
  CHECK(untouched.move_pedals(axes, {}, 0.1).clutch == 0.0);
}

TEST_CASE(
    "the foot waits at the bite point while the clutch pulls the engine down, and yields before the engine stalls") {
  KeyboardPedals feet(kPace, kClutch);
  // [1] The pedal 0.1 s later, from the middle of the bite zone, which takes 1.2 s for 0.6 of the travel.
  const auto later = [&](double held, double engine_speed) {
    feet.place({.clutch = 0.5});
    return feet.move({.held_throttle = held}, 0.1, engine_speed, false).clutch;
  };
  CHECK(later(0.5, 200.0) == doctest::Approx(0.45));   // free
  CHECK(later(0.5, 137.5) == doctest::Approx(0.475));  // 195 - 65 = 130 rad/s is the least; half of the 15 rad/s above
  CHECK(later(0.5, 130.0) == doctest::Approx(0.5));
  CHECK(later(0.5, 115.0) == doctest::Approx(0.55));  // yields as fast as it rises
  CHECK(later(0.5, 90.0) == doctest::Approx(0.55));
  CHECK(later(0.0, 84.0) == doctest::Approx(0.45));  // without throttle an idling engine is not pulled down
  CHECK(later(0.0, 50.0) == doctest::Approx(0.55));
  CHECK(later(0.5, 10.0) == doctest::Approx(0.45));   // stalled: nothing is left to feel
  CHECK(later(1.0, 165.0) == doctest::Approx(0.45));  // never waits above 150 rad/s
  feet.place({.clutch = 0.79});
  CHECK(feet.move({.held_throttle = 0.5}, 1.0, 90.0, false).clutch ==
        doctest::Approx(0.8));  // at most to the bite point
}
