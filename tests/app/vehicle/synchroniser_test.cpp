// The synchroniser, compared with closed forms for the cone, the ring and two inertias.
#include "app/vehicle/synchroniser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "app/vehicle/driveline.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

constexpr double kT = 0.001;  // [s]
constexpr double kScale = kPaperForce / kMaxHandForce;

// A sleeve that is pushed against the ring or the dogs, in a car with the clutch down or up.
struct Bench {
  explicit Bench(const CarSpec& spec, double scale = kScale, std::uint64_t seed = 1)
      : car(spec),
        gate(gate_of(spec)),
        sleeve(spec.synchro, gate, scale, kNeutralGear, seed),
        driveline(spec),
        force_scale(scale) {}

  // Enters the slot of gear `wanted` while the shaft turns at `shaft` [rad/s] and the car moves at `road` [m/s].
  void enter(int wanted, double shaft, double road) {
    gear = wanted;
    input.slot = slot_of_gear(gate, gear);
    at = sleeve_stations(gate, slot_of(gate, input.slot));
    driveline.place(clutch_down ? car.engine.idle : shaft, shaft, road, true);
    input.depth = at.block;
  }

  // Runs one cycle in which a hand pushes the knob of the real car with `push` [N].
  void step(double push) {
    const VehicleState& now = driveline.state();
    input.push = force_scale * push;
    input.difference = (now.shaft_speed - shaft_per_road(car, gear) * now.road_speed) / ratio_of(car, gear);
    input.clutch_open = clutch_down;
    input.load = now.drive_torque / car.gearbox.final_drive;
    out = sleeve.step(input, kT);
    DrivelineInput in;
    in.pedals.clutch = clutch_down ? 1.0 : 0.0;
    in.pedals.throttle = throttle;
    in.meshed = out.meshed;
    in.cone_gear = out.cone_gear;
    in.cone_torque = out.cone_torque;
    driveline.step(in, kT);
    if (moves) input.depth = std::min(out.depth_max, input.depth + 0.0003);
    time += kT;
  }

  CarSpec car;
  Gate gate;
  Synchroniser sleeve;
  Driveline driveline;
  double force_scale;
  bool clutch_down = true;
  double throttle = 0.0;
  bool moves = false;  // whether the sleeve moves inwards at 0.3 m/s while nothing blocks it
  int gear = kNeutralGear;
  SleeveStations at;
  SleeveInput input;
  SleeveOutput out;
  double time = 0.0;
};

struct TimedShift {
  int from, to;
  double push, time;  // [N] push; [s] time, computed by a separate program
};
const TimedShift kShifts[] = {{1, 2, 60.0, 0.274}, {2, 3, 60.0, 0.144}, {3, 4, 60.0, 0.081}, {4, 5, 60.0, 0.056},
                              {1, 2, 30.0, 0.508}, {2, 3, 30.0, 0.273}, {3, 4, 30.0, 0.156}, {4, 5, 30.0, 0.109},
                              {2, 1, 60.0, 1.097}, {3, 2, 60.0, 0.375}};

// The time until the speeds of shaft and car match. With the cone's torque T_c, the drag torque T_drag and the gear
// ratio i, the shaft (inertia J, speed w) follows J w' = -+T_c / i - T_drag, and the car (mass m, speed v) follows
// m v' = +-G T_c / i, where G is shaft_per_road(). The drag helps an upshift.
double closed_form(const CarSpec& car, const TimedShift& shift, double difference) {
  const double ratio = ratio_of(car, shift.to), per_road = shaft_per_road(car, shift.to);
  const double cone = shift.push * car.synchro.lever_ratio * car.synchro.efficiency * cone_gain(car.synchro) / ratio;
  const double drag = car.gearbox.drag * (shift.to > shift.from ? 1.0 : -1.0);
  const double shaft = car.clutch.disc_inertia, mass = car.body.mass + car.body.rotating;
  return ratio * difference / (cone * (1.0 / shaft + per_road * per_road / mass) + drag / shaft);
}

// The hatchback without rolling and air resistance, so that the car does not slow down during the shift.
CarSpec rolling_hatchback() {
  CarSpec car = shipped_car("hatchback");
  car.body.resistance = car.body.resistance_slope = car.body.resistance_square = 0.0;
  return car;
}

// [s] The time until the ring lets the sleeve pass, at most 5 s.
double synchronising_time(Bench& bench, double push) {
  do bench.step(push);
  while (bench.out.depth_max == bench.at.block && bench.time < 5.0);
  return bench.time;
}

}  // namespace

TEST_CASE("gains of cone and ring, and the friction below which the ring no longer blocks") {
  CarSpec car = shipped_car("hatchback");
  CHECK(cone_gain(car.synchro) == doctest::Approx(0.0265).epsilon(0.001));
  CHECK(60.0 * 7.0 * 0.8 * cone_gain(car.synchro) == doctest::Approx(8.91).epsilon(0.005));
  CHECK(index_gain(car.synchro) == doctest::Approx(0.0222).epsilon(0.002));
  CHECK(cone_gain(car.synchro) / index_gain(car.synchro) == doctest::Approx(1.20).epsilon(0.005));
  CHECK(critical_friction(car.synchro) == doctest::Approx(0.084).epsilon(0.005));
  car.synchro.pointing_angle = 57.5 * std::numbers::pi / 180.0;
  CHECK(cone_gain(car.synchro) / index_gain(car.synchro) == doctest::Approx(1.46).epsilon(0.005));
  CHECK(critical_friction(car.synchro) == doctest::Approx(0.068).epsilon(0.008));
}

TEST_CASE("synchronising takes J dw i^2 / (T_c +- T_drag i): up and down, 60 N and 30 N, at 2500 rpm") {
  const CarSpec car = rolling_hatchback();
  for (const TimedShift& shift : kShifts) {
    CAPTURE(shift.from);
    CAPTURE(shift.to);
    CAPTURE(shift.push);
    Bench bench(car);
    const double road = road_speed_at(car, shift.from, 2500.0 * kRpm);
    const double target = shaft_per_road(car, shift.to) * road;
    const double difference = std::abs(2500.0 * kRpm - target) / ratio_of(car, shift.to);
    CHECK(closed_form(car, shift, difference) == doctest::Approx(shift.time).epsilon(0.025));
    bench.enter(shift.to, 2500.0 * kRpm, road);
    const double took = synchronising_time(bench, shift.push);
    const double wanted = closed_form(car, shift, difference - car.synchro.dog_speed);
    // The tolerance is 2.5 cycles, because the cone acts only in half of the first cycle, in the last cycle it uses the
    // push of the cycle before, and the time is measured in whole cycles.
    CHECK(std::abs(took - wanted) < 2.5 * kT);
  }
}

TEST_CASE("for any push, the cone's heat is half of its torque times the speed difference times the time") {
  const CarSpec car = shipped_car("hatchback");
  for (const double push : {15.0, 30.0, 60.0, 120.0}) {
    CAPTURE(push);
    Bench bench(car);
    const double road = road_speed_at(car, 1, 2500.0 * kRpm);
    const double difference = (2500.0 * kRpm - shaft_per_road(car, 2) * road) / ratio_of(car, 2);
    bench.enter(2, 2500.0 * kRpm, road);
    const double kinetic = bench.driveline.kinetic_energy();
    const double took = synchronising_time(bench, push);
    const double torque = push * car.synchro.lever_ratio * car.synchro.efficiency * cone_gain(car.synchro);
    const EnergyLedger& went = bench.driveline.energy();
    CHECK(went.cone == doctest::Approx(0.5 * torque * difference * took).epsilon(0.03));
    const double lost = kinetic - bench.driveline.kinetic_energy() + went.engine;
    CHECK(lost == doctest::Approx(went.cone + went.shaft_drag + went.rolling + went.friction).epsilon(1e-9));
  }
}

TEST_CASE("the ring is a hard wall: no push opens it while the speeds differ") {
  const CarSpec car = shipped_car("hatchback");
  for (const double push : {0.0, 5.0, 60.0, 300.0, 1e4}) {
    CAPTURE(push);
    Bench bench(car);
    bench.enter(2, 2500.0 * kRpm, road_speed_at(car, 1, 2500.0 * kRpm));
    bench.step(push);
    for (int i = 0; i < 3000 && std::abs(bench.input.difference) > car.synchro.dog_speed; ++i) {
      REQUIRE(bench.out.depth_max == bench.at.block);
      REQUIRE(bench.out.phase == SyncPhase::synchronising);
      REQUIRE(bench.out.meshed == kNeutralGear);
      bench.step(push);
    }
    if (push >= 5.0) CHECK(bench.out.depth_max == bench.at.dogs);
  }
}

TEST_CASE("a lever that crosses the ring within one cycle is still held there: only equal speeds let it pass") {
  CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  for (const bool worn : {false, true}) {
    if (worn) car.synchro.friction = 0.9 * critical_friction(car.synchro);
    // [rad/s] The speed difference in the cycle before the lever reaches the ring.
    for (const double before : {50.0, 0.9 * car.synchro.dog_speed}) {
      Synchroniser sleeve(car.synchro, gate, kScale, kNeutralGear, 1);
      SleeveInput in;
      in.slot = slot_of_gear(gate, 3);
      in.clutch_open = true;
      in.push = 10.0;
      const SleeveStations at = sleeve_stations(gate, slot_of(gate, in.slot));
      in.depth = 0.5 * (at.index + at.block);
      in.difference = before;
      sleeve.step(in, kT);
      in.depth = at.dogs + 0.001;
      in.difference = 1.1 * car.synchro.dog_speed;
      SleeveOutput out = sleeve.step(in, kT);
      CAPTURE(worn);
      CAPTURE(before);
      CHECK(out.phase == (worn ? SyncPhase::clashing : SyncPhase::synchronising));
      CHECK((out.grind_power > 0.0) == worn);
      CHECK(out.depth_max == (worn ? at.dogs : at.block));
      const double full = 10.0 / kScale * 7.0 * 0.8 * cone_gain(car.synchro);  // [N m] cone torque at the full push
      if (!worn) CHECK(out.cone_torque == doctest::Approx(full));
      CHECK(out.meshed == kNeutralGear);
      in.difference = 0.9 * car.synchro.dog_speed;
      out = sleeve.step(in, kT);
      CHECK(out.meshed == 3);
    }
  }
}

TEST_CASE("with the clutch up the cone would have to accelerate the engine: 60 N cannot do that in 2.5 s") {
  const CarSpec car = shipped_car("hatchback");
  for (const double throttle : {0.0, 0.3}) {
    CAPTURE(throttle);
    Bench bench(car);
    bench.clutch_down = false;
    bench.throttle = throttle;
    bench.enter(1, throttle > 0.0 ? 300.0 : car.engine.idle, 5.0);  // first gear needs 232 rad/s at 5 m/s
    for (int i = 0; i < 2500; ++i) {
      bench.step(60.0);
      REQUIRE(bench.out.depth_max == bench.at.block);
    }
  }
}

TEST_CASE("with the clutch up the sleeve passes when the falling engine speed matches") {
  const CarSpec car = shipped_car("hatchback");
  Bench bench(car);
  bench.clutch_down = false;
  bench.moves = true;
  const double road = road_speed_at(car, 3, 2000.0 * kRpm);
  bench.enter(3, 2300.0 * kRpm, road);
  while (bench.out.meshed == kNeutralGear && bench.time < 3.0) bench.step(20.0);
  CHECK(bench.out.meshed == 3);
  CHECK(bench.driveline.state().engine_speed == doctest::Approx(2000.0 * kRpm).epsilon(0.02));
  CHECK(bench.driveline.energy().mesh < 1.0);
}

TEST_CASE("a worn ring lets the sleeve through below the critical friction, and not above it") {
  CarSpec car = shipped_car("hatchback");
  const double critical = critical_friction(car.synchro);
  for (const double worn : {0.6, 0.9, 0.99, 1.01, 1.1}) {
    CAPTURE(worn);
    car.synchro.friction = worn * critical;
    Bench bench(car);
    bench.enter(2, 2500.0 * kRpm, road_speed_at(car, 1, 2500.0 * kRpm));
    bench.step(30.0);
    CHECK(bench.out.depth_max == (worn < 1.0 ? bench.at.dogs : bench.at.block));
  }
}

TEST_CASE("clashing dogs are a hard wall, dissipate F mu R dw, and engage once the speeds are close") {
  CarSpec car = shipped_car("hatchback");
  car.synchro.friction = 0.05;
  double longer = std::numeric_limits<double>::infinity();
  for (const double push : {15.0, 30.0, 60.0}) {
    CAPTURE(push);
    Bench bench(car);
    bench.moves = true;
    bench.enter(2, 2500.0 * kRpm, road_speed_at(car, 1, 2500.0 * kRpm));
    double ground = 0.0;
    while (bench.out.meshed == kNeutralGear && bench.time < 10.0) {
      bench.step(push);
      if (bench.out.meshed != kNeutralGear) break;
      REQUIRE(bench.input.depth <= bench.at.dogs);
      if (bench.out.phase != SyncPhase::clashing) continue;
      ground += kT;
      const double rub = push * 7.0 * 0.8 * car.synchro.index_friction * car.synchro.index_radius;
      REQUIRE(bench.out.grind_power == doctest::Approx(rub * std::abs(bench.input.difference)).epsilon(1e-9));
      REQUIRE(std::abs(bench.input.difference) > car.synchro.dog_speed);
    }
    CHECK(bench.out.meshed == 2);
    CHECK(bench.driveline.energy().mesh < 0.1);
    CHECK(ground > 0.1);
    CHECK(ground < longer);  // a harder push grinds for a shorter time
    longer = ground;
  }
}

TEST_CASE("reverse has no cone: only drag slows the shaft down, and only then the dogs engage") {
  const CarSpec car = shipped_car("hatchback");
  Bench bench(car);
  const double start = car.engine.idle;
  bench.enter(kReverseGear, start, 0.0);
  bench.input.depth = bench.at.block;  // at the ring's depth, before the dogs, nothing grinds
  const double near = car.synchro.dog_speed * ratio_of(car, kReverseGear);
  const double run_down = car.clutch.disc_inertia * (start - near) / car.gearbox.drag;
  while (std::abs(bench.driveline.state().shaft_speed) > near) bench.step(20.0);
  CHECK(bench.time == doctest::Approx(run_down).epsilon(0.005));
  CHECK(bench.out.cone_gear == kNeutralGear);
  bench.input.depth = bench.at.dogs;
  bench.step(20.0);
  bench.step(20.0);
  CHECK(bench.out.meshed == kReverseGear);
}

TEST_CASE("reverse pushed against its turning dogs grinds and does not engage; the rubbing stops the shaft sooner") {
  const CarSpec car = shipped_car("hatchback");
  Bench bench(car);
  bench.enter(kReverseGear, car.engine.idle, 0.0);
  bench.input.depth = bench.at.dogs;
  bench.step(20.0);
  CHECK(bench.out.phase == SyncPhase::clashing);
  const double rub = 20.0 * 7.0 * 0.8 * car.synchro.index_friction * car.synchro.index_radius;
  const double ratio = ratio_of(car, kReverseGear);
  const double near = car.synchro.dog_speed * ratio;
  const double run_down = car.clutch.disc_inertia * (car.engine.idle - near) / (car.gearbox.drag + rub / ratio);
  while (bench.out.meshed == kNeutralGear && bench.time < 5.0) bench.step(20.0);
  CHECK(bench.time == doctest::Approx(run_down).epsilon(0.01));
}

TEST_CASE("the second bump is at most a third of the push, random, and equal for equal seeds") {
  const CarSpec car = shipped_car("hatchback");
  const auto peak = [&](std::uint64_t seed, double push) {
    Bench bench(car, kScale, seed);
    bench.moves = true;
    bench.enter(3, 2500.0 * kRpm, road_speed_at(car, 2, 2500.0 * kRpm));
    double max_push = 0.0;
    for (int i = 0; i < 1000; ++i) {
      bench.step(push);
      REQUIRE(bench.out.force <= 0.0);
      max_push = std::max(max_push, -bench.out.force);
    }
    REQUIRE(bench.out.meshed == 3);
    REQUIRE(bench.out.phase == SyncPhase::meshed);
    return max_push;
  };
  const double effort = 15.0;  // [N] push on the real knob; small enough for the device to render the whole bump
  std::vector<double> peaks;
  for (std::uint64_t seed = 0; seed < 200; ++seed) peaks.push_back(peak(seed, effort));
  std::sort(peaks.begin(), peaks.end());
  CHECK(peaks.back() <= kScale * effort / 3.0);
  CHECK(peaks.back() > 0.9 * kScale * effort / 3.0);
  CHECK(peaks.front() < 0.1 * kScale * effort / 3.0);
  CHECK(peaks[100] == doctest::Approx(0.5 * kScale * effort / 3.0).epsilon(0.2));
  CHECK(peak(7, effort) == peak(7, effort));
  for (const double push : {30.0, 60.0, 200.0})
    for (std::uint64_t seed = 0; seed < 20; ++seed) CHECK(peak(seed, push) <= kScale * push / 3.0);
}

TEST_CASE("the bump's force and slope are continuous, and it is felt only on the way in") {
  const CarSpec car = shipped_car("hatchback");
  Bench bench(car, kScale, 3);
  bench.enter(3, 2500.0 * kRpm, road_speed_at(car, 2, 2500.0 * kRpm));
  (void)synchronising_time(bench, 60.0);
  bench.input.depth = bench.at.dogs;
  while (bench.out.meshed == kNeutralGear) bench.step(60.0);
  const double step = 1e-6, width = bench.at.home - bench.at.dogs;
  double before = 0.0, slope_before = 0.0, max_push = 0.0, steepest = 0.0;
  for (double depth = bench.at.dogs; depth <= bench.at.home + 0.001; depth += step) {
    bench.input.depth = depth;
    bench.step(60.0);
    const double slope = (bench.out.force - before) / step;
    REQUIRE(std::abs(slope - slope_before) < 1.1 * step * 2.0 * 2000.0 * std::numbers::pi / width);
    before = bench.out.force;
    slope_before = slope;
    max_push = std::max(max_push, -bench.out.force);
    steepest = std::max(steepest, std::abs(slope));
  }
  CHECK(max_push > 0.3);
  CHECK(steepest < 2000.0);
  for (double depth = bench.at.home; depth >= bench.at.out; depth -= 1e-5) {
    bench.input.depth = depth;
    bench.step(-10.0);
    REQUIRE(bench.out.force == 0.0);
  }
}

TEST_CASE("under load the gear cannot be pulled out; coasting needs a light pull, and the clutch down none") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  const int slot = slot_of_gear(gate, 3);
  const double rest = slot_of(gate, slot).rest;
  // [N m] The load torque at which a hand with the force F = 60 N can just pull the gear out: F i eta R / (mu + taper),
  // with the lever ratio i, its efficiency eta, the radius R and friction mu of the blocking teeth, and the taper of
  // the dogs (0.07).
  const double max_torque = kMaxHandForce * 7.0 * 0.8 * car.synchro.index_radius / (car.synchro.index_friction + 0.07);
  CHECK(max_torque > 65.0);
  CHECK(max_torque < 120.0);  // [N m] at the gear; with its ratio of 1.29, 50 to 93 N m at the engine
  const auto draws_out = [&](double load, double pull, bool clutch_open) {
    Synchroniser sleeve(car.synchro, gate, kScale, 3, 1);
    SleeveInput in;
    in.slot = slot;
    in.depth = rest;
    in.load = load;
    in.clutch_open = clutch_open;
    SleeveOutput out = sleeve.step(in, 0.0);
    REQUIRE(out.meshed == 3);
    for (int i = 0; i < 3000 && out.meshed == 3; ++i) {
      in.push = -kScale * pull;
      in.depth = std::max(out.depth_min, in.depth - 0.0002);
      out = sleeve.step(in, kT);
    }
    return out.meshed == kNeutralGear;
  };
  for (const double load : {1.02 * max_torque, -1.02 * max_torque, 1000.0}) {
    CHECK_FALSE(draws_out(load, 60.0, false));
    CHECK_FALSE(draws_out(load, 1000.0, false));
    CHECK(draws_out(load, 15.0, true));
  }
  CHECK(draws_out(0.98 * max_torque, 61.0, false));
  CHECK_FALSE(draws_out(0.98 * max_torque, 55.0, false));
  for (const double load : {0.2 * max_torque, -0.2 * max_torque}) {
    CHECK(draws_out(load, 13.0, false));
    CHECK_FALSE(draws_out(load, 11.0, false));
  }
  CHECK(draws_out(0.0, 0.5, false));
}

TEST_CASE(
    "in every slot of every gate, the ring blocks near a third of the way and the dogs engage before the gear counts") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    for (const Slot& slot : slots(gate)) {
      const SleeveStations at = sleeve_stations(gate, slot);
      CHECK(at.index < at.block);
      CHECK(at.block < at.out);
      CHECK(at.out < at.dogs);
      CHECK(at.dogs < at.home);
      CHECK(at.home < slot.engage_depth);
      // A drum's new sleeve moves only behind the crest.
      if (is_sequential(gate) || is_mechanism(gate))
        CHECK(at.index == slot.release_depth);
      else
        CHECK(at.block == doctest::Approx(slot.rest / 3.0).epsilon(0.05));
    }
  }
}

TEST_CASE("pulled out slowly, the dogs disengage in the slot, and the gear must be synchronised again") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  Synchroniser sleeve(car.synchro, gate, kScale, 4, 1);
  SleeveInput in;
  in.slot = slot_of_gear(gate, 4);
  in.clutch_open = true;
  const SleeveStations at = sleeve_stations(gate, slot_of(gate, in.slot));
  for (in.depth = at.home; in.depth > at.out; in.depth -= 1e-5) REQUIRE(sleeve.step(in, kT).meshed == 4);
  in.depth = at.out - 1e-5;
  in.difference = 20.0;
  CHECK(sleeve.step(in, kT).meshed == kNeutralGear);
  in.depth = at.dogs;
  CHECK(sleeve.step(in, kT).phase == SyncPhase::clashing);
  in.depth = at.index;
  CHECK(sleeve.step(in, kT).depth_max == at.block);
}

TEST_CASE("a sleeve that starts in gear is engaged; one that starts elsewhere is not, wherever it moves") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  SleeveInput in;
  in.slot = slot_of_gear(gate, 4);
  in.depth = slot_of(gate, in.slot).rest;
  in.difference = 50.0;
  CHECK(Synchroniser(car.synchro, gate, kScale, 4, 1).step(in, 0.0).meshed == 4);
  CHECK(Synchroniser(car.synchro, gate, kScale, 3, 1).step(in, 0.0).meshed == kNeutralGear);
  Synchroniser elsewhere(car.synchro, gate, kScale, 4, 1);
  CHECK(elsewhere.step({}, 0.0).meshed == kNeutralGear);
  CHECK(elsewhere.step(in, kT).meshed == kNeutralGear);
}

TEST_CASE("on any path in and out of a slot, the bump does no positive work on the hand") {
  const CarSpec car = shipped_car("hatchback");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Bench bench(car, kScale, seed);
    bench.enter(3, 2500.0 * kRpm, road_speed_at(car, 2, 2500.0 * kRpm));
    (void)synchronising_time(bench, 60.0);
    std::uint64_t row = seed;
    const auto chance = [&] {
      row = row * 6364136223846793005u + 1442695040888963407u;
      return static_cast<double>(row >> 11) * 0x1.0p-53;
    };
    double work = 0.0, last = 0.0, max_work = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const double before = bench.input.depth;
      const double step = 0.0004 * (chance() - 0.49);
      bench.input.depth =
          std::clamp(before + step, bench.at.block, std::min(bench.out.depth_max, bench.at.home + 0.003));
      bench.input.depth = std::max(bench.input.depth, bench.out.depth_min);
      bench.step(10.0);
      work += 0.5 * (bench.out.force + last) * (bench.input.depth - before);
      last = bench.out.force;
      max_work = std::max(max_work, work);
      REQUIRE(bench.out.phase != SyncPhase::clashing);
    }
    CHECK(max_work < 2e-5);  // [J] allows for the error of the trapezoidal rule
    CHECK(work < 0.0);
  }
}
