// Recordings begun in the middle of a drive: they replay bit for bit.
#include <signal.h>
#include <sys/resource.h>

#include <filesystem>
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
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

HapticTuning softer(const Trainer& trainer) {
  HapticTuning tuning = trainer.admitted().tuning;
  tuning.wall_stiffness = 1500.0;
  tuning.feel_scale = 0.4;
  return tuning;
}

// No file may grow beyond that, as on a disk that is full.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &was_);
    handler_ = signal(SIGXFSZ, SIG_IGN);
    const rlimit small{bytes, was_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &was_);
    signal(SIGXFSZ, handler_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  rlimit was_{};
  void (*handler_)(int) = nullptr;
};

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

TEST_CASE("a disk that fills up is told when the recording stops, and the lever goes on") {
  const TempFolder folder;
  Trainer trainer(trainer_config(TrainerClock::virtual_time));
  trainer.arm();
  std::optional<std::string> problem;
  {
    const SmallFiles small(300'000);  // [bytes] less than a second
    trainer.start_recording(folder / "drive.trace");
    trainer.advance(3.0);
    problem = trainer.stop_recording();
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
