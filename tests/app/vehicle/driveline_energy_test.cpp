// The energy ledger of the driveline balances, up to rounding, for any use of the pedals.
#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "app/lab/bench/driveline/drives.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::lab;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

double spent(const EnergyLedger& e) {
  return e.friction + e.clutch + e.cone + e.shaft_drag + e.rolling + e.brakes + e.slope + e.teeth + e.mesh;
}

double turnover(const EnergyLedger& e) {
  return std::abs(e.engine) + e.friction + e.clutch + e.cone + e.shaft_drag + e.rolling + e.brakes + e.teeth + e.mesh;
}

// A loss must never decrease. The energy spent on the slope is not a loss, so it may decrease.
bool losses_only_grow(const EnergyLedger& a, const EnergyLedger& b, double rounding) {
  const double EnergyLedger::*losses[] = {&EnergyLedger::friction, &EnergyLedger::clutch, &EnergyLedger::cone,
                                          &EnergyLedger::rolling,  &EnergyLedger::brakes, &EnergyLedger::shaft_drag,
                                          &EnergyLedger::teeth,    &EnergyLedger::mesh};
  return std::all_of(std::begin(losses), std::end(losses),
                     [&](const double EnergyLedger::*part) { return b.*part >= a.*part - rounding; });
}

// A driver with random pedals and gears, who sometimes switches the ignition off or presses a synchroniser cone.
class RandomDriver {
 public:
  explicit RandomDriver(unsigned seed) : random_(seed) {}
  DrivelineInput next() {
    for (double* pedal : {&in_.pedals.throttle, &in_.pedals.clutch, &in_.pedals.brake, &in_.pedals.hand_brake}) {
      if (random_() % 200 == 0) *pedal = random_() % 2 == 0 ? number(0.0, 1.0) : random_() % 3 == 0 ? 1.0 : 0.0;
    }
    if (random_() % 50 == 0) in_.slope = number(-0.2, 0.2);
    if (random_() % 500 == 0) in_.meshed = static_cast<int>(random_() % 7) - 1;
    if (random_() % 500 == 0) in_.cone_gear = static_cast<int>(random_() % 7) - 1;
    if (random_() % 100 == 0) in_.cone_torque = number(0.0, 40.0);
    if (random_() % 3000 == 0) in_.ignition = !in_.ignition;
    if (!in_.ignition && random_() % 200 == 0) in_.ignition = true;
    // The starter is on for 1.5 s on average, because starting takes at least half a second.
    in_.starter = random_() % (in_.starter ? 1500 : 400) == 0 ? !in_.starter : in_.starter;
    return in_;
  }
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

 private:
  std::mt19937 random_;
  DrivelineInput in_;
};

}  // namespace

TEST_CASE("the energy from engine and slope is kinetic or dissipated, to 1e-12 over a minute of random input") {
  const unsigned seeds = is_full_campaign() ? 20 : 6;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    CAPTURE(seed);
    CarSpec car = hatchback();
    car.engine.compression = 40.0;
    car.engine.idle_integral_gain = 0.03;
    car.engine.idle_lift = 20.0;
    if (seed % 2 == 1) car.gearbox.efficiency = 0.93;
    RandomDriver fool(seed);
    Driveline line(car);
    line.place(100.0, 50.0, fool.number(-10.0, 30.0), true);
    const double begin = line.kinetic_energy();
    bool good = true;
    for (int i = 0; i < 60000; ++i) {
      const EnergyLedger before = line.energy();
      line.step(fool.next(), 0.001);
      good = good && losses_only_grow(before, line.energy(), 1e-8) && std::isfinite(line.state().acceleration);
    }
    CHECK(good);
    const EnergyLedger& e = line.energy();
    CHECK(std::abs(begin + e.engine - spent(e) - line.kinetic_energy()) < 1e-12 * (turnover(e) + begin));
    CHECK(turnover(e) > 5e4);  // [J] so that the relative bound above is strict; stalls make some drives short
    CHECK(line.fallbacks() == 0);
  }
}

TEST_CASE("ledger entries that the drive does not use stay zero") {
  Driveline line(hatchback());
  for (int i = 0; i < 2000; ++i) line.step(pedals(0, 0.3, 1.0), 0.001);
  const EnergyLedger& e = line.energy();
  CHECK(e.engine > 0.0);
  CHECK(e.friction > 0.0);
  for (const double part : {e.clutch, e.cone, e.shaft_drag, e.rolling, e.brakes, e.slope, e.teeth, e.mesh})
    CHECK(part == 0.0);
}

TEST_CASE("with the engine off the car only loses energy") {
  Driveline line(hatchback());
  line.place(400.0, 400.0, 400.0 / shaft_per_road(hatchback(), 2), false);
  DrivelineInput in = pedals(2, 1.0, 0.0);
  in.ignition = false;
  double last = 1e99;
  bool falls = true;
  for (int i = 0; i < 60000 && line.state().road_speed != 0.0; ++i) {
    in.pedals.clutch = 0.5 + 0.5 * std::sin(0.01 * i);
    line.step(in, 0.001);
    falls = falls && line.kinetic_energy() < last;
    last = line.kinetic_energy();
  }
  CHECK(falls);
  CHECK(line.state().road_speed == 0.0);
  CHECK(line.energy().engine == 0.0);
}

// With an efficiency of 0.9, the gear teeth turn a tenth of the transmitted energy into heat.
TEST_CASE("gear teeth dissipate (1 - efficiency) of the transmitted energy") {
  CarSpec car = bare_car(0.1, 0.6, 300.0, 100.0);
  car.gearbox.efficiency = 0.9;
  Driveline line(car);
  line.place(50.0, 50.0, 5.0, true);
  const double begin = 0.5 * car.body.mass * 25.0;
  for (int i = 0; i < 2000; ++i) line.step(pedals(1, 1.0, 0.0), 0.001);
  const double gained = 0.5 * car.body.mass * std::pow(line.state().road_speed, 2) - begin;
  CHECK(line.energy().teeth == doctest::Approx(gained / 9.0).epsilon(1e-9));
}

TEST_CASE("without external torque momentum is constant while the clutch slips, locks and is locked") {
  const CarSpec car = bare_car(0.15, 0.569, 200.0);
  Driveline line(car);
  line.place(300.0, 30.0, 3.0, false);
  DrivelineInput in = pedals(1, 0.0, 0.0);
  in.ignition = false;
  const auto momentum = [&] { return 0.15 * line.state().engine_speed + 0.569 * kPerRoad * line.state().road_speed; };
  const double begin = momentum();
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    line.step(in, 0.001);
    worst = std::max(worst, std::abs(momentum() / begin - 1.0));
  }
  CHECK(line.state().clutch_locked);
  CHECK(worst < 1e-13);
}
