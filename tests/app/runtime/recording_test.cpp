// Recordings that begin in the middle of a drive replay bit for bit.
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
#include "tests/app/runtime/runtime_rig.h"
#include "tests/support/gates.h"
#include "tests/support/short_trace.h"
#include "tests/support/small_files.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;

namespace {

HapticTuning softer(const Runtime& runtime) {
  HapticTuning tuning = runtime.admitted().tuning;
  tuning.wall_stiffness = 1500.0;
  tuning.feel_scale = 0.4;
  return tuning;
}

// A configuration whose guard allows no position beyond the device's end stop. For a lever at the stop, the rounding
// encoder reports a position 8 um beyond it, so pushing the lever against the stop causes a fault.
RuntimeConfig breakable(RuntimeClock clock) {
  RuntimeConfig config = runtime_config(clock);
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

TEST_CASE(
    "a recording begun in gear, with changes of tuning and pedals, a disarm and a stop in it, replays bit for bit") {
  const TempFolder folder;
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.arm();
  LeadingPerson person(runtime, [&] { runtime.advance(LeadingPerson::kFrame); });
  person.shift_to(1);
  runtime.change_tuning(softer(runtime));
  DriverControls controls;
  controls.pedals.clutch = 0.7;
  runtime.set_controls(controls);
  person.wait(10);

  const HapticSnapshot before = runtime.snapshot();
  runtime.start_recording(folder / "drive.trace");
  CHECK(runtime.is_recording());
  runtime.change_tuning(runtime.config().preset.haptics.tuning);  // takes effect in the recording's second cycle
  const HapticSnapshot after = runtime.snapshot();
  CHECK(after.time_ns == before.time_ns + 1'000'000);
  CHECK(glm::distance(after.lever, before.lever) < 0.0005);  // the lever does not jump
  CHECK(after.wall_stiffness == 1500.0);                     // [N/m] from softer(); new tuning applies a cycle later
  person.shift_to(2);
  HapticTuning tuning = softer(runtime);
  tuning.aisle_damping = 5.0;
  runtime.change_tuning(tuning);
  controls.pedals.throttle = 0.3;
  runtime.set_controls(controls);
  person.shift_to(3);
  runtime.disarm();
  person.wait(10);
  runtime.arm();
  person.shift_to(4);
  runtime.stop();
  person.wait(10);
  CHECK_FALSE(runtime.stop_recording());
  CHECK_FALSE(runtime.is_recording());
  person.wait(10);  // the drive continues after the recording

  const Trace trace = read_trace(folder / "drive.trace");
  CHECK(trace.header.armed);
  CHECK(trace.samples.front().out.cycle == 0);
  CHECK(trace.samples.front().controls.pedals.clutch == 0.7);
  CHECK(trace.samples.size() > 3000);
  CHECK(replay(trace).bit_for_bit());
  // Without its armed state, the trace must replay differently. Without its first cycle, it must be rejected.
  Trace unarmed = trace;
  unarmed.header.armed = false;
  CHECK_FALSE(replay(unarmed).bit_for_bit());
  Trace late = trace;
  late.samples.erase(late.samples.begin());
  CHECK_THROWS_AS(replay(late), FileError);
}

TEST_CASE("consecutive recordings are complete, and each begins with an event for the engaged gear") {
  const TempFolder folder;
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.arm();
  std::vector<int> gears;
  LeadingPerson person(runtime, [&] { runtime.advance(LeadingPerson::kFrame); });
  person.shift_to(5);
  for (const char* name : {"a.trace", "b.trace"}) {
    (void)runtime.read_frame();
    runtime.start_recording(folder / name);
    person.wait(60);
    CHECK_FALSE(runtime.stop_recording());
    gears.clear();
    add_gears(runtime.read_frame().events, gears);
    CHECK(gears == std::vector{5});
    const Trace trace = read_trace(folder / name);
    CHECK(trace.samples.size() == 1000);
    CHECK(replay(trace).bit_for_bit());
  }
  CHECK(runtime.snapshot().guard == GuardState::running);
}

TEST_CASE("the begin of a recording loses or reorders no event, and does not restart the clock") {
  const TempFolder folder;
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.arm();
  LeadingPerson person(runtime, [&] { runtime.advance(LeadingPerson::kFrame); });
  person.shift_to(1);
  person.shift_to(2);
  const double before = runtime.time();
  runtime.start_recording(folder / "drive.trace");
  person.shift_to(3);
  CHECK(runtime.time() > before + 0.5);
  const std::vector<HapticEvent> events = runtime.read_frame().events;
  std::vector<int> gears;
  add_gears(events, gears);
  CHECK(gears == std::vector{1, 2, 2, 3});
  for (std::size_t i = 1; i < events.size(); ++i) CHECK(events[i].time_ns >= events[i - 1].time_ns);
}

TEST_CASE("a recording begun in third of a sequential gate, without a car, stays in third and replays bit for bit") {
  const TempFolder folder;
  Runtime runtime(runtime_config(RuntimeClock::virtual_time, kSequentialGate));
  runtime.arm();
  const auto stroke = [&](double shift) {
    for (const double place : {shift, 0.0}) {
      HandTarget target;
      target.position = {0.0, place};
      runtime.set_hand(target);
      runtime.advance(0.6);
    }
  };
  for (int i = 0; i < 3; ++i) stroke(-0.045);
  REQUIRE(runtime.snapshot().gear == 3);
  runtime.start_recording(folder / "drive.trace");
  runtime.advance(0.2);
  CHECK(runtime.snapshot().gear == 3);
  stroke(-0.045);
  CHECK(runtime.snapshot().gear == 4);
  CHECK_FALSE(runtime.stop_recording());
  CHECK(replay(read_trace(folder / "drive.trace")).bit_for_bit());
}

TEST_CASE("a recording never switches forces on, neither in a disarmed runtime nor just after a stop") {
  const TempFolder folder;
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.advance(0.1);
  runtime.start_recording(folder / "idle.trace");
  runtime.advance(1.0);
  CHECK(runtime.snapshot().guard == GuardState::idle);
  runtime.stop_recording();
  runtime.arm();
  runtime.advance(1.0);
  CHECK(runtime.snapshot().guard == GuardState::running);
  runtime.stop();  // the loop has not yet handled this when the recording begins
  runtime.start_recording(folder / "stopped.trace");
  runtime.advance(1.0);
  CHECK(runtime.snapshot().commanded == glm::dvec2(0.0));
  CHECK(runtime.snapshot().guard == GuardState::idle);
  runtime.stop_recording();
  CHECK(replay(read_trace(folder / "idle.trace")).bit_for_bit());
  CHECK(replay(read_trace(folder / "stopped.trace")).bit_for_bit());
}

TEST_CASE("a file that cannot be created changes nothing; a second recording is rejected; stopping none is no error") {
  const TempFolder folder;
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.arm();
  runtime.advance(1.0);
  const HapticSnapshot before = runtime.snapshot();
  CHECK_THROWS_AS(runtime.start_recording(folder / "no_such_folder" / "a.trace"), FileError);
  CHECK_FALSE(runtime.is_recording());
  runtime.advance(0.001);
  CHECK(runtime.snapshot().cycle == before.cycle + 1);
  CHECK(runtime.snapshot().guard == GuardState::running);
  CHECK_FALSE(runtime.stop_recording());
  runtime.start_recording(folder / "a.trace");
  CHECK_THROWS_AS(runtime.start_recording(folder / "b.trace"), std::logic_error);
  CHECK_FALSE(std::filesystem::exists(folder / "b.trace"));
}

TEST_CASE("a fault while the file is being opened persists: the recording's loop commands no force") {
  const TempFolder folder;
  const std::filesystem::path pipe = folder / "pipe.trace";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);  // opening a FIFO for writing blocks until a reader opens it
  Runtime runtime(breakable(RuntimeClock::real_time));
  runtime.arm();
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  REQUIRE(runtime.snapshot().guard == GuardState::running);
  (void)runtime.read_frame();

  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    runtime.set_hand(against_the_stop());
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    runtime.set_hand({});
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    std::ifstream reader(pipe, std::ios::binary);
    reader.ignore(std::numeric_limits<std::streamsize>::max());
  });
  runtime.start_recording(pipe);
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  const HapticSnapshot now = runtime.snapshot();
  const std::vector<HapticEvent> events = runtime.read_frame().events;
  (void)runtime.stop_recording();
  other.join();
  const bool fell = std::any_of(events.begin(), events.end(), [](const HapticEvent& event) {
    return event.kind == EventKind::guard_changed && static_cast<GuardState>(event.value) == GuardState::released;
  });
  CHECK(fell);
  CHECK(now.guard == GuardState::released);
  CHECK(now.commanded == glm::dvec2(0.0));
}

TEST_CASE("a fault outlasts any number of recordings: only the user restores the forces") {
  const TempFolder folder;
  Runtime runtime(breakable(RuntimeClock::virtual_time));
  runtime.arm();
  runtime.advance(1.0);
  runtime.set_hand(against_the_stop());
  runtime.advance(0.5);
  REQUIRE(runtime.snapshot().guard == GuardState::released);
  runtime.set_hand({});
  runtime.advance(0.5);
  for (const char* name : {"a.trace", "b.trace"}) {
    runtime.start_recording(folder / name);
    runtime.advance(1.0);
    CHECK(runtime.snapshot().commanded == glm::dvec2(0.0));
    CHECK_FALSE(runtime.wants_forces());
    CHECK_FALSE(runtime.stop_recording());
  }
  runtime.arm();
  runtime.advance(1.0);
  CHECK(runtime.snapshot().guard == GuardState::running);
  CHECK(runtime.wants_forces());

  runtime.start_recording(folder / "c.trace");  // the fault of an earlier loop is over
  runtime.advance(1.0);
  CHECK(runtime.snapshot().guard == GuardState::running);
  CHECK_FALSE(runtime.stop_recording());
}

TEST_CASE("a full disk is reported during the recording, and again when it stops; the lever keeps running") {
  const TempFolder folder;
  Runtime runtime(runtime_config(RuntimeClock::virtual_time));
  runtime.arm();
  std::optional<std::string> problem;
  runtime.start_recording(folder / "second.trace");
  runtime.advance(1.0);
  CHECK_FALSE(runtime.stop_recording());
  {
    const SmallFiles small(std::filesystem::file_size(folder / "second.trace"));
    runtime.start_recording(folder / "drive.trace");
    CHECK_FALSE(runtime.poll_recording_problem());
    runtime.advance(3.0);
    const std::optional<std::string> reported = runtime.poll_recording_problem();
    CHECK_FALSE(runtime.poll_recording_problem());
    problem = runtime.stop_recording();
    CHECK(reported == problem);
    CHECK_FALSE(runtime.poll_recording_problem());
  }
  CHECK(runtime.snapshot().guard == GuardState::running);
  REQUIRE(problem);
  CHECK(problem->find("the recording failed after") != std::string::npos);
}

TEST_CASE("a destroyed runtime's recording is closed and complete") {
  const TempFolder folder;
  {
    Runtime runtime(runtime_config(RuntimeClock::virtual_time));
    runtime.arm();
    runtime.start_recording(folder / "drive.trace");
    runtime.advance(20.0);  // 20 s are more cycles than the recorder's queue can hold
  }
  const Trace trace = read_trace(folder / "drive.trace");
  CHECK(trace.samples.size() == 20000);
  CHECK(replay(trace).bit_for_bit());
}

TEST_CASE("on the real clock, a recording begun while the lever is moved and tuned replays bit for bit") {
  const TempFolder folder;
  Runtime runtime(runtime_config(RuntimeClock::real_time));
  runtime.arm();
  LeadingPerson person(runtime, [] { std::this_thread::sleep_for(std::chrono::milliseconds(4)); });
  person.go({0.02, 0.0});
  for (const char* name : {"a.trace", "b.trace"}) {
    runtime.start_recording(folder / name);
    runtime.change_tuning(softer(runtime));
    person.go({-0.02, 0.004});
    runtime.set_controls({{.throttle = 0.5}, true, false});
    person.go({0.02, 0.0});
    CHECK_FALSE(runtime.stop_recording());
    const Trace trace = read_trace(folder / name);
    CHECK(trace.samples.front().out.cycle == 0);
    CHECK(trace.samples.size() > 50);
    CHECK(replay(trace).bit_for_bit());
  }
}
