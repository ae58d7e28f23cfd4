// The car keeps the guarantees of the haptic cycle: no allocation, no lock and no system call.
#include "tests/support/realtime_proof.h"

#include <memory>

#include <doctest/doctest.h>

#include "tests/app/vehicle/car_run.h"

namespace gearshift::test {

TEST_CASE("the car's load is real-time safe: shifts, grinding, stall, restart, hill, late cycles") {
  vehicle::CarSpec car = shipped_car("hatchback");
  car.synchro.friction = 0.06;  // a worn synchroniser ring, so that the dogs grind
  const haptics::Gate gate = gate_of(car);
  haptics::ScriptedHand hand = shifting_hand(gate, 1, {2, 1, haptics::kReverseGear, 2, 3});
  vehicle::CarLoad load(car, gate, kPaperForce, rolling_in(car, 1, 300.0));
  auto run = std::make_unique<haptics::SimulatedRun>(gripped(gate, 1), hand, &load);
  bool ground = false, stalled = false;
  const auto drive = [&] {
    for (int i = 0; i < 10'000; ++i) {
      haptics::DriverControls feet = i < 6000 || i > 9000 ? clutch_down() : clutch_up(i < 7000 ? 0.5 : 0.0);
      feet.pedals.brake = i > 7000 ? 1.0 : 0.0;
      feet.starter = i > 9000;
      feet.slope = i > 5000 ? 0.2 : 0.0;
      run->inputs().controls.write(feet);
      run->step();
      ground = ground || load.state().grinding;
      stalled = stalled || load.state().stalled;
    }
    load.step({}, 0.5);
  };
  const RealtimeProof proof = prove_realtime(drive);  // calls drive() in another process, hence the call below
  INFO(proof.verdict());
  CHECK(proof.clean());
  drive();
  CHECK(ground);
  CHECK(stalled);
}

}  // namespace gearshift::test
