// Tests how a lesson can end early, the message for each case, and who controls the car afterwards.
#include <functional>
#include <string>

#include <doctest/doctest.h>

#include "app/session/session.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::runtime;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;

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
    choice.clock = RuntimeClock::virtual_time;
    choice.sound = SoundOutput::none;
    return choice;
  }
  void ask(const std::function<void(PanelRequests&)>& request) {
    PanelRequests requests;
    request(requests);
    session.apply(requests);
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
  // Whether the learner controls the car. The learner presses no pedal, so a pressed pedal is the instructor's.
  bool has_car() {
    DriverControls free;
    free.ignition = true;
    session.set_driver({}, free);
    go(0.1);
    return session.car().pedals.brake == 0.0 && session.car().pedals.clutch == 0.0;
  }
};

}  // namespace

TEST_CASE("every way to end a lesson early is reported with its reason") {
  struct Case {
    const char* why;
    std::function<void(PanelRequests&)> request;
  };
  const Case cases[] = {{"the learner changed", [](PanelRequests& r) { r.lesson.learner = "Bo"; }},
                        {"the learner changed", [](PanelRequests& r) { r.lesson.learner = ""; }},
                        {"the car changed", [](PanelRequests& r) { r.car = "diesel"; }},
                        {"the gate changed", [](PanelRequests& r) { r.gate = "four_speed"; }},
                        {"the hand changed", [](PanelRequests& r) { r.hand = std::string(kAutomaticHand); }},
                        {"the preset changed", [](PanelRequests& r) { r.preset = "measured"; }},
                        {"the settings changed", [](PanelRequests& r) { r.restart = HapticConfig(); }}};
  for (const Case& one : cases) {
    CAPTURE(one.why);
    LeftRig rig;
    rig.begin();
    rig.ask(one.request);
    CHECK(rig.session.coach().view().phase != LessonPhase::driving);
    CAPTURE(rig.session.message());
    CHECK(rig.says("ended early"));
    CHECK(rig.says(one.why));
    rig.ask(one.request);  // no lesson is running now, so none can end early
    CHECK_FALSE(rig.says("ended early"));
  }
}

TEST_CASE("after a lesson the instructor holds the car, and the panel shows it, until a new choice returns it") {
  for (const auto& choose :
       {std::function<void(PanelRequests&)>([](PanelRequests& r) { r.car = "diesel"; }),
        std::function<void(PanelRequests&)>([](PanelRequests& r) { r.gate = "four_speed"; }),
        std::function<void(PanelRequests&)>([](PanelRequests& r) { r.hand = "light"; }),
        std::function<void(PanelRequests&)>([](PanelRequests& r) { r.lesson.dismiss_lesson = true; })}) {
    LeftRig rig;
    CHECK_FALSE(rig.session.panel_input().instructor_holds_pedals);
    rig.begin();
    CHECK_FALSE(rig.session.panel_input().instructor_holds_pedals);
    rig.ask([](PanelRequests& requests) { requests.lesson.leave = true; });
    CHECK_FALSE(rig.has_car());
    CHECK(rig.session.panel_input().instructor_holds_pedals);
    // Offering a lesson does not return the car to the learner; only choosing a lesson does.
    rig.ask([](PanelRequests& requests) { requests.lesson.offer = "hill_start"; });
    CHECK_FALSE(rig.has_car());
    CHECK(rig.session.panel_input().instructor_holds_pedals);
    rig.ask(choose);
    CHECK(rig.has_car());
    CHECK_FALSE(rig.session.panel_input().instructor_holds_pedals);
  }
  LeftRig rig;
  rig.begin();
  rig.ask([](PanelRequests& requests) { requests.lesson.leave = true; });
  rig.begin();
  CHECK(rig.has_car());
}

TEST_CASE("the errors that fail a lesson are listed with its goal; without a lesson there is no list") {
  LeftRig rig;
  CHECK(rig.session.coach().view().fail_conditions == failing_errors_sentence(*rig.session.coach().lesson()));
  CHECK_FALSE(rig.session.coach().view().fail_conditions.empty());
  rig.ask([](PanelRequests& requests) { requests.lesson.dismiss_lesson = true; });
  CHECK(rig.session.coach().view().fail_conditions.empty());
}

TEST_CASE("a car chosen during a lesson is controlled by the learner") {
  LeftRig rig;
  rig.begin();
  rig.ask([](PanelRequests& requests) { requests.car = "diesel"; });
  CHECK(rig.has_car());
}

TEST_CASE("a rejected name selects nobody and is reported once; a valid one removes the message") {
  for (const std::string& hand : {std::string("grip"), std::string(kAutomaticHand)}) {
    CAPTURE(hand);
    LeftRig rig(hand);
    rig.ask([](PanelRequests& requests) { requests.lesson.learner = "a\tb"; });
    CHECK(rig.says("learner's name"));
    rig.ask([](PanelRequests& requests) { requests.car = "diesel"; });
    CHECK_FALSE(rig.says("learner's name"));
    CHECK(rig.session.coach().view().learner == (hand == kAutomaticHand ? "" : "Ada"));
    rig.ask([](PanelRequests& requests) { requests.lesson.learner = "a\tb"; });
    rig.ask([](PanelRequests& requests) { requests.lesson.learner = "Bo"; });
    CHECK_FALSE(rig.says("learner's name"));
    rig.ask([](PanelRequests& requests) { requests.hand = "light"; });
    CHECK(rig.session.coach().view().learner == "Bo");
  }
}

TEST_CASE("the panel shows that a trial can no longer be passed, from the failing error on") {
  LeftRig rig;
  rig.begin();
  CHECK_FALSE(rig.session.panel_input().is_unpassable);
  DriverControls stalls;  // the engine will stall when the test releases the clutch
  stalls.ignition = true;
  stalls.pedals.clutch = 1.0;
  HandTarget first;
  first.position = rest_position(rig.session.runtime().gate(), 1);
  const auto column = glm::dvec2(first.position.x, 0.0);
  rig.session.set_driver({column, {}}, stalls);
  rig.go(1.0);
  rig.session.set_driver(first, stalls);
  rig.go(1.0);
  REQUIRE(rig.session.shown().gear == 1);
  CHECK_FALSE(rig.session.panel_input().is_unpassable);
  stalls.pedals.clutch = 0.0;
  rig.session.set_driver(first, stalls);
  rig.go(1.5);
  REQUIRE(rig.session.coach().view().phase == LessonPhase::driving);
  REQUIRE(rig.session.car().stalled);
  CHECK(rig.session.panel_input().is_unpassable);
  rig.ask([](PanelRequests& requests) { requests.lesson.leave = true; });
  CHECK_FALSE(rig.session.panel_input().is_unpassable);
  rig.begin();
  CHECK_FALSE(rig.session.panel_input().is_unpassable);
}
