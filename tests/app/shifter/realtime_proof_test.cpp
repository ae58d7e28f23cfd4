// The telemetry's load is a part of the haptic cycle.
#include "tests/support/realtime_proof.h"

#include <doctest/doctest.h>

#include "app/shifter/telemetry_load.h"
#include "tests/app/vehicle/cars.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::shifter;
using namespace gearshift::test;

TEST_CASE("a step neither allocates nor locks nor calls the system, also when telemetry begins and ends") {
  const gearshift::vehicle::CarSpec car = shipped_car("hatchback");
  const Gate gate = shipped_gate(car.gate);
  LatestValue<Telemetry> newest;
  TelemetryLoad load(car, gate, kPaperForce, newest);
  LeverInput lever;
  lever.slot = slot_of_gear(gate, 3);
  lever.depth = 0.025;
  lever.push.y = 10.0;
  const RealtimeProof proof = prove_realtime([&] {
    for (int i = 0; i < 100; ++i) {
      Telemetry now;
      now.is_live = i % 40 < 30;
      now.car.speed = 10.0;
      now.car.clutch = 1.0;
      newest.write(now);
      (void)load.step(lever, 0.001);
    }
  });
  CHECK_MESSAGE(proof.clean(), proof.verdict());
}
