// After a late wake-up, the loop also reports the deadlines that it missed while its thread slept.
#include <doctest/doctest.h>

#include "app/runtime/cycle_runner.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/device/smoothed_hand.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;

TEST_CASE("skipped deadlines are counted, and separately the cycles that took too long") {
  const HapticConfig config;
  const Gate gate = paper_gate();
  LatestValue<HandTarget> person{HandTarget{}};
  SmoothedHand hand(person, period_s(config));
  SimulatedLever lever(SimulatedLeverConfig{}, period_ns(config), hand);
  CycleRunner runner;
  LoopRun run(config, gate, lever, runner.inputs, 1);
  runner.switch_to(run);
  CycleStatistics statistics;
  std::int64_t deadline = 0;
  std::uint64_t skipped = 0, overruns = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::int64_t missed = i % 500 == 37 ? 3 : 0;
    const bool too_long = i % 1000 == 41;
    skipped += static_cast<std::uint64_t>(missed);
    overruns += too_long ? 1u : 0u;
    statistics.skipped = skipped;
    statistics.overruns = overruns;
    deadline += (1 + missed) * period_ns(config);
    runner.cycle({deadline, missed, missed * period_ns(config) + i}, &statistics);
    CHECK(runner.stream.newest()->skipped == skipped);
    CHECK(runner.stream.newest()->late_ns == missed * period_ns(config) + i);
    CHECK(runner.stream.newest()->overruns == overruns);
  }
  CHECK(runner.newest().skipped == 12);
  CHECK(runner.newest().overruns == 2);
}
