// Feet that go with a simulated hand: on the real lever, in front of the car that the cabin shows.
#include "app/train/feet.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/train/session.h"
#include "app/train/touring_feet.h"
#include "app/vehicle/rolling_car.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/shift_script.h"
#include "haptics/loop/simulated_run.h"
#include "tests/support/gates.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift;

namespace {

struct Drive {
  std::vector<GearTime> engaged;
  std::vector<int> gear;  // every 1/60 s
};

Drive tour_of(const Gate& gate) {
  SimulatedRunConfig config;
  config.gate = gate;
  config.lever.hand = kGripHand;
  config.start = rest_position(gate, kNeutralGear);
  ScriptedHand hand(touring_hand(config.start), shift_strokes(gate, config.start, tour_order(gate)),
                    period_s(config.haptics));
  SimulatedRun run(config, hand);
  Drive drive;
  int gear = kNeutralGear;
  for (int i = 0; run.time() < hand.duration() + 0.5; ++i) {
    const int now = run.step().gear;
    if (now != gear && now != kNeutralGear) drive.engaged.push_back({now, run.time()});
    gear = now;
    if (i % 17 == 0) drive.gear.push_back(now);
  }
  return drive;
}

Gate shipped(const std::string& name) {
  const YokeGeometry yoke;
  return compile_gate(read_gate_layout(find_asset("gates", name)), workspace_half_extent(yoke), yoke.radius);
}

}  // namespace

TEST_CASE("in a tour of any shipped gate no gear grinds, reverse comes when the car stands, and the engine runs on") {
  for (const std::string& name : shipped_names("gates")) {
    CAPTURE(name);
    const Drive drive = tour_of(shipped(name));
    REQUIRE(drive.engaged.size() > 3);
    RollingCarConfig config;
    config.start_speed = 30.0 / kKmhPerMps;
    RollingCar car(config);
    double fastest = 0.0, backwards = 0.0;
    for (std::size_t i = 0; i < drive.gear.size(); ++i) {
      const double time = 0.017 * static_cast<double>(i);
      car.step(feet_at(time, drive.engaged, car.state()), drive.gear[i], 0.017);
      CAPTURE(time);
      CHECK_FALSE(car.state().grinding);
      CHECK_FALSE(car.state().stalled);
      if (drive.gear[i] == kReverseGear) CHECK(car.state().road_speed <= 0.0);
      fastest = std::max(fastest, car.state().road_speed);
      backwards = std::min(backwards, car.state().road_speed);
    }
    CHECK(fastest > config.start_speed);
    MESSAGE(name << ": " << kKmhPerMps * fastest << " km/h, back " << kKmhPerMps * backwards << " km/h");
  }
}

TEST_CASE("the hand by itself has feet: lap after lap no gear grinds, the engine runs, the car moves both ways") {
  for (const std::string& name : shipped_names("gates")) {
    CAPTURE(name);
    const TempFolder folder;
    const Variable home("XDG_DATA_HOME", folder.path().c_str());
    SessionChoice choice;
    choice.gate = name;
    choice.hand = kTouringHand;
    choice.clock = TrainerClock::virtual_time;
    choice.sound = SoundOutput::none;
    Session session(choice);
    const double lap = TouringFeet(session.trainer().gate()).lap();
    double fastest = 0.0, slowest = 0.0, later = 0.0;  // [m/s]
    std::vector<int> gears;
    while (session.time() < 2.5 * lap) {
      session.advance(1.0 / 60.0);
      const VehicleState& car = session.car();
      CAPTURE(session.time());
      CHECK_FALSE(car.grinding);
      CHECK_FALSE(car.stalled);
      fastest = std::max(fastest, car.road_speed);
      slowest = std::min(slowest, car.road_speed);
      if (session.time() > lap) later = std::max(later, car.road_speed);
      for (const HapticEvent& event : session.events())
        if (event.kind == EventKind::gear_engaged) gears.push_back(static_cast<int>(event.value));
    }
    MESSAGE(name << ": " << kKmhPerMps * slowest << " to " << kKmhPerMps * fastest << " km/h");
    CHECK(fastest > 30.0 / kKmhPerMps);
    CHECK(slowest < -0.3);
    CHECK(later > 1.0);
    CHECK(gears.size() >= 2 * tour_order(session.trainer().gate()).size());
  }
}

TEST_CASE("a hand that is led has the person's feet and no others") {
  SessionChoice choice;
  choice.hand = "grip";
  choice.clock = TrainerClock::virtual_time;
  choice.sound = SoundOutput::none;
  Session session(choice);
  DriverControls feet;
  feet.ignition = true;
  feet.brake = 0.25;
  session.lead({}, feet);
  session.advance(0.1);
  CHECK(session.car().brake == 0.25);
  CHECK(session.car().clutch == 0.0);
}
