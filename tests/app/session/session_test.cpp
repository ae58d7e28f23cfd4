// The user's commands at the panel. Tested on the virtual clock, without window, GPU or sound card.
#include "app/session/session.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "app/base/program_name.h"
#include "app/vehicle/car_load.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "tests/support/memory_in_use.h"
#include "tests/support/short_trace.h"
#include "tests/support/small_files.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift::base;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;
using namespace gearshift::vehicle;
namespace fs = std::filesystem;

namespace {

// An empty user folder, and a session whose automatic hand moves the lever through the paper's gate.
struct Rig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Variable data{"XDG_DATA_HOME", folder.path().c_str()};
  Session session;

  explicit Rig(const SessionChoice& choice = choice_by_itself()) : session(choice) {}

  static SessionChoice choice_by_itself() {
    SessionChoice choice;
    choice.hand = kAutomaticHand;
    choice.clock = RuntimeClock::virtual_time;
    choice.sound = SoundOutput::none;
    choice.gate = "paper";
    return choice;
  }

  void go(double seconds) {
    for (double time = 0.0; time < seconds; time += 1.0 / 60.0) session.advance(1.0 / 60.0);
  }
  bool says(const std::string& words) const { return session.message().find(words) != std::string::npos; }
  HapticTuning tuning() { return session.runtime().config().preset.haptics.tuning; }

  std::set<fs::path> traces() const {
    std::set<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder / "gearshift/recordings", error), end; entry != end; ++entry)
      files.insert(entry->path());
    return files;
  }
  fs::path own_preset(const std::string& name) const { return folder / ("gearshift/presets/" + name + ".toml"); }
};

HapticTuning softer(HapticTuning tuning) {
  tuning.wall_stiffness = 4321.0;
  return tuning;
}

bool has_node(const Session& session, const std::string& name) {
  return session.stage().model().node(name) != kNone;
}

}  // namespace

TEST_CASE("a change of gate or hand keeps the tuning; a chosen preset brings its own") {
  Rig rig;
  rig.session.apply(ChangeTuning{softer(rig.tuning())});
  rig.session.apply(ChooseGate{"four_speed"});
  CHECK(rig.tuning().wall_stiffness == 4321.0);
  rig.session.apply(ChooseHand{"grip"});
  CHECK(rig.tuning().wall_stiffness == 4321.0);
  rig.session.apply(ChoosePreset{"measured"});
  CHECK(rig.tuning() == read_preset(GEARSHIFT_ASSETS "/presets/measured.toml").haptics.tuning);
}

TEST_CASE("commands are executed in their order, and a rejected one is reported without stopping the others") {
  Rig rig;
  rig.session.apply(PanelCommands{ChooseGate{"four_speed"}, ChooseHand{"grip"}, ChooseGate{"no_such_gate"},
                                  SavePreset{"a/b"}, ChooseGate{"dog_leg_five"}, ChangeTuning{softer(rig.tuning())}});
  CHECK(rig.session.panel_input().gate_name == "dog_leg_five");
  CHECK(rig.session.panel_input().hand_name == "grip");
  CHECK(rig.tuning().wall_stiffness == 4321.0);
  CHECK(rig.says("no_such_gate"));
  CHECK(rig.says("is not a valid preset name"));
  rig.session.apply(ChooseGate{"paper"});
  CHECK(rig.session.message().empty());
}

TEST_CASE("STOP comes before the other commands, whatever becomes of them") {
  Rig rig;
  rig.go(2.0);
  REQUIRE(rig.session.runtime().snapshot().guard == GuardState::running);
  rig.session.apply(PanelCommands{ChooseGate{"no_such_gate"}, ChooseGate{"four_speed"}, Stop{}});
  rig.go(2.0);
  CHECK(rig.session.panel_input().gate_name == "four_speed");
  CHECK(rig.session.runtime().snapshot().guard == GuardState::idle);  // the new lever's forces were never on
  rig.session.apply(PanelCommands{Stop{}, Arm{}});
  rig.go(2.0);
  CHECK(rig.session.runtime().snapshot().guard == GuardState::running);
  rig.session.apply(PanelCommands{Arm{}, Stop{}});
  rig.go(2.0);
  CHECK(rig.session.runtime().snapshot().guard == GuardState::released);
  rig.session.apply(Disarm{});
  rig.go(1.0);
  rig.session.apply(PanelCommands{Arm{}, ChooseGate{"paper"}, Stop{}});
  rig.go(2.0);
  CHECK(rig.session.runtime().snapshot().guard == GuardState::idle);
  rig.session.apply(PanelCommands{Arm{}, Stop{}});
  rig.go(2.0);
  CHECK(rig.session.runtime().snapshot().guard == GuardState::idle);  // an arming before STOP is cancelled
}

TEST_CASE("a change of hand also keeps a restart's configuration and the tuning after it") {
  Rig rig;
  Restart restart{rig.session.runtime().config().preset.haptics};
  restart.config.guard.ramp_time = 0.25;
  rig.session.apply(restart);
  rig.session.apply(ChangeTuning{softer(rig.tuning())});
  rig.session.apply(ChooseHand{"arm"});
  CHECK(rig.session.runtime().config().preset.haptics.guard.ramp_time == 0.25);
  CHECK(rig.tuning().wall_stiffness == 4321.0);
}

TEST_CASE("a failed recording is reported in the same frame, and has ended") {
  Rig rig;
  {
    const SmallFiles small(60'000);  // [bytes] room to record a few tenths of a second
    rig.session.apply(ToggleRecording{});
    CHECK(rig.says("recording to"));
    rig.go(3.0);
  }
  CHECK(rig.says("the recording failed after"));
  CHECK_FALSE(rig.session.recording());
  CHECK_FALSE(rig.session.panel_input().recording);
}

TEST_CASE("a change of gate ends the recording and reports where the file is, or how it failed") {
  Rig rig;
  rig.session.apply(ToggleRecording{});
  rig.go(0.5);
  rig.session.apply(ChooseGate{"four_speed"});
  CHECK_FALSE(rig.session.recording());
  CHECK(rig.says("recorded: "));
  REQUIRE(rig.traces().size() == 1);
  const Trace trace = read_trace(*rig.traces().begin());
  CHECK(replay(trace, make_car_load).bit_for_bit());
  CHECK(trace.header.program == program_name());
  {
    // [bytes] More than the trace's header and less than one of its blocks, so the write fails only when the file is
    // closed.
    const SmallFiles small(10'000);
    rig.session.apply(ToggleRecording{});
    rig.go(0.1);
    rig.session.apply(ChooseGate{"paper"});
  }
  CHECK(rig.says("the recording failed after"));
}

TEST_CASE("two recordings within a second are two complete files") {
  Rig rig;
  for (int i = 0; i < 4; ++i) {
    rig.session.apply(ToggleRecording{});
    rig.go(0.1);
  }
  REQUIRE(rig.traces().size() == 2);
  for (const fs::path& file : rig.traces()) CHECK(replay(read_trace(file), make_car_load).bit_for_bit());
}

TEST_CASE("a replay shows the trace's cycles in order, each once, and the running lever's guard") {
  Rig rig;
  rig.go(1.0);
  rig.session.apply(ToggleRecording{});
  rig.go(2.0);
  rig.session.apply(ToggleRecording{});
  const Trace trace = read_trace(*rig.traces().begin());
  rig.go(1.0);
  rig.session.apply(ReplayLastRecording{});
  REQUIRE(rig.says("replaying"));
  rig.session.apply(Stop{});
  std::vector<std::uint64_t> cycles;
  std::size_t events = 0;
  for (int i = 0; i < 60; ++i) {
    rig.session.advance(1.0 / 60.0);
    const PanelInput input = rig.session.panel_input();
    for (const HapticSnapshot& snapshot : input.history) {
      cycles.push_back(snapshot.cycle);
      REQUIRE(snapshot.time_ns <= trace.samples.back().out.time_ns);
    }
    REQUIRE_FALSE(input.history.empty());
    CHECK(input.now.time_ns == input.history.back().time_ns);
    CHECK(input.now.guard == GuardState::released);
    events += input.events.size();
  }
  REQUIRE(cycles.size() > 235);
  // The panel's history has one snapshot per 4 ms, i.e. per four cycles at 1 kHz.
  for (std::size_t i = 1; i < cycles.size(); ++i) REQUIRE(cycles[i] == cycles[i - 1] + 4);
  CHECK(events == 0);
  rig.go(1.5);
  // The replay stops at the trace's end.
  CHECK(rig.session.panel_input().now.time_ns == trace.samples.back().out.time_ns);
  rig.session.apply(CloseReplay{});
  rig.go(0.1);
  CHECK(rig.session.panel_input().now.time_ns > trace.samples.back().out.time_ns);
  for (const HapticSnapshot& snapshot : rig.session.panel_input().history)
    CHECK(snapshot.time_ns > trace.samples.back().out.time_ns);
}

TEST_CASE("a trace is shown in the gate of its recording, and a change of gate ends the replay") {
  Rig rig;
  rig.session.apply(ToggleRecording{});
  rig.go(1.0);
  rig.session.apply(ToggleRecording{});
  rig.session.apply(ReplayLastRecording{});
  rig.go(0.1);
  const glm::dvec2 shown = rig.session.shown().lever;
  rig.session.apply(ChooseGate{"four_speed"});
  rig.session.advance(1.0 / 60.0);
  // The replay has ended, so the panel gets the running lever's events, for example that it was armed.
  CHECK_FALSE(rig.session.panel_input().events.empty());
  CHECK(rig.session.panel_input().gate.slot_count == 5);
  (void)rig.session.take_new_model();
  rig.session.apply(ReplayLastRecording{});
  CHECK(rig.session.take_new_model());
  CHECK(rig.session.panel_input().gate.slot_count == 6);
  rig.go(0.1);
  CHECK(rig.session.shown().lever == shown);
  rig.session.apply(CloseReplay{});
  CHECK(rig.session.take_new_model());
  CHECK(rig.session.panel_input().gate.slot_count == 5);
}

TEST_CASE("if the preset to compare with is unreadable, nothing is compared, and a message says so") {
  Rig rig;
  rig.session.apply(ComparePreset{"measured"});
  CHECK(rig.session.panel_input().compared != nullptr);
  rig.session.apply(ComparePreset{"no_such_preset"});
  CHECK(rig.session.panel_input().compared == nullptr);
  CHECK(rig.says("no_such_preset"));
}

TEST_CASE("a preset is saved under the user's name and is listed at once, only once") {
  Rig rig;
  for (const char* name : {"", ".", "..", ".hidden", "a/b", "../x", "default", "paper"}) {
    CAPTURE(name);
    rig.session.apply(SavePreset{name});
    CHECK(rig.says("is not a valid preset name"));
  }
  CHECK_FALSE(fs::exists(rig.folder / "gearshift/presets"));
  rig.session.apply(SavePreset{(rig.folder / "x").string()});
  CHECK_FALSE(fs::exists(rig.folder / "x.toml"));
  rig.session.apply(SavePreset{"heavy"});
  rig.session.apply(SavePreset{"heavy"});
  CHECK(fs::exists(rig.own_preset("heavy")));
  const auto presets = rig.session.panel_input().presets;
  CHECK(std::ranges::equal(presets, std::array{"default", "measured", "paper", "heavy"}));
}

TEST_CASE("a file named like a shipped preset neither replaces it nor is listed twice") {
  Rig rig;
  rig.session.apply(ChangeTuning{softer(rig.tuning())});
  rig.session.apply(SavePreset{"heavy"});
  fs::rename(rig.own_preset("heavy"), rig.own_preset("measured"));
  Session other(Rig::choice_by_itself());
  const auto presets = other.panel_input().presets;
  CHECK(std::count(presets.begin(), presets.end(), "measured") == 1);
  rig.session.apply(ChoosePreset{"measured"});
  CHECK(rig.tuning().wall_stiffness != 4321.0);
}

TEST_CASE("the stage is created again only for a different gate or yoke") {
  Rig rig;
  CHECK(rig.session.take_new_model());
  rig.session.apply(ChooseHand{"grip"});
  rig.session.apply(ChoosePreset{"measured"});
  CHECK_FALSE(rig.session.take_new_model());
  rig.session.apply(ChooseGate{"four_speed"});
  CHECK(rig.session.take_new_model());
  const fs::path wide = rig.folder / "wide.toml";
  std::ofstream(wide) << "name = \"wide\"\n[lever.yoke]\nradius_m = 0.15\n[lever]\nhand = \"grip\"\n";
  rig.session.apply(ChoosePreset{wide.string()});
  CHECK(rig.session.runtime().device().yoke_radius == 0.15);
  CHECK(rig.session.take_new_model());
}

TEST_CASE("the cameras that look into the mechanism open the cabin") {
  SessionChoice choice = Rig::choice_by_itself();
  choice.camera = "gearbox";
  Rig rig(choice);
  CHECK(has_node(rig.session, "GearboxSigns"));
  rig.session.take_new_model();
  rig.session.set_camera("driver");
  CHECK(rig.session.take_new_model());
  CHECK_FALSE(has_node(rig.session, "GearboxSigns"));
  rig.session.set_camera("lever");
  CHECK_FALSE(rig.session.take_new_model());
  const std::uint64_t closed = rig.session.stage().model().triangle_count();
  rig.session.set_camera("gate");
  CHECK(rig.session.take_new_model());
  CHECK(rig.session.stage().model().triangle_count() != closed);
  rig.session.apply(ChooseGate{"four_speed"});  // the gearbox is cut open in the new stage too
  rig.session.set_camera("gate");
  CHECK(rig.session.take_new_model());
  CHECK_FALSE(rig.session.take_new_model());
}

TEST_CASE("repeated changes of gate do not increase a session's memory") {
  Rig rig;
  const auto there_and_back = [&](int times) {
    for (int i = 0; i < times; ++i) {
      for (const char* gate : {"six_speed_r_left_up", "four_speed"}) {
        rig.session.apply(ChooseGate{gate});
        rig.go(0.1);
      }
    }
    return memory_in_use();
  };
  const std::size_t once = there_and_back(2), often = there_and_back(6);
  CHECK(often < once + 65'536);
}
