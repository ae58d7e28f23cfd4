// Recordings begun in the middle of a drive: they replay bit for bit.
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/files/file_error.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "tests/app/trainer/trainer_bench.h"
#include "tests/support/small_files.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

HapticTuning softer(const Trainer& trainer) {
  HapticTuning tuning = trainer.admitted().tuning;
  tuning.wall_stiffness = 1500.0;
  tuning.feel_scale = 0.4;
  return tuning;
}

// A device whose stop, as its encoder reads it, is 8 um beyond what its guard allows: who pushes it there breaks a limit.
TrainerConfig breakable(TrainerClock clock) {
  TrainerConfig config = trainer_config(clock);
  config.preset.haptics.guard.position_margin = 0.0;
  return config;
}

HandTarget against_the_stop() {
  HandTarget target;
  target.position = {0.0, 0.06};
  target.push = {0.0, 100.0};
  return target;
}

}  // namespace

TEST_CASE("a recording begun in gear, after tuning, pedals and a fault of the person, replays bit for bit") {
  const TempFolder folder;
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.arm();
  LeadingPerson person(trainer, [&] { trainer.advance(LeadingPerson::kFrame); });
  person.shift_to(1);
  trainer.change_tuning(softer(trainer));
  DriverControls controls;
  controls.clutch = 0.7;
  trainer.set_controls(controls);
  person.wait(10);

  const HapticSnapshot before = trainer.snapshot();
  trainer.start_recording(folder / "drive.trace");
  CHECK(trainer.recording());
  trainer.change_tuning(trainer.config().preset.haptics.tuning);  // at once: into the second cycle
  const HapticSnapshot after = trainer.snapshot();
  CHECK(after.time_ns == before.time_ns + 1'000'000);
  CHECK(glm::distance(after.lever, before.lever) < 0.0005);  // the lever stays
  CHECK(after.wall_stiffness == 1500.0);                     // and so does the tuning
  person.shift_to(2);
  HapticTuning tuning = softer(trainer);
  tuning.aisle_damping = 5.0;
  trainer.change_tuning(tuning);
  controls.throttle = 0.3;
  trainer.set_controls(controls);
  person.shift_to(3);
  trainer.disarm();
  person.wait(10);
  trainer.arm();
  person.shift_to(4);
  trainer.stop();
  person.wait(10);
  CHECK_FALSE(trainer.stop_recording());
  CHECK_FALSE(trainer.recording());
  person.wait(10);  // the drive goes on

  const Trace trace = read_trace(folder / "drive.trace");
  CHECK(trace.header.armed);
  CHECK(trace.samples.front().out.cycle == 0);
  CHECK(trace.samples.front().controls.clutch == 0.7);
  CHECK(trace.samples.size() > 3000);
  CHECK(replay(trace).bit_for_bit());
  // And it would not, if it had begun a cycle late or had not said that the lever was armed.
  Trace unarmed = trace;
  unarmed.header.armed = false;
  CHECK_FALSE(replay(unarmed).bit_for_bit());
  Trace late = trace;
  late.samples.erase(late.samples.begin());
  CHECK_THROWS_AS(replay(late), FileError);
}

TEST_CASE("one recording after another, each whole; the gear that is in is engaged anew in each") {
  const TempFolder folder;
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.arm();
  std::vector<int> gears;
  LeadingPerson person(trainer, [&] { trainer.advance(LeadingPerson::kFrame); });
  person.shift_to(5);
  for (const char* name : {"a.trace", "b.trace"}) {
    trainer.take_events();
    trainer.start_recording(folder / name);
    person.wait(60);
    CHECK_FALSE(trainer.stop_recording());
    gears.clear();
    add_gears(trainer.take_events(), gears);
    CHECK(gears == std::vector{5});
    const Trace trace = read_trace(folder / name);
    CHECK(trace.samples.size() == 1000);
    CHECK(replay(trace).bit_for_bit());
  }
  CHECK(trainer.snapshot().guard == GuardState::running);
}

TEST_CASE("no event is lost or out of order where a recording begins, and time goes on") {
  const TempFolder folder;
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.arm();
  LeadingPerson person(trainer, [&] { trainer.advance(LeadingPerson::kFrame); });
  person.shift_to(1);
  person.shift_to(2);
  const double before = trainer.time();
  trainer.start_recording(folder / "drive.trace");
  person.shift_to(3);
  CHECK(trainer.time() > before + 0.5);
  const std::vector<HapticEvent> events = trainer.take_events();
  std::vector<int> gears;
  add_gears(events, gears);
  CHECK(gears == std::vector{1, 2, 2, 3});
  for (std::size_t i = 1; i < events.size(); ++i) CHECK(events[i].time_ns >= events[i - 1].time_ns);
}

TEST_CASE("a recording never takes forces that were not there: disarmed, or stopped a moment ago") {
  const TempFolder folder;
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.advance(0.1);
  trainer.start_recording(folder / "idle.trace");
  trainer.advance(1.0);
  CHECK(trainer.snapshot().guard == GuardState::idle);
  trainer.stop_recording();
  trainer.arm();
  trainer.advance(1.0);
  CHECK(trainer.snapshot().guard == GuardState::running);
  trainer.stop();  // not taken by the loop yet
  trainer.start_recording(folder / "stopped.trace");
  trainer.advance(1.0);
  CHECK(trainer.snapshot().commanded == glm::dvec2(0.0));
  CHECK(trainer.snapshot().guard == GuardState::idle);
  trainer.stop_recording();
  CHECK(replay(read_trace(folder / "idle.trace")).bit_for_bit());
  CHECK(replay(read_trace(folder / "stopped.trace")).bit_for_bit());
}

TEST_CASE("a file that cannot be made changes nothing; a second recording is refused; none to stop is no problem") {
  const TempFolder folder;
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.arm();
  trainer.advance(1.0);
  const HapticSnapshot before = trainer.snapshot();
  CHECK_THROWS_AS(trainer.start_recording(folder / "no_such_folder" / "a.trace"), FileError);
  CHECK_FALSE(trainer.recording());
  trainer.advance(0.001);
  CHECK(trainer.snapshot().cycle == before.cycle + 1);
  CHECK(trainer.snapshot().guard == GuardState::running);
  CHECK_FALSE(trainer.stop_recording());
  trainer.start_recording(folder / "a.trace");
  CHECK_THROWS_AS(trainer.start_recording(folder / "b.trace"), std::logic_error);
  CHECK_FALSE(std::filesystem::exists(folder / "b.trace"));
}

TEST_CASE("a fault that falls while the file is being opened stays: the recording's loop gives no force") {
  const TempFolder folder;
  const std::filesystem::path pipe = folder / "pipe.trace";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);  // opened for writing only when somebody reads it
  Trainer trainer(breakable(TrainerClock::real_time));
  trainer.arm();
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  REQUIRE(trainer.snapshot().guard == GuardState::running);
  (void)trainer.take_events();

  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    trainer.set_hand(against_the_stop());
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    trainer.set_hand({});
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    std::ifstream reader(pipe, std::ios::binary);
    reader.ignore(std::numeric_limits<std::streamsize>::max());
  });
  trainer.start_recording(pipe);
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  const HapticSnapshot now = trainer.snapshot();
  const std::vector<HapticEvent> events = trainer.take_events();
  (void)trainer.stop_recording();
  other.join();
  const bool fell = std::any_of(events.begin(), events.end(), [](const HapticEvent& event) {
    return event.kind == EventKind::guard_changed && static_cast<GuardState>(event.value) == GuardState::released;
  });
  CHECK(fell);
  CHECK(now.guard == GuardState::released);
  CHECK(now.commanded == glm::dvec2(0.0));
}

TEST_CASE("a fault outlives any number of recordings: only a person gives the forces back") {
  const TempFolder folder;
  Trainer trainer(breakable(TrainerClock::virtual_time));
  trainer.arm();
  trainer.advance(1.0);
  trainer.set_hand(against_the_stop());
  trainer.advance(0.5);
  REQUIRE(trainer.snapshot().guard == GuardState::released);
  trainer.set_hand({});
  trainer.advance(0.5);
  for (const char* name : {"a.trace", "b.trace"}) {
    trainer.start_recording(folder / name);
    trainer.advance(1.0);
    CHECK(trainer.snapshot().commanded == glm::dvec2(0.0));
    CHECK_FALSE(trainer.stop_recording());
  }
  trainer.arm();
  trainer.advance(1.0);
  CHECK(trainer.snapshot().guard == GuardState::running);
}

TEST_CASE("a disk that fills up is told once while the recording runs, and again when it stops; the lever goes on") {
  const TempFolder folder;
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.arm();
  std::optional<std::string> problem;
  trainer.start_recording(folder / "second.trace");
  trainer.advance(1.0);
  CHECK_FALSE(trainer.stop_recording());
  {
    const SmallFiles small(std::filesystem::file_size(folder / "second.trace"));
    trainer.start_recording(folder / "drive.trace");
    CHECK_FALSE(trainer.take_recording_problem());
    trainer.advance(3.0);
    const std::optional<std::string> told = trainer.take_recording_problem();
    CHECK_FALSE(trainer.take_recording_problem());
    problem = trainer.stop_recording();
    CHECK(told == problem);
    CHECK_FALSE(trainer.take_recording_problem());
  }
  CHECK(trainer.snapshot().guard == GuardState::running);
  REQUIRE(problem);
  CHECK(problem->find("the recording failed after") != std::string::npos);
}

TEST_CASE("the recording of a trainer that goes away is closed and whole") {
  const TempFolder folder;
  {
    Trainer trainer(trainer_config(TrainerClock::virtual_time));
    trainer.arm();
    trainer.start_recording(folder / "drive.trace");
    trainer.advance(20.0);  // more than the queue holds
  }
  const Trace trace = read_trace(folder / "drive.trace");
  CHECK(trace.samples.size() == 20000);
  CHECK(replay(trace).bit_for_bit());
}

TEST_CASE("on the real clock, begun while the lever is led and tuned, it replays bit for bit") {
  const TempFolder folder;
  Trainer trainer(trainer_config(TrainerClock::real_time));
  trainer.arm();
  LeadingPerson person(trainer, [] { std::this_thread::sleep_for(std::chrono::milliseconds(4)); });
  person.go({0.02, 0.0});
  for (const char* name : {"a.trace", "b.trace"}) {
    trainer.start_recording(folder / name);
    trainer.change_tuning(softer(trainer));
    person.go({-0.02, 0.004});
    trainer.set_controls({0.5, 0.0, 0.0, 0.0, true, false});
    person.go({0.02, 0.0});
    CHECK_FALSE(trainer.stop_recording());
    const Trace trace = read_trace(folder / name);
    CHECK(trace.samples.front().out.cycle == 0);
    CHECK(trace.samples.size() > 50);
    CHECK(replay(trace).bit_for_bit());
  }
}
