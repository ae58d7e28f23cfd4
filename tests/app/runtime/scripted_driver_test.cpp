// A scripted driver is called with every cycle, and the lever gets exactly the hand target that the driver returns.
// Only the instructor sets road and guidance.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <thread>

#include <doctest/doctest.h>

#include "app/vehicle/car_load.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_reader.h"
#include "tests/app/runtime/runtime_rig.h"
#include "tests/support/short_trace.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// A driver whose hand jumps and reverses, to reveal any filter between hand and lever. Its action depends on its input,
// so any deviation grows.
DriverAction restless(const DriveSample& now) {
  const double t = now.time();
  DriverAction action;
  action.hand.position = {0.012 * std::sin(9.0 * t) - 0.1 * now.lever.lever.x, std::fmod(t, 0.4) < 0.2 ? 0.03 : -0.02};
  action.hand.velocity = {0.3 * std::cos(9.0 * t), 0.0};
  action.hand.push = {0.0, 2.0 * std::sin(40.0 * t)};
  action.controls.ignition = true;
  action.controls.pedals.throttle = std::max(0.0, 0.3 + 0.2 * std::sin(t) - 0.001 * now.car.engine_speed);
  action.controls.pedals.clutch = std::fmod(t, 1.0);
  action.controls.guidance = 1.0;  // ignored, because only the instructor sets guidance and slope
  action.controls.guided_gear = 5;
  action.controls.slope = 0.5;
  return action;
}

bool same(const DriveSample& a, const DriveSample& b) {
  return a.lever.time_ns == b.lever.time_ns && a.lever.lever == b.lever.lever && a.lever.f_h == b.lever.f_h &&
         a.lever.commanded == b.lever.commanded && a.lever.gear == b.lever.gear &&
         a.controls.pedals.throttle == b.controls.pedals.throttle &&
         a.controls.pedals.hand_brake == b.controls.pedals.hand_brake && a.controls.slope == b.controls.slope &&
         a.car.engine_speed == b.car.engine_speed && a.car.road_speed == b.car.road_speed;
}

class DriverHand final : public HandDriver {
 public:
  HandTarget next(double, glm::dvec2) noexcept override { return target; }
  HandTarget target;
};

// The expected drive, computed without Runtime from lever, loop and car on a virtual clock, without guidance. Each
// action is applied in the next cycle.
std::vector<DriveSample> driven_without_runtime(const RuntimeConfig& config, const Gate& gate, int cycles) {
  SimulatedRunConfig setup;
  setup.haptics = config.preset.haptics;
  setup.lever = config.preset.lever;
  setup.lever.hand = leading_hand(setup.lever.hand);
  setup.gate = gate;
  setup.start = rest_position(gate, kNeutralGear);
  DriverHand hand;
  hand.target.position = setup.start;
  IdleHand idle_hand;
  const double force = SimulatedLever(setup.lever, 1'000'000, idle_hand).spec().max_force.y;
  CarLoad car(*config.car, gate, force, config.start, config.seed);
  SimulatedRun run(setup, hand, &car);
  std::vector<DriveSample> samples;
  DriveSample now;
  now.controls.ignition = true;
  now.controls.slope = 0.05;
  now.controls.pedals = config.pedals;
  for (int i = 0; i < cycles; ++i) {
    run.inputs().controls.write(now.controls);
    now.lever = run.step();
    now.lever.cycle = static_cast<std::uint64_t>(i);
    now.car = car.state();
    samples.push_back(now);
    const DriverAction action = restless(now);
    hand.target = action.hand;
    now.controls = action.controls;
    now.controls.slope = 0.05;
    now.controls.guidance = 0.0;
  }
  return samples;
}

}  // namespace

TEST_CASE("on the virtual clock the driver gets every cycle once, and its action is applied exactly in the next") {
  RuntimeConfig config = hatchback(RuntimeClock::virtual_time);
  config.pedals.hand_brake = 0.8;
  const auto driven = std::make_shared<std::vector<DriveSample>>();
  config.driver = [driven](const DriveSample& now) {
    driven->push_back(now);
    return restless(now);
  };
  Runtime runtime(config);
  DriverControls instructor;
  instructor.slope = 0.05;
  runtime.set_controls(instructor);
  runtime.arm();
  for (int i = 0; i < 300; ++i) runtime.advance(1.0 / 60.0);
  const std::vector<DriveSample> expected = driven_without_runtime(config, runtime.gate(), 5000);
  const std::vector<DriveSample> cycles = runtime.read_frame().cycles;
  REQUIRE(driven->size() == 5000);
  REQUIRE(cycles.size() == 5000);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    REQUIRE(same((*driven)[i], expected[i]));
    REQUIRE(same(cycles[i], expected[i]));
    REQUIRE(cycles[i].lever.cycle == i);
  }
  CHECK(cycles.back().car.engine_speed > 10.0);  // [rad/s] the driver has started the engine
}

TEST_CASE("the driver controls hand and pedals, the instructor road and guidance, and neither overrides the other") {
  RuntimeConfig config = hatchback(RuntimeClock::virtual_time);
  config.driver = restless;
  Runtime runtime(config);
  DriverControls instructor;
  instructor.slope = 0.02;
  instructor.guidance = 0.4;
  instructor.guided_gear = 3;
  instructor.pedals.throttle = 0.9;
  instructor.pedals.clutch = 0.9;
  runtime.set_controls(instructor);
  HandTarget idle_hand;
  idle_hand.position = {0.03, 0.03};
  runtime.set_hand(idle_hand);
  runtime.advance(0.005);
  CHECK(runtime.read_frame().cycles.back().lever.lever.x < 0.01);
  runtime.set_controls(instructor);
  runtime.advance(0.002);
  for (const DriveSample& now : runtime.read_frame().cycles) {
    CHECK(now.controls.slope == 0.02);
    CHECK(now.controls.guidance == 0.4);
    CHECK(now.controls.guided_gear == 3);
    CHECK(now.controls.pedals.throttle < 0.5);
    CHECK(now.controls.pedals.clutch < 0.01);
    CHECK(now.controls.ignition);
  }
}

TEST_CASE("a driver shifts through the gears on either clock") {
  for (const RuntimeClock clock : {RuntimeClock::virtual_time, RuntimeClock::real_time}) {
    RuntimeConfig config = runtime_config(clock);
    config.driver = touring_driver(paper_gate());
    Runtime runtime(config);
    runtime.arm();
    std::vector<int> gears;
    const std::vector<int> first_three{1, 2, 3};
    CHECK(becomes_true([&] {
      if (clock == RuntimeClock::virtual_time) runtime.advance(0.02);
      add_gears(runtime.read_frame().events, gears);
      return gears == first_three;
    }));
  }
}

TEST_CASE("recorded on the virtual clock, a scripted drive replays bit for bit and misses no cycle") {
  const TempFolder folder;
  RuntimeConfig config = hatchback(RuntimeClock::virtual_time);
  const auto driven = std::make_shared<std::vector<std::uint64_t>>();
  config.driver = [driven](const DriveSample& now) {
    driven->push_back(now.lever.cycle);
    return restless(now);
  };
  Runtime runtime(config);
  runtime.arm();
  runtime.advance(0.7);
  runtime.start_recording(folder / "a.trace");
  runtime.advance(0.8);
  CHECK_FALSE(runtime.stop_recording());
  REQUIRE(driven->size() == 1500);
  for (std::size_t i = 0; i < driven->size(); ++i) CHECK((*driven)[i] == (i < 700 ? i : i - 700));
  const Trace trace = read_trace(folder / "a.trace");
  CHECK(trace.samples.size() == 800);
  CHECK(trace.samples[0].controls.pedals.throttle != 0.0);  // recording does not reset the throttle
  CHECK(replay(trace, make_car_load).bit_for_bit());
}

TEST_CASE(
    "on the real clock the driver gets each cycle at most once, in order, while road, guidance and recordings change") {
  const TempFolder folder;
  RuntimeConfig config = hatchback(RuntimeClock::real_time);
  struct DrivenCycles {
    std::mutex mutex;
    std::vector<DriveSample> cycles;
  };
  const auto driven = std::make_shared<DrivenCycles>();
  config.driver = [driven](const DriveSample& now) {
    const std::lock_guard lock(driven->mutex);
    driven->cycles.push_back(now);
    return restless(now);
  };
  {
    Runtime runtime(config);
    runtime.arm();
    for (const char* name : {"a.trace", "b.trace", "c.trace"}) {
      runtime.start_recording(folder / name);
      DriverControls instructor;
      for (int i = 0; i < 60; ++i) {
        instructor.slope = 0.001 * i;
        instructor.guidance = i % 20 < 10 ? 0.0 : 0.8;
        instructor.guided_gear = 2;
        runtime.set_controls(instructor);
        runtime.set_hand({});
        sleep_ms(3);
        (void)runtime.read_frame();
      }
      CHECK_FALSE(runtime.stop_recording());
    }
  }
  const std::size_t at_end = driven->cycles.size();
  sleep_ms(20);
  CHECK(driven->cycles.size() == at_end);  // the driver is not called after the runtime has ended
  REQUIRE(at_end > 100);
  bool guided = false;
  for (std::size_t i = 1; i < at_end; ++i) {
    CHECK(driven->cycles[i].lever.time_ns > driven->cycles[i - 1].lever.time_ns);
    guided = guided || driven->cycles[i].controls.guidance == 0.8;
    CHECK(driven->cycles[i].controls.slope < 0.06);
  }
  CHECK(guided);
  for (const char* name : {"a.trace", "b.trace", "c.trace"})
    CHECK(replay(read_trace(folder / name), make_car_load).bit_for_bit());
}

TEST_CASE("a sleeping driver blocks neither lever nor instructor, and the runtime ends when the driver returns") {
  RuntimeConfig config = hatchback(RuntimeClock::real_time);
  const auto calls = std::make_shared<std::atomic<int>>(0);
  config.driver = [calls](const DriveSample& now) {
    if (++*calls > 1) sleep_ms(700);
    return restless(now);
  };
  Runtime runtime(config);
  REQUIRE(becomes_true([&] { return *calls > 1; }));
  const std::uint64_t before = runtime.snapshot().cycle;
  DriverControls instructor;
  instructor.guidance = 0.6;
  runtime.set_controls(instructor);
  bool is_combined = false;
  CHECK(becomes_true([&] {
    for (const DriveSample& now : runtime.read_frame().cycles)
      is_combined = is_combined || (now.controls.guidance == 0.6 && now.controls.pedals.throttle != 0.0);
    return is_combined;
  }));
  CHECK(becomes_true([&] { return runtime.snapshot().cycle > before + 50; }));
}
