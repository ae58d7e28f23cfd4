// The trainer's callback keeps the promise of the haptic cycle: no allocation, no lock, no system call.
#include "tests/support/realtime_proof.h"

#include <memory>

#include <doctest/doctest.h>

#include "app/trainer/cycle_runner.h"
#include "app/trainer/touring_hand.h"
#include "haptics/device/simulated_lever.h"
#include "tests/support/gates.h"

using namespace gearshift;

TEST_CASE(
    "the callback is real-time safe: queues full, late, recorded, handed over to another loop with a car, touring") {
  constexpr std::int64_t kPeriod = 1'000'000;
  const Gate gate = paper_gate();
  TouringHand hand(gate, 1, 0.001);
  SimulatedLeverConfig config;
  config.hand = kGripHand;
  SimulatedLever lever(config, kPeriod, hand);
  auto first = std::make_unique<LoopRun>(HapticConfig{}, gate, lever);
  const CarSpec car = read_car(GEARSHIFT_ASSETS "/cars/hatchback.toml");
  auto second = std::make_unique<LoopRun>(HapticConfig{}, gate, lever, std::make_unique<CarWorld>(car, gate, 31.7));
  first->loop.arm();
  second->loop.arm();
  second->channels.recording.store(true);
  auto runner = std::make_unique<CycleRunner>(kPeriod);
  auto statistics = std::make_unique<CycleStatistics>();

  const RealtimeProof proof = prove_realtime([&] {
    std::int64_t now = 0;
    runner->cycle({now, 0}, statistics.get());  // before there is a loop
    runner->hand_over(*first);
    for (int i = 0; i < 20'000; ++i) {
      const std::int64_t skipped = i % 500 == 0 ? 3 : 0;
      now += kPeriod * (1 + skipped);
      if (i % 1000 == 0) ++statistics->overruns;
      if (i == 5'000) runner->hand_over(*second);
      runner->cycle({now, skipped}, statistics.get());
    }
    (void)runner->figures.update();
  });
  INFO(proof.verdict());
  CHECK(proof.clean());
}

TEST_CASE("a lap of the touring hand is longer than the proof's first second, and shorter than all of it") {
  const TouringHand hand(paper_gate(), 1, 0.001);
  CHECK(hand.lap() > 1.0);
  CHECK(hand.lap() < 20.0);
}
