// How a lesson that is driven can end before its time, who has the car then, and that it is said.
#include <functional>
#include <string>

#include <doctest/doctest.h>

#include "app/train/session.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift;

namespace {

constexpr double kLeftFrame = 1.0 / 60.0;

struct LeftRig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Variable data{"XDG_DATA_HOME", folder.path().c_str()};
  Session session;

  explicit LeftRig(const std::string& hand = "grip") : session(choice(hand)) {}
  SessionChoice choice(const std::string& hand) const {
    SessionChoice choice;
    choice.lesson = "moving_off";
    choice.learner = "Ada";
    choice.history = folder / "history.db";
    choice.hand = hand;
    choice.help = false;
    choice.clock = TrainerClock::virtual_time;
    choice.sound = SoundOutput::none;
    return choice;
  }
  void ask(const std::function<void(PanelRequests&)>& what) {
    PanelRequests requests;
    what(requests);
    session.obey(requests);
  }
  void go(double seconds) {
    for (double time = 0.0; time < seconds; time += kLeftFrame) session.advance(kLeftFrame);
  }
  void begin() {
    ask([](PanelRequests& requests) { requests.lesson.begin = true; });
    go(0.2);
    REQUIRE(session.coach().view().phase == LessonPhase::driving);
  }
  bool says(const std::string& words) const { return session.message().find(words) != std::string::npos; }
  // Both feet off: what of the brake is down is the teacher's.
  bool has_car() {
    DriverControls free;
    free.ignition = true;
    session.lead({}, free);
    go(0.1);
    return session.car().brake == 0.0 && session.car().clutch == 0.0;
  }
};

}  // namespace

TEST_CASE("whatever takes a driven lesson away says that it was left, and why") {
  struct Case {
    const char* why;
    std::function<void(PanelRequests&)> what;
  };
  const Case cases[] = {{"another learner", [](PanelRequests& r) { r.lesson.learner = "Bo"; }},
                        {"another learner", [](PanelRequests& r) { r.lesson.learner = ""; }},
                        {"another car", [](PanelRequests& r) { r.car = "diesel"; }},
                        {"another gate", [](PanelRequests& r) { r.gate = "four_speed"; }},
                        {"another hand", [](PanelRequests& r) { r.hand = std::string(kByItself); }},
                        {"another preset", [](PanelRequests& r) { r.preset = "measured"; }},
                        {"another setup", [](PanelRequests& r) { r.restart = HapticConfig(); }}};
  for (const Case& one : cases) {
    CAPTURE(one.why);
    LeftRig rig;
    rig.begin();
    rig.ask(one.what);
    CHECK(rig.session.coach().view().phase != LessonPhase::driving);
    CAPTURE(rig.session.message());
    CHECK(rig.says("was left"));
    CHECK(rig.says(one.why));
    rig.ask(one.what);  // once more: nothing is driven
    CHECK_FALSE(rig.says("was left"));
  }
}

TEST_CASE("after a lesson, left or not, the teacher holds the car and the panel is told; who chooses gets it back") {
  for (const auto& choose : {std::function<void(PanelRequests&)>([](PanelRequests& r) { r.car = "diesel"; }),
                             std::function<void(PanelRequests&)>([](PanelRequests& r) { r.gate = "four_speed"; }),
                             std::function<void(PanelRequests&)>([](PanelRequests& r) { r.hand = "light"; }),
                             std::function<void(PanelRequests&)>([](PanelRequests& r) { r.lesson.put_away = true; })}) {
    LeftRig rig;
    CHECK_FALSE(rig.session.panel_input().teacher_holds);
    rig.begin();
    CHECK_FALSE(rig.session.panel_input().teacher_holds);
    rig.ask([](PanelRequests& requests) { requests.lesson.leave = true; });
    CHECK_FALSE(rig.has_car());
    CHECK(rig.session.panel_input().teacher_holds);
    rig.ask([](PanelRequests& requests) { requests.lesson.offer = "hill_start"; });  // until it begins
    CHECK_FALSE(rig.has_car());
    CHECK(rig.session.panel_input().teacher_holds);
    rig.ask(choose);
    CHECK(rig.has_car());
    CHECK_FALSE(rig.session.panel_input().teacher_holds);
  }
  LeftRig rig;
  rig.begin();
  rig.ask([](PanelRequests& requests) { requests.lesson.leave = true; });
  rig.begin();
  CHECK(rig.has_car());
}

TEST_CASE("what a lesson is not passed with is told with its goal, and nothing where there is none") {
  LeftRig rig;
  CHECK(rig.session.panel_input().lesson_catches == catches_sentence(*rig.session.coach().lesson()));
  CHECK_FALSE(rig.session.panel_input().lesson_catches.empty());
  rig.ask([](PanelRequests& requests) { requests.lesson.put_away = true; });
  CHECK(rig.session.panel_input().lesson_catches.empty());
}

TEST_CASE("a car that is chosen in the middle of a lesson is the person's") {
  LeftRig rig;
  rig.begin();
  rig.ask([](PanelRequests& requests) { requests.car = "diesel"; });
  CHECK(rig.has_car());
}

TEST_CASE("a name that is refused is nobody's, is told once, and a good one takes the message away") {
  for (const std::string& hand : {std::string("grip"), std::string(kByItself)}) {
    CAPTURE(hand);
    LeftRig rig(hand);
    rig.ask([](PanelRequests& requests) { requests.lesson.learner = "a\tb"; });
    CHECK(rig.says("learner's name"));
    rig.ask([](PanelRequests& requests) { requests.car = "diesel"; });
    CHECK_FALSE(rig.says("learner's name"));
    CHECK(rig.session.coach().view().learner == (hand == kByItself ? "" : "Ada"));
    rig.ask([](PanelRequests& requests) { requests.lesson.learner = "a\tb"; });
    rig.ask([](PanelRequests& requests) { requests.lesson.learner = "Bo"; });
    CHECK_FALSE(rig.says("learner's name"));
    rig.ask([](PanelRequests& requests) { requests.hand = "light"; });
    CHECK(rig.session.coach().view().learner == "Bo");
  }
}

TEST_CASE("the panel is told when a trial cannot be passed any more, from the fault that fails it on") {
  LeftRig rig;
  rig.begin();
  CHECK_FALSE(rig.session.panel_input().trial_lost);
  DriverControls stalls;  // the clutch comes up at once, without throttle
  stalls.ignition = true;
  stalls.clutch = 1.0;
  HandTarget first;
  first.position = rest_position(rig.session.trainer().gate(), 1);
  const auto column = glm::dvec2(first.position.x, 0.0);
  rig.session.lead({column, {}}, stalls);
  rig.go(1.0);
  rig.session.lead(first, stalls);
  rig.go(1.0);
  REQUIRE(rig.session.shown().gear == 1);
  CHECK_FALSE(rig.session.panel_input().trial_lost);
  stalls.clutch = 0.0;
  rig.session.lead(first, stalls);
  rig.go(1.5);
  REQUIRE(rig.session.coach().view().phase == LessonPhase::driving);
  REQUIRE(rig.session.car().stalled);
  CHECK(rig.session.panel_input().trial_lost);
  rig.ask([](PanelRequests& requests) { requests.lesson.leave = true; });
  CHECK_FALSE(rig.session.panel_input().trial_lost);
  rig.begin();
  CHECK_FALSE(rig.session.panel_input().trial_lost);
}
