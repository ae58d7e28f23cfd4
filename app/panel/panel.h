// The engineer's and the instructor's panel, in Dear ImGui. Draws what it is given and says what was asked for: it starts,
// stops and changes nothing itself.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/panel/controls.h"
#include "app/trainer/trainer.h"
#include "app/vehicle/vehicle_state.h"

namespace gearshift {

struct PanelInput {
  const Gate* gate = nullptr;          // never null in draw()
  const DeviceSpec* device = nullptr;  // never null in draw()
  HapticConfig haptics;                // in use; the tuning as wanted
  AdmittedTuning admitted;             // in use
  HapticSnapshot now;
  std::uint64_t run = 0;                // another number: another lever, or a replay; its trajectory begins anew
  std::vector<HapticSnapshot> history;  // new since the last frame
  std::vector<HapticEvent> events;      // new since the last frame; [ns] since the program's start
  LoopHealth health;
  VehicleState car;
  std::string gate_name, preset_name, hand_name, device_name;
  std::vector<std::string> gates, presets, hands;  // to choose from
  std::optional<Preset> compared;  // what PanelRequests::compare asked for; nothing where it could not be read
  bool recording = false;
  std::string message;  // the last refusal or news, one sentence
  double frame_ms = 0.0;
};

// What was asked for in this frame. The caller does it and shows refusals in PanelInput::message.
struct PanelRequests {
  bool arm = false, disarm = false, stop = false, record = false, replay = false, reset_view = false;
  std::optional<HapticTuning> tuning;             // to be applied: it has been found admissible as it is
  std::optional<HapticConfig> restart;            // to start the loop anew with: within its ranges
  std::optional<std::string> gate, preset, hand;  // to change to
  std::optional<std::string> save_preset;         // a name
  std::optional<std::string> compare;             // a preset, to be read into PanelInput::compared
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

  ControlRect middle() const noexcept;  // [px] of the last draw(): what the panel leaves to the cabin

  void undo();  // with the next draw()
  void redo();
  bool visible() const noexcept;
  void set_visible(bool on) noexcept;
  bool shows_help() const noexcept;
  // One binding per line, key and what it does apart by a tab.
  void show_help(bool on, const std::string& bindings_text);

  // Of the last draw(): where a control stands, for a test or a script; and how many texts had too little room.
  // "stop", "arm", "disarm", "record", "replay", "gate", "gate: NAME", "reset_view", "undo", "redo", "reset", "slot_b", "tab_loop",
  // "wall_stiffness_n_per_m" and the other keys of the tuning, "use_stable", "keep_running", "restart", ...
  std::optional<ControlRect> control_rect(std::string_view name) const;
  int shortened_texts() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
