// Converts window input to the driver's hand and pedals. Needs no window; the result depends only on the input.
//
//   hand    The hand is moved by the captured mouse, by lever keys at a fixed speed, or by a stick at a speed
//           proportional to the square of its deflection. With LeverMode::places, the deflection of the stick sets the
//           hand's position while the stick is away from rest. The hand stays within reach; mouse motion beyond reach
//           becomes a push on the lever. With keys, or with a stick that sets the speed, the hand leads the
//           lever by at most 5 cm. 0.3 s after their release the hand moves back to at most 5 mm from the lever, so
//           that it does not push on the lever permanently. In a sequential gate it then lets go, so that the lever
//           springs back. With LeverMode::steps, each pull of the stick is a `shift_up`, each push a `shift_down`.
//   gears   A controller's gear buttons move the hand to the gear whose button is held. None held stands for neutral.
//           Where the shifter is at the start moves nothing, only its changes do. Keys, mouse or a stick
//           take the hand over when they move it. If something holds the lever, such as a synchroniser, the hand gives
//           up, and tries again when the clutch is pressed.
//   buttons A button that is down when its controller appears, or when the bindings change, performs no action before it
//           is released.
//   handbrake  Applied as far as its axis, or while `hand_brake_hold` is held, or from one press of `hand_brake` to the
//           next. A lesson may start with the handbrake on; the first use of axis or `hand_brake_hold` takes it over.
//   pedals  The held pedal keys go to the car, which moves its pedals, see vehicle::KeyboardPedals. The throttle stays
//           where `throttle_more` and `throttle_less` have put it, a tenth of its travel per press and, if they are held,
//           per 0.1 s after the first 0.4 s; the brake key lets it off. A pedal axis
//           is used only after its first motion, because a pad does not report the true position of an axis earlier. The
//           first change of another stick's axis may be its first report, so its motion begins with the second.
//   mouse   A click on the cabin, or the action `grab_mouse`, captures the mouse for the lever. `grab_mouse` again, or
//           the loss of the window's focus, releases the mouse.
//   screen  The panel's pedals stay where the mouse put them, until a key moves the same pedal; its gate sends the hand to
//           a gear, and its switches act as the keys do.
//   panel   Keys and clicks that the panel uses are ignored, with two exceptions: `stop` with a key that types no text,
//           and `grab_mouse` or `free_mouse` while the mouse is captured.
//   chords  A key pressed with Ctrl or Alt held is ignored, except for `stop`, and `grab_mouse` while the mouse is
//           captured. If Ctrl or Alt is itself bound to an action, it acts like any other key.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "app/ui/input/bindings.h"
#include "app/ui/input/gear_hand.h"
#include "engine/window/window.h"
#include "haptics/device/hand.h"
#include "haptics/device/haptic_device.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::ui {

struct InputConfig {
  Bindings bindings;
  glm::dvec2 reach{0.06, 0.06};  // [m] limit of the hand on each side of the origin, see hand_reach()
  double max_push = 75.0;        // [N] push per axis with the mouse 50 mm beyond reach; triggers the over-push warning
};

// [m] Reach of the hand: 20 mm beyond the gate's end stops and end walls, limited to the device's workspace. A hand
// with a stiffness of 500 N/m needs the 20 mm to pull the lever over any detent.
glm::dvec2 hand_reach(const haptics::Gate& gate, const haptics::DeviceSpec& device) noexcept;

class DriverInput {
 public:
  explicit DriverInput(const InputConfig& config);

  // Call once per frame. `seconds`: time since the last call. `ui_has_mouse`: the panel uses the mouse. `ui_has_keys`:
  // the panel uses the keyboard.
  void update(const engine::WindowInput& input, double seconds, bool ui_has_mouse, bool ui_has_keys);

  // True if this key press switches the motors off. `ui_has_keys`: as in update().
  bool stops(const engine::KeyEvent& key, bool ui_has_keys) const;

  const haptics::HandTarget& hand() const noexcept { return hand_; }
  const haptics::DriverControls& controls() const noexcept { return controls_; }  // pedal axes only, no pedal keys
  // Pedal keys held until the next update(). A key pressed and released between two frames is held for one frame.
  haptics::PedalKeys pedal_keys() const;
  const std::vector<Action>& pressed() const noexcept { return pressed_; }  // one-shot actions of this frame, in order
  bool mouse_moves_lever() const noexcept { return mouse_moves_lever_; }    // the mouse is captured
  double held_throttle() const noexcept { return held_throttle_; }          // [1] where the keys hold the throttle
  DeviceAtHand at_hand() const noexcept { return at_hand_; }
  bool holds_starter() const { return is_held(Action::starter) || screen_starter_; }

  // From the panel, until the next call. `pressed` [1]: 0 to 1.
  void move_pedal(double haptics::Pedals::*pedal, double pressed);
  void hold_starter(bool on) noexcept { screen_starter_ = on; }
  void shift_to(int gear);
  void perform(Action action) { trigger(action); }  // hand_brake or ignition

  void recentre(glm::dvec2 lever);  // puts the hand at the lever, without a push
  void set_gate(const haptics::Gate& gate, const haptics::DeviceSpec& device);  // call when one of them changes
  void rebind(const Bindings& bindings);
  std::uint64_t rebinds() const noexcept { return rebinds_; }  // number of calls of rebind() so far
  // [m] where the lever is, and the engaged gear, until the next call
  void feel(glm::dvec2 lever, int engaged = haptics::kNeutralGear) noexcept { lever_ = lever, engaged_ = engaged; }
  void release_mouse() noexcept { mouse_moves_lever_ = mouse_moved_lever_ = false; }
  void set_car(bool ignition, double hand_brake);  // call at the start of a lesson; hand_brake [1]: 0 to 1
  const Bindings& bindings() const noexcept { return config_.bindings; }
  // The gear that a shifter is in or a button has selected, if the lever is not in it: the gate does not have the gear,
  // or something holds the lever, for example a synchroniser. Empty otherwise.
  struct MissedGear {
    int gear = 0;
    int engaged = 0;          // gear in place of it
    bool of_shifter = false;  // a shifter is in this gear; otherwise a button for one gear up or down has selected it
  };
  std::optional<MissedGear> missed_gear() const;

 private:
  struct AxisWatch {
    std::optional<double> first;
    bool is_reported = false;  // `first` is from a report
    bool moved = false;
  };
  struct Source {            // a key or button
    int device = kKeyboard;  // kKeyboard, kGamepads, or an index in Bindings::controllers
    int code = 0;
    bool operator<(const Source& other) const { return std::tie(device, code) < std::tie(other.device, other.code); }
  };
  static constexpr int kKeyboard = -2, kGamepads = -1;

  void update_keys(const engine::WindowInput& input, bool ui_has_keys);
  bool is_chord(const engine::KeyEvent& key) const;
  void update_buttons(const engine::WindowInput& input);
  void set_button(Source source, bool down, bool is_new);
  void follow_shifter(const ControllerButtons& bound, const engine::Controller* one, std::optional<int>& last);
  void retry_gear();
  const std::map<Action, std::vector<int>>& bound_on(int device) const;
  void update_mouse(const engine::WindowInput& input, bool ui_has_mouse);
  void press(Source source, bool ui_has_keys, bool chord);
  void release(Source source) { released_.insert(source); }
  void release_all() { released_ = down_; }
  void trigger(Action action);
  bool is_held(Action action) const;
  bool is_held_at_end(Action action) const;
  template <class Holds>
  bool any_bound_source(Action action, const Holds& holds) const;
  void move_hand(const engine::WindowInput& input, double seconds);
  void aim_by_stick(glm::dvec2 stick);
  void shift_by_stick(double shift);
  void read_pedals(const engine::WindowInput& input);
  void aim_by_mouse(glm::dvec2 moved_px);
  void aim_by_speed(glm::dvec2 speed, double seconds);
  glm::dvec2 key_speed() const;
  void set_hand();
  void step_throttle(int steps);
  void repeat_throttle(double seconds);
  std::optional<double> raw_axis(const engine::WindowInput& input, const std::optional<AxisBinding>& axis,
                                 AxisWatch& watch) const;
  double stick(const engine::WindowInput& input, std::optional<AxisBinding> Bindings::*axis);
  double pedal_axis(const engine::WindowInput& input, std::optional<AxisBinding> Bindings::*axis);
  AxisWatch& watch_of(std::optional<AxisBinding> Bindings::*axis);

  InputConfig config_;
  glm::dvec2 aim_{0.0};            // [m] target of the hand; the part beyond reach becomes a push
  glm::dvec2 lever_{0.0};          // [m] lever point
  int engaged_ = 0;                // engaged gear
  double since_key_motion_ = 1.0;  // [s] time since a key or stick moved the hand, at most kRestDelay
  haptics::HandTarget hand_;
  haptics::DriverControls controls_;
  std::vector<Action> pressed_;
  bool mouse_moves_lever_ = false;
  bool mouse_moved_lever_ = false;  // mouse_moves_lever_ in the last frame; used to skip motion before the capture
  bool was_clicked_ = false;        // the left button was down in the last frame
  bool was_focused_ = false;        // the window had the focus in the last frame
  std::set<Source> down_;           // keys and buttons held in this frame, even if only for part of it
  std::set<Source> newly_down_;     // keys and buttons in down_ that were pressed in this frame
  std::set<Source> released_;       // keys and buttons in down_ that were released in this frame
  std::array<AxisWatch, std::size(kAxes)> watch_;  // in the order of kAxes
  std::optional<haptics::Gate> gate_;
  GearHand gear_hand_;
  std::vector<std::optional<int>> shifters_;  // gear of each of Bindings::controllers; empty: not plugged in
  bool is_stick_pulled_ = true;               // with LeverMode::steps, until the stick springs back
  bool has_pads_ = false;                     // in the last frame
  bool is_gear_of_shifter_ = false;           // the gear that gear_hand_ moves to
  bool was_clutch_down_ = false;
  std::uint64_t rebinds_ = 0;
  double hand_brake_switch_ = 0.0;  // [1] as pressed by the action hand_brake or set by the lesson
  haptics::Pedals screen_pedals_;   // as put in the panel
  bool screen_starter_ = false;     // held in the panel
  DeviceAtHand at_hand_ = DeviceAtHand::keyboard;
  double held_throttle_ = 0.0;            // [1] as put by throttle_more and throttle_less
  double throttle_key_held_ = 0.0;        // [s] time since the last step of the key that is held; negative before
  std::array<bool, 2> stick_controls_{};  // select, shift
};

}  // namespace gearshift::ui
