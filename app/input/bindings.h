// Which key, button or axis does what. A TOML file says it; the shipped one is assets/bindings/default.toml.
// What the file does not name is not bound; only `stop` must have a key.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/input/axis.h"

namespace gearshift {

// Everything that input can do. Held ones act while held, others once when pressed.
enum class Action {
  // held: the hand
  lever_left,
  lever_right,
  lever_forward,
  lever_back,
  push_down,
  lift,
  // held: the car
  throttle,
  throttle_light,
  brake,
  clutch,
  clutch_hold,
  starter,
  // once
  hand_brake,
  ignition,
  arm,
  stop,
  recentre,
  full_screen,
  help,
  panel,
  next_camera,
  record,
  undo,
  redo,
  grab_mouse,
  quit
};
struct ActionInfo {
  Action action;
  std::string_view key;   // in the file: "lever_left"
  std::string_view says;  // in the help: "lever to the left"
  bool held;
};
const std::vector<ActionInfo>& all_actions();

// How a stick leads the hand.
enum class LeverMode {
  moves,  // as far as it is pushed, as fast the hand goes; let go, the hand stays. For sticks with a centring spring
  places  // where the stick is, there is the hand. For levers that stay where they are put
};

struct Bindings {
  std::map<Action, std::vector<int>> keys;  // GLFW_KEY_...
  std::map<Action, std::vector<int>> pad_buttons;
  std::string button_stick;  // a part of the name or the GUID of the sticks whose buttons these are; empty: of all
  std::optional<AxisBinding> lever_select, lever_shift, throttle, brake, clutch;
  LeverMode lever_mode = LeverMode::moves;
  double stick_speed = 0.3;       // [m/s] of the hand at full deflection, where the stick moves it
  double mouse_mm_per_px = 0.12;  // [mm] of the hand in the lever plane per pixel of the mouse
  double key_speed = 0.25;        // [m/s] of the hand while a lever key is held
  double pedal_time = 0.25;       // [s] from up to down by key
  double clutch_slip_time = 1.2;  // [s] the clutch by key, on its way up, through the part where it takes hold
};

// Throws FileError: file, line, key, value, allowed range. A key, button or axis that does two things is refused.
Bindings read_bindings(const std::filesystem::path& file);

// A file that read_bindings gives back as these. Throws FileError; then what was there before still is.
void write_bindings(const Bindings& bindings, const std::filesystem::path& file);
std::string bindings_text(const Bindings& bindings);

// Where the user's own bindings of that name are, below the folder of the user's configuration; nothing is made. Throws
// std::invalid_argument with one sentence for a name that is no file's.
std::filesystem::path own_bindings_file(const std::filesystem::path& config_folder, const std::string& name);

// What F1 shows: a line for each action that has a key, then mouse and pad; what is pressed and what it does apart by a
// tab.
std::string help_text(const Bindings& bindings);

// The first key of what drives the car, in the order of use: "clutch", "A". What has no key is left out.
struct DrivingKey {
  std::string_view does;
  std::string key;
};
std::vector<DrivingKey> driving_keys(const Bindings& bindings);

}  // namespace gearshift
