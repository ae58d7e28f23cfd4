// A runtime with a car connected to its lever: driven, recorded from the middle of a drive, and replayed.
#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "app/vehicle/car_load.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "tests/app/runtime/runtime_rig.h"
#include "tests/support/short_trace.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

void feet(Runtime& runtime, double throttle, double clutch) {
  DriverControls controls;
  controls.ignition = true;
  controls.pedals.throttle = throttle;
  controls.pedals.clutch = clutch;
  runtime.set_controls(controls);
}

// Moves off in first gear and shifts into second, with clutch and throttle.
void move_off(Runtime& runtime, LeadingPerson& person) {
  feet(runtime, 0.0, 1.0);
  person.shift_to(1);
  for (int i = 0; i < 120; ++i) {
    feet(runtime, 0.3, std::max(0.0, 0.75 - 0.006 * i));
    person.wait(1);
  }
  feet(runtime, 0.4, 0.0);
  person.wait(150);
  feet(runtime, 0.0, 1.0);
  person.shift_to(2);
  feet(runtime, 0.3, 0.0);
  person.wait(30);
}

}  // namespace

TEST_CASE("moving off, shifting up and driving") {
  Runtime runtime(hatchback(RuntimeClock::virtual_time));
  runtime.arm();
  LeadingPerson person(runtime, [&] { runtime.advance(LeadingPerson::kFrame); });
  runtime.advance(1.0);
  CHECK(runtime.car().running);  // the engine runs before any pedal input
  CHECK(runtime.car().force_scale == doctest::Approx(31.7 / 60.0));
  move_off(runtime, person);
  CHECK(runtime.car().gear == 2);
  CHECK(runtime.snapshot().gear == 2);
  CHECK(runtime.car().running);
  CHECK(runtime.car().road_speed > 3.0);
  CHECK(runtime.car().road_speed == runtime.snapshot().road_speed);
  CHECK(runtime.car().distance > 5.0);
}

TEST_CASE("the car continues when a recording begins, and the trace replays bit for bit") {
  const TempFolder folder;
  Runtime runtime(hatchback(RuntimeClock::virtual_time));
  runtime.arm();
  LeadingPerson person(runtime, [&] { runtime.advance(LeadingPerson::kFrame); });
  move_off(runtime, person);
  const VehicleState before = runtime.car();
  runtime.start_recording(folder / "drive.trace");
  const VehicleState after = runtime.car();
  CHECK(after.gear == 2);
  CHECK(after.running);
  CHECK(after.road_speed == doctest::Approx(before.road_speed).epsilon(0.001));
  CHECK(after.engine_speed == doctest::Approx(before.engine_speed).epsilon(0.001));
  CHECK(after.distance == before.distance);  // the recording starts a new loop, whose first cycle has no duration
  CHECK(after.slip_energy >= before.slip_energy);
  feet(runtime, 0.0, 1.0);
  person.shift_to(3);
  feet(runtime, 0.5, 0.0);
  person.wait(60);
  CHECK_FALSE(runtime.stop_recording());
  CHECK(runtime.car().gear == 3);
  const Trace trace = read_trace(folder / "drive.trace");
  const ReplayResult result = replay(trace, make_car_load);
  CHECK(result.bit_for_bit());
  CHECK(result.cycles > 1500);
}

TEST_CASE("pedals moved by keys continue when a recording begins, and the trace replays without the keys") {
  const TempFolder folder;
  RuntimeConfig config = hatchback(RuntimeClock::virtual_time);
  config.pedal_timing = {0.25, 1.2};
  Runtime runtime(config);
  runtime.arm();
  DriverControls key_on;
  key_on.ignition = true;
  runtime.set_controls(key_on, {.throttle_light = true, .clutch = true});
  runtime.advance(0.5);
  runtime.set_controls(key_on, {.throttle = true});
  runtime.advance(0.1);
  const Pedals before = runtime.car().pedals;
  CHECK(before.throttle == doctest::Approx(0.2 + 0.1 / 0.25).epsilon(0.01));
  CHECK(before.clutch < 0.76);  // it has left the floor, and rises through the bite zone in 1.2 s
  runtime.start_recording(folder / "keys.trace");
  runtime.advance(0.5);
  runtime.set_controls(key_on, {.brake = true, .clutch_hold = true});
  runtime.advance(0.2);
  CHECK_FALSE(runtime.stop_recording());
  const Trace trace = read_trace(folder / "keys.trace");
  const Pedals first = trace.samples.front().controls.pedals;
  CHECK(std::abs(first.throttle - before.throttle) < 0.005);  // 0.004 in a cycle
  CHECK(std::abs(first.clutch - before.clutch) < 0.005);
  CHECK(trace.samples.back().controls.pedals.brake == doctest::Approx(0.8).epsilon(0.01));
  CHECK(replay(trace, make_car_load).bit_for_bit());
}

TEST_CASE("guidance on, off and to a different gear has an effect, and its recording replays bit for bit") {
  const TempFolder folder;
  Runtime runtime(hatchback(RuntimeClock::virtual_time));
  runtime.arm();
  LeadingPerson person(runtime, [&] { runtime.advance(LeadingPerson::kFrame); });
  move_off(runtime, person);
  const auto guide = [&](double strength, int gear) {
    DriverControls controls;
    controls.ignition = true;
    controls.pedals.clutch = 1.0;
    controls.guidance = strength;
    controls.guided_gear = gear;
    runtime.set_controls(controls);
  };
  guide(0.8, 3);
  person.wait(30);
  runtime.start_recording(folder / "drive.trace");
  person.shift_to(3);
  guide(0.0, 3);
  person.wait(60);
  guide(1.0, 4);
  person.shift_to(4);
  guide(0.3, 5);
  person.shift_to(5);
  guide(0.0, kNeutralGear);
  person.wait(30);
  CHECK_FALSE(runtime.stop_recording());
  Trace trace = read_trace(folder / "drive.trace");
  CHECK(trace.samples[0].controls.guidance == 0.8);  // guidance was on when the recording began
  const ReplayResult result = replay(trace, make_car_load);
  CHECK(result.bit_for_bit());
  CHECK(result.cycles == trace.samples.size());
  for (TraceSample& sample : trace.samples) sample.controls.guidance = 0.0;
  CHECK_FALSE(replay(trace, make_car_load).bit_for_bit());
}

TEST_CASE("the car can start in gear at speed, also on the real clock") {
  RuntimeConfig config = hatchback(RuntimeClock::real_time);
  config.start.gear = 4;
  config.start.road_speed = 20.0;
  Runtime runtime(config);
  runtime.arm();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(runtime.car().gear == 4);
  CHECK(runtime.snapshot().gear == 4);
  CHECK(runtime.car().running);
  CHECK(runtime.car().road_speed > 19.0);
  CHECK(runtime.car().distance > 3.0);
}

TEST_CASE("a car that does not fit the gate is rejected; without a car there is none") {
  RuntimeConfig config = hatchback(RuntimeClock::virtual_time);
  config.layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/six_speed_r_left_up.toml");
  CHECK_THROWS_AS(Runtime{config}, std::invalid_argument);
  config.car.reset();
  Runtime runtime(config);
  runtime.advance(0.5);
  CHECK(runtime.car().engine_speed == 0.0);
}
