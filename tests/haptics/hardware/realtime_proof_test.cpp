// Proves that the stick's calls in the haptic cycle allocate nothing, take no lock and make no system call except the
// write that wakes the port.
#include "tests/support/realtime_proof.h"

#include <doctest/doctest.h>

#include "haptics/hardware/pid_lever.h"
#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/calibrated.h"
#include "tests/haptics/hardware/stick_bench.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

TEST_CASE("reading, writing, walls and release allocate nothing, take no lock, and write to nothing but the wake-up") {
  EmulatedStickConfig config;
  StillHand hand;
  StickBench bench(config, hand);
  bench.prepare();
  PidLever lever(calibration_of(config), bench.driver, 0.001);
  bench.tick_for(0.1, {});
  const auto cycles = [&] {
    for (int i = 0; i < 1000; ++i) {
      (void)lever.read(i);
      lever.write({0.01 * i, -0.02 * i});
      lever.set_device_walls({{-0.01, -0.02}, {0.01, 1e-5 * i}, 0.5});
      if (i % 100 == 0) lever.release();
    }
  };
  const RealtimeProof proof = prove_realtime(cycles, bench.stream.wake_fd);
  INFO(proof.verdict());
  CHECK(proof.clean());
  CHECK_FALSE(prove_realtime(cycles).clean());  // negative control: the wake-up's write is detected
  CHECK_FALSE(prove_realtime(cycles, bench.stream.wake_fd + 1).clean());
}

TEST_CASE("the port's side takes no lock and allocates nothing") {
  EmulatedStickConfig config;
  StillHand hand;
  StickBench bench(config, hand);
  bench.prepare();
  bench.tick_for(0.1, pushing(0.5, 0.5));
  const std::vector<std::uint8_t> report(13, 1), unknown{0x77};
  const RealtimeProof proof = prove_realtime(
      [&] {
        for (int i = 0; i < 1000; ++i) {
          const std::int64_t now = std::int64_t{1'000'000} * i;
          bench.driver.on_input(report, now);
          bench.driver.on_input(unknown, now);
          bench.driver.command(pushing(0.001 * i, 0.5));
          if (bench.driver.next_output(now).size > 0) bench.driver.on_sent(now);
        }
      },
      bench.stream.wake_fd);
  INFO(proof.verdict());
  CHECK(proof.clean());
}

TEST_CASE("the watch of forces allocates nothing, takes no lock and makes no system call") {
  DeviceSpec spec;
  spec.workspace = glm::dvec2(1.0);
  ForceWatch watch(spec, 0.001);
  StickForces forces;
  const RealtimeProof proof = prove_realtime(
      [&] {
        for (int i = 0; i < 1000; ++i) {
          const std::int64_t now = std::int64_t{1'000'000} * i;
          forces[0].constant = 0.01 * (i % 100);
          watch.on_output(forces, now);
          watch.on_reading({1e-5 * (i % 50), 0.0}, now);
          static_cast<void>(watch.fault());
        }
      },
      -1);
  INFO(proof.verdict());
  CHECK(proof.clean());
}
