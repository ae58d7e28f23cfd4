// The calls that run in the haptic cycle, proved: no allocation, no lock, no system call.
#include "tests/support/realtime_proof.h"

#include <doctest/doctest.h>

#include "haptics/device/led_hand.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/device/simulated_lever.h"

using namespace gearshift;

TEST_CASE("reading, writing and releasing allocate nothing, take no lock and make no system call") {
  SimulatedLeverConfig config;
  config.hand = kGripHand;
  config.coulomb_friction = 0.2;
  config.force_sensor.noise_gw = 10.0;
  config.delay = 2;
  ScriptedHandConfig script;
  script.effort_gain = 100.0;
  script.effort_limit = 10.0;
  HandStroke stroke;
  stroke.to = {0.07, 0.06};
  ScriptedHand scripted(script, {stroke, HandStroke{}}, 1e-3);
  LatestValue<HandTarget> channel;
  LedHand led(channel, 1e-3);
  SimulatedLever by_script(config, 1'000'000, scripted), by_person(config, 1'000'000, led);

  const RealtimeProof proof = prove_realtime([&] {
    for (std::int64_t ms = 0; ms < 1000; ++ms) {
      channel.write(HandTarget{{0.01, 0.02}, {}, {}, false, false});
      by_script.read(ms * 1'000'000);
      by_script.write({-20.0, 3.0});
      by_person.read(ms * 1'000'000);
      by_person.write({2.0, 2.0});
    }
    by_script.release();
    by_person.place({0.01, 0.01});
  });
  INFO(proof.verdict());
  CHECK(proof.clean());
}
