// The table of input actions: names in files and texts in the help window.
#include "app/ui/input/bindings.h"

namespace gearshift::ui {

const std::vector<ActionInfo>& all_actions() {
  static const std::vector<ActionInfo> actions = {
      {Action::lever_left, "lever_left", "move the lever left", true},
      {Action::lever_right, "lever_right", "move the lever right", true},
      {Action::lever_forward, "lever_forward", "move the lever forward", true},
      {Action::lever_back, "lever_back", "move the lever back", true},
      {Action::push_down, "push_down", "push the knob down, or hold the reverse button", true},
      {Action::lift, "lift", "hold the lift ring up", true},
      {Action::throttle, "throttle", "full throttle while held", true},
      {Action::throttle_light, "throttle_light", "a little throttle while held", true},
      {Action::brake, "brake", "brake", true},
      {Action::clutch, "clutch", "clutch", true},
      {Action::clutch_hold, "clutch_hold", "hold the clutch where it is", true},
      {Action::starter, "starter", "starter", true},
      {Action::hand_brake_hold, "hand_brake_hold", "handbrake", true},
      {Action::throttle_more, "throttle_more", "more throttle; it stays there", false},
      {Action::throttle_less, "throttle_less", "less throttle; the brake lets it off", false},
      {Action::hand_brake, "hand_brake", "turn the handbrake on or off", false},
      {Action::shift_up, "shift_up", "shift one gear up", false},
      {Action::shift_down, "shift_down", "shift one gear down", false},
      {Action::ignition, "ignition", "turn the ignition on or off", false},
      {Action::arm, "arm", "turn forces on and start the offered lesson", false},
      {Action::stop, "stop", "stop (turn forces off)", false},
      {Action::recentre, "recentre", "recentre the hand and the view", false},
      {Action::full_screen, "full_screen", "switch between full screen and window", false},
      {Action::help, "help", "show these controls", false},
      {Action::panel, "panel", "switch between the learner's and the engineer's view", false},
      {Action::next_camera, "next_camera", "next camera", false},
      {Action::record, "record", "start or end a recording", false},
      {Action::undo, "undo", "undo the last tuning change", false},
      {Action::redo, "redo", "redo the last tuning change", false},
      {Action::grab_mouse, "grab_mouse", "capture the mouse to move the lever, or release it", false},
      {Action::free_mouse, "free_mouse", "release the mouse", false},
      {Action::lessons, "lessons", "show or hide lessons and history", false},
      {Action::quit, "quit", "quit", false},
  };
  return actions;
}

std::string gear_key(int gear) {
  if (gear == haptics::kReverseGear) return "gear_reverse";
  return gear == haptics::kNeutralGear ? "gear_neutral" : "gear_" + std::to_string(gear);
}

}  // namespace gearshift::ui
