// Bindings of keys, buttons and axes, read from a TOML file; the shipped file is assets/bindings/default.toml. An
// action that is missing from the file is not bound. Only `stop` must have a key.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/input/axis.h"
#include "app/vehicle/car_spec.h"

namespace gearshift::ui {

// A held action acts as long as its key is held; any other action acts once per key press.
enum class Action {
  // held actions that move the hand
  lever_left,
  lever_right,
  lever_forward,
  lever_back,
  push_down,
  lift,
  // held actions that control the car
  throttle,
  throttle_light,
  brake,
  clutch,
  clutch_hold,
  starter,
  hand_brake_hold,
  // actions performed once per key press
  throttle_more,
  throttle_less,
  hand_brake,
  shift_up,
  shift_down,
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
  free_mouse,
  lessons,
  quit
};
struct ActionInfo {
  Action action;
  std::string_view key;   // name in the bindings file: "lever_left"
  std::string_view help;  // text in the help window: "move the lever left"
  bool held;
};
const std::vector<ActionInfo>& all_actions();

enum class LeverMode {
  moves,   // for self-centring sticks: deflection sets the hand's speed, so the hand stops when the stick is released
  places,  // for levers that stay in place when released: deflection sets the hand's position
  steps    // for sequential levers that spring back: each pull shifts one gear up, each push one gear down
};
constexpr const char* file_key(LeverMode mode) noexcept {
  constexpr const char* kKeys[] = {"moves", "places", "steps"};
  return kKeys[static_cast<std::size_t>(mode)];
}
constexpr LeverMode last_value(LeverMode) noexcept {
  return LeverMode::steps;
}

// "gear_reverse", "gear_neutral", "gear_1", ...
std::string gear_key(int gear);

// The buttons of one controller.
struct ControllerButtons {
  ControllerName of{};
  int which = 0;  // index among the controllers of this name, as AxisBinding::which
  std::map<Action, std::vector<int>> actions{};
  // Buttons that are held while the controller's own lever is in a gear. Some shifters also have one for neutral.
  std::map<int, std::vector<int>> gears{};
};

// How sticks move the hand.
struct StickMotion {
  LeverMode mode = LeverMode::moves;
  double speed = 0.3;  // [m/s] hand speed at full deflection of the stick, with LeverMode::moves
};

// How fast mouse and keys move the hand.
struct HandPace {
  double mouse_mm_per_px = 0.12;  // [mm] hand motion in the lever plane per mouse pixel
  double key_speed = 0.25;        // [m/s] hand speed while a lever key is held
};

struct Bindings {
  std::map<Action, std::vector<int>> keys;         // GLFW_KEY_...
  std::map<Action, std::vector<int>> pad_buttons;  // GLFW_GAMEPAD_BUTTON_... of any game pad
  std::vector<ControllerButtons> controllers;
  std::optional<AxisBinding> clutch, brake, throttle, hand_brake, lever_select, lever_shift;
  StickMotion lever;
  HandPace pace;
  vehicle::PedalTiming pedal_timing;  // of the pedals that keys press
};

// The controls that an axis can move.
struct AxisInfo {
  std::string_view key;  // name in the bindings file
  std::optional<AxisBinding> Bindings::*axis;
  bool is_lever;          // otherwise a pedal, or the handbrake
  std::string_view help;  // text in the help window
  std::string_view prompt;
  std::array<std::optional<Action>, 3> actions{};  // by which keys and buttons move the same control
};
inline constexpr AxisInfo kAxes[] = {{"clutch",
                                      &Bindings::clutch,
                                      false,
                                      "clutch",
                                      "Press the CLUTCH pedal all the way down, then release it.",
                                      {Action::clutch}},
                                     {"brake",
                                      &Bindings::brake,
                                      false,
                                      "brake",
                                      "Press the BRAKE pedal all the way down, then release it.",
                                      {Action::brake}},
                                     {"throttle",
                                      &Bindings::throttle,
                                      false,
                                      "throttle",
                                      "Press the THROTTLE pedal all the way down, then release it.",
                                      {Action::throttle_more, Action::throttle, Action::throttle_light}},
                                     {"hand_brake",
                                      &Bindings::hand_brake,
                                      false,
                                      "handbrake",
                                      "Pull the HANDBRAKE all the way, then release it.",
                                      {Action::hand_brake_hold, Action::hand_brake}},
                                     {"lever_select",
                                      &Bindings::lever_select,
                                      true,
                                      "move the lever sideways",
                                      "Move the LEVER to the left, then to the right, and let go.",
                                      {Action::lever_left, Action::lever_right}},
                                     {"lever_shift",
                                      &Bindings::lever_shift,
                                      true,
                                      "move the lever forward and back",
                                      "Move the LEVER back, then forward, and let go.",
                                      {Action::lever_forward, Action::lever_back}}};

// Throws FileError, which names file, line, key, value and allowed range. Each key and each button may have only one
// action; ranges of an axis that are bound to different actions must not overlap.
Bindings read_bindings(const std::filesystem::path& file);
Bindings parse_bindings(std::string_view text, const std::string& file_name);

// Writes a file that read_bindings() reads back unchanged. If the function throws FileError, an existing file is
// unchanged.
void write_bindings(const Bindings& bindings, const std::filesystem::path& file);
std::string bindings_text(const Bindings& bindings);

// Path of the user's bindings file for `name`, below the user's configuration folder; creates nothing. Throws
// std::invalid_argument with one sentence if the name cannot be a file name.
std::filesystem::path user_bindings_file(const std::filesystem::path& config_folder, const std::string& name);

// Names of the keys, buttons and axes that are bound to an action or move a control: "A", "Pad LB", "G29 axis 1". Game
// pads have the names that are printed on the first of them.
std::vector<std::string> bound_inputs(const Bindings& bindings, Action action,
                                      const std::vector<engine::Controller>& all);
std::vector<std::string> bound_inputs(const Bindings& bindings, const AxisInfo& control,
                                      const std::vector<engine::Controller>& all);

// Returns the text of the help window (F1): one line per bound action, then lines for mouse and controllers. A tab
// separates the input from the action.
std::string help_text(const Bindings& bindings, const std::vector<engine::Controller>& all);

// The kind of device that the driver used last.
enum class DeviceAtHand { keyboard, pad, controller };

// A driving action and what performs it on the device at hand, as the device prints it: "clutch" and "A", or "LB".
struct DrivingKey {
  std::string_view action;
  std::string key;
};
// Returns them in the order in which the legend shows them. Actions that the device at hand does not have keep their keys;
// those without a key are left out, and so are pedals of a wheel, which have their names.
std::vector<DrivingKey> driving_keys(const Bindings& bindings, DeviceAtHand at_hand = DeviceAtHand::keyboard,
                                     const std::vector<engine::Controller>& all = {});

}  // namespace gearshift::ui

namespace gearshift::haptics {

template <>
inline constexpr Parameter<ui::StickMotion, ui::LeverMode> kParameters<ui::StickMotion>[] = {
    {&ui::StickMotion::mode, "mode", "mode", FileRange{}, "How the axes of a stick move the hand."},
    {&ui::StickMotion::speed, "speed", "full_speed_m_per_s", FileRange{0.01, 2.0},
     "Speed of the hand at full deflection."},
};
static_assert(DescribesAll<ui::StickMotion>);

template <>
inline constexpr Parameter<ui::HandPace> kParameters<ui::HandPace>[] = {
    {&ui::HandPace::mouse_mm_per_px, "mouse_mm_per_px", "mouse_mm_per_px", FileRange{0.005, 5.0},
     "Motion of the hand per pixel of the mouse."},
    {&ui::HandPace::key_speed, "key_speed", "lever_key_m_per_s", FileRange{0.01, 2.0},
     "Speed of the hand while a key moves it."},
};
static_assert(DescribesAll<ui::HandPace>);

}  // namespace gearshift::haptics
