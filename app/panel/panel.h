// The engineer's and the instructor's panel, in Dear ImGui. Draws what it is given and says what was asked for: it starts,
// stops and changes nothing itself.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/coach/coach_view.h"
#include "app/headset/headset_report.h"
#include "app/panel/controls.h"
#include "app/replay/player.h"
#include "app/trainer/trainer.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift {

struct KeyHint {
  std::string does, key;  // "clutch", "A"
};

// A stick that a person holds, in place of the simulated lever.
struct StickView {
  bool plugged_in = true;
  double delay = 0.0;  // [s] measured, from a reading to the effect of the force that answers it
};

struct PanelInput {
  const Gate* gate = nullptr;          // never null in draw()
  const DeviceSpec* device = nullptr;  // never null in draw()
  HapticConfig haptics;                // in use; the tuning as wanted
  AdmittedTuning admitted;             // in use
  HapticSnapshot now;
  std::uint64_t run =
      0;  // another number: another lever, a replay or a jump in it; trajectory, plots and clipping begin anew
  std::vector<HapticSnapshot> history;  // new since the last frame
  std::vector<HapticEvent> events;      // new since the last frame; [ns] since the program's start
  LoopHealth health;
  VehicleState car;
  std::string gate_name, preset_name, hand_name, device_name;
  std::optional<StickView> stick;                  // none: simulated
  std::vector<std::string> gates, presets, hands;  // to choose from; no hands: a person's own
  std::optional<Preset> compared;  // what PanelRequests::compare asked for; nothing where it could not be read
  bool recording = false;
  std::string message;  // the last refusal or news, one sentence
  double frame_ms = 0.0;
  std::string car_name;
  std::vector<std::string> cars;  // to choose from
  CoachView coach;
  const Player* replay = nullptr;        // while one is looked at; then `now` and `car` are its
  std::string opening;                   // the file of a recorded drive that is still read; empty: none
  std::vector<KeyHint> keys;             // what drives the car, in the order of use; empty: no keys
  bool mouse_leads = false;              // the lever: the cursor is not free
  bool by_itself = false;                // the hand needs nobody: keys and mouse move nothing, nothing is remembered
  bool teacher_holds = false;            // clutch and brake, after a lesson, until the next one or none
  bool trial_lost = false;               // the one that is driven cannot be passed any more
  std::optional<HeadsetReport> headset;  // none: nobody wears one
  std::string lesson_catches;            // what the lesson is not passed with, one sentence; empty: not known
};

struct LessonRequests {
  std::optional<std::string> offer;  // a lesson's key
  bool begin = false;                // the one that is offered, or the one that is over again
  bool leave = false, put_away = false;
  std::optional<LessonMode> mode;
  std::optional<bool> help;
  std::optional<std::string> learner;  // another one, known or new; empty: nobody
  std::optional<std::string> next;     // the instructor's choice of the next lesson; empty: as suggested
  struct Comment {
    std::int64_t run = 0;
    std::string author, text;
  };
  std::optional<Comment> comment;
  struct CommentChange {
    std::int64_t run = 0, comment = 0;  // CommentRow::id
    std::optional<std::string> text;    // none: it is deleted
  };
  std::optional<CommentChange> comment_change;
};

struct ReplayRequests {
  struct Shift {
    std::string recording;
    double begin = 0.0;  // [s] on the loop's clock
  };
  std::optional<Shift> open;         // a shift of the history
  std::optional<std::size_t> shift;  // of the drive that is looked at: only that
  bool whole = false;                // all of it
  std::optional<double> seek;        // [s]
  std::optional<bool> play;
  std::optional<double> pace;
  bool close = false;  // back to the lever that runs
};

// What was asked for in this frame. The caller does it and shows refusals in PanelInput::message.
struct PanelRequests {
  bool arm = false, disarm = false, stop = false, record = false, replay = false, reset_view = false;
  std::optional<HapticTuning> tuning;             // to be applied: it has been found admissible as it is
  std::optional<HapticConfig> restart;            // to start the loop anew with: within its ranges
  std::optional<std::string> gate, preset, hand;  // to change to
  std::optional<std::string> save_preset;         // a name
  std::optional<std::string> compare;             // a preset, to be read into PanelInput::compared
  std::optional<std::string> car;                 // to change to; its gate comes with it
  LessonRequests lesson;
  ReplayRequests look;
  HeadsetRequests headset;
};

class Panel {
 public:
  Panel();
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  // Between UiContext::begin and end, as often as there is a frame.
  PanelRequests draw(const PanelInput& input);

  // Between end() and the next begin(): is a button that goes down there [px] the panel's, and is a key? They tell of the
  // panel as it was drawn last, but of the mouse where it is now; a drag that began on the panel is its own to its end.
  bool covers(glm::dvec2 mouse) const;
  bool has_keyboard() const;

  // [px] of the last draw(): what columns, bar, a replay and a lesson's card leave to the cabin.
  ControlRect middle() const noexcept;
  // [px] of the last draw(): what columns and bar leave to cabin, replay and card.
  ControlRect between() const noexcept;

  void undo();  // with the next draw()
  void redo();
  bool visible() const noexcept;
  void set_visible(bool on) noexcept;
  bool shows_help() const noexcept;
  // One binding per line, key and what it does apart by a tab.
  void show_help(bool on, const std::string& bindings_text);

  // Of the last draw(): where a control stands, for a test or a script; and how many texts had too little room.
  // The bar: "stop", "arm", "disarm", "record", "replay". The left column: "reset_view", "axis_shift", "axis_select".
  // The right one: "car", "gate", "preset", "hand", each with "gate: NAME" once it is open; "tab_lesson", "tab_history",
  // "tab_tuning", "tab_setup", "tab_loop", "tab_presets", "tab_headset" while one is worn.
  // Lessons: "learner" (Enter takes the name), "learner_known" with "learner: NAME" (none: nobody), "lesson_suggested",
  // "lesson: KEY", "next: KEY", "next_as_suggested". History: "run: ID" opens it; then "look: ID SHIFT",
  // "comment_author", "comment", "comment_add"; of each comment "comment_edit: ID" ("comment_text", "comment_save",
  // "comment_cancel"), "comment_delete: ID" (again: "comment_delete_sure").
  // The card: "lesson_begin", "mode", "help", "lesson_put_away"; "lesson_leave"; "lesson_again", "lesson_next".
  // A replay: "replay_shift: INDEX", "replay_time", "replay_play", "replay_pace: 0.1" (0.25, 0.5, 1, 2),
  // "replay_whole", "replay_close".
  // Tuning, setup: "wall_stiffness_n_per_m" and the other keys, "slot_a", "slot_b", "undo", "redo", "reset",
  // "use_stable", "keep_running", "restart", ...
  std::optional<ControlRect> control_rect(std::string_view name) const;
  int shortened_texts() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
