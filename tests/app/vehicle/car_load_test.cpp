// Complete shifts: a hand on the simulated lever, feet on the pedals, and a car that is connected to the lever.
#include "app/vehicle/car_load.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/device/simulated_lever.h"
#include "tests/app/vehicle/car_run.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::vehicle;
using glm::dvec2;

namespace {

// Measurements during a drive. drive() also checks invariants in every cycle.
struct CarDrive {
  double blocked = 0.0, ground = 0.0;  // [s] time with the ring blocking; time with the dogs grinding
  double deepest = 0.0;                // [m] largest depth of the proxy in a slot
  double push = 0.0;                   // [N] the hand's largest push along the slot
  bool stalled = false;
  std::vector<int> gears;  // the engaged gears, in order

  void drive(CarRun& run, double seconds) {
    const double end = run.time() + seconds;
    int before = run.run.loop().snapshot().gear;
    while (run.time() < end) {
      const HapticSnapshot& lever = run.step();
      const VehicleState& car = run.state();
      if (lever.gear != before && lever.gear != kNeutralGear) {
        REQUIRE(car.gear == lever.gear);  // the lever's gear is reported only if its dogs are engaged
        gears.push_back(lever.gear);
      }
      before = lever.gear;
      REQUIRE(lever.load_force.x == 0.0);
      REQUIRE(std::abs(lever.load_force.y) <= kPaperForce / 3.0);
      blocked += car.sync == SyncPhase::synchronising ? 0.001 : 0.0;
      ground += car.grinding ? 0.001 : 0.0;
      stalled = stalled || car.stalled;
      if (lever.slot != kNoSlot) deepest = std::max(deepest, std::abs(lever.proxy.y));
      push = std::max(push, std::abs(lever.f_h.y));
    }
  }
};

SleeveStations stations_of(const Gate& gate, int gear) {
  return sleeve_stations(gate, slot_of(gate, slot_of_gear(gate, gear)));
}

double direction_of(const Gate& gate, int gear) {
  return static_cast<double>(static_cast<int>(slot_of(gate, slot_of_gear(gate, gear)).side));
}

// A hand that holds the lever in front of the gear's slot and, from 0.2 s on, pushes it into the slot with `push` [N].
PushingHand leaning_hand(const Gate& gate, int gear, double push) {
  const double direction = direction_of(gate, gear), across = rest_position(gate, gear).x;
  return PushingHand([=](double time, dvec2 lever) {
    return dvec2{2000.0 * (across - lever.x), time < 0.2 ? 0.0 : direction * push};
  });
}

SimulatedRunConfig before_slot(const Gate& gate, int gear) {
  SimulatedRunConfig config = gripped(gate, kNeutralGear);
  config.lever.hand = kBareHand;
  config.start = {rest_position(gate, gear).x, 0.0};
  return config;
}

// A car that nothing but the cone slows down.
CarSpec rolling_freely(CarSpec car) {
  car.body.resistance = car.body.resistance_slope = car.body.resistance_square = 0.0;
  return car;
}

// At the knob of the real car.
struct KnobForces {
  double ring = 0.0, bump = 0.0, end = 0.0;  // [N] largest push while the ring blocks, in the second bump, in gear
  double impulse = 0.0, blocked = 0.0;       // [N s], [s] while the ring blocks
  double difference = 0.0;                   // [rad/s] of the speeds when the lever reaches the ring
  double depth = 0.0;                        // [m] at which the ring blocks
};

// A shift at 2500 rpm with the clutch down, by a hand of the practised simulated driver's pace.
KnobForces shift_briskly(const CarSpec& car, const Gate& gate, int from, int to) {
  ShiftStyle style;
  style.pace = 0.35;
  style.reaction = 0.06;
  style.dwell_gear = 3.0;
  ScriptedHand hand = shifting_hand(gate, from, {to}, 0.2, style);
  CarRun run(car, rolling_in(car, from, 2500.0 * kRpm), hand, [](double) { return clutch_down(); });
  KnobForces felt;
  while (run.time() < hand.duration()) {
    const HapticSnapshot& lever = run.step();
    const VehicleState& now = run.state();
    const double push = std::abs(lever.f_h.y) / now.force_scale;
    if (now.sync == SyncPhase::synchronising) {
      if (felt.blocked == 0.0) felt.difference = std::abs(now.dog_difference);
      felt.ring = std::max(felt.ring, push);
      felt.impulse += 0.001 * push;
      felt.blocked += 0.001;
      felt.depth = std::abs(lever.proxy.y);
    }
    if (now.sync == SyncPhase::second_bump) felt.bump = std::max(felt.bump, push);
    if (now.sync == SyncPhase::meshed && now.gear == to) felt.end = std::max(felt.end, push);
  }
  REQUIRE(run.state().gear == to);
  return felt;
}

// A lever whose force sensor can be switched off.
class Lever final : public HapticDevice {
 public:
  Lever(const SimulatedLeverConfig& config, const HapticConfig& haptics, HandDriver& hand, bool measures)
      : lever_(config, period_ns(haptics), hand), spec_(lever_.spec()) {
    spec_.measures_hand_force = measures;
  }
  void place(dvec2 at) { lever_.place(at); }
  const DeviceSpec& spec() const noexcept override { return spec_; }
  LeverReading read(std::int64_t now_ns) noexcept override {
    LeverReading reading = lever_.read(now_ns);
    if (!spec_.measures_hand_force) reading.hand_force = {0.0, 0.0};
    return reading;
  }
  void write(dvec2 force) noexcept override { lever_.write(force); }
  void release() noexcept override { lever_.release(); }

 private:
  SimulatedLever lever_;
  DeviceSpec spec_;
};

// Returns the total time [s] for which the ring blocks the hand during the shifts 2-3-2-1; 100 if first gear is not
// reached. `rate` [Hz] is the loop's, `delay` [cycles] is the device's. `measures`: whether the device measures the
// hand's force.
double blocked_time(const CarSpec& car, double rate, int delay, bool measures) {
  const Gate gate = gate_of(car);
  HapticConfig haptics;
  haptics.rate = rate;
  haptics.guard.ramp_time = 0.01;
  SimulatedLeverConfig config = gripped(gate, 2).lever;
  config.delay = delay;
  const dvec2 start = rest_position(gate, 2);
  ShiftStyle style;
  style.dwell_gear = 1.2;
  const int gears[] = {3, 2, 1};
  ScriptedHand hand(measured_hand(start), shift_strokes(gate, start, gears, style), period_s(haptics));
  Lever lever(config, haptics, hand, measures);
  lever.place(start);
  CarLoad load(car, gate, kPaperForce, rolling_in(car, 2, 250.0));
  LoopInputs inputs;
  HapticLoop loop(haptics, gate, lever, load, inputs);
  loop.arm();
  inputs.controls.write(clutch_down());
  double held = 0.0;
  for (std::int64_t now = 0; 1e-9 * static_cast<double>(now) < hand.duration(); now += period_ns(haptics)) {
    loop.cycle(now, 0);
    REQUIRE_FALSE(load.state().grinding);
    held += load.state().sync == SyncPhase::synchronising ? period_s(haptics) : 0.0;
  }
  return loop.snapshot().gear == 1 ? held : 100.0;
}

}  // namespace

TEST_CASE(
    "with the clutch down every shift, up, down or skipping gears, is synchronised and does not grind: both cars") {
  for (const char* name : {"hatchback", "diesel"}) {
    const CarSpec car = shipped_car(name);
    const Gate gate = gate_of(car);
    const int top = car.gearbox.ratio[5] > 0.0 ? 6 : 5;
    const double shaft = 0.4 * car.engine.limiter;
    int shifts = 0;
    for (int from = 1; from <= top; ++from) {
      for (int to = 1; to <= top; ++to) {
        if (to == from || ratio_of(car, to) / ratio_of(car, from) * shaft > car.engine.limiter) continue;
        CAPTURE(name);
        CAPTURE(from);
        CAPTURE(to);
        ++shifts;
        ScriptedHand hand = shifting_hand(gate, from, {to}, 0.2, 2.0);
        CarRun run(car, rolling_in(car, from, shaft), hand,
                   [](double time) { return time > 0.1 ? clutch_down() : clutch_up(0.2); });
        CarDrive drive;
        drive.drive(run, hand.duration());
        CHECK(drive.gears == std::vector{from, to});
        CHECK(run.state().gear == to);
        CHECK(run.state().sync == SyncPhase::meshed);
        CHECK(drive.ground == 0.0);
        CHECK(drive.blocked > 0.005);
        CHECK(drive.blocked < 2.0);  // the diesel from second to first at 1900 rpm
        CHECK(run.state().shaft_speed ==
              doctest::Approx(shaft_per_road(car, to) * run.state().road_speed).epsilon(1e-9));
        CHECK(run.load.driveline().fallbacks() == 0);
        CHECK(run.load.driveline().energy().mesh < 0.2);
      }
    }
    CHECK(shifts >= 15);
  }
}

TEST_CASE("pressing the clutch just past its bite point is enough for a shift") {
  const CarSpec car = shipped_car("hatchback");
  ScriptedHand hand = shifting_hand(gate_of(car), 2, {3});
  CarRun run(car, rolling_in(car, 2, 250.0), hand, [&](double time) {
    DriverControls feet = clutch_down();
    feet.pedals.clutch = time > 0.1 ? car.clutch.bite + 0.01 : 0.0;
    return feet;
  });
  CarDrive drive;
  drive.drive(run, hand.duration());
  CHECK(drive.gears == std::vector{2, 3});
  CHECK(drive.ground == 0.0);
}

TEST_CASE("without the clutch a hard wall blocks the gear, however long and hard the hand pushes") {
  for (const char* name : {"hatchback", "diesel"}) {
    const CarSpec car = shipped_car(name);
    const Gate gate = gate_of(car);
    for (const int gear : {1, 2, 3, 4}) {
      for (const double push : {10.0, 20.0, 31.0}) {
        CAPTURE(name);
        CAPTURE(gear);
        CAPTURE(push);
        PushingHand hand = leaning_hand(gate, gear, push);
        CarStart start = rolling_in(car, gear, 300.0);
        start.gear = kNeutralGear;
        CarLoad load(car, gate, kPaperForce, start);
        SimulatedRun run(before_slot(gate, gear), hand, &load);
        run.inputs().controls.write(clutch_up());
        const double block = stations_of(gate, gear).block;
        while (run.time() < 2.0) {
          const HapticSnapshot& lever = run.step();
          REQUIRE(lever.gear == kNeutralGear);
          REQUIRE(std::abs(lever.proxy.y) <= block + 1e-9);
          REQUIRE(lever.load_force == dvec2(0.0));  // the ring blocks like a plain wall, without rattle or vibration
        }
        CHECK(std::abs(run.loop().snapshot().proxy.y) == doctest::Approx(block));
        CHECK(load.state().sync == SyncPhase::synchronising);
      }
    }
  }
}

TEST_CASE("without the clutch a gear engages when the falling engine speed matches, as in a real gearbox") {
  for (const char* name : {"hatchback", "diesel"}) {
    const CarSpec car = shipped_car(name);
    const Gate gate = gate_of(car);
    for (const int gear : {2, 3, 4, 5}) {
      CAPTURE(name);
      CAPTURE(gear);
      PushingHand hand = leaning_hand(gate, gear, 12.0);
      CarStart start = rolling_in(car, gear, 200.0);
      start.gear = kNeutralGear;
      start.engine_speed = start.shaft_speed = 240.0;
      CarLoad load(car, gate, kPaperForce, start);
      SimulatedRun run(before_slot(gate, gear), hand, &load);
      run.inputs().controls.write(clutch_up());
      while (run.time() < 3.0 && run.loop().snapshot().gear == kNeutralGear) {
        run.step();
        REQUIRE_FALSE(load.state().grinding);
      }
      CHECK(run.loop().snapshot().gear == gear);
      CHECK(load.state().clutch_locked);
      CHECK(load.driveline().energy().mesh < 5.0);
    }
  }
}

// Reason for this test: users of other simulators complain that grinding gears engage, and that the grinding does not
// depend on the push.
TEST_CASE(
    "a worn synchroniser grinds at a hard wall, louder with more push, and no gear engages before the speeds match") {
  CarSpec car = shipped_car("hatchback");
  car.synchro.friction = 0.5 * critical_friction(car.synchro);
  const Gate gate = gate_of(car);
  double quieter = 0.0;
  for (const double push : {8.0, 16.0, 31.0}) {
    CAPTURE(push);
    PushingHand hand = leaning_hand(gate, 2, push);
    CarStart start = rolling_in(car, 1, 400.0);
    start.gear = kNeutralGear;
    start.shaft_speed = 400.0;
    CarLoad load(car, gate, kPaperForce, start);
    SimulatedRun run(before_slot(gate, 2), hand, &load);
    run.inputs().controls.write(clutch_down());
    const double dogs = stations_of(gate, 2).dogs;
    double power = 0.0, max_step = 0.0, ground = 0.0;
    dvec2 before{0.0};
    while (run.time() < 4.0 && run.loop().snapshot().gear == kNeutralGear) {
      const HapticSnapshot& lever = run.step();
      if (load.state().gear == kNeutralGear) REQUIRE(std::abs(lever.proxy.y) <= dogs + 1e-9);
      if (load.state().grinding) REQUIRE(std::abs(load.state().dog_difference) > 0.0);
      power = std::max(power, load.state().grind_power);
      ground += load.state().grinding ? 0.001 : 0.0;
      max_step = std::max(max_step, std::abs(lever.load_force.y - before.y));
      before = lever.load_force;
      REQUIRE(lever.load_force.y * direction_of(gate, 2) <= 0.0);  // no force pulls the lever into the slot
    }
    CHECK(run.loop().snapshot().gear == 2);
    CHECK(ground > 0.05);
    CHECK(power > 1.4 * quieter);
    CHECK(max_step < 3.0);  // [N] force change per cycle
    quieter = power;
  }
}

TEST_CASE(
    "torque lock: under load the gear is clamped, while coasting it is held lightly, with the clutch down it is free") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  const auto pulled_out = [&](int gear, double pull, const DriverControls& feet) {
    const double direction = direction_of(gate, gear);
    PushingHand hand([=](double time, dvec2) { return dvec2{0.0, time < 0.5 ? 0.0 : -direction * pull}; });
    CarLoad load(car, gate, kPaperForce, rolling_in(car, gear, 250.0));
    SimulatedRunConfig config = gripped(gate, gear);
    config.lever.hand = kBareHand;
    SimulatedRun run(config, hand, &load);
    run.inputs().controls.write(feet);
    while (run.time() < 1.5) {
      if (load.state().torque_locked && run.loop().snapshot().gear == gear)
        REQUIRE(std::abs(run.loop().snapshot().proxy.y) > stations_of(gate, gear).home);
      if (run.step().gear != gear && run.time() > 0.1) return true;
    }
    return false;
  };
  const double lock_feel = 12.0;  // [N] force with which the gate's own feel holds the gear
  for (const int gear : {1, 2, 3}) {
    CAPTURE(gear);
    CHECK_FALSE(pulled_out(gear, 31.0, clutch_up(1.0)));
    CHECK_FALSE(pulled_out(gear, 60.0, clutch_up(1.0)));  // [N] more than the device's 31.7, yet the gear holds
    CHECK(pulled_out(gear, lock_feel + 2.0, clutch_down()));
    DriverControls full_throttle = clutch_down();
    full_throttle.pedals.throttle = 1.0;
    CHECK(pulled_out(gear, lock_feel + 2.0, full_throttle));
  }
  CHECK_FALSE(pulled_out(3, lock_feel + 1.0, clutch_up()));
  CHECK(pulled_out(3, lock_feel + 12.0, clutch_up()));
}

TEST_CASE(
    "with the clutch down every gear can be left for neutral, in both cars, after full throttle and while braking") {
  for (const char* name : {"hatchback", "diesel"}) {
    const CarSpec car = shipped_car(name);
    const Gate gate = gate_of(car);
    for (const Slot& slot : slots(gate)) {
      for (const bool brakes : {false, true}) {
        CAPTURE(name);
        CAPTURE(slot.gear);
        CAPTURE(brakes);
        ScriptedHand hand = shifting_hand(gate, slot.gear, {kNeutralGear}, 0.6, 0.0);
        CarStart start = rolling_in(car, slot.gear, slot.gear == kReverseGear ? 150.0 : 250.0);
        CarRun run(car, start, hand, [&](double time) {
          DriverControls feet = time < 0.5 ? clutch_up(1.0) : clutch_down();
          feet.pedals.brake = brakes && time >= 0.5 ? 1.0 : 0.0;
          return feet;
        });
        CarDrive drive;
        drive.drive(run, hand.duration() + 0.05);
        CHECK(run.run.loop().snapshot().gear == kNeutralGear);
        CHECK(run.state().gear == kNeutralGear);
        CHECK(run.run.loop().snapshot().slot == kNoSlot);
      }
    }
  }
}

TEST_CASE("over many shifts, no gear stays engaged in neutral, and no force remains there") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  ScriptedHand hand =
      shifting_hand(gate, kNeutralGear, {1, 2, kNeutralGear, 3, 2, kNeutralGear, 1, kNeutralGear, 4, 3});
  CarStart start;
  start.road_speed = 5.0;
  CarRun run(car, start, hand, [](double) { return clutch_down(); });
  double in_neutral = 0.0;
  int times = 0;
  while (run.time() < hand.duration()) {
    const HapticSnapshot& lever = run.step();
    in_neutral = lever.slot == kNoSlot ? in_neutral + 0.001 : 0.0;
    if (lever.slot == kNoSlot) REQUIRE(run.state().gear == kNeutralGear);
    // Outside the slots, the car exerts no force on the lever.
    if (lever.slot == kNoSlot) REQUIRE(lever.load_force == dvec2(0.0));
    if (in_neutral > 0.012) REQUIRE(lever.gear == kNeutralGear);
    times += in_neutral > 0.012 && in_neutral < 0.0135 ? 1 : 0;
  }
  CHECK(times >= 6);
  CHECK(run.state().gear == 3);
}

TEST_CASE("a stall is reported after the clutch was dumped at idle") {
  const CarSpec car = shipped_car("hatchback");
  ScriptedHand idle_hand = shifting_hand(gate_of(car), 1, {});
  CarStart start;
  start.gear = 1;
  CarRun run(car, start, idle_hand, [](double time) {
    DriverControls feet = time < 0.3 ? clutch_down() : clutch_up();
    feet.pedals.brake = 1.0;
    return feet;
  });
  CarDrive drive;
  drive.drive(run, 0.25);
  CHECK_FALSE(drive.stalled);
  drive.drive(run, 1.0);
  CHECK(run.state().stalled);
  CHECK_FALSE(run.state().running);
  CHECK(run.state().engine_speed == 0.0);
}

TEST_CASE("reverse is locked out by the gate at 30 km/h, blocked by its dogs at walking pace, and engages at rest") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  const auto drive_at = [&](double speed, double wait, CarDrive& drive) {
    ScriptedHand hand = shifting_hand(gate, kNeutralGear, {kReverseGear}, wait, 2.0);
    CarStart start;
    start.road_speed = speed;
    CarRun run(car, start, hand, [](double) { return clutch_down(); });
    drive.drive(run, hand.duration());
    return run.state().gear;
  };
  const double dogs = stations_of(gate, kReverseGear).dogs;
  CarDrive fast, walking, resting, hasty;
  CHECK(drive_at(30.0 / 3.6, 2.0, fast) == kNeutralGear);
  CHECK(fast.deepest <= stations_of(gate, kReverseGear).index);
  CHECK(drive_at(2.0, 2.0, walking) == kNeutralGear);
  CHECK(walking.deepest == doctest::Approx(dogs));
  CHECK(walking.ground > 0.2);
  CHECK(drive_at(0.0, 3.0, resting) == kReverseGear);  // after a wait of 3 s the shaft has stopped
  CHECK(resting.ground == 0.0);
  // After a wait of 0.1 s the shaft still turns, and the dogs grind until it stops.
  CHECK(drive_at(0.0, 0.1, hasty) == kReverseGear);
  CHECK(hasty.ground > 0.1);
}

TEST_CASE("the energy ledger balances over a whole drive, and the cone's heat follows from the hand's push") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  ScriptedHand hand = shifting_hand(gate, 1, {2, 3, 2}, 1.0, 1.0);
  CarRun run(car, rolling_in(car, 1, 250.0), hand, [&](double time) {
    const double phase = std::fmod(time, 2.0);
    return phase < 0.8 ? clutch_up(0.4) : clutch_down();
  });
  const double before = run.load.driveline().kinetic_energy();
  const double gain = car.synchro.lever_ratio * car.synchro.efficiency * cone_gain(car.synchro);
  double heat = 0.0, work = 0.0, push = 0.0, position = run.run.lever().true_position().y;
  while (run.time() < hand.duration()) {
    const HapticSnapshot& lever = run.step();
    const VehicleState& now = run.state();
    if (now.sync == SyncPhase::synchronising)
      heat += 0.001 * gain * std::max(0.0, push) / now.force_scale * std::abs(now.dog_difference);
    push = lever.slot == kNoSlot ? 0.0 : std::copysign(1.0, lever.proxy.y) * lever.f_h.y;
    const double here = run.run.lever().true_position().y;
    work += lever.load_force.y * (here - position);
    position = here;
  }
  const EnergyLedger& went = run.load.driveline().energy();
  const double out = went.friction + went.clutch + went.cone + went.shaft_drag + went.rolling + went.brakes +
                     went.slope + went.teeth + went.mesh;
  CHECK(before + went.engine == doctest::Approx(out + run.load.driveline().kinetic_energy()).epsilon(1e-9));
  CHECK(went.cone > 20.0);
  CHECK(heat == doctest::Approx(went.cone).epsilon(0.05));
  CHECK(work < 0.001);  // [J] the car does practically no work on the hand
}

TEST_CASE("a device of 31.7 N renders 0.53 of the real forces, a strong device all of them") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  CHECK(CarLoad(car, gate, 31.7).state().force_scale == doctest::Approx(31.7 / 60.0));
  CHECK(CarLoad(car, gate, 90.0).state().force_scale == 1.0);
}

TEST_CASE("at the start engine, shaft and car turn together, in neutral at idle, or in any given state") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  CHECK(CarLoad(car, gate, 31.7).state().engine_speed == doctest::Approx(car.engine.idle));
  CHECK(CarLoad(car, gate, 31.7).state().shaft_speed == doctest::Approx(car.engine.idle));
  const CarLoad rolling(car, gate, 31.7, rolling_in(car, 3, 200.0));
  CHECK(rolling.state().engine_speed == doctest::Approx(200.0));
  CHECK(rolling.state().shaft_speed == doctest::Approx(200.0));
  CHECK(rolling.state().gear == 3);

  ScriptedHand hand = shifting_hand(gate, 2, {3});
  CarRun run(car, rolling_in(car, 2, 250.0), hand, [](double) { return clutch_down(); });
  CarDrive drive;
  drive.drive(run, 0.5);
  const CarLoad next(car, gate, 31.7, start_from(run.state()));
  CHECK(next.state().engine_speed == run.state().engine_speed);
  CHECK(next.state().shaft_speed == run.state().shaft_speed);
  CHECK(next.state().road_speed == run.state().road_speed);
  CHECK(next.state().distance == run.state().distance);
  CHECK(next.state().slip_energy == run.state().slip_energy);

  CarStart before = rolling_in(car, 3, 200.0);
  before.distance = 1000.0;
  before.slip_energy = 500.0;
  CarLoad later(car, gate, 31.7, before);
  LeverInput in;
  in.controls = clutch_down();
  for (int i = 0; i < 100; ++i) later.step(in, 0.001);
  CHECK(later.state().distance == doctest::Approx(1000.0 + 0.1 * before.road_speed).epsilon(1e-4));
  CHECK(later.state().slip_energy == 500.0);
}

TEST_CASE(
    "on a slope a car in neutral rolls back with m a = m g sin(slope) - resistance, and the loop receives its speed") {
  const CarSpec car = shipped_car("hatchback");
  CarLoad load(car, gate_of(car), 31.7);
  LeverInput in;
  in.controls = clutch_down();
  in.controls.slope = 0.1;
  LeverOutput out;
  for (int i = 0; i < 1000; ++i) out = load.step(in, 0.001);
  const double pull =
      (car.body.mass * 9.81 * std::sin(0.1) - car.body.resistance) / (car.body.mass + car.body.rotating);
  CHECK(out.road_speed == doctest::Approx(-pull).epsilon(0.01));
  CHECK(load.state().slope == 0.1);
}

TEST_CASE("for any input, the output is finite and bounded") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  CarLoad load(car, gate, 31.7);
  const double nan = std::nan(""), inf = HUGE_VAL;
  std::uint64_t row = 1;
  const auto chance = [&] {
    return static_cast<double>((row = row * 6364136223846793005u + 1442695040888963407u) >> 33) / 2147483648.0;
  };
  for (int i = 0; i < 20000; ++i) {
    LeverInput in;
    in.slot = static_cast<int>(chance() * (gate.slot_count + 1)) - 1;
    in.depth = in.slot == kNoSlot ? 0.0 : 0.05 * chance();
    in.push = {0.0, chance() < 0.05 ? nan : chance() < 0.05 ? inf : 400.0 * (chance() - 0.5)};
    in.controls = {{chance(), chance(), chance() < 0.1 ? nan : chance(), 0.0},
                   chance() < 0.9,
                   chance() < 0.1,
                   0.2 * (chance() - 0.5),
                   0,
                   0.0};
    const LeverOutput out = load.step(in, i % 100 == 0 ? 0.011 : 0.001);
    REQUIRE(std::isfinite(out.force.x));
    REQUIRE(std::abs(out.force.y) <= 10.0);
    REQUIRE(std::isfinite(out.road_speed));
    REQUIRE(out.depth_min <= out.depth_max);
    REQUIRE(out.depth_min >= 0.0);
  }
}

TEST_CASE(
    "blocking takes equally long at 1 and 4 kHz, with and without a sample of delay, with and without a force sensor") {
  const CarSpec car = shipped_car("hatchback");
  const double usual = blocked_time(car, 1000.0, 0, true);
  CHECK(usual > 0.5);
  CHECK(usual < 2.0);
  for (const double rate : {1000.0, 4000.0})
    for (const int delay : {0, 1})
      for (const bool measures : {false, true})
        CHECK(blocked_time(car, rate, delay, measures) == doctest::Approx(usual).epsilon(0.03));
}

// In a real car the ring blocks near a third of the way, with 40 to 120 N at the knob. The hand's push is free, but not its
// integral until the speeds match, which the cone turns into the shaft's momentum:
//   i (dw - dw_dogs) = (1/J + G^2/m) r e mu R / (sin(a) i) x integral of F dt + T_drag t / J
TEST_CASE(
    "every shift of a practised hand is felt: 40 to 120 N at the ring, a third of the way in, less at the end stop") {
  for (const char* name : {"hatchback", "diesel"}) {
    const CarSpec car = rolling_freely(shipped_car(name));
    const Gate gate = gate_of(car);
    const SynchroSpec& ring = car.synchro;
    const double gain =
        ring.lever_ratio * ring.efficiency * ring.cones * ring.friction * ring.radius / std::sin(ring.cone_angle);
    const int top = car.gearbox.ratio[5] > 0.0 ? 6 : 5;
    for (const int step : {1, -1}) {
      for (int from = step > 0 ? 1 : 2; from <= (step > 0 ? top - 1 : top); ++from) {
        CAPTURE(name);
        CAPTURE(from);
        CAPTURE(step);
        const KnobForces felt = shift_briskly(car, gate, from, from + step);
        const double ratio = ratio_of(car, from + step), per_road = shaft_per_road(car, from + step);
        const double shaft = car.clutch.disc_inertia, mass = car.body.mass + car.body.rotating;
        const double per_impulse = (1.0 / shaft + per_road * per_road / mass) * gain / ratio;
        const double drag = step * car.gearbox.drag * felt.blocked / shaft;
        const double change = per_impulse * felt.impulse + drag - ratio * (felt.difference - ring.dog_speed);
        CHECK(std::abs(change) < 2.5 * 0.001 * per_impulse * felt.ring);  // the push is up to 2.5 cycles old
        CHECK(felt.ring > 40.0 - 0.8);  // the sensor has steps of 0.8 N of the real car
        CHECK(felt.ring < 120.0);
        CHECK(felt.end < felt.ring);
        CHECK(felt.bump < felt.ring);
        CHECK(felt.depth == doctest::Approx(slot_of(gate, slot_of_gear(gate, from + step)).rest / 3.0).epsilon(0.05));
      }
    }
  }
}
