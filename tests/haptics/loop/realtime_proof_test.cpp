// Proves that the haptic cycle allocates nothing, takes no lock and makes no system call.
#include "tests/support/realtime_proof.h"

#include <algorithm>
#include <memory>

#include <doctest/doctest.h>

#include "haptics/device/pushing_hand.h"
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

}  // namespace gearshift::test
