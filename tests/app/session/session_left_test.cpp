// Tests how a lesson can end early, the message for each case, and who controls the car afterwards.
#include <algorithm>
#include <cmath>
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
    choice.pedal_timing = {0.25, 1.2};
    return choice;
  }
  void go(double seconds) {
    for (double time = 0.0; time < seconds; time += kLeftFrame) session.advance(kLeftFrame);
  }
  void begin() {
    session.apply(BeginLesson{});
    go(0.2);
    REQUIRE(session.coach().view().phase == LessonPhase::driving);
  }
  bool says(const std::string& words) const { return session.message().find(words) != std::string::npos; }
  // Whether the learner controls the car. The learner presses no pedal, so a pressed pedal is the instructor's.
  bool has_car() {
    DriverControls free;
    free.ignition = true;
    session.lever().set_driver({}, free);
    go(2.0);  // the clutch pedal takes 1.5 s to rise
    return session.car().pedals.brake == 0.0 && session.car().pedals.clutch == 0.0;
  }
};

}  // namespace

TEST_CASE("every way to end a lesson early is reported with its reason") {
  struct Case {
    const char* why;
    PanelCommand command;
  };
  const Case cases[] = {{"the learner changed", ChooseLearner{"Bo"}},
                        {"the learner changed", ChooseLearner{""}},
                        {"the car changed", ChooseCar{"diesel"}},
                        {"the gate changed", ChooseGate{"four_speed"}},
                        {"the hand changed", ChooseHand{std::string(kAutomaticHand)}},
                        {"the preset changed", ChoosePreset{"measured"}},
                        {"the settings changed", Restart{HapticConfig()}}};
  for (const Case& one : cases) {
    CAPTURE(one.why);
    LeftRig rig;
    rig.begin();
    rig.session.apply(one.command);
    CHECK(rig.session.coach().view().phase != LessonPhase::driving);
    CAPTURE(rig.session.message());
    CHECK(rig.says("ended early"));
    CHECK(rig.says(one.why));
    rig.session.apply(one.command);  // no lesson is running now, so none can end early
    CHECK_FALSE(rig.says("ended early"));
  }
}

TEST_CASE("after a lesson the instructor holds the car, and the panel shows it, until a new choice returns it") {
  for (const PanelCommand& choose :
       PanelCommands{ChooseCar{"diesel"}, ChooseGate{"four_speed"}, ChooseHand{"light"}, DismissLesson{}}) {
    LeftRig rig;
    CHECK_FALSE(rig.session.panel_input().instructor_holds_pedals);
    rig.begin();
    CHECK_FALSE(rig.session.panel_input().instructor_holds_pedals);
    rig.session.apply(LeaveLesson{});
    CHECK_FALSE(rig.has_car());
    CHECK(rig.session.panel_input().instructor_holds_pedals);
    // Offering a lesson does not return the car to the learner; only choosing a lesson does.
    rig.session.apply(OfferLesson{"hill_start"});
    CHECK_FALSE(rig.has_car());
    CHECK(rig.session.panel_input().instructor_holds_pedals);
    rig.session.apply(choose);
    CHECK(rig.has_car());
    CHECK_FALSE(rig.session.panel_input().instructor_holds_pedals);
  }
  LeftRig rig;
  rig.begin();
  rig.session.apply(LeaveLesson{});
  rig.begin();
  CHECK(rig.has_car());
}

TEST_CASE("the clutch pedal does not jump when the instructor takes the car and returns it") {
  LeftRig rig;
  rig.begin();
  rig.session.apply(LeaveLesson{});
  double before = rig.session.car().pedals.clutch, highest = 0.0;
  for (int frame = 0; frame < 240; ++frame) {
    if (frame == 120) rig.session.apply(DismissLesson{});
    rig.go(kLeftFrame);
    const double clutch = rig.session.car().pedals.clutch;
    CHECK(std::abs(clutch - before) <= kLeftFrame / 0.25 + 0.005);  // the full travel takes 0.25 s; a cycle more
    highest = std::max(highest, before = clutch);
  }
  CHECK(highest == 1.0);
  CHECK(before == 0.0);
}

TEST_CASE("the instructor's foot does not press the clutch in the learner's next lesson") {
  LeftRig rig;
  rig.begin();
  rig.session.apply(LeaveLesson{});
  rig.go(1.0);
  CHECK(rig.session.car().pedals.clutch == 1.0);
  rig.begin();  // the lesson's first step asks for the clutch
  CHECK(rig.session.car().pedals.clutch == 0.0);
  CHECK(rig.session.coach().view().now->step == 0);
}

TEST_CASE("a pedal key held when the automatic driver takes the car does not press his pedals") {
  LeftRig rig;
  rig.session.apply(DismissLesson{});
  rig.session.lever().set_driver({}, {}, {.brake = true});
  rig.go(0.5);
  CHECK(rig.session.car().pedals.brake == 1.0);
  rig.session.apply(ChooseHand{std::string(kAutomaticHand)});
  rig.session.advance(kLeftFrame);
  CHECK(rig.session.car().pedals.brake < 0.2);  // the driver's own foot; the released key's pedal would be above 0.9
}

TEST_CASE("an axis keeps its pedal pressed from the new lever's first cycle on") {
  const LeftRig rig;
  SessionChoice choice = rig.choice("grip");
  choice.lesson = kNoLesson;
  choice.clock = RuntimeClock::real_time;  // the new lever runs before it is in force
  Session session(choice);
  DriverControls pad;
  pad.pedals.clutch = 0.9;
  session.lever().set_driver({}, pad);
  session.advance(0.0);
  session.apply(ChooseCar{"diesel"});
  const auto cycles = session.runtime().read_frame().cycles;
  CHECK_FALSE(cycles.empty());
  for (const auto& cycle : cycles) CHECK(cycle.controls.pedals.clutch == 0.9);
}

TEST_CASE("the errors that fail a lesson are listed with its goal; without a lesson there is no list") {
  LeftRig rig;
  CHECK(rig.session.coach().view().fail_conditions == failing_errors_sentence(*rig.session.coach().lesson()));
  CHECK_FALSE(rig.session.coach().view().fail_conditions.empty());
  rig.session.apply(DismissLesson{});
  CHECK(rig.session.coach().view().fail_conditions.empty());
}

TEST_CASE("a car chosen during a lesson is controlled by the learner") {
  LeftRig rig;
  rig.begin();
  rig.session.apply(ChooseCar{"diesel"});
  CHECK(rig.has_car());
}

TEST_CASE("a rejected name selects nobody and is reported once; a valid one removes the message") {
  for (const std::string& hand : {std::string("grip"), std::string(kAutomaticHand)}) {
    CAPTURE(hand);
    LeftRig rig(hand);
    rig.session.apply(ChooseLearner{"a\tb"});
    CHECK(rig.says("learner's name"));
    rig.session.apply(ChooseCar{"diesel"});
    CHECK_FALSE(rig.says("learner's name"));
    CHECK(rig.session.coach().view().learner == (hand == kAutomaticHand ? "" : "Ada"));
    rig.session.apply(ChooseLearner{"a\tb"});
    rig.session.apply(ChooseLearner{"Bo"});
    CHECK_FALSE(rig.says("learner's name"));
    rig.session.apply(ChooseHand{"light"});
    CHECK(rig.session.coach().view().learner == "Bo");
  }
}

TEST_CASE("a renamed learner stays the session's learner, also after the simulated driver has driven") {
  LeftRig rig;
  const auto learner = [&] { return rig.session.coach().view().learner; };
  rig.session.apply(RenameLearner{"Ada  L"});
  CHECK(learner() == "Ada L");
  rig.session.apply(ChooseHand{"light"});
  CHECK(learner() == "Ada L");
  rig.session.apply(ChooseHand{std::string(kAutomaticHand)});
  CHECK(learner().empty());
  rig.session.apply(ChooseHand{"light"});
  CHECK(learner() == "Ada L");
  rig.session.apply(RenameLearner{"a\tb"});
  CHECK(rig.says("learner's name"));
  rig.session.apply(ChooseLearner{"ADA L"});
  CHECK(learner() == "Ada L");
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
  rig.session.lever().set_driver({column, {}}, stalls);
  rig.go(1.0);
  rig.session.lever().set_driver(first, stalls);
  rig.go(1.0);
  REQUIRE(rig.session.shown().gear == 1);
  CHECK_FALSE(rig.session.panel_input().is_unpassable);
  stalls.pedals.clutch = 0.0;
  rig.session.lever().set_driver(first, stalls);
  rig.go(1.5);
  REQUIRE(rig.session.coach().view().phase == LessonPhase::driving);
  REQUIRE(rig.session.car().stalled);
  CHECK(rig.session.panel_input().is_unpassable);
  rig.session.apply(LeaveLesson{});
  CHECK_FALSE(rig.session.panel_input().is_unpassable);
  rig.begin();
  CHECK_FALSE(rig.session.panel_input().is_unpassable);
}
