// The panel, operated with a scripted mouse and keyboard, without a GPU.
#include <string>

#include <doctest/doctest.h>

#include "app/ui/panel/tuning_fields.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

constexpr int kTab = 258, kSpace = 32, kRight = 262, kLeft = 263, kDown = 264;

constexpr const char* kStiffness = "wall_stiffness_n_per_m";

}  // namespace

TEST_CASE("stop, arm, release, record and replay are requested once by a click on their button only") {
  PanelRig rig;
  const PanelCommands stop = rig.click("stop");
  CHECK(has<Stop>(stop));
  CHECK_FALSE(has<Arm>(stop));
  CHECK_FALSE(has<Stop>(rig.frame()));
  CHECK(has<Arm>(rig.click("arm")));
  rig.input.now.guard = GuardState::running;
  rig.frame();
  CHECK_FALSE(rig.panel.control_rect("arm").has_value());
  CHECK(has<Disarm>(rig.click("disarm")));
  CHECK(has<Stop>(rig.click("stop")));
  CHECK(has<ToggleRecording>(rig.click("record")));
  CHECK(has<ReplayLastRecording>(rig.click("replay")));
  CHECK(has<ResetView>(rig.click("reset_view")));
  CHECK_FALSE(has<ResetView>(rig.frame()));
  rig.events.mouse = {640, 300};  // the cabin
  rig.events.mouse_down[0] = true;
  CHECK_FALSE(has<Stop>(rig.frame()));
  CHECK_FALSE(rig.panel.covers({640, 300}));
}

TEST_CASE("a dragged slider requests tunings within its range, and the running loop accepts each unchanged") {
  TuningRig rig;
  for (const TuningField& field : kTuningFields) {
    CAPTURE(field.key);
    const std::vector<HapticTuning> tunings = rig.drag(std::string(field.key), 0.1, 0.6);
    for (const HapticTuning& tuning : tunings) {
      CHECK_NOTHROW(check_tuning(tuning));
      HapticConfig config = rig.input.haptics;
      config.tuning = tuning;
      CHECK(admit_tuning(config, rig.device, paper_feel()).tuning == tuning);
    }
  }
  TuningRig other;
  const std::vector<HapticTuning> tunings = other.drag(kStiffness, 0.3, 0.8);
  REQUIRE(tunings.size() > 5);
  CHECK(tunings.back().wall_stiffness == doctest::Approx(16000.0).epsilon(0.02));
}

TEST_CASE("a slider dragged over its full width never requests a wall beyond the stability limit") {
  TuningRig rig(1);  // with one cycle of delay, the quiet limit is 5375 N/m
  const std::vector<HapticTuning> tunings = rig.drag(kStiffness, 0.25, 1.0, 60);
  REQUIRE_FALSE(tunings.empty());
  double max = 0.0;
  for (const HapticTuning& tuning : tunings) max = std::max(max, tuning.wall_stiffness);
  CHECK(max <= 0.25 * kPaperAxisY.mass / (0.002 * 0.002));
  CHECK(max > 4850.0);
  CHECK(rig.input.admitted.tuning.wall_stiffness == max);  // the last stable value remains in use
  REQUIRE(rig.panel.control_rect("use_stable").has_value());
}

TEST_CASE("a rejected value can be reduced to the stable limit, or discarded") {
  TuningRig rig(1);
  rig.drag(kStiffness, 0.25, 1.0, 3);
  const double before = rig.input.admitted.tuning.wall_stiffness;
  CHECK_FALSE(has<ChangeTuning>(rig.click("keep_running")));
  CHECK_FALSE(rig.panel.control_rect("use_stable").has_value());
  CHECK(rig.input.admitted.tuning.wall_stiffness == before);
  rig.drag(kStiffness, 0.25, 1.0, 3);
  const auto asked = find<ChangeTuning>(rig.click("use_stable"));
  REQUIRE(asked);
  CHECK(asked->tuning.wall_stiffness == doctest::Approx(0.25 * kPaperAxisY.mass / 4e-6));
  CHECK_FALSE(rig.panel.control_rect("use_stable").has_value());
}

TEST_CASE("with allow_unstable an unstable value is accepted") {
  TuningRig rig(1);
  rig.input.haptics.contact.allow_unstable = true;
  rig.input.admitted = admit_tuning(rig.input.haptics, rig.device, paper_feel());
  rig.frame();
  const std::vector<HapticTuning> tunings = rig.drag(kStiffness, 0.25, 1.0, 10);
  REQUIRE_FALSE(tunings.empty());
  CHECK(tunings.back().wall_stiffness == 20000.0);
}

TEST_CASE("undo restores the tuning before the drag, redo the one after it, reset the one at the start") {
  TuningRig rig;
  const HapticTuning start = rig.input.admitted.tuning;
  rig.drag(kStiffness, 0.25, 0.5);
  const HapticTuning dragged = rig.input.admitted.tuning;
  REQUIRE_FALSE(dragged == start);
  rig.click("undo");
  CHECK(rig.input.admitted.tuning == start);
  rig.click("redo");
  CHECK(rig.input.admitted.tuning == dragged);
  rig.panel.undo();  // the program calls undo() when the undo key is pressed
  rig.frame();
  CHECK(rig.input.admitted.tuning == start);
  rig.panel.redo();
  rig.frame();
  CHECK(rig.input.admitted.tuning == dragged);
  rig.click("reset");
  CHECK(rig.input.admitted.tuning == start);
}

TEST_CASE("undo first discards a value that was not applied") {
  TuningRig rig(1);
  rig.drag(kStiffness, 0.25, 0.30);
  const HapticTuning applied = rig.input.admitted.tuning;
  rig.point(kStiffness, 0.9);
  rig.drag(kStiffness, 0.9, 0.95);
  REQUIRE(rig.panel.control_rect("use_stable").has_value());
  rig.click("undo");
  CHECK(rig.input.admitted.tuning == applied);
  CHECK_FALSE(rig.panel.control_rect("use_stable").has_value());
}

TEST_CASE("the buttons A and B switch between two tunings, each as it was left") {
  TuningRig rig;
  const HapticTuning start = rig.input.admitted.tuning;
  rig.drag(kStiffness, 0.25, 0.5);
  const HapticTuning a = rig.input.admitted.tuning;
  rig.click("slot_b");
  CHECK(rig.input.admitted.tuning == start);
  rig.drag(kStiffness, 0.25, 0.8);
  const HapticTuning b = rig.input.admitted.tuning;
  rig.click("slot_a");
  CHECK(rig.input.admitted.tuning == a);
  rig.click("slot_b");
  CHECK(rig.input.admitted.tuning == b);
}

TEST_CASE("after a tuning is changed elsewhere, the history starts again from it") {
  TuningRig rig;
  rig.drag(kStiffness, 0.25, 0.5);
  HapticTuning loaded;
  loaded.wall_stiffness = 3333.0;
  rig.input.haptics.tuning = rig.input.admitted.tuning = loaded;
  rig.frame();
  rig.panel.undo();  // there is nothing to undo
  rig.frame();
  CHECK(rig.input.admitted.tuning == loaded);
}

TEST_CASE("the panel also works if the program applies a tuning some frames late") {
  TuningRig rig;
  rig.point(kStiffness, 0.25);
  rig.frame();
  rig.events.mouse_down[0] = true;
  std::vector<HapticTuning> late;
  for (int i = 0; i < 12; ++i) {
    rig.point(kStiffness, 0.25 + 0.03 * i);
    rig.ui.feed(rig.events);
    rig.ui.begin(rig.screen);
    const auto asked = find<ChangeTuning>(rig.panel.draw(rig.input.view(rig.gate, rig.device)));
    rig.ui.end();
    if (asked) late.push_back(asked->tuning);
    if (late.size() > 3) rig.input.admitted.tuning = late[late.size() - 4];
  }
  rig.events.mouse_down[0] = false;
  rig.input.admitted.tuning = late.back();
  rig.frame();
  CHECK(value(rig.click("undo"), &ChangeTuning::tuning) == HapticTuning());  // one undo reverts the whole drag
}

TEST_CASE("gate, preset and hand are chosen from their lists") {
  PanelRig rig;
  rig.click("gate");
  CHECK(value(rig.click("gate: dog_leg_five"), &ChooseGate::name) == "dog_leg_five");
  rig.click("preset");
  CHECK(value(rig.click("preset: paper"), &ChoosePreset::name) == "paper");
  rig.click("hand");
  CHECK(value(rig.click("hand: touring"), &ChooseHand::name) == "touring");
  rig.click("gate");
  CHECK_FALSE(has<ChooseGate>(rig.click("gate: paper")));  // this gate is already selected
}

TEST_CASE("a preset is saved only under a typed name") {
  PanelRig rig;
  rig.click("tab_presets");
  CHECK_FALSE(has<SavePreset>(rig.click("save")));
  rig.click("save_name");
  const std::u32string name = U"heavy";
  rig.events.steps.assign(name.begin(), name.end());
  rig.frame();
  rig.frame();
  CHECK(value(rig.click("save"), &SavePreset::name) == "heavy");
  rig.click("compare");
  CHECK(value(rig.click("compare: paper"), &ComparePreset::name) == "paper");
}

TEST_CASE("settings that are fixed while the loop runs are collected, checked, and applied by a restart") {
  PanelRig rig;
  rig.click("tab_setup");
  CHECK_FALSE(has<Restart>(rig.click("restart")));  // no setting has changed, so there is nothing to request
  // The drag does not begin on the grab, which would keep its distance from the mouse.
  rig.drag("slew_n_per_cycle", 0.5, 0.75);
  const auto asked = find<Restart>(rig.click("restart"));
  REQUIRE(asked);
  CHECK(asked->config.guard.slew == doctest::Approx(75.0).epsilon(0.05));
  CHECK_NOTHROW(check_config(asked->config));
  rig.drag("clear_below_n", 0.1, 0.9);  // invalid, because `clear_below` now exceeds `warn_above`
  CHECK_FALSE(has<Restart>(rig.click("restart")));
  rig.click("revert");
  CHECK_FALSE(has<Restart>(rig.click("restart")));
}

TEST_CASE("the check of new settings is repeated when the device changes, even if the settings do not") {
  PanelRig rig;
  rig.device.simulated = true;
  rig.click("tab_setup");
  rig.click("study");
  REQUIRE(has<Restart>(rig.click("restart")));
  rig.device.simulated = false;  // unstable values are rejected on a real device
  CHECK_FALSE(has<Restart>(rig.click("restart")));
}

TEST_CASE("by keys only: Tab enters the panel, arrows move to STOP, Space presses it, Escape leaves the panel") {
  PanelRig rig;
  CHECK_FALSE(rig.panel.has_keyboard());
  rig.press(kRight);  // before Tab, an arrow key moves only the lever
  CHECK_FALSE(rig.panel.has_keyboard());
  rig.press(kTab);
  CHECK(rig.panel.has_keyboard());
  bool stopped = false;
  for (int i = 0; i < 6 && !stopped; ++i) {
    rig.press(kRight);
    stopped = has<Stop>(rig.press(kSpace));
  }
  CHECK(stopped);
  rig.press(kEscape);
  rig.press(kEscape);
  CHECK_FALSE(rig.panel.has_keyboard());
  rig.press(kLeft);
  CHECK_FALSE(rig.panel.has_keyboard());
}

TEST_CASE("Ctrl+Tab moves to the lists for car and gate; from there the arrows reach the tuning and change it") {
  PanelRig rig;
  rig.press(kTab);
  rig.press(kTab, true);
  for (int i = 0; i < 4; ++i) rig.press(kDown);  // moves the focus past car, gate, preset and hand to the tabs
  for (int i = 0; i < 5 && !rig.panel.control_rect("undo"); ++i) {  // moves the focus right to the tuning tab
    rig.press(kSpace);
    if (!rig.panel.control_rect("undo")) rig.press(kRight);
  }
  REQUIRE(rig.panel.control_rect("undo").has_value());
  double stiffness = 0.0;
  for (int i = 0; i < 4 && stiffness == 0.0; ++i) {  // moves the focus past the undo buttons to the first slider
    rig.press(kDown);
    rig.press(kSpace);
    const auto asked = find<ChangeTuning>(rig.press(kRight));
    if (asked) stiffness = asked->tuning.wall_stiffness;
    rig.press(kSpace);
  }
  CHECK(stiffness > 5000.0);
}

TEST_CASE("a click in the panel does not take the keyboard from the car") {
  PanelRig rig;
  rig.click("record");
  CHECK_FALSE(rig.panel.has_keyboard());
  rig.press(kDown);
  CHECK_FALSE(rig.panel.has_keyboard());
}

TEST_CASE("a hidden panel draws nothing, ignores the mouse and keeps collecting data") {
  PanelRig rig;
  const ControlRect stop = rig.rect("stop");
  rig.panel.set_visible(false);
  rig.wait(10.0);  // waits until the message over the cabin has disappeared
  CHECK_FALSE(rig.panel.control_rect("stop").has_value());
  CHECK(ImGui::GetDrawData()->TotalVtxCount == 0);
  rig.events.mouse = 0.5 * (stop.min + stop.max);
  rig.events.mouse_down[0] = true;
  CHECK_FALSE(has<Stop>(rig.frame()));
  rig.events.mouse_down[0] = false;
  rig.panel.set_visible(true);
  rig.frame();
  CHECK(has<Stop>(rig.click("stop")));
}

TEST_CASE("the help lists the text it is given, and can be closed") {
  PanelRig rig;
  const int before = ImGui::GetDrawData()->TotalVtxCount;
  rig.panel.show_help(true, "F1\thelp\n\nno tab here\n");
  for (int i = 0; i < 4; ++i) rig.frame();
  CHECK(ImGui::GetDrawData()->TotalVtxCount > before + 200);
  CHECK(rig.panel.shows_help());
  rig.panel.show_help(false, {});
  rig.frame();
  CHECK_FALSE(rig.panel.shows_help());
}
