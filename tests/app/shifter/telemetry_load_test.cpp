// The lever's load from telemetry, against closed forms of its input shaft and the measured ratio.
#include "app/shifter/telemetry_load.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "app/shifter/shifter.h"
#include "tests/app/vehicle/cars.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::shifter;
using namespace gearshift::test;
using namespace gearshift::vehicle;
using doctest::Approx;

namespace {

constexpr double kT = 0.001;  // [s]
constexpr double kNoLimit = std::numeric_limits<double>::max();

struct Bench {
  CarSpec car;
  Gate gate = shipped_gate(car.gate);
  LatestValue<Telemetry> telemetry;
  TelemetryLoad load{car, gate, kPaperForce, telemetry};
  LeverInput lever;
  LeverOutput out;
  double rattle = 0.0;  // [N] largest
  Telemetry now;

  explicit Bench(const CarSpec& spec = shipped_car("hatchback")) : car(spec) { now.is_live = true; }

  void put_into(int gear, double depth, double push = 0.0) {
    lever.slot = slot_of_gear(gate, gear);
    lever.depth = depth;
    lever.push.y = push * static_cast<int>(slot_of(gate, lever.slot).side);
  }
  SleeveStations stations(int gear) const { return sleeve_stations(gate, slot_of(gate, slot_of_gear(gate, gear))); }

  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / kT); ++i) {
      telemetry.write(now);
      out = load.step(lever, kT);
      rattle = std::max(rattle, std::abs(out.vibration.y));
    }
  }
};

}  // namespace

TEST_CASE("without telemetry there is no force, no wall and no speed") {
  Bench bench;
  bench.now.is_live = false;
  bench.now.car.speed = 30.0;
  bench.put_into(1, 0.030, 20.0);
  bench.run(0.1);
  CHECK(bench.out.force.y == 0.0);
  CHECK(bench.out.limited_slot == kNoSlot);
  CHECK(bench.out.road_speed == 0.0);
}

TEST_CASE("with the clutch pressed, the shaft runs down as Coulomb and viscous drag say") {
  CarSpec car = shipped_car("hatchback");
  car.gearbox.drag_slope = 0.005;
  Bench bench(car);
  bench.now.car.engine_speed = 300.0;
  bench.run(0.1);
  CHECK(bench.load.shaft_speed() == 300.0);
  bench.now.car.clutch = 1.0;
  bench.run(0.2);
  // J w' = -d - s w, so w = (w0 + d / s) exp(-s t / J) - d / s
  const double d = bench.car.gearbox.drag, s = bench.car.gearbox.drag_slope, j = bench.car.clutch.disc_inertia;
  CHECK(bench.load.shaft_speed() == Approx((300.0 + d / s) * std::exp(-s * 0.2 / j) - d / s).epsilon(1e-3));
}

TEST_CASE("the ring blocks while the speeds differ, and the gear goes in once the cone has made them equal") {
  Bench bench;
  bench.now.car.speed = 10.0;
  bench.now.car.engine_speed = 500.0;
  bench.run(0.01);
  bench.now.car.clutch = 1.0;
  const SleeveStations at = bench.stations(3);
  bench.put_into(3, at.block, 10.0);
  bench.run(0.01);
  CHECK(bench.out.limited_slot == bench.lever.slot);
  CHECK(bench.out.depth_max == Approx(at.block));
  bench.run(3.0);
  CHECK(bench.load.shaft_speed() == Approx(shaft_per_road(bench.car, 3) * 10.0).epsilon(0.01));
  CHECK(bench.out.depth_max > at.block);
  bench.put_into(3, at.home, 10.0);
  bench.run(0.1);
  CHECK(bench.out.depth_max == kNoLimit);
}

TEST_CASE("with the clutch up and other speeds, the dogs of reverse grind and rattle") {
  Bench bench;
  bench.now.car.speed = 0.0;
  bench.now.car.engine_speed = 90.0;
  const SleeveStations at = bench.stations(kReverseGear);
  bench.put_into(kReverseGear, at.dogs, 15.0);
  bench.run(0.3);
  CHECK(bench.out.depth_max == Approx(at.dogs));
  CHECK(bench.rattle > 1.0);
}

TEST_CASE("a loaded gear is held, and a pressed clutch frees it; the lever's gear is in when telemetry begins") {
  Bench bench;
  bench.lever.gear = 3;
  bench.put_into(3, bench.stations(3).home);
  bench.now.car.speed = 15.0;
  bench.now.car.engine_speed = shaft_per_road(bench.car, 3) * 15.0;
  bench.now.car.throttle = 1.0;
  bench.run(0.1);
  CHECK(bench.out.depth_min == Approx(bench.lever.depth));
  CHECK(bench.out.road_speed == 15.0);
  bench.now.car.clutch = 1.0;
  bench.run(0.1);
  CHECK(bench.out.depth_min == 0.0);
}

TEST_CASE("the other car's ratio is measured in gear with the clutch up, and not with it down or in another gear") {
  Bench bench;
  const int slot = slot_of_gear(bench.gate, 3);
  const double before = bench.load.per_road(slot);
  bench.lever.gear = 3;
  bench.put_into(3, bench.stations(3).home);
  bench.now.car.gear = 3;
  bench.now.car.speed = 20.0;
  bench.now.car.engine_speed = 1.3 * before * 20.0;
  bench.now.car.clutch = 1.0;
  bench.run(1.0);
  CHECK(bench.load.per_road(slot) == before);
  bench.now.car.clutch = 0.0;
  bench.run(0.5);
  CHECK(bench.load.per_road(slot) == Approx(before * (1.0 + 0.3 * (1.0 - std::exp(-1.0)))).epsilon(0.01));
  bench.run(5.0);
  CHECK(bench.load.per_road(slot) == Approx(1.3 * before).epsilon(1e-3));
  bench.now.car.gear = 4;
  bench.now.car.engine_speed = 2.0 * before * 20.0;
  bench.run(1.0);
  CHECK(bench.load.per_road(slot) == Approx(1.3 * before).epsilon(1e-3));
}

TEST_CASE("buttons: forward gears, then reverse, then other positions; up and down of a sequential gate") {
  const auto labels = [](const char* name) {
    const Gate gate = shipped_gate(name);
    std::string all;
    for (const int slot : button_slots(gate)) all += std::string(gear_label(gate, slot_of(gate, slot).gear)) + " ";
    return all;
  };
  CHECK(labels("paper") == "1 2 3 4 5 R ");
  CHECK(labels("seven_speed") == "1 2 3 4 5 6 7 R ");
  CHECK(labels("sequential_six") == "+ - ");
  CHECK(labels("selector_p_r_n_d") == "R P D M + - ");
}
