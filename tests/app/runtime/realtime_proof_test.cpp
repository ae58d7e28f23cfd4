// The runtime's cycle callback keeps the guarantees of the haptic cycle: no allocation, no lock and no system call.
#include "tests/support/realtime_proof.h"

#include <memory>

#include <doctest/doctest.h>

#include "app/runtime/cycle_runner.h"
#include "app/runtime/exact_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/device/smoothed_hand.h"
#include "tests/app/runtime/runtime_rig.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

constexpr std::int64_t kPeriod = 1'000'000;  // [ns]

// Runs the callback first without a car, then with a car that is recorded and whose guidance is switched on and off.
// The stream has no reader, so it wraps. Keys move the pedals.
void prove(LatestValue<HandTarget>& led, HandDriver& hand) {
  const Gate gate = paper_gate();
  ScriptedHand script = tour_of(gate);
  SimulatedLeverConfig config;
  config.hand = kGripHand;
  SimulatedLever lever(config, kPeriod, hand);
  auto runner = std::make_unique<CycleRunner>();
  auto first = std::make_unique<LoopRun>(HapticConfig{}, gate, lever, runner->inputs, 1);
  const CarSpec car = read_car(GEARSHIFT_ASSETS "/cars/hatchback.toml");
  auto second = std::make_unique<LoopRun>(HapticConfig{}, gate, lever, runner->inputs, 2,
                                          std::make_unique<CarLoad>(car, gate, 31.7));
  first->loop.arm();
  second->loop.arm();
  auto statistics = std::make_unique<CycleStatistics>();
  DriverControls controls;
  controls.ignition = true;

  const RealtimeProof proof = prove_realtime([&] {
    std::int64_t now = 0;
    runner->cycle({now, 0}, statistics.get());  // the callback has no loop yet
    runner->switch_to(*first);
    for (int i = 0; i < 20'000; ++i) {
      const std::int64_t skipped = i % 500 == 0 ? 3 : 0;
      now += kPeriod * (1 + skipped);
      if (i % 1000 == 0) ++statistics->overruns;
      if (i == 5'000) runner->switch_to(*second);
      controls.guidance = i % 2000 < 1000 ? 0.0 : 0.7;
      controls.guided_gear = 1 + i / 4000;
      controls.pedals.clutch = i % 3000 < 1500 ? 1.0 : 0.0;
      runner->inputs.controls.write(controls);
      runner->inputs.pedal_keys.write({.throttle = i % 700 < 300, .clutch = i % 900 < 500});
      led.write(script.next(1e-9 * static_cast<double>(now), runner->newest().cycle.out.lever));
      runner->cycle({now, skipped}, statistics.get());
    }
  });
  INFO(proof.verdict());
  CHECK(proof.clean());
}

}  // namespace

TEST_CASE(
    "the callback is real-time safe: stream wrapped, late, switched to a guided car, moved by a user and by keys") {
  LatestValue<HandTarget> led;
  SmoothedHand hand(led, 1e-9 * static_cast<double>(kPeriod));
  prove(led, hand);
}

TEST_CASE("the callback is real-time safe with a scripted driver's hand") {
  LatestValue<HandTarget> led;
  ExactHand hand(led);
  prove(led, hand);
}

TEST_CASE("the hand tours the gate before and after the switch of loops, and finishes before the proof does") {
  CHECK(tour_of(paper_gate()).duration() > 6.0);
  CHECK(tour_of(paper_gate()).duration() < 20.0);
}
