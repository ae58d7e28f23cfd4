// Tests a session with a stick in the user's hand: what arms the stick, which changes affect it, and what happens if it
// is unplugged.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <doctest/doctest.h>

#include "app/lessons/history/history.h"
#include "app/session/session.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/trace_reader.h"
#include "tests/app/runtime/devices/open_stick_rig.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::runtime;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;
namespace fs = std::filesystem;

namespace {

KnownStick late_by(double delay) {  // [s] delay of the stick's response
  IdleHand idle_hand;
  KnownStick known{sidewinder_calibration(), EmulatedStick({}, idle_hand).report_descriptor()};
  known.calibration.timing.delay = delay;
  known.calibration.buttons.stop = 3;
  return known;
}

struct HeldRig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Variable data{"XDG_DATA_HOME", folder.path().c_str()};
  HeldStick held;
  std::unique_ptr<Session> session;

  explicit HeldRig(const std::string& lesson = std::string(kNoLesson), double delay = 0.0,
                   const EmulatedStickConfig& stick = HeldStick::config())
      : held(late_by(delay), stick) {
    SessionChoice choice;
    choice.stick = held.lever;
    choice.lesson = lesson;
    choice.learner = "Ada";
    choice.history = folder / "history.db";
    choice.help = false;
    choice.sound = SoundOutput::none;
    session = std::make_unique<Session>(choice);
    REQUIRE(becomes_true([&] { return held.lever->connected() && session->panel_input().stick->plugged_in; }));
  }

  void frame() {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    session->advance(0.005);
  }
  // Runs at most 2000 frames of 5 ms until the condition is true.
  bool becomes_true(const std::function<bool()>& condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) frame();
    return condition();
  }
  void arm() { session->apply(Arm{}); }
  // Holds or releases the stick's panic button, and waits until the stick has reported it.
  void hold_stop(bool held_down) {
    {
      const std::lock_guard lock(held.mutex);
      held.stick.held_buttons = held_down ? 1u << 2 : 0u;
    }
    for (int i = 0; i < 10; ++i) frame();
  }
  void be_silent(bool on) {
    const std::lock_guard lock(held.mutex);
    held.stick.faults.silent = on;
  }
  void tap_stop() {  // without a frame
    for (const std::uint64_t buttons : {std::uint64_t{1u << 2}, std::uint64_t{0}}) {
      {
        const std::lock_guard lock(held.mutex);
        held.stick.held_buttons = buttons;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  GuardState guard() { return session->runtime().snapshot().guard; }
  // Runs frames until the guard's state is `running`. If the guard trips, as may happen on a busy machine, arms the
  // lever again.
  bool runs() {
    return becomes_true([&] {
      const GuardState now = guard();
      if (now == GuardState::damped || now == GuardState::released) arm();
      return now == GuardState::running;
    });
  }
  bool stays_off(int frames = 100) {
    for (int i = 0; i < frames; ++i) {
      frame();
      if (guard() != GuardState::idle && guard() != GuardState::released) return false;
    }
    return held.force() == 0.0;
  }
  // The paper's gate with its outer columns 150 mm from the middle, beyond the stick's travel.
  fs::path wide_gate() const {
    std::ifstream paper(GEARSHIFT_ASSETS "/gates/paper.toml");
    std::string text{std::istreambuf_iterator<char>(paper), {}};
    for (const std::string column : {"position_mm = -30", "position_mm = 30"})
      text.replace(text.find(column), column.size(), column.substr(0, column.size() - 2) + "150");
    std::ofstream(folder / "wide.toml") << text;
    return folder / "wide.toml";
  }
  bool says(const std::string& words) const { return session->message().find(words) != std::string::npos; }
};

}  // namespace

// Every rule of the table, on a stick whose forces were on, and on one whose forces were off. A fault is followed by a
// recording, which on its own keeps the forces.
TEST_CASE("each rule of arming and motors-off, on a stick") {
  const auto cause = [](HeldRig& rig, ForceCause what) {
    if (what == ForceCause::user_arms) rig.arm();
    if (what == ForceCause::user_disarms) rig.session->apply(Disarm{});
    if (what == ForceCause::user_stops) rig.session->apply(Stop{});
    if (what == ForceCause::new_lever) rig.session->apply(ChooseGate{"four_speed"});
    if (what == ForceCause::new_lever_of_armed) rig.session->apply(PanelCommands{Arm{}, ChooseGate{"four_speed"}});
    if (what == ForceCause::fault) {
      rig.be_silent(true);
      REQUIRE(rig.becomes_true([&] { return rig.guard() != GuardState::running; }));
      rig.be_silent(false);
      for (int i = 0; i < 10; ++i) rig.frame();
      rig.session->apply(ToggleRecording{});
    }
    if (what == ForceCause::recording) rig.session->apply(ToggleRecording{});
    if (what == ForceCause::stick_lost) {
      rig.held.unplug();
      REQUIRE(rig.becomes_true([&] { return !rig.session->panel_input().stick->plugged_in; }));
      rig.held.plug_in();
      REQUIRE(rig.becomes_true([&] { return rig.session->panel_input().stick->plugged_in; }));
    }
  };
  // Stated here a second time, so that a changed rule is noticed: forces after a cause; empty: as before.
  const std::pair<ForceCause, std::optional<bool>> wanted[] = {
      {ForceCause::start, false},      {ForceCause::user_arms, true},  {ForceCause::user_disarms, false},
      {ForceCause::user_stops, false}, {ForceCause::new_lever, false}, {ForceCause::stick_lost, false},
      {ForceCause::recording, {}},     {ForceCause::fault, false},     {ForceCause::new_lever_of_armed, true},
  };
  static_assert(std::size(wanted) == std::size(kForceRules));
  for (const auto& rule : wanted) {
    const ForceCause what = rule.first;
    const std::optional<bool>& forces = rule.second;
    CAPTURE(static_cast<int>(what));
    for (const bool before : {true, false}) {
      CAPTURE(before);
      if (before && what == ForceCause::start) continue;  // no forces have been switched on at the start
      HeldRig rig;
      if (before) rig.arm();
      if (before) REQUIRE(rig.runs());
      cause(rig, what);
      const bool after = forces.value_or(before);
      CHECK((after ? rig.becomes_true([&] { return rig.guard() == GuardState::running; }) : rig.stays_off(60)));
    }
  }
}

TEST_CASE("only Enter arms the stick: not the start, nor a change of gate, car, preset or setup") {
  HeldRig rig;
  CHECK(rig.stays_off());
  CHECK(rig.session->panel_input().device_name == "SideWinder");
  rig.arm();
  CHECK(rig.runs());
  const PanelCommand changes[] = {ChooseGate{"four_speed"}, ChooseCar{"diesel"}, ChoosePreset{"measured"},
                                  Restart{HapticConfig()}};
  for (const PanelCommand& change : changes) {
    rig.session->apply(change);
    CHECK(rig.stays_off(30));
    rig.arm();
    CHECK(rig.runs());
  }
}

// The stick's own panic button against Enter, which on the lesson card both arms and begins the lesson.
TEST_CASE("while the panic button is held, neither Enter nor a new lever nor a recording switches forces on") {
  HeldRig rig("moving_off");
  rig.hold_stop(true);
  rig.session->apply(PanelCommands{Arm{}, BeginLesson{}});
  REQUIRE(rig.session->coach().view().phase == LessonPhase::driving);
  CHECK(rig.stays_off(40));
  rig.hold_stop(false);
  CHECK(rig.stays_off(40));  // a person has to arm again
  rig.session->apply(PanelCommands{LeaveLesson{}});

  rig.session->apply(Disarm{});
  rig.hold_stop(true);
  rig.arm();  // refused
  CHECK(rig.stays_off(20));
  rig.hold_stop(false);
  rig.frame();
  rig.session->apply(PanelCommands{ToggleRecording{}});
  CHECK(rig.session->recording());
  CHECK(rig.stays_off(40));
  rig.arm();
  CHECK(rig.runs());
}

TEST_CASE("a panic button tapped after Enter, while the lesson loads, keeps the lesson's lever without forces") {
  HeldRig rig("moving_off");
  rig.frame();
  rig.session->apply(PanelCommands{Arm{}});
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  rig.tap_stop();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  rig.session->apply(PanelCommands{BeginLesson{}});  // in the same frame as Enter
  REQUIRE(rig.session->coach().view().phase == LessonPhase::driving);
  CHECK(rig.stays_off(60));
}

TEST_CASE("the message that the stick's delay makes the walls softer is shown until it is armed") {
  HeldRig rig(std::string(kNoLesson), 0.004);
  CHECK(rig.says("SideWinder takes 7.0 ms to respond, so the walls were softened from 5000 to "));
  CHECK(rig.says(" N/m"));
  rig.arm();
  CHECK(rig.session->message().empty());
}

// The driver's own tests are in stick_faults_test.cpp. Here, a person presses against walls that are not there.
TEST_CASE("a stick without power says so on the screen, whether it reports its state or not") {
  for (const bool tells_state : {true, false}) {
    CAPTURE(tells_state);
    EmulatedStickConfig stick = HeldStick::config();
    if (!tells_state) stick.habits.state_sent = StateSent::never;
    HeldRig rig(std::string(kNoLesson), 0.0, stick);
    {
      const std::lock_guard lock(rig.held.mutex);
      rig.held.stick.faults.no_power = true;
    }
    rig.arm();
    const char* const due =
        tells_state ? "the stick reported that its motors have no power" : "against the stick's full force";
    int frame = 0;
    const auto is_told = [&] {
      if (rig.says(due)) return true;
      const bool is_forward = ++frame / 80 % 2 != 0;  // turns every 0.4 s
      rig.held.hand.go(is_forward ? glm::dvec2(0.014, 0.020) : glm::dvec2(0.012, 0.0));
      const GuardState now = rig.guard();  // on a busy machine, the motors may go off for a late command
      if (now == GuardState::damped || now == GuardState::released) rig.arm();
      return false;
    };
    CHECK((rig.becomes_true(is_told) || rig.becomes_true(is_told) || rig.becomes_true(is_told)));  // within 30 s
    CHECK(rig.says("power supply"));
    CHECK(rig.held.force() == 0.0);
  }
}

TEST_CASE("the lever follows the stick, and the mouse has no effect") {
  HeldRig rig;
  rig.held.hand.go({0.020, 0.0});
  HandTarget mouse;
  mouse.position = {-0.05, 0.0};
  rig.session->lever().set_driver(mouse, {});
  CHECK(rig.becomes_true([&] { return std::abs(rig.session->shown().lever.x - 0.020) < 0.002; }));
}

TEST_CASE("a rejected change leaves lever, forces and gate unchanged") {
  HeldRig rig;
  rig.arm();
  REQUIRE(rig.runs());
  const Runtime* before = &rig.session->runtime();
  HapticConfig study = before->config().preset.haptics;
  study.contact.allow_unstable = true;
  rig.session->apply(Restart{study});
  CHECK(rig.says("simulated"));
  rig.session->apply(ChooseHand{std::string(kAutomaticHand)});
  CHECK(rig.says("works only with the simulated lever"));
  const fs::path gate = rig.wide_gate();
  rig.session->apply(ChooseGate{gate.string()});
  CHECK(rig.says("outside the workspace"));
  CHECK(&rig.session->runtime() == before);
  CHECK(rig.guard() == GuardState::running);
}

TEST_CASE(
    "unplugged in a recorded lesson: forces off, the lesson continues, and the user arms it again when it is back") {
  HeldRig rig("moving_off");
  // One button on the lesson card asks for both.
  rig.session->apply(PanelCommands{Arm{}, BeginLesson{}});
  REQUIRE(rig.session->coach().view().phase == LessonPhase::driving);
  CHECK(rig.session->recording());
  CHECK(rig.runs());
  rig.held.unplug();
  CHECK(rig.becomes_true([&] { return !rig.session->panel_input().stick->plugged_in; }));
  CHECK(rig.says("was unplugged"));
  rig.arm();
  CHECK(rig.says("not plugged in"));
  CHECK(rig.session->coach().view().phase == LessonPhase::driving);
  rig.held.plug_in();
  CHECK(rig.becomes_true([&] { return rig.session->panel_input().stick->plugged_in; }));
  CHECK(rig.stays_off());
  rig.arm();
  CHECK(rig.runs());
  rig.session->apply(LeaveLesson{});
  CHECK(rig.session->save_and_stop().empty());
  rig.session.reset();
  History history(rig.folder / "history.db");
  const std::vector<RunRow> runs = history.runs(history.find_or_add_learner("Ada"));
  REQUIRE(runs.size() == 1);
  TraceReader trace(history.recording_file(runs.front().recording));
  CHECK(trace.cycles() > 1000);
  CHECK_FALSE(trace.header().device.simulated);
}

TEST_CASE("a session that ends while the stick is unplugged still saves its lesson") {
  HeldRig rig("moving_off");
  rig.session->apply(PanelCommands{Arm{}, BeginLesson{}});
  REQUIRE(rig.runs());
  rig.held.unplug();
  rig.frame();
  CHECK(rig.session->save_and_stop().empty());
  rig.session.reset();
  History history(rig.folder / "history.db");
  const std::vector<RunRow> runs = history.runs(history.find_or_add_learner("Ada"));
  REQUIRE(runs.size() == 1);
  CHECK(TraceReader(history.recording_file(runs.front().recording)).cycles() > 100);
}

TEST_CASE("a lesson that starts in a gear begins only when the stick is in that gear") {
  HeldRig rig("eco_driving");  // this lesson starts in first gear
  rig.session->apply(BeginLesson{});
  CHECK(rig.says("starts in first, but the stick is in neutral"));
  CHECK(rig.session->coach().view().phase == LessonPhase::offered);
  DriverControls feet;
  feet.ignition = true;
  feet.pedals.clutch = 1.0;  // with the clutch pedal up, the synchroniser would block the gear
  rig.session->lever().set_driver({}, feet);
  const glm::dvec2 first = rest_position(rig.session->runtime().gate(), 1);
  rig.held.hand.go({first.x, 0.0});
  CHECK(rig.becomes_true([&] { return std::abs(rig.session->shown().lever.x - first.x) < 0.003; }));
  rig.held.hand.go(first);
  CHECK(rig.becomes_true([&] { return rig.session->shown().gear == 1; }));
  rig.session->apply(BeginLesson{});
  CHECK(rig.session->coach().view().phase == LessonPhase::driving);
}
