// If the user has switched the forces off, they stay off after any change of gate, preset or hand until the user arms
// the lever.
#include <chrono>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <utility>

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

struct ForcesRig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Session session;

  explicit ForcesRig(RuntimeClock clock = RuntimeClock::virtual_time) : session(choice(clock)) { go(2.0); }

  static SessionChoice choice(RuntimeClock clock) {
    SessionChoice choice;
    choice.hand = "grip";
    choice.clock = clock;
    choice.sound = SoundOutput::none;
    return choice;
  }
  void go(double seconds) {
    for (double time = 0.0; time < seconds; time += 1.0 / 60.0) session.advance(1.0 / 60.0);
  }
  // Asks for change number `which` (0, 1, ...). Each of these changes needs a new runtime.
  void change(int which) {
    if (which == 0) session.apply(ChooseGate{"four_speed"});
    if (which == 1) session.apply(ChoosePreset{"measured"});
    if (which == 2) session.apply(ChooseHand{"arm"});
    if (which == 3) session.apply(Restart{session.runtime().config().preset.haptics});
  }
  // With a position margin of zero, pushing through a soft wall to the device's end stop causes a fault.
  void provoke_fault() {
    Restart restart{session.runtime().config().preset.haptics};
    restart.config.guard.position_margin = 0.0;
    restart.config.tuning.wall_stiffness = 500.0;
    session.apply(restart);
    go(2.0);
    HandTarget hand;
    for (int i = 0; i < 3000 && session.runtime().snapshot().guard != GuardState::released; ++i) {
      hand.position = {i % 2 ? 0.09 : -0.09, i % 2 ? 0.09 : -0.09};
      hand.push = {0.0, i % 2 ? 75.0 : -75.0};
      session.lever().set_driver(hand, {});
      session.advance(0.1);
    }
    REQUIRE(session.runtime().snapshot().guard == GuardState::released);
    session.lever().set_driver({}, {});
  }
  void cause(ForceCause what) {
    switch (what) {
      case ForceCause::start:
        return;
      case ForceCause::stick_lost:  // a session with a simulated lever has no stick to lose
        return session.runtime().follow(ForceCause::stick_lost);
      case ForceCause::user_arms:
        return session.apply(Arm{});
      case ForceCause::user_disarms:
        return session.apply(Disarm{});
      case ForceCause::user_stops:
        return session.apply(Stop{});
      case ForceCause::fault:
        provoke_fault();
        return change(2);
      case ForceCause::new_lever:
        return change(0);
      case ForceCause::new_lever_of_armed:
        return session.apply(PanelCommands{Arm{}, ChooseGate{"four_speed"}});
      case ForceCause::recording:
        session.apply(ToggleRecording{});
        go(0.5);
        return session.apply(ToggleRecording{});
    }
  }
  bool has_forces() {
    const GuardState guard = session.runtime().snapshot().guard;
    return guard == GuardState::armed || guard == GuardState::ramping || guard == GuardState::running;
  }
};

}  // namespace

// Stated here a second time, so that a changed rule is noticed: forces after a cause; empty: as before.
constexpr std::pair<ForceCause, std::optional<bool>> kSimulatedForces[] = {
    {ForceCause::start, true},       {ForceCause::user_arms, true}, {ForceCause::user_disarms, false},
    {ForceCause::user_stops, false}, {ForceCause::fault, false},    {ForceCause::new_lever, {}},
    {ForceCause::stick_lost, {}},    {ForceCause::recording, {}},   {ForceCause::new_lever_of_armed, true},
};
static_assert(std::size(kSimulatedForces) == std::size(kForceRules));

TEST_CASE("each rule of arming and motors-off, on a simulated lever that had forces, and on one that had none") {
  for (const auto& rule : kSimulatedForces) {
    const ForceCause cause = rule.first;
    const std::optional<bool>& after = rule.second;
    CAPTURE(static_cast<int>(cause));
    for (const bool before : {true, false}) {
      CAPTURE(before);
      const bool is_possible = before || (cause != ForceCause::start && cause != ForceCause::fault);
      if (!is_possible) continue;  // a session starts once, and a lever without forces has no fault
      ForcesRig rig;
      if (!before) rig.session.apply(Disarm{});
      rig.go(1.0);
      rig.cause(cause);
      rig.go(2.0);
      CHECK(rig.has_forces() == after.value_or(before));
    }
  }
}

TEST_CASE("after STOP or Forces off, no gate, preset, hand or restart restores the forces; only arming does") {
  for (const PanelCommand& command : PanelCommands{Stop{}, Disarm{}}) {
    for (int which = 0; which < 4; ++which) {
      CAPTURE(which);
      ForcesRig rig;
      REQUIRE(rig.has_forces());
      rig.session.apply(command);
      if (which % 2 == 0) rig.go(0.5);  // for odd `which`, the change comes in the same frame as the command
      rig.change(which);
      rig.go(2.0);
      CHECK_FALSE(rig.has_forces());
      rig.change((which + 1) % 4);
      rig.go(2.0);
      CHECK_FALSE(rig.has_forces());
      rig.session.apply(Arm{});
      rig.go(2.0);
      CHECK(rig.has_forces());
    }
  }
}

TEST_CASE("an armed lever keeps its forces after a change, and after two changes within a frame") {
  for (int which = 0; which < 4; ++which) {
    CAPTURE(which);
    ForcesRig rig;
    rig.change(which);
    rig.change((which + 2) % 4);
    rig.go(2.0);
    CHECK(rig.has_forces());
  }
}

TEST_CASE("event times are relative to the session's start, across every change of gate") {
  for (const RuntimeClock clock : {RuntimeClock::virtual_time, RuntimeClock::real_time}) {
    const auto start = std::chrono::steady_clock::now();
    ForcesRig rig(clock);
    std::size_t events = 0;
    double last = 0.0;
    for (int i = 0; i < 60; ++i) {
      if (i % 20 == 10) rig.change(i == 30 ? 1 : 0);
      if (i % 20 == 15) rig.session.apply(i % 40 == 15 ? PanelCommand(Stop{}) : PanelCommand(Arm{}));
      if (clock == RuntimeClock::real_time) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      const double before = rig.session.time();
      rig.session.advance(1.0 / 60.0);
      const double now = clock == RuntimeClock::virtual_time
                             ? rig.session.time()
                             : std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      for (const HapticEvent& event : rig.session.events()) {
        const double time = 1e-9 * static_cast<double>(event.time_ns);
        CHECK(time >= last);
        CHECK(time <= now + 1e-6);
        if (clock == RuntimeClock::virtual_time) CHECK(time > before - 1.1e-3);
        last = time;
        ++events;
      }
    }
    CHECK(events > 3);
  }
}

TEST_CASE("forces removed by a fault are not restored by a recording, two changes or a lesson; only arming does") {
  for (const auto& [lesson, recording] : {std::pair{false, false}, {true, false}, {false, true}}) {
    ForcesRig rig;
    rig.provoke_fault();
    if (recording) rig.cause(ForceCause::recording);
    rig.change(2);
    rig.go(1.0);
    CHECK_FALSE(rig.has_forces());
    if (lesson) {
      rig.session.apply(BeginLesson{});
      CHECK(rig.session.coach().view().phase == LessonPhase::driving);
    } else {
      rig.change(1);
    }
    rig.go(1.0);
    CHECK_FALSE(rig.has_forces());
    rig.session.apply(Arm{});
    rig.go(2.0);
    CHECK(rig.has_forces());
  }
}
