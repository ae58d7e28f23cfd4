// For 20 s, in every slot and under every load, an engaged gear must stay engaged, and a lever in a slot must stay in
// the slot's middle. The guard must not mistake the lever for a chattering wall. Users of other simulators complain
// about gears that jump out and levers that drift.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/gate/feel_curve.h"
#include "haptics/gate/gate_feel.h"
#include "tests/app/vehicle/car_run.h"
#include "tests/support/event_log.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::vehicle;
using glm::dvec2;

namespace {

constexpr double kLong = 20.0;      // [s]
constexpr double kMaxShake = 1e-3;  // [m] a dying engine moves a released lever by at most this much

DriverControls pedals_at(double clutch, double throttle, double brake = 0.0) {
  DriverControls feet;
  feet.ignition = true;
  feet.pedals.clutch = clutch;
  feet.pedals.throttle = throttle;
  feet.pedals.brake = brake;
  return feet;
}

bool every_other(double time, double seconds) {
  return std::fmod(time, 2.0 * seconds) < seconds;
}

// Pedals in a pattern that repeats every 5 s. In the first second of each period, the clutch is down and the starter
// runs for 0.8 s (not in the first period). Then the clutch pedal comes up to `clutch` without throttle, and the engine
// dies.
DriverControls dying(double time, double clutch, double brake) {
  const double since = std::fmod(time, 5.0);
  DriverControls feet = pedals_at(since < 1.0 ? 1.0 : clutch, 0.0, brake);
  feet.starter = time > 5.0 && since > 0.1 && since < 0.9;
  return feet;
}

struct Driving {
  const char* name;
  bool rolls;  // whether the car rolls at the start
  DriverControls (*feet)(double time);
};

// The loads on the gear. The engine runs into the limiter (which cuts its torque many times per second), coasts, or
// pulls and coasts in turn. The clutch pedal rests at half its travel, trembles about the bite point, goes down and up
// in turn, or stays down. In the last two loads, the engine dies while the car creeps or is held by the brake.
const Driving kDriving[] = {
    {"pulls into the limiter", true, [](double) { return pedals_at(0.0, 1.0); }},
    {"coasts", true, [](double) { return pedals_at(0.0, 0.0); }},
    {"on and off the throttle", true, [](double time) { return pedals_at(0.0, every_other(time, 0.25) ? 0.5 : 0.0); }},
    {"half a clutch, pulling", true, [](double) { return pedals_at(0.5, 0.4); }},
    {"half a clutch, no throttle", true, [](double) { return pedals_at(0.5, 0.0); }},
    {"an unsteady foot about the bite", true,
     [](double time) { return pedals_at(0.68 + 0.1 * std::sin(20.0 * time) + 0.02 * std::sin(331.0 * time), 0.1); }},
    {"clutch down and up", true, [](double time) { return pedals_at(every_other(time, 0.5) ? 1.0 : 0.0, 0.3); }},
    {"clutch down", true, [](double) { return pedals_at(1.0, 0.0); }},
    {"creeps and dies", false, [](double time) { return dying(time, 0.6, 0.0); }},
    {"dies at the brake", false, [](double time) { return dying(time, 0.0, 1.0); }},
};

double direction_of(const Slot& slot) {
  return static_cast<double>(static_cast<int>(slot.side));
}

// A lever that no hand holds. It is pushed by a force that depends on time and position.
struct PushedLever {
  template <typename Push>
  PushedLever(const CarSpec& car, const CarStart& start, dvec2 place, Push push)
      : gate(gate_of(car)), hand(push), load(car, gate, kPaperForce, start), run(bare(gate, place), hand, &load) {}

  static SimulatedRunConfig bare(const Gate& gate, dvec2 place) {
    SimulatedRunConfig config = gripped(gate, kNeutralGear);
    config.lever.hand = kBareHand;
    config.start = place;
    return config;
  }
  const HapticSnapshot& step(const Driving& driving) {
    run.inputs().controls.write(driving.feet(run.time()));
    const HapticSnapshot& lever = run.step();
    events.see(run.loop());
    shaken = std::max(shaken, load.state().shudder);
    return lever;
  }
  bool is_guarded() {
    return events.count(EventKind::stiffness_lowered) == 0 && run.loop().snapshot().guard == GuardState::running;
  }

  Gate gate;
  PushingHand hand;
  CarLoad load;
  SimulatedRun run;
  EventLog events;
  double shaken = 0.0;
};

CarStart in_gear(const CarSpec& car, const Slot& slot, const Driving& driving) {
  const double speed = slot.gear == kReverseGear ? 150.0 : 250.0;
  return rolling_in(car, slot.gear, driving.rolls ? speed : 0.0);
}

// A lever in the slot's gear. A force pulls the lever out of the slot and rises to `pull` [N] within half a second.
PushedLever pulled(const CarSpec& car, const Slot& slot, const Driving& driving, double pull) {
  const double direction = direction_of(slot);
  return {car, in_gear(car, slot, driving), rest_position(gate_of(car), slot.gear), [=](double time, dvec2) {
            return dvec2{0.0, -direction * pull * std::min(1.0, 2.0 * time)};
          }};
}

// Calls `attempt` for every combination of car, slot and driving. The short run takes every third combination, which
// still covers each car, each slot and each driving.
template <typename Try>
void for_each_case(Try attempt) {
  int counted = 0;
  for (const char* name : {"hatchback", "diesel"}) {
    const CarSpec car = shipped_car(name);
    const Gate gate = gate_of(car);
    for (const Slot& slot : slots(gate)) {
      for (const Driving& driving : kDriving) {
        if (counted++ % 3 != 0 && !is_full_campaign()) continue;
        const std::string drive = std::string(name) + ", " + std::string(gear_name(slot.gear)) + ", " + driving.name;
        CAPTURE(drive);
        attempt(car, slot, driving);
      }
    }
  }
}

// The mean position of a lever during a quarter of a second, and whether the lever rested in a slot all that time.
struct RestState {
  bool is_at_rest = true;
  double depth = 0.0, across = 0.0;  // [m]
};
RestState rest_state(PushedLever& lever, const Driving& driving) {
  RestState out;
  double min = 1.0, max = 0.0;
  for (int i = 0; i < 250; ++i) {
    const HapticSnapshot& now = lever.step(driving);
    const double depth = std::abs(now.lever.y);
    out.is_at_rest = out.is_at_rest && now.slot != kNoSlot;
    out.depth += depth / 250.0;
    out.across += now.lever.x / 250.0;
    min = std::min(min, depth);
    max = std::max(max, depth);
  }
  out.is_at_rest = out.is_at_rest && max - min < 0.002;  // [m] a rattle of less than 2 mm counts as rest
  return out;
}

// [m] The distance from the rest position at which the force of the gear's detent equals `pull` [N].
double detent_balance(const Slot& slot, double pull) {
  double distance = 0.0;
  while (feel_force(slot.feel, slot.rest - distance) < pull) distance += 1e-5;
  return distance;
}

}  // namespace

TEST_CASE("a released lever stays in its gear for 20 s: every slot, with each load") {
  double shaken = 0.0;
  for_each_case([&](const CarSpec& car, const Slot& slot, const Driving& driving) {
    PushedLever lever = pulled(car, slot, driving, 0.0);
    double farthest = 0.0;
    while (lever.run.time() < kLong) {
      const HapticSnapshot& now = lever.step(driving);
      if (lever.run.time() < 0.2) continue;
      REQUIRE(now.gear == slot.gear);
      REQUIRE(lever.load.state().gear == slot.gear);
      farthest = std::max(farthest, std::abs(std::abs(now.lever.y) - slot.rest));
    }
    shaken = std::max(shaken, lever.shaken);
    CHECK(farthest < (lever.shaken > 0.0 ? 0.0005 + kMaxShake : 0.0005));
    CHECK(lever.is_guarded());
  });
  CHECK(shaken == doctest::Approx(1.0).epsilon(0.05));  // full shudder: the engine died in at least one case
}

TEST_CASE("a pull of half the detent's force moves a lever to where the detent balances it, and no further in 20 s") {
  for_each_case([](const CarSpec& car, const Slot& slot, const Driving& driving) {
    PushedLever lever = pulled(car, slot, driving, 6.0);
    double farthest = 0.0;
    while (lever.run.time() < kLong) {
      const HapticSnapshot& now = lever.step(driving);
      REQUIRE((lever.run.time() < 0.1 || now.gear == slot.gear));
      farthest = std::max(farthest, slot.rest - std::abs(now.lever.y));
    }
    const double spring = 15.7 * slot.rest;  // [N] force of the bare lever's return spring
    CHECK(farthest < detent_balance(slot, 6.0 + spring) + 0.0005 + (lever.shaken > 0.0 ? kMaxShake : 0.0));
    CHECK(lever.is_guarded());
  });
}

TEST_CASE("a lever in a slot does not drift sideways in 20 s: blocked, clashing or in gear, every slot and load") {
  for (const double worn : {1.0, 0.5}) {
    for_each_case([worn](CarSpec car, const Slot& slot, const Driving& driving) {
      car.synchro.friction *= worn;
      const Gate gate = gate_of(car);
      const double direction = direction_of(slot), across = rest_position(gate, slot.gear).x;
      CarStart start;
      if (driving.rolls) start.road_speed = slot.gear == kReverseGear ? 2.0 : 20.0;
      PushedLever lever(car, start, {across, 0.0}, [=](double time, dvec2 at) {
        return dvec2{2000.0 * (across - at.x), time < 0.2 ? 0.0 : 20.0 * direction};
      });
      // For each depth (in steps of 0.5 mm): the first position across the slot at which the lever rested [m].
      std::map<long, double> place;
      double farthest = 0.0;
      while (lever.run.time() < kLong) {
        const RestState stand = rest_state(lever, driving);
        if (!stand.is_at_rest) continue;
        const double first = place.try_emplace(std::lround(2000.0 * stand.depth), stand.across).first->second;
        farthest = std::max(farthest, std::abs(stand.across - first));
      }
      CHECK(!place.empty());
      CHECK(farthest < 0.0005);
      CHECK(lever.is_guarded());
    });
  }
}
