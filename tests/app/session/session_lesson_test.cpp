// Lessons in a running session on the virtual clock: driven, saved and replayed.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>

#include "app/lessons/simulated_driver/auto_driver.h"
#include "app/session/session.h"
#include "app/vehicle/car_load.h"
#include "haptics/loop/replay.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/short_trace.h"
#include "tests/support/small_files.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::runtime;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;
using namespace gearshift::vehicle;
namespace fs = std::filesystem;

namespace {

constexpr double kLessonFrame = 1.0 / 60.0;

struct LessonRig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Variable data{"XDG_DATA_HOME", folder.path().c_str()};
  fs::path history = folder / "history.db";

  SessionChoice choice(const std::string& lesson, std::string hand = std::string(kAutomaticHand)) const {
    SessionChoice choice;
    choice.lesson = lesson;
    choice.learner = "Ada";
    choice.history = history;
    choice.help = false;
    choice.hand = std::move(hand);
    choice.clock = RuntimeClock::virtual_time;
    choice.sound = SoundOutput::none;
    return choice;
  }
  std::string bytes_of_history() const {
    std::ifstream file(history, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

// Saves trials that failed by errors of the hand.
void fail_by_hand(const fs::path& file, const std::string& learner, const std::string& lesson, int trials) {
  History history(file);
  const std::int64_t session = history.begin_session(history.find_or_add_learner(learner), "test");
  LessonResult result;
  result.lesson = result.task = lesson;
  result.errors = {make_driving_error(ErrorKind::wrong_gear, Severity::very_severe, 1.0, 4.0)};
  for (int i = 0; i < trials; ++i) {
    const std::int64_t run = history.begin_run(session, result, "");
    result.end = LessonEnd::done;
    history.end_run(run, result);
  }
}

void go(Session& session, double seconds) {
  for (double time = 0.0; time < seconds; time += kLessonFrame) {
    session.advance(kLessonFrame);
    session.update_cabin();
  }
}

// Drives the lesson to its end as a competent user would. Uses the hand and pedal inputs, with one frame per
// millisecond.
const CoachView& drive_as_person(Session& session) {
  if (session.coach().view().phase == LessonPhase::offered) session.apply(BeginLesson{});
  AutoDriverConfig config;
  config.lesson = *session.coach().lesson();
  config.car = *session.runtime().config().car;
  config.gate = session.runtime().gate();
  AutoDriver driver(config);
  DriveSample sample;
  sample.controls.ignition = config.lesson.start.running;
  sample.controls.pedals.hand_brake = config.lesson.start.hand_brake;
  sample.controls.pedals.brake = config.lesson.start.brake;
  for (int i = 0; i < 120'000 && session.coach().view().phase == LessonPhase::driving; ++i) {
    session.advance(1e-3);
    sample.lever = session.shown();
    sample.car = session.car();
    const DriverAction action = driver.act(sample);
    sample.controls = action.controls;
    session.lever().set_driver(action.hand, action.controls);
  }
  REQUIRE(session.coach().view().phase == LessonPhase::over);
  return session.coach().view();
}

const CoachView& drive_to_the_end(Session& session) {
  for (int i = 0; i < 120 * 60 && session.coach().view().phase == LessonPhase::driving; ++i) go(session, kLessonFrame);
  REQUIRE(session.coach().view().phase == LessonPhase::over);
  return session.coach().view();
}

}  // namespace

TEST_CASE("a lesson on a sequential gate takes a gate with a slot for each gear, and says so") {
  LessonRig rig;
  SessionChoice choice = rig.choice("moving_off", "grip");
  choice.gate = "sequential_six";
  choice.car = "diesel";
  Session offered(choice);
  CHECK(offered.message() ==
        "This lesson needs a slot for each gear, so the gate is six_speed_r_left_down instead of sequential_six.");
  CHECK_FALSE(is_sequential(offered.runtime().gate()));

  choice.lesson = "none";
  Session free(choice);
  CHECK(free.message().empty());
  CHECK(is_sequential(free.runtime().gate()));
  free.apply(OfferLesson{"moving_off"});
  CHECK(is_sequential(free.runtime().gate()));
  free.apply(BeginLesson{});
  CHECK(free.message().find("This lesson needs a slot for each gear") == 0);
  CHECK(free.coach().view().phase == LessonPhase::driving);

  choice.gate.clear();  // the car's own gate
  CHECK(Session(choice).message().empty());
}

TEST_CASE(
    "on a slope the instructor holds the foot brake until the learner has pressed it as far, and then never again") {
  LessonRig rig;
  Session session(rig.choice("hill_start_with_foot_brake", "grip"));
  session.apply(BeginLesson{});
  const auto press = [&](double brake) {
    DriverControls feet;
    feet.pedals.clutch = 1.0;
    feet.pedals.brake = brake;
    HandTarget hand;
    hand.position = session.shown().lever;
    session.lever().set_driver(hand, feet);
    go(session, 0.5);
    return session.car().pedals.brake;
  };
  CHECK(press(0.0) == doctest::Approx(0.5));
  CHECK(press(0.4) == doctest::Approx(0.5));
  CHECK(session.car().road_speed == 0.0);
  CHECK(press(0.6) == doctest::Approx(0.6));
  CHECK(press(0.4) == doctest::Approx(0.4));
  CHECK(session.car().road_speed == 0.0);
  CHECK(press(0.0) == 0.0);
  CHECK(session.car().road_speed < -0.1);
}

TEST_CASE("a competent driver passes a lesson in the running session; run, shifts and recording are saved") {
  LessonRig rig;
  Session session(rig.choice("hill_start", "grip"));
  const CoachView& coach = drive_as_person(session);
  CHECK(coach.result->passed);
  CHECK(coach.result->grade >= 9.0);
  CHECK(session.car().slope == doctest::Approx(std::atan(0.1)));  // the lesson's slope is 10 %
  History history(rig.history);
  const auto runs = history.runs(history.find_learner("Ada").value().id);
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].result.passed);
  CHECK(runs[0].result.shifts.size() == coach.result->shifts.size());
  CHECK_FALSE(session.recording());
  const Trace trace = read_trace(history.recording_file(runs[0].recording).string());
  CHECK(replay(trace, make_car_load).bit_for_bit());
  // The recording covers every shift of the lesson. A shift may end up to 0.5 s after the last recorded cycle.
  for (const ShiftRecord& shift : runs[0].result.shifts) {
    CHECK(shift.begin > 1e-9 * static_cast<double>(trace.samples.front().out.time_ns));
    CHECK(shift.end < 1e-9 * static_cast<double>(trace.samples.back().out.time_ns) + 0.5);
  }
}

TEST_CASE("a lesson begins with the gear, speed, engine and handbrake in its file, and the user's switches follow") {
  LessonRig rig;
  Session session(rig.choice("emergency_stop", "grip"));
  CHECK(session.coach().view().phase == LessonPhase::offered);
  CHECK(session.car().road_speed == 0.0);
  session.apply(BeginLesson{});
  go(session, 0.1);
  CHECK(session.coach().view().phase == LessonPhase::driving);
  CHECK(session.shown().gear == 3);
  CHECK(session.car().road_speed == doctest::Approx(40.0 / 3.6).epsilon(0.02));
  session.apply(LeaveLesson{});
  CHECK(session.coach().view().result->end == LessonEnd::left);
  session.apply(OfferLesson{"start_and_stop"});
  (void)session.lever().take_switches();
  session.apply(BeginLesson{});
  const std::optional<CarSwitches> switches = session.lever().take_switches();
  REQUIRE(switches);
  CHECK_FALSE(switches->ignition);
  CHECK(switches->hand_brake == 1.0);
  go(session, 0.1);
  CHECK_FALSE(session.car().running);
  CHECK(session.car().pedals.hand_brake == 1.0);
}

TEST_CASE("during a lesson, a change of gate ends the lesson, and a replay is refused") {
  LessonRig rig;
  Session session(rig.choice("moving_off", "grip"));
  session.apply(BeginLesson{});
  go(session, 1.0);
  session.apply(OpenShift{"nowhere.trace", 0.0});
  CHECK(session.message().find("Leave the lesson first") != std::string::npos);
  CHECK(session.coach().view().phase == LessonPhase::driving);
  session.apply(ChooseGate{"four_speed"});
  CHECK(session.coach().view().phase == LessonPhase::over);
  CHECK(session.coach().view().result->end == LessonEnd::left);
  CHECK_FALSE(session.recording());
}

TEST_CASE("any shift in the history can be replayed in the cabin as it was recorded") {
  LessonRig rig;
  Session session(rig.choice("up_through_the_gears", "grip"));
  const CoachView& coach = drive_as_person(session);
  REQUIRE(coach.result->shifts.size() >= 3);
  const RunRow run = coach.runs.front();
  const ShiftRecord& wanted = coach.result->shifts[1];
  session.apply(PanelCommands{OpenShift{run.recording, wanted.begin}, PlayReplay{false}});
  const Player* player = session.panel_input().replay;
  REQUIRE(player);
  REQUIRE(player->shift());
  const RecordedShift& shift = player->drive().shifts()[*player->shift()];
  CHECK(shift.record.begin == doctest::Approx(wanted.begin).epsilon(1e-6));
  CHECK(shift.record.from == wanted.from);
  CHECK(shift.record.to == wanted.to);
  const Trace trace = read_trace(run.recording);
  for (const double part : {0.1, 0.5, 0.9}) {
    const double time = wanted.begin + part * (wanted.end - wanted.begin);
    session.apply(SeekReplay{time});
    go(session, kLessonFrame);
    const auto then = std::find_if(trace.samples.begin(), trace.samples.end(), [time](const TraceSample& sample) {
      return 1e-9 * static_cast<double>(sample.out.time_ns) > time - 4.1e-3;
    });
    // The lever moves at most 0.5 m/s and the sample is at most 4 ms old, so the shown position differs from the sample
    // by at most 2 mm.
    CHECK(glm::length(session.shown().proxy - then->out.proxy) < 2e-3);
    CHECK(session.car().pedals.clutch == doctest::Approx(then->controls.pedals.clutch).epsilon(0.05));
    CHECK(session.car().engine_speed > 50.0);
  }
}

TEST_CASE(
    "a car brings its gate; a gate that lacks the car's gears brings a different car; without a car no engine runs") {
  LessonRig rig;
  Session session(rig.choice(std::string(kNoLesson), "grip"));
  CHECK(session.panel_input().gate_name == "five_speed_r_right_down");
  const auto ask_for = [&session](const PanelCommand& command) {
    session.apply(command);
    go(session, 0.05);
    return session.panel_input();
  };
  CHECK(ask_for(ChooseGate{"six_speed_r_left_up"}).car_name == "diesel");
  CHECK(ask_for(ChooseCar{"hatchback"}).gate_name == "five_speed_r_right_down");
  CHECK(session.car().engine_speed > 60.0);
  CHECK(ask_for(ChooseCar{"none"}).gate_name == "five_speed_r_right_down");
  CHECK(session.car().engine_speed == 0.0);
}

TEST_CASE("a lesson's own gate is used only in that lesson: the next one uses the user's gate") {
  LessonRig rig;
  Session session(rig.choice("another_gate", "grip"));
  session.apply(BeginLesson{});
  CHECK(session.panel_input().gate_name == "dog_leg_five");
  session.apply(LeaveLesson{});
  session.apply(ChangeTuning{HapticTuning{.wall_stiffness = 4321.0}});
  session.apply(OfferLesson{"moving_off"});
  session.apply(BeginLesson{});
  CHECK(session.runtime().config().preset.haptics.tuning.wall_stiffness == 4321.0);  // [N/m] the user's tuning is kept
  CHECK(session.panel_input().gate_name == "five_speed_r_right_down");
}

TEST_CASE("the user can neither stop a lesson's recording nor start one during the lesson") {
  LessonRig rig;
  SessionChoice choice = rig.choice("moving_off", "grip");
  for (const char* learner : {"Ada", ""}) {
    choice.learner = learner;
    Session session(choice);
    session.apply(BeginLesson{});
    go(session, 0.2);
    const bool recording = session.recording();
    CHECK(recording == (choice.learner == "Ada"));
    session.apply(ToggleRecording{});
    go(session, 0.2);
    CHECK(session.recording() == recording);
    CHECK(session.message().find("recorded automatically") != std::string::npos);
    CHECK(session.coach().view().result->is_complete);
  }
}

TEST_CASE("automatic driving is not saved for the learner; after the user takes over, runs are saved again") {
  LessonRig rig;
  Session session(rig.choice("moving_off"));
  CHECK(drive_to_the_end(session).result->passed);
  session.apply(ChooseHand{"grip"});
  CHECK(session.coach().view().learner == "Ada");
  CHECK(History(rig.history).learners().empty());
  session.apply(OfferLesson{"moving_off"});
  (void)drive_as_person(session);
  CHECK(History(rig.history).runs(History(rig.history).find_learner("Ada").value().id).size() == 1);
}

TEST_CASE("a run is judged by the norm until a key moves a pedal, and then by its errors only") {
  for (const bool by_key : {false, true}) {
    LessonRig rig;
    Session session(rig.choice("moving_off", "grip"));
    session.lever().set_driver({}, {}, {.clutch = true});  // before the lesson
    go(session, 0.1);
    session.lever().set_driver({}, {});
    go(session, 0.1);
    session.apply(BeginLesson{});
    CHECK(session.coach().view().norm != nullptr);
    DriverControls presses;
    presses.pedals.clutch = 1.0;
    session.lever().set_driver({}, by_key ? DriverControls{} : presses, {.clutch = by_key});
    go(session, 0.1);
    session.lever().set_driver({}, {});
    go(session, 0.1);
    CHECK((session.coach().view().norm == nullptr) == by_key);
  }
}

TEST_CASE("without a learner nothing is saved, and lessons still work") {
  LessonRig rig;
  SessionChoice choice = rig.choice("moving_off");
  choice.learner.clear();
  Session session(choice);
  CHECK(drive_to_the_end(session).result->passed);
  CHECK_FALSE(fs::exists(rig.folder / "gearshift/recordings"));
  if (fs::exists(rig.history)) CHECK(History(rig.history).learners().empty());
}

TEST_CASE("a damaged history is reported in one sentence and left unchanged; the lesson continues") {
  LessonRig rig;
  std::ofstream(rig.history) << "this is no database, and long enough to be taken for none";
  const std::string before = rig.bytes_of_history();
  Session session(rig.choice("moving_off"));
  CHECK(session.message().find("history.db") != std::string::npos);
  CHECK(drive_to_the_end(session).result->passed);
  CHECK(rig.bytes_of_history() == before);
}

TEST_CASE("a lesson whose recording fails is still assessed and saved") {
  LessonRig rig;
  {
    History history(rig.history);  // the database must exist before the file sizes are limited
    (void)history.find_or_add_learner("Ada");
  }
  const SmallFiles small(200'000);  // [bytes]
  Session session(rig.choice("moving_off"));
  CHECK(drive_to_the_end(session).result->passed);
}

TEST_CASE("in a guided trial the lever guides and no grade is given; without help no trial is guided") {
  LessonRig rig;
  SessionChoice unguided = rig.choice("up_through_the_gears", "grip");
  for (int trial = 0; trial < 6; ++trial) {
    Session session(unguided);
    session.apply(BeginLesson{});
    CHECK(session.coach().guidance() == 0.0);
    unguided.learner += "a";
  }
  // A new learner, because Ada's trials would affect the guidance, whose hand failed four trials. The lesson starts in
  // first gear. The first step that names a gear names second, so the guidance leads to second.
  // Two of the first four trials are guided.
  SessionChoice person = rig.choice("up_through_the_gears", "grip");
  person.help = true;
  person.learner = "Bo";
  fail_by_hand(rig.history, person.learner, person.lesson, 4);
  for (int trial = 0; trial < 4; ++trial) {
    Session driven(person);
    const CoachView& coach = drive_as_person(driven);
    if (coach.guidance == 0.0) continue;
    CHECK(coach.result->guided);
    CHECK_FALSE(coach.result->passed);
    const Trace trace = read_trace(coach.runs.front().recording);
    CHECK(std::any_of(trace.samples.begin(), trace.samples.end(), [](const TraceSample& sample) {
      return sample.controls.guidance > 0.0 && sample.controls.guided_gear == 2;
    }));
    CHECK(replay(trace, make_car_load).bit_for_bit());
    return;
  }
  FAIL("none of four trials was guided");
}

TEST_CASE("a replay requested during a lesson neither ends its recording nor shows anything") {
  LessonRig rig;
  Session session(rig.choice("moving_off", "grip"));
  session.apply(BeginLesson{});
  go(session, 0.3);
  session.apply(ReplayLastRecording{});
  CHECK(session.message().find("Leave the lesson first") != std::string::npos);
  CHECK(session.recording());
  CHECK(session.panel_input().replay == nullptr);
}

TEST_CASE("dismissing a lesson removes its slope, and recordings are stored next to their history") {
  LessonRig rig;
  rig.history = rig.folder / "elsewhere" / "history.db";
  fs::create_directories(rig.history.parent_path());
  Session session(rig.choice("hill_start", "grip"));
  session.apply(BeginLesson{});
  go(session, 0.3);
  CHECK(session.car().slope > 0.09);
  session.apply(LeaveLesson{});
  session.apply(DismissLesson{});
  go(session, 0.3);
  CHECK(session.car().slope == 0.0);
  CHECK(fs::exists(rig.folder / "elsewhere/recordings"));
  CHECK_FALSE(fs::exists(rig.folder / "gearshift/recordings"));
}

TEST_CASE(
    "after a lesson the instructor holds the car, also on a slope, until the next lesson begins or is dismissed") {
  LessonRig rig;
  Session session(rig.choice("hill_start", "grip"));
  session.apply(BeginLesson{});
  DriverControls rolls;
  rolls.ignition = true;
  rolls.pedals.clutch = 1.0;
  session.lever().set_driver({}, rolls);
  for (int i = 0; i < 20 * 60 && session.coach().view().phase == LessonPhase::driving; ++i) go(session, kLessonFrame);
  REQUIRE(session.coach().view().phase == LessonPhase::over);  // the car rolled back one metre, which ended the lesson
  CHECK(session.car().road_speed < -0.5);
  go(session, 2.0);
  CHECK(session.car().road_speed == 0.0);
  CHECK(session.car().running);
  session.apply(BeginLesson{});
  session.lever().set_driver({}, rolls);
  go(session, 1.0);
  CHECK(session.car().road_speed < -0.1);
}

TEST_CASE(
    "if another program deletes the learner during her lesson, a message appears and her recordings are deleted") {
  LessonRig rig;
  Session session(rig.choice("moving_off", "grip"));
  session.apply(BeginLesson{});
  go(session, 0.5);
  REQUIRE(std::distance(fs::directory_iterator(rig.folder / "recordings"), fs::directory_iterator()) == 1);
  {
    History other(rig.history);
    CHECK(other.erase_learner(other.find_learner("Ada").value().id, [](const auto&) {}).empty());
  }
  session.apply(LeaveLesson{});
  go(session, 0.5);
  CHECK(session.panel_input().message.find("Another program deleted Ada") != std::string::npos);
  CHECK(session.panel_input().coach.learner_deleted);
  CHECK(session.save_and_stop().empty());
  CHECK(fs::is_empty(rig.folder / "recordings"));
  CHECK(History(rig.history).learners().empty());
}

TEST_CASE("an instructor's comment is edited and deleted through the panel's commands") {
  LessonRig rig;
  Session session(rig.choice("moving_off", "grip"));
  (void)drive_as_person(session);
  const std::int64_t run = session.coach().view().run;
  session.apply(AddComment{run, "Ms Torque", "Slower."});
  History history(rig.history);
  const auto comments = [&] { return comments_of(history, run); };
  REQUIRE(comments().size() == 1);
  const std::int64_t comment = comments()[0].id;
  session.apply(EditComment{run, comment, "Slower at the bite point."});
  CHECK(comments().at(0).text == "Slower at the bite point.");
  session.apply(DeleteComment{run, comment});
  CHECK(comments().empty());
}
