// A session with a stick in a person's hand: who may arm it, what a change does, and a stick that is pulled out.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "app/history/history.h"
#include "app/train/session.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/trace_reader.h"
#include "tests/app/devices/held_stick.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift;
namespace fs = std::filesystem;

namespace {

KnownStick late_by(double delay) {  // [s]
  RestingHand nobody;
  KnownStick known{sidewinder_calibration(), EmulatedStick({}, nobody).report_descriptor()};
  known.calibration.timing.delay = delay;
  return known;
}

struct HeldRig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Variable data{"XDG_DATA_HOME", folder.path().c_str()};
  HeldStick held;
  std::unique_ptr<Session> session;

  explicit HeldRig(const std::string& lesson = std::string(kNoLesson), double delay = 0.0) : held(late_by(delay)) {
    SessionChoice choice;
    choice.stick = held.lever;
    choice.lesson = lesson;
    choice.learner = "Ada";
    choice.history = folder / "history.db";
    choice.help = false;
    choice.sound = SoundOutput::none;
    session = std::make_unique<Session>(choice);
    REQUIRE(comes_true([&] { return held.lever->connected() && session->panel_input().stick->plugged_in; }));
  }

  void frame() {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    session->advance(0.005);
  }
  // In frames, at most ten seconds.
  bool comes_true(const std::function<bool()>& condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) frame();
    return condition();
  }
  void ask(const std::function<void(PanelRequests&)>& what) {
    PanelRequests requests;
    what(requests);
    session->obey(requests);
  }
  void arm() {
    ask([](PanelRequests& requests) { requests.arm = true; });
  }
  GuardState guard() { return session->trainer().snapshot().guard; }
  // A machine that is busy takes the forces now and then; a person arms again.
  bool runs() {
    return comes_true([&] {
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
  // The paper's, with lengths of nine hundred millimetres: the stick goes 140.
  fs::path wide_gate() const {
    std::ifstream paper(GEARSHIFT_ASSETS "/gates/paper.toml");
    std::string text{std::istreambuf_iterator<char>(paper), {}};
    for (std::size_t at = 0; (at = text.find("_mm = ", at)) != std::string::npos; at += 6) text.insert(at + 6, "9");
    std::ofstream(folder / "wide.toml") << text;
    return folder / "wide.toml";
  }
  bool says(const std::string& words) const { return session->message().find(words) != std::string::npos; }
};

}  // namespace

TEST_CASE("nobody but a person arms it: not the start, not another gate, car, preset or setup, and Enter does") {
  HeldRig rig;
  CHECK(rig.stays_off());
  CHECK(rig.session->panel_input().device_name == "SideWinder");
  rig.arm();
  CHECK(rig.runs());
  const std::function<void(PanelRequests&)> changes[] = {
      [](PanelRequests& requests) { requests.gate = "four_speed"; },
      [](PanelRequests& requests) { requests.car = "diesel"; },
      [](PanelRequests& requests) { requests.preset = "measured"; },
      [](PanelRequests& requests) { requests.restart = HapticConfig(); }};
  for (const auto& change : changes) {
    rig.ask(change);
    CHECK(rig.stays_off(30));
    rig.arm();
    CHECK(rig.runs());
  }
}

TEST_CASE("what its delay costs is told of the walls, until it is armed") {
  HeldRig rig(std::string(kNoLesson), 0.004);
  CHECK(rig.says("SideWinder answers after 7.0 ms: its walls are softer, "));
  CHECK(rig.says(" N/m instead of 5000"));
  rig.arm();
  CHECK(rig.session->message().empty());
}

TEST_CASE("the lever is where the stick is, and the mouse's hand is nothing to it") {
  HeldRig rig;
  rig.held.hand.go({0.020, 0.0});
  HandTarget mouse;
  mouse.position = {-0.05, 0.0};
  rig.session->lead(mouse, {});
  CHECK(rig.comes_true([&] { return std::abs(rig.session->shown().lever.x - 0.020) < 0.002; }));
}

TEST_CASE("what is refused leaves lever, forces and gate as they were") {
  HeldRig rig;
  rig.arm();
  REQUIRE(rig.runs());
  const Trainer* before = &rig.session->trainer();
  HapticConfig study = before->config().preset.haptics;
  study.contact.study = true;
  rig.ask([&](PanelRequests& requests) { requests.restart = study; });
  CHECK(rig.says("simulated"));
  rig.ask([](PanelRequests& requests) { requests.hand = std::string(kByItself); });
  CHECK(rig.says("a person holds the stick"));
  const fs::path gate = rig.wide_gate();
  rig.ask([&](PanelRequests& requests) { requests.gate = gate.string(); });
  CHECK_FALSE(rig.session->message().empty());
  CHECK(&rig.session->trainer() == before);
  CHECK(rig.guard() == GuardState::running);
}

TEST_CASE(
    "pulled out in a lesson that is recorded: forces off, the lesson goes on, and a person arms it when it is back") {
  HeldRig rig("moving_off");
  rig.ask([](PanelRequests& requests) { requests.arm = requests.lesson.begin = true; });  // as the card's button does
  REQUIRE(rig.session->coach().view().phase == LessonPhase::driving);
  CHECK(rig.session->recording());
  CHECK(rig.runs());
  rig.held.unplug();
  CHECK(rig.comes_true([&] { return !rig.session->panel_input().stick->plugged_in; }));
  CHECK(rig.says("was unplugged"));
  rig.arm();
  CHECK(rig.says("not plugged in"));
  CHECK(rig.session->coach().view().phase == LessonPhase::driving);
  rig.held.plug_in();
  CHECK(rig.comes_true([&] { return rig.session->panel_input().stick->plugged_in; }));
  CHECK(rig.stays_off());
  rig.arm();
  CHECK(rig.runs());
  rig.ask([](PanelRequests& requests) { requests.lesson.leave = true; });
  CHECK(rig.session->settle().empty());
  rig.session.reset();
  History history(rig.folder / "history.db");
  const std::vector<RunRow> runs = history.runs(history.learner("Ada"));
  REQUIRE(runs.size() == 1);
  TraceReader trace(history.recording_file(runs.front().recording));
  CHECK(trace.cycles() > 1000);
  CHECK_FALSE(trace.header().device.simulated);
}

TEST_CASE("a session that ends while the stick is out has kept its lesson all the same") {
  HeldRig rig("moving_off");
  rig.ask([](PanelRequests& requests) { requests.arm = requests.lesson.begin = true; });
  REQUIRE(rig.runs());
  rig.held.unplug();
  rig.frame();
  CHECK(rig.session->settle().empty());
  rig.session.reset();
  History history(rig.folder / "history.db");
  const std::vector<RunRow> runs = history.runs(history.learner("Ada"));
  REQUIRE(runs.size() == 1);
  CHECK(TraceReader(history.recording_file(runs.front().recording)).cycles() > 100);
}

TEST_CASE("a lesson that begins in a gear begins when the stick stands in it") {
  HeldRig rig("eco_driving");  // in first gear
  rig.ask([](PanelRequests& requests) { requests.lesson.begin = true; });
  CHECK(rig.says("begins in 1 and the stick stands in N"));
  CHECK(rig.session->coach().view().phase == LessonPhase::offered);
  DriverControls feet;
  feet.ignition = true;
  feet.clutch = 1.0;  // or the synchroniser does not let it in
  rig.session->lead({}, feet);
  const glm::dvec2 first = rest_position(rig.session->trainer().gate(), 1);
  rig.held.hand.go({first.x, 0.0});
  CHECK(rig.comes_true([&] { return std::abs(rig.session->shown().lever.x - first.x) < 0.003; }));
  rig.held.hand.go(first);
  CHECK(rig.comes_true([&] { return rig.session->shown().gear == 1; }));
  rig.ask([](PanelRequests& requests) { requests.lesson.begin = true; });
  CHECK(rig.session->coach().view().phase == LessonPhase::driving);
}
