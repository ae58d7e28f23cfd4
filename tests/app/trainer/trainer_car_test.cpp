// A trainer with a car behind its lever: driven, recorded in the middle, run again.
#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "app/training/lesson_world.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "tests/app/trainer/trainer_bench.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

void feet(Trainer& trainer, double throttle, double clutch) {
  DriverControls controls;
  controls.ignition = true;
  controls.throttle = throttle;
  controls.clutch = clutch;
  trainer.set_controls(controls);
}

// From rest to second gear, as one drives.
void move_off(Trainer& trainer, LeadingPerson& person) {
  feet(trainer, 0.0, 1.0);
  person.shift_to(1);
  for (int i = 0; i < 120; ++i) {
    feet(trainer, 0.3, std::max(0.0, 0.75 - 0.006 * i));
    person.wait(1);
  }
  feet(trainer, 0.4, 0.0);
  person.wait(150);
  feet(trainer, 0.0, 1.0);
  person.shift_to(2);
  feet(trainer, 0.3, 0.0);
  person.wait(30);
}

}  // namespace

TEST_CASE("one moves off, shifts up and drives") {
  Trainer trainer(hatchback(TrainerClock::virtual_time));
  trainer.arm();
  LeadingPerson person(trainer, [&] { trainer.advance(LeadingPerson::kFrame); });
  trainer.advance(1.0);
  CHECK(trainer.car().running);  // before anybody has touched the pedals
  CHECK(trainer.car().force_scale == doctest::Approx(31.7 / 60.0));
  move_off(trainer, person);
  CHECK(trainer.car().gear == 2);
  CHECK(trainer.snapshot().gear == 2);
  CHECK(trainer.car().running);
  CHECK(trainer.car().road_speed > 3.0);
  CHECK(trainer.car().road_speed == trainer.snapshot().road_speed);
  CHECK(trainer.car().distance > 5.0);
}

TEST_CASE("a recording begun while it drives: the car goes on, and the trace replays bit for bit") {
  const TempFolder folder;
  Trainer trainer(hatchback(TrainerClock::virtual_time));
  trainer.arm();
  LeadingPerson person(trainer, [&] { trainer.advance(LeadingPerson::kFrame); });
  move_off(trainer, person);
  const VehicleState before = trainer.car();
  trainer.start_recording(folder / "drive.trace");
  const VehicleState after = trainer.car();
  CHECK(after.gear == 2);
  CHECK(after.running);
  CHECK(after.road_speed == doctest::Approx(before.road_speed).epsilon(0.001));
  CHECK(after.engine_speed == doctest::Approx(before.engine_speed).epsilon(0.001));
  CHECK(after.distance == before.distance);  // a loop's first cycle takes no time
  CHECK(after.slip_energy >= before.slip_energy);
  feet(trainer, 0.0, 1.0);
  person.shift_to(3);
  feet(trainer, 0.5, 0.0);
  person.wait(60);
  CHECK_FALSE(trainer.stop_recording());
  CHECK(trainer.car().gear == 3);
  const Trace trace = read_trace(folder / "drive.trace");
  const ReplayResult result = replay(trace, make_lesson_world);
  CHECK(result.bit_for_bit());
  CHECK(result.cycles > 1500);
  // Without guidance it is the bare car's drive, to the bit.
  const auto bare = [](const std::string& name, const Gate& gate) {
    return make_car_world(name.substr(std::string("guided ").size()), gate);
  };
  CHECK(replay(trace, bare).bit_for_bit());
}

TEST_CASE("guided on and off, to one gear and another: it is felt, and what was recorded of it replays bit for bit") {
  const TempFolder folder;
  Trainer trainer(hatchback(TrainerClock::virtual_time));
  trainer.arm();
  LeadingPerson person(trainer, [&] { trainer.advance(LeadingPerson::kFrame); });
  move_off(trainer, person);
  const auto guide = [&](double strength, int gear) {
    DriverControls controls;
    controls.ignition = true;
    controls.clutch = 1.0;
    controls.guidance = strength;
    controls.guided_gear = gear;
    trainer.set_controls(controls);
  };
  guide(0.8, 3);
  person.wait(30);
  trainer.start_recording(folder / "drive.trace");
  person.shift_to(3);
  guide(0.0, 3);
  person.wait(60);
  guide(1.0, 4);
  person.shift_to(4);
  guide(0.3, 5);
  person.shift_to(5);
  guide(0.0, kNeutralGear);
  person.wait(30);
  CHECK_FALSE(trainer.stop_recording());
  const Trace trace = read_trace(folder / "drive.trace");
  CHECK(trace.samples[0].controls.guidance == 0.8);  // a lesson goes on where its recording begins
  const ReplayResult result = replay(trace, make_lesson_world);
  CHECK(result.bit_for_bit());
  CHECK(result.cycles == trace.samples.size());
  CHECK_THROWS_AS(replay(trace, make_car_world), FileError);
  const auto unguided = [](const std::string& name, const Gate& gate) {
    return make_car_world(name.substr(std::string("guided ").size()), gate);
  };
  CHECK_FALSE(replay(trace, unguided).bit_for_bit());
}

TEST_CASE("it starts in gear at speed; on the real clock, too") {
  TrainerConfig config = hatchback(TrainerClock::real_time);
  config.start.gear = 4;
  config.start.road_speed = 20.0;
  Trainer trainer(config);
  trainer.arm();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(trainer.car().gear == 4);
  CHECK(trainer.snapshot().gear == 4);
  CHECK(trainer.car().running);
  CHECK(trainer.car().road_speed > 19.0);
  CHECK(trainer.car().distance > 3.0);
}

TEST_CASE("a car that does not fit the gate is refused; without a car there is none") {
  TrainerConfig config = hatchback(TrainerClock::virtual_time);
  config.layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/six_speed_r_left_up.toml");
  CHECK_THROWS_AS(Trainer{config}, std::invalid_argument);
  config.car.reset();
  Trainer trainer(config);
  trainer.advance(0.5);
  CHECK(trainer.car().engine_speed == 0.0);
}
