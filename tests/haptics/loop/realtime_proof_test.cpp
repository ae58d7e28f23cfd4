// The promise of the haptic cycle, proved: no allocation, no lock, no system call.
#include "tests/support/realtime_proof.h"

#include <algorithm>
#include <memory>

#include <doctest/doctest.h>

#include "haptics/loop/simulated_run.h"
#include "tests/haptics/loop/recorded_drive.h"
#include "tests/support/hands.h"

namespace gearshift {

TEST_CASE("the cycle allocates nothing, takes no lock and makes no system call, whatever happens to it") {
  auto drive = std::make_unique<RecordedDrive>();
  drive->channels().recording.store(true);
  // Longer than the trace and event queues hold: full queues are part of it.
  const RealtimeProof proof = prove_realtime([&] {
    for (int i = 0; i < 10'000; ++i) drive->step();
  });
  INFO(proof.verdict());
  CHECK(proof.clean());
}

TEST_CASE("nor in any way of making a contact") {
  const Gate gate = paper_gate();
  for (const ContactHold hold : {ContactHold::zero_order, ContactHold::half_sample, ContactHold::observer}) {
    for (const EnergyControl control :
         {EnergyControl::none, EnergyControl::energy_bounding, EnergyControl::passivity_controller}) {
      PushingHand hand([](double time, glm::dvec2) { return glm::dvec2{0.0, 20.0 * std::min(1.0, time)}; });
      SimulatedRunConfig config;
      config.haptics.contact = {hold, control, true, true};
      config.haptics.estimator.window = 8;
      config.lever.delay = 3;  // so that some of them chatter, and the limiter works
      config.lever.model_error = 0.1;
      config.lever.period_jitter = 0.1;
      config.gate = gate;
      config.start = {0.5 * (gate.column[0].center + gate.column[1].center), 0.0};
      auto run = std::make_unique<SimulatedRun>(config, hand);
      const RealtimeProof proof = prove_realtime([&] {
        for (int i = 0; i < 3000; ++i) run->step();
      });
      INFO(proof.verdict());
      CHECK(proof.clean());
    }
  }
}

}  // namespace gearshift
