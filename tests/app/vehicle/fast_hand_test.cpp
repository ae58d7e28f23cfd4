// Hands that are faster and stronger than any human hand. With sound rings, no such hand can grind a forward gear. With
// worn rings, every shift grinds.
#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "tests/app/vehicle/car_run.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::vehicle;
using glm::dvec2;

namespace {

constexpr double kHandReady = 0.05;  // [s] time at which the hand begins to move, after the guard has ramped up

struct Rush {
  double speed, push, rate;  // [m/s] the hand's speed; [N] its largest push; [Hz] loop rate
};

struct Shifted {
  bool in = false;
  double ground = 0.0;      // [J] energy dissipated by grinding
  double difference = 0.0;  // [rad/s] largest speed difference at which the ring let the sleeve pass
};

// A hand that follows a target into the slot, and pushes with at most `rush.push` [N].
PushingHand rushing_hand(const Slot& slot, double across, const Rush& rush) {
  const double direction = static_cast<double>(static_cast<int>(slot.side)), end = slot.end + 0.01;
  return PushingHand([=](double time, dvec2 lever) {
    const double goal = std::clamp((time - kHandReady) * rush.speed, 0.0, end);
    const double force = std::clamp(2e4 * (goal - direction * lever.y), -rush.push, rush.push);
    return dvec2{2000.0 * (across - lever.x), time < kHandReady ? 0.0 : direction * force};
  });
}

// Shifts from neutral into `to` with the clutch down. Shaft and car start at the speeds of gear `from` at 2500 rpm.
Shifted shift(const CarSpec& car, const Gate& gate, int from, int to, const Rush& rush, double brake) {
  const Slot& slot = slot_of(gate, slot_of_gear(gate, to));
  SimulatedRunConfig config = gripped(gate, kNeutralGear);
  config.haptics.rate = rush.rate;
  config.lever.hand = kBareHand;
  config.start = {rest_position(gate, to).x, 0.0};
  CarStart start = rolling_in(car, from, 2500.0 * kRpm);
  start.gear = kNeutralGear;
  start.shaft_speed = start.engine_speed = 2500.0 * kRpm;
  PushingHand hand = rushing_hand(slot, config.start.x, rush);
  CarLoad load(car, gate, kPaperForce, start);
  SimulatedRun run(config, hand, &load);
  DriverControls feet = clutch_down();
  feet.pedals.brake = brake;
  run.inputs().controls.write(feet);
  Shifted shifted;
  bool was_through = false;
  while (run.time() < 6.0 && !shifted.in) {
    const VehicleState before = load.state();  // the ring uses the state before the step
    const double difference = std::abs(before.shaft_speed - shaft_per_road(car, to) * before.road_speed);
    shifted.in = run.step().gear == to;
    const VehicleState& now = load.state();
    shifted.ground += now.grind_power / rush.rate;
    // A hand that bounces off the ring may reach the opposite slot.
    const bool through = run.loop().snapshot().slot == slot_of_gear(gate, to) && now.sync != SyncPhase::free &&
                         now.sync != SyncPhase::indexing && now.sync != SyncPhase::synchronising;
    if (through && !was_through) shifted.difference = std::max(shifted.difference, difference / ratio_of(car, to));
    was_through = through;
  }
  return shifted;
}

bool fits(const CarSpec& car, const Gate& gate) {
  return std::all_of(slots(gate).begin(), slots(gate).end(),
                     [&](const Slot& slot) { return shaft_per_road(car, slot.gear) != 0.0; });
}

// Calls f(gate, from, to) for all shifts between forward gears that do not over-rev the engine, in all shipped gates.
template <class F>
void each_shift(const CarSpec& car, F f) {
  for (const std::string& name : shipped_names()) {
    const Gate gate = shipped_gate(name);
    if (!fits(car, gate)) continue;
    CAPTURE(name);
    for (const Slot& out_of : slots(gate)) {
      for (const Slot& into : slots(gate)) {
        if (out_of.gear < 1 || into.gear < 1 || out_of.gear == into.gear) continue;
        if (ratio_of(car, into.gear) / ratio_of(car, out_of.gear) * 2500.0 * kRpm > car.engine.limiter) continue;
        f(gate, out_of.gear, into.gear);
      }
    }
  }
}

constexpr Rush kRushes[] = {{0.2, 20.0, 4000.0}, {0.2, 120.0, 500.0},  {0.7, 60.0, 1000.0},
                            {2.0, 20.0, 2000.0}, {2.0, 120.0, 1000.0}, {2.0, 120.0, 500.0}};

}  // namespace

TEST_CASE("sound rings: no forward gear grinds with the clutch down, at 0.2 to 2 m/s, up to 120 N, 500 to 4000 Hz") {
  for (const std::string model : {"hatchback", "diesel"}) {
    const CarSpec car = shipped_car(model);
    CAPTURE(model);
    int shifts = 0, counted = 0;
    each_shift(car, [&](const Gate& gate, int from, int to) {
      for (const Rush& rush : kRushes) {
        for (const double brake : {0.0, 1.0}) {
          if (counted++ % 5 != 0 && !is_full_campaign()) continue;
          CAPTURE(from);
          CAPTURE(to);
          CAPTURE(rush.speed);
          CAPTURE(rush.push);
          CAPTURE(rush.rate);
          CAPTURE(brake);
          const Shifted shifted = shift(car, gate, from, to, rush, brake);
          ++shifts;
          CHECK(shifted.in);
          CHECK(shifted.ground == 0.0);
          CHECK(shifted.difference <= car.synchro.dog_speed);
        }
      }
    });
    CHECK(shifts > (is_full_campaign() ? 500 : 100));
  }
}

TEST_CASE("worn rings: every shift between forward gears grinds") {
  CarSpec car = shipped_car("hatchback");
  car.synchro.friction = 0.07;
  each_shift(car, [&](const Gate& gate, int from, int to) {
    CAPTURE(from);
    CAPTURE(to);
    const Shifted shifted = shift(car, gate, from, to, {0.7, 60.0, 1000.0}, 0.0);
    CHECK(shifted.ground > 0.5);
    CHECK(shifted.difference > car.synchro.dog_speed);
  });
}
