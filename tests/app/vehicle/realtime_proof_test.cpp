// The car keeps the promise of the haptic cycle: no allocation, no lock, no system call.
#include "tests/support/realtime_proof.h"

#include <memory>

#include <doctest/doctest.h>

#include "tests/app/vehicle/car_run.h"

namespace gearshift {

TEST_CASE("the car behind the loop is real-time safe: shifts, grinding, stall, restart, hill, late cycles") {
  CarSpec car = shipped_car("hatchback");
  car.synchro.friction = 0.06;  // worn
  const Gate gate = gate_of(car);
  ScriptedHand hand = shifting_hand(gate, 1, {2, 1, kReverseGear, 2, 3});
  CarWorld world(car, gate, kPaperForce, rolling_in(car, 1, 300.0));
  auto run = std::make_unique<SimulatedRun>(gripped(gate, 1), hand, &world);
  run->channels().recording.store(true);
  bool ground = false, stalled = false;
  const auto drive = [&] {
    for (int i = 0; i < 10'000; ++i) {
      DriverControls feet = i < 6000 || i > 9000 ? clutch_down() : clutch_up(i < 7000 ? 0.5 : 0.0);
      feet.brake = i > 7000 ? 1.0 : 0.0;
      feet.starter = i > 9000;
      feet.slope = i > 5000 ? 0.2 : 0.0;
      run->channels().controls.write(feet);
      run->step();
      ground = ground || world.state().grinding;
      stalled = stalled || world.state().stalled;
    }
    world.step({}, 0.5);
  };
  const RealtimeProof proof = prove_realtime(drive);  // in a process of its own
  INFO(proof.verdict());
  CHECK(proof.clean());
  drive();
  CHECK(ground);
  CHECK(stalled);
}

}  // namespace gearshift
