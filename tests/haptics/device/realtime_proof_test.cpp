// Proves that the simulated lever's calls in the haptic cycle do not allocate, lock or make system calls.
#include "tests/support/realtime_proof.h"

#include <doctest/doctest.h>

#include "haptics/device/scripted_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/device/smoothed_hand.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

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
  SmoothedHand smoothed(channel, 1e-3);
  SimulatedLever scripted_lever(config, 1'000'000, scripted), smoothed_lever(config, 1'000'000, smoothed);

  const RealtimeProof proof = prove_realtime([&] {
    for (std::int64_t ms = 0; ms < 1000; ++ms) {
      channel.write(HandTarget{{0.01, 0.02}, {}, {}, false, false});
      scripted_lever.read(ms * 1'000'000);
      scripted_lever.write({-20.0, 3.0});
      smoothed_lever.read(ms * 1'000'000);
      smoothed_lever.write({2.0, 2.0});
    }
    scripted_lever.release();
    smoothed_lever.place({0.01, 0.01});
  });
  INFO(proof.verdict());
  CHECK(proof.clean());
}
