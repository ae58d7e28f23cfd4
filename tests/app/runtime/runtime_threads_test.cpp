// The runtime on its own thread. No check depends on the machine's speed. The test also runs under the thread
// sanitizer.
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "tests/app/runtime/runtime_rig.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;
using namespace gearshift::vehicle;

TEST_CASE("on the real clock, moved through the paper's gate, the gears engage in order") {
  Runtime runtime(runtime_config(RuntimeClock::real_time));
  runtime.arm();
  std::vector<int> gears;
  LeadingPerson person(runtime, [&] {
    sleep_ms(8);
    add_gears(runtime.read_frame().events, gears);
  });
  for (const int gear : kPaperTour) {
    CAPTURE(gear);
    person.shift_to(gear);
    CHECK(becomes_true([&] { return runtime.snapshot().gear == gear; }));
  }
  add_gears(runtime.read_frame().events, gears);
  CHECK(gears == kPaperTour);
}

TEST_CASE("while a frame hangs for a second, the lever keeps running, and no cycle is lost") {
  RuntimeConfig config = runtime_config(RuntimeClock::real_time);
  config.preset.haptics.rate = 4000.0;  // [Hz] the highest rate fills the queues fastest
  config.driver = touring_driver(paper_gate(), 1.0 / 4000.0);
  Runtime runtime(config);
  runtime.arm();
  REQUIRE(becomes_true([&] { return runtime.snapshot().guard == GuardState::running; }));
  const HapticSnapshot before = runtime.snapshot();
  (void)runtime.read_frame();
  sleep_ms(1000);
  const HapticSnapshot after = runtime.snapshot();
  const std::vector<DriveSample> cycles = runtime.read_frame().cycles;
  CHECK(after.time_ns - before.time_ns > 500'000'000);
  CHECK(after.cycle > before.cycle + 100);
  REQUIRE(cycles.size() > 100);
  for (std::size_t i = 1; i < cycles.size(); ++i)
    CHECK(cycles[i].lever.cycle == cycles[i - 1].lever.cycle + 1);  // no cycle is missing
  CHECK(cycles.back().lever.cycle >= after.cycle);
  CHECK(runtime.health().lost == 0);
  // After a frame that hung for 1 s, the loop still reacts to commands.
  runtime.stop();
  CHECK(becomes_true([&] { return runtime.snapshot().guard == GuardState::released; }));
}

TEST_CASE("on the real clock, lateness percentiles are ordered, and each frame starts a new measurement") {
  Runtime runtime(runtime_config(RuntimeClock::real_time));
  CHECK(runtime.health().late_worst == 0.0);  // nothing was measured before the first frame
  sleep_ms(200);
  CHECK(runtime.health().late_worst == 0.0);
  (void)runtime.read_frame();
  const LoopHealth health = runtime.health();
  CHECK(health.late_worst > 0.0);
  CHECK(health.late_p50 <= health.late_p99);
  CHECK(health.late_p99 <= health.late_worst);
  // Without real-time priority there must be a reason. Even with it there may be one: the memory could not be locked.
  CHECK((health.realtime || !health.not_realtime_reason.empty()));
  CHECK(runtime.health().late_worst == health.late_worst);  // reading the health changes nothing
  while (!runtime.read_frame().cycles.empty()) continue;    // until a frame without a cycle
  CHECK(runtime.health().late_worst == 0.0);
}

TEST_CASE("the destructor returns at once in any state") {
  for (int i = 0; i < 3; ++i) {
    Runtime runtime(runtime_config(RuntimeClock::real_time));
    if (i > 0) runtime.arm();
    if (i > 1) runtime.stop();
  }
  CHECK_THROWS_AS(Runtime(runtime_config(RuntimeClock::real_time)).advance(0.1), std::logic_error);
}
