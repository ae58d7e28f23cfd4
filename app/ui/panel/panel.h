// The engineer's and the instructor's panel, in Dear ImGui. It draws its input and returns the user's commands; it
// starts, stops and changes nothing itself.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "app/cabin/headset/headset_report.h"
#include "app/lessons/assessment/lesson.h"
#include "app/lessons/coach/coach_view.h"
#include "app/lessons/replay/player.h"
#include "app/runtime/runtime.h"
#include "app/ui/input/controls_setup.h"
#include "app/ui/panel/commands.h"
#include "app/ui/panel/controls.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift::ui {

struct KeyHint {
  std::string action, key;  // "clutch", "A"
};

// The displays around the cabin: only the lesson card; those that a learner needs; all of them, with all controls.
enum class PanelView { hidden, learner, engineer };

// State of a physical stick that is used instead of the simulated lever.
struct StickView {
  bool plugged_in = true;
  double delay = 0.0;  // [s] measured time from a reading to the effect of the force computed from it
};

// Controllers without force feedback.
struct ControlsView {
  const ControlsSetup* setup = nullptr;                  // being done; null: none
  std::span<const engine::Controller> controllers = {};  // that can be set up
  std::span<const std::string> offers = {};              // names of controllers that have no effect yet
  std::string_view request = {};                         // what to do with a shifter; empty: nothing
};

// The state that the panel shows. It refers to everything that is larger than a few words, so that a frame copies
// none of it: the caller changes nothing until draw() returns.
struct PanelInput {
  const haptics::Gate& gate;
  const haptics::DeviceSpec& device;
  const haptics::HapticConfig& haptics;     // configuration in use, but with the requested tuning
  const haptics::AdmittedTuning& admitted;  // tuning in use
  const haptics::HapticSnapshot& now;
  // Changes if the lever is replaced, a replay starts or ends, or a replay jumps in time. The panel then clears
  // trajectory, plots and clipping display.
  std::uint64_t run;
  std::span<const haptics::HapticSnapshot> history;  // snapshots since the last frame
  std::span<const haptics::HapticEvent> events;      // events since the last frame; [ns] since the program's start
  const runtime::LoopHealth& health;
  const vehicle::VehicleState& car;
  std::string_view gate_name, preset_name, hand_name, device_name;
  std::optional<StickView> stick;                      // physical stick; none: the lever is simulated
  std::span<const std::string> gates, presets, hands;  // choices; `hands` is empty if a real hand moves the lever
  const haptics::Preset* compared;  // preset named by ComparePreset; null if there is none, or it is unreadable
  bool recording;
  std::string_view message;  // the last message, one sentence
  double frame_ms;
  std::string_view car_name;
  std::span<const std::string> cars;  // available choices
  const lessons::CoachView& coach;
  const lessons::Player* replay;        // not null during a replay; `now` and `car` then come from it
  std::string_view opening;             // file name of a recorded drive that is still loading; empty: none
  std::span<const KeyHint> keys;        // keys that drive the car, in the order of use; may be empty
  bool mouse_moves_lever;               // the mouse is captured and moves the lever
  bool is_automatic_hand;               // a simulated hand drives: keys and mouse do nothing, nothing is saved
  bool instructor_holds_pedals;         // true after a lesson, until the next lesson or the Close button
  bool is_unpassable;                   // the current run can no longer be passed
  const cabin::HeadsetReport* headset;  // null: no headset in use
  ControlsView controls{};
  // The condition that ends the lesson's present step; null: nothing is prompted. `way` [m]: from the lever to the gear in the gate's
  // plane; empty: no gear is wanted, or it is engaged.
  const lessons::DriveCondition* wanted = nullptr;
  int wanted_gear = haptics::kNeutralGear;
  std::span<const glm::dvec2> way{};
  std::string_view reply{};    // answer to a key that came too early: "Ignition first: I."; may be empty
  double held_throttle = 0.0;  // [1] where the keys hold the throttle
  const vehicle::EngineSpec* engine = nullptr;  // null: no car
};
static_assert(std::is_trivially_copyable_v<PanelInput>);

class Panel {
 public:
  Panel();
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  // Call once per frame, between UiContext::begin and end. The caller executes the commands and shows problems in
  // PanelInput::message.
  PanelCommands draw(const PanelInput& input);

  // Call between UiContext::end and the next UiContext::begin. covers(): true if a mouse press at this place [px] goes
  // to the panel as last drawn. has_keyboard(): true if a key press goes to the panel. A drag that began on the panel
  // belongs to the panel until the button is released.
  bool covers(glm::dvec2 mouse) const;
  bool has_keyboard() const;

  // The area [px] that columns, status bar, replay bar and lesson card leave free for the cabin, as of the last draw().
  ControlRect cabin_area() const noexcept;
  // The area [px] between columns and status bar, for cabin, replay bar and lesson card, as of the last draw().
  ControlRect central_area() const noexcept;

  void undo();  // takes effect in the next draw()
  void redo();
  bool visible() const noexcept { return view() != PanelView::hidden; }
  void set_visible(bool on) noexcept;  // shows the view that was shown last, at first the engineer's
  PanelView view() const noexcept;
  void set_view(PanelView view) noexcept;
  void toggle_lessons() noexcept;  // lessons and history beside the learner's view
  bool shows_help() const noexcept;
  // bindings_text: one binding per line, with a tab between key and action.
  void show_help(bool on, const std::string& bindings_text);

  // For tests and scripts, as of the last draw(): the place of a named control, and how many texts did not fit. Names:
  // Learner's view: "pedal_clutch", "pedal_brake", "pedal_throttle", "gate", "hand_brake", "ignition", "starter",
  // "lessons", "view", "arm", "disarm", "stop".
  // Bar: "stop", "arm", "disarm", "record", "replay". Left column: "reset_view", "axis_shift", "axis_select".
  // Right column: the lists "car", "gate", "preset" and "hand"; while a list is open, also its entries, for example
  // "gate: NAME"; "tab_lesson", "tab_history", "tab_tuning", "tab_setup", "tab_loop", "tab_presets", and "tab_headset"
  // while a headset is in use.
  // Setting up controllers: "controls_setup" in the right column; "setup_begin", "setup_decline"; "setup_done",
  // "setup_skip", "setup_back", "setup_gears", "setup_paddles", "setup_lever", "setup_other", "setup_stays",
  // "setup_returns", "setup_save", "setup_cancel".
  // Lessons: "learner" (Enter applies the name), "learner_known" with "learner: NAME" (empty name: no learner),
  // "lesson_suggested", "lesson: KEY", "next: KEY", "next_as_suggested". History: "run: ID" opens it; then
  // "look: ID SHIFT", "comment_author", "comment", "comment_add"; per comment "comment_edit: ID" ("comment_text",
  // "comment_save", "comment_cancel"), "comment_delete: ID" (then "comment_delete_sure").
  // Card: "lesson_begin", "mode", "help", "lesson_dismiss"; "lesson_leave"; "lesson_again", "lesson_next".
  // Replay: "replay_shift: INDEX", "replay_time", "replay_play", "replay_pace: 0.1" (0.25, 0.5, 1, 2),
  // "replay_whole", "replay_close".
  // Tuning, setup: "wall_stiffness_n_per_m" and the other keys, "slot_a", "slot_b", "undo", "redo", "reset",
  // "use_stable", "keep_running", "restart", "revert", ...
  std::optional<ControlRect> control_rect(std::string_view name) const;
  int shortened_texts() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::ui
