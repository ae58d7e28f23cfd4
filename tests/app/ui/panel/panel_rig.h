// A panel with realistic input: a simulated hand moves the lever through the paper's gate, and a scripted mouse and
// keyboard operate the panel.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <doctest/doctest.h>

#include "app/ui/panel/panel.h"
#include "engine/ui/ui.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/loop/shift_script.h"
#include "haptics/loop/simulated_run.h"
#include "tests/app/ui/panel/coach_views.h"
#include "tests/support/gates.h"

namespace gearshift::test {

inline constexpr int kEscape = 256;  // GLFW's key code

// Snapshots of a lever that is moved through the gears for `seconds` seconds: one snapshot per `step` cycles.
inline std::vector<haptics::HapticSnapshot> toured(const haptics::Gate& gate, double seconds, int step = 4) {
  haptics::SimulatedRunConfig config;
  config.gate = gate;
  config.lever.hand = haptics::kGripHand;
  config.start = haptics::rest_position(gate, haptics::kNeutralGear);
  haptics::ScriptedHand hand(haptics::touring_hand(config.start),
                             haptics::shift_strokes(gate, config.start, haptics::tour_order(gate)),
                             haptics::period_s(config.haptics));
  haptics::SimulatedRun run(config, hand);
  std::vector<haptics::HapticSnapshot> snapshots;
  for (int i = 0; run.time() < seconds; ++i) {
    const haptics::HapticSnapshot& now = run.step();
    if (i % step == 0) snapshots.push_back(now);
  }
  return snapshots;
}

// Owns what a PanelInput refers to.
struct PanelState {
  haptics::HapticConfig haptics;
  haptics::AdmittedTuning admitted;
  haptics::HapticSnapshot now;
  std::uint64_t run = 0;
  std::vector<haptics::HapticSnapshot> history;
  std::vector<haptics::HapticEvent> events;
  runtime::LoopHealth health;
  vehicle::VehicleState car;
  std::string gate_name, preset_name, hand_name, device_name;
  std::optional<ui::StickView> stick;
  std::vector<std::string> gates, presets, hands;
  std::optional<haptics::Preset> compared;
  bool recording = false;
  std::string message;
  double frame_ms = 0.0;
  std::string car_name;
  std::vector<std::string> cars;
  CoachState coach;
  const lessons::Player* replay = nullptr;
  std::string opening;
  std::vector<ui::KeyHint> keys;
  bool mouse_moves_lever = false, is_automatic_hand = false, instructor_holds_pedals = false, is_unpassable = false;
  std::optional<cabin::HeadsetReport> headset;
  ui::ControlsView controls;
  const lessons::DriveCondition* wanted = nullptr;
  int wanted_gear = haptics::kNeutralGear;
  std::vector<glm::dvec2> way;
  std::string reply;
  double held_throttle = 0.0;
  const vehicle::EngineSpec* engine = nullptr;

  ui::PanelInput view(const haptics::Gate& gate, const haptics::DeviceSpec& device) {
    return {gate,
            device,
            haptics,
            admitted,
            now,
            run,
            history,
            events,
            health,
            car,
            gate_name,
            preset_name,
            hand_name,
            device_name,
            stick,
            gates,
            presets,
            hands,
            compared ? &*compared : nullptr,
            recording,
            message,
            frame_ms,
            car_name,
            cars,
            coach.view(),
            replay,
            opening,
            keys,
            mouse_moves_lever,
            is_automatic_hand,
            instructor_holds_pedals,
            is_unpassable,
            headset ? &*headset : nullptr,
            controls,
            wanted,
            wanted_gear,
            way,
            reply,
            held_throttle,
            engine};
  }
};

template <class Command, class Asked>
void find_in(const Asked& asked, std::optional<Command>& found) {
  if constexpr (std::is_same_v<Asked, Command>)
    found = asked;
  else if constexpr (std::is_same_v<Asked, ui::PanelCommand> || std::is_same_v<Asked, ui::HeadsetCommand> ||
                     std::is_same_v<Asked, ui::ControlsCommand> || std::is_same_v<Asked, ui::DriveCommand>)
    std::visit([&](const auto& inner) { find_in(inner, found); }, asked);
}

// The newest command of this type; empty if there is none.
template <class Command>
std::optional<Command> find(const ui::PanelCommands& commands) {
  std::optional<Command> found;
  for (const ui::PanelCommand& command : commands) find_in(command, found);
  return found;
}

template <class Command>
bool has(const ui::PanelCommands& commands) {
  return find<Command>(commands).has_value();
}

// The member's value in the newest command of its type; empty if there is none.
template <class Command, class Value>
std::optional<Value> value(const ui::PanelCommands& commands, Value Command::*member) {
  const std::optional<Command> found = find<Command>(commands);
  return found ? std::optional<Value>((*found).*member) : std::nullopt;
}

struct PanelRig {
  haptics::Gate gate = paper_gate();
  haptics::DeviceSpec device;
  engine::UiContext ui;
  engine::UiInput screen;
  engine::UiEvents events;
  ui::Panel panel;
  PanelState input;
  ui::PanelCommands asked;  // commands of the newest frame

  explicit PanelRig(int delay = 0) {
    device.simulated = true;
    device.delay = delay;
    device.workspace = kPaperWorkspace;
    input.admitted = haptics::admit_tuning(input.haptics, device, paper_feel());
    input.gate_name = "paper";
    input.gates = {"paper", "four_speed", "dog_leg_five"};
    input.preset_name = "default";
    input.presets = {"default", "measured", "paper"};
    input.hand_name = "mouse and keys";
    input.hands = {"mouse and keys", "touring"};
    input.device_name = "simulated lever";
    input.car_name = "hatchback";
    input.cars = {"hatchback", "diesel"};
    input.health.rate = 1000.0;
    input.message = "Ready.";
    frame();
    frame();  // a control has a position after two frames
  }

  // Draws one frame of the panel, and applies a requested tuning as the session does.
  const ui::PanelCommands& frame() {
    ui.feed(events);
    events.steps.clear();
    ui.begin(screen);
    asked = panel.draw(input.view(gate, device));
    ui.end();
    input.history.clear();
    input.events.clear();
    if (const auto change = find<ui::ChangeTuning>(asked)) {
      haptics::HapticConfig wanted = input.haptics;
      wanted.tuning = change->tuning;
      wanted.contact.hold = input.admitted.hold;
      input.admitted = haptics::admit_tuning(wanted, device, paper_feel());
      input.haptics.tuning = change->tuning;
    }
    return asked;
  }

  void wait(double seconds) {
    const float usual = std::exchange(screen.seconds, static_cast<float>(seconds));
    frame();
    screen.seconds = usual;
    frame();
  }

  ui::ControlRect rect(const std::string& name) const {
    const auto found = panel.control_rect(name);
    REQUIRE_MESSAGE(found.has_value(), name << " is not on the screen");
    return *found;
  }
  void point(const std::string& name, double fraction = 0.5) {
    const ui::ControlRect r = rect(name);
    events.mouse = {r.min.x + fraction * (r.max.x - r.min.x), 0.5 * (r.min.y + r.max.y)};
  }

  // Clicks a control, and returns all commands of the frames of the click.
  ui::PanelCommands click(const std::string& name) {
    point(name);
    frame();
    events.mouse_down[0] = true;
    ui::PanelCommands all = frame();
    events.mouse_down[0] = false;
    merge(all, frame());
    merge(all, frame());
    return all;
  }
  // Drags a slider from `from` to `to`, as fractions of its width. Returns every tuning that was requested during the
  // drag.
  std::vector<haptics::HapticTuning> drag(const std::string& name, double from, double to, int steps = 10) {
    std::vector<haptics::HapticTuning> tunings;
    const auto look = [&] {
      frame();
      if (const auto change = find<ui::ChangeTuning>(asked)) tunings.push_back(change->tuning);
    };
    point(name, from);
    look();
    events.mouse_down[0] = true;
    for (int i = 0; i <= steps; ++i) {
      point(name, from + (to - from) * i / steps);
      look();
    }
    events.mouse_down[0] = false;
    look();
    look();
    return tunings;
  }
  ui::PanelCommands press(int key, bool control = false) {
    constexpr int kLeftControl = 341;  // GLFW_KEY_LEFT_CONTROL
    events.steps = {engine::UiKey{key, true}};
    if (control) events.steps.insert(events.steps.begin(), engine::UiKey{kLeftControl, true});
    ui::PanelCommands all = frame();
    merge(all, frame());
    events.steps = {engine::UiKey{key, false}};
    merge(all, frame());
    events.steps = {engine::UiKey{kLeftControl, false}};
    merge(all, frame());
    return all;
  }

  static void merge(ui::PanelCommands& all, const ui::PanelCommands& next) {
    all.insert(all.end(), next.begin(), next.end());
  }
};

// A rig with the tuning tab open.
struct TuningRig : PanelRig {
  explicit TuningRig(int delay = 0) : PanelRig(delay) { click("tab_tuning"); }
};

}  // namespace gearshift::test
