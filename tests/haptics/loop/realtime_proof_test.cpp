// The promise of the haptic cycle, proved: no allocation, no lock, no system call.
#include "tests/support/realtime_proof.h"

#include <memory>

#include <doctest/doctest.h>

#include "tests/haptics/loop/recorded_drive.h"

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

}  // namespace gearshift
