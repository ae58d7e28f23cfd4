// Proves that the haptic cycle allocates nothing, takes no lock and makes no system call, and that recording allocates
// nothing.
#include "tests/support/realtime_proof.h"

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/device/pushing_hand.h"
#include "haptics/loop/block_codec.h"
#include "haptics/loop/simulated_run.h"
#include "tests/haptics/loop/recorded_drive.h"

namespace gearshift::test {

TEST_CASE("the cycle allocates nothing, takes no lock and makes no system call, whatever happens to it") {
  auto drive = std::make_unique<RecordedDrive>();
  const RealtimeProof proof = prove_realtime([&] {
    for (int i = 0; i < 10'000; ++i) drive->step();
  });
  INFO(proof.verdict());
  CHECK(proof.clean());
}

TEST_CASE("every kind of contact allocates nothing, takes no lock and makes no system call") {
  const haptics::Gate gate = paper_gate();
  for (const haptics::ContactHold hold :
       {haptics::ContactHold::zero_order, haptics::ContactHold::half_sample, haptics::ContactHold::observer}) {
    for (const haptics::EnergyControl control : {haptics::EnergyControl::none, haptics::EnergyControl::energy_bounding,
                                                 haptics::EnergyControl::passivity_controller}) {
      haptics::PushingHand hand([](double time, glm::dvec2) { return glm::dvec2{0.0, 20.0 * std::min(1.0, time)}; });
      haptics::SimulatedRunConfig config;
      config.haptics.contact = {hold, control, true, true};
      config.haptics.estimator.window = 8;
      config.lever.delay = 3;  // [periods] so long that some levers chatter and the loop softens walls
      config.lever.model_error = 0.1;
      config.lever.period_jitter = 0.1;
      config.gate = gate;
      config.start = {0.5 * (gate.column[0].center + gate.column[1].center), 0.0};
      auto run = std::make_unique<haptics::SimulatedRun>(config, hand);
      const RealtimeProof proof = prove_realtime([&] {
        for (int i = 0; i < 3000; ++i) run->step();
      });
      INFO(proof.verdict());
      CHECK(proof.clean());
    }
  }
}

// The recorder's thread cannot report that memory ran out, so the codec must have all of it before the drive.
TEST_CASE("once a full block was encoded, blocks of any size and content are encoded without allocating") {
  std::mt19937_64 random(1);
  std::vector<std::byte> block(haptics::kSamplesPerBlock * haptics::kSampleBytes), coded;
  haptics::BlockCodec codec;
  codec.encode(block, coded);
  for (std::byte& byte : block) byte = static_cast<std::byte>(random());
  const RealtimeProof proof = prove_realtime([&] {
    for (std::size_t last = 1; last <= haptics::kSamplesPerBlock; ++last) {
      codec.encode(block, coded);
      codec.encode(std::span(block).first(last * haptics::kSampleBytes), coded);
    }
  });
  INFO(proof.verdict());
  CHECK(proof.clean());
}

}  // namespace gearshift::test
