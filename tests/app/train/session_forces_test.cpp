// Who may give the lever its forces: what a person has taken, no change of gate, preset or hand gives back.
#include <chrono>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "app/train/session.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift;

namespace {

struct ForcesRig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Session session;

  explicit ForcesRig(TrainerClock clock = TrainerClock::virtual_time) : session(choice(clock)) { go(2.0); }

  static SessionChoice choice(TrainerClock clock) {
    SessionChoice choice;
    choice.hand = "grip";
    choice.clock = clock;
    choice.sound = SoundOutput::none;
    return choice;
  }
  void go(double seconds) {
    for (double time = 0.0; time < seconds; time += 1.0 / 60.0) session.advance(1.0 / 60.0);
  }
  void ask(bool PanelRequests::*what) {
    PanelRequests requests;
    requests.*what = true;
    session.obey(requests);
  }
  // One of the changes that make another trainer.
  void change(int which) {
    PanelRequests requests;
    if (which == 0) requests.gate = "four_speed";
    if (which == 1) requests.preset = "measured";
    if (which == 2) requests.hand = "arm";
    if (which == 3) requests.restart = session.trainer().config().preset.haptics;
    session.obey(requests);
  }
  bool has_forces() {
    const GuardState guard = session.trainer().snapshot().guard;
    return guard == GuardState::armed || guard == GuardState::ramping || guard == GuardState::running;
  }
};

}  // namespace

TEST_CASE("after STOP or Release neither gate, preset, hand nor restart gives the forces back; Arm does") {
  for (const auto taken : {&PanelRequests::stop, &PanelRequests::disarm}) {
    for (int which = 0; which < 4; ++which) {
      CAPTURE(which);
      ForcesRig rig;
      REQUIRE(rig.has_forces());
      rig.ask(taken);
      if (which % 2 == 0) rig.go(0.5);  // or in the frame itself
      rig.change(which);
      rig.go(2.0);
      CHECK_FALSE(rig.has_forces());
      rig.change((which + 1) % 4);
      rig.go(2.0);
      CHECK_FALSE(rig.has_forces());
      rig.ask(&PanelRequests::arm);
      rig.go(2.0);
      CHECK(rig.has_forces());
    }
  }
}

TEST_CASE("a lever that had its forces has them after a change, too, and after two changes within a frame") {
  for (int which = 0; which < 4; ++which) {
    CAPTURE(which);
    ForcesRig rig;
    rig.change(which);
    rig.change((which + 2) % 4);
    rig.go(2.0);
    CHECK(rig.has_forces());
  }
}

TEST_CASE("events tell the time since the session's start, over every change of gate") {
  for (const TrainerClock clock : {TrainerClock::virtual_time, TrainerClock::real_time}) {
    const auto start = std::chrono::steady_clock::now();
    ForcesRig rig(clock);
    std::size_t events = 0;
    double last = 0.0;
    for (int i = 0; i < 60; ++i) {
      if (i % 20 == 10) rig.change(i == 30 ? 1 : 0);
      if (i % 20 == 15) rig.ask(i % 40 == 15 ? &PanelRequests::stop : &PanelRequests::arm);
      if (clock == TrainerClock::real_time) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      const double before = rig.session.time();
      rig.session.advance(1.0 / 60.0);
      const double now = clock == TrainerClock::virtual_time
                             ? rig.session.time()
                             : std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      for (const HapticEvent& event : rig.session.events()) {
        const double time = 1e-9 * static_cast<double>(event.time_ns);
        CHECK(time >= last);
        CHECK(time <= now + 1e-6);
        if (clock == TrainerClock::virtual_time) CHECK(time > before - 1.1e-3);
        last = time;
        ++events;
      }
    }
    CHECK(events > 3);
  }
}

TEST_CASE("what a fault has taken neither two changes nor the begin of a lesson give back; Arm does") {
  for (const bool lesson : {false, true}) {
    ForcesRig rig;
    // A position margin of nothing and a hand at the device's end: the limit is broken.
    PanelRequests restart;
    restart.restart = rig.session.trainer().config().preset.haptics;
    restart.restart->guard.position_margin = 0.0;
    rig.session.obey(restart);
    rig.go(2.0);
    HandTarget hand;
    for (int i = 0; i < 3000 && rig.session.trainer().snapshot().guard != GuardState::released; ++i) {
      hand.position = {i % 2 ? 0.09 : -0.09, i % 2 ? 0.09 : -0.09};
      hand.push = {0.0, i % 2 ? 75.0 : -75.0};
      rig.session.lead(hand, {});
      rig.session.advance(0.1);
    }
    REQUIRE(rig.session.trainer().snapshot().guard == GuardState::released);
    rig.session.lead({}, {});
    rig.change(2);
    rig.go(1.0);
    CHECK_FALSE(rig.has_forces());
    if (lesson) {
      PanelRequests begin;
      begin.lesson.begin = true;
      rig.session.obey(begin);
      CHECK(rig.session.coach().view().phase == LessonPhase::driving);
    } else {
      rig.change(1);
    }
    rig.go(1.0);
    CHECK_FALSE(rig.has_forces());
    rig.ask(&PanelRequests::arm);
    rig.go(2.0);
    CHECK(rig.has_forces());
  }
}
