// From window input to what the driver's hand and feet do. Needs no window: the same input gives the same driver.
//
//   hand    the mouse leads it while it leads the lever; lever keys move it at their speed, a stick the faster the further
//           it is pushed, its square; or (LeverMode::places) the stick puts it where the stick is, from when it leaves its
//           rest until it is back there. It stays within reach; a mouse that goes on pushes instead, against whatever
//           holds the lever. Keys and sticks that move it lead it at most 5 cm before the lever, and when they are let go
//           it rests 5 mm before it at most: nobody leans on a lever for good
//   feet    which pedals' keys are held, for KeyFeet, which move the pedals on the car's clock; and where the axes are,
//           once these have moved: a pad tells nothing of an axis before
//   mouse   leads the lever after a click beside the panel or by grab_mouse, until grab_mouse or the focus is lost
//   panel   what it uses is not the driver's: no key goes down and no click counts. Two things pass: a key that types
//           no text for `stop`, and grab_mouse while the mouse leads
//   chords  a key that goes down with Ctrl or Alt held is none of these, but for `stop`, and grab_mouse while the mouse
//           leads; where Ctrl or Alt is bound itself it is a key as any other
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "app/input/bindings.h"
#include "app/input/key_feet.h"
#include "engine/window/window.h"
#include "haptics/device/hand.h"
#include "haptics/device/haptic_device.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

struct InputConfig {
  Bindings bindings;
  glm::dvec2 reach{0.06, 0.06};  // [m] the hand stays within, on each side of the origin: hand_reach()
  double most_push = 75.0;       // [N] per axis, of a mouse 50 mm beyond reach: above the over-push warning
};

// Beyond the gate's end stops and end walls by 20 mm, as far as the device goes: what a hand of 500 N/m needs to pull
// the lever over any detent. [m]
glm::dvec2 hand_reach(const Gate& gate, const DeviceSpec& device) noexcept;

class DriverInput {
 public:
  explicit DriverInput(const InputConfig& config);

  // Once a frame. ui_has_mouse, ui_has_keys: the panel uses them, they are not the driver's. seconds since the last call.
  void update(const WindowInput& input, double seconds, bool ui_has_mouse, bool ui_has_keys);

  const HandTarget& hand() const noexcept { return hand_; }
  const DriverControls& controls() const noexcept { return controls_; }  // pedals: of axes; at first the ignition is on
  // From now to the next update(): one that went down and up since the last one is held so long.
  FootKeys foot_keys() const;
  const std::vector<Action>& pressed() const noexcept { return pressed_; }  // once-actions of this frame, in order
  bool mouse_leads() const noexcept { return mouse_leads_; }                // captured by the lever

  void recentre(glm::dvec2 lever);                          // the hand is where the lever is now, and does not push
  void set_reach(glm::dvec2 reach);                         // [m] of another gate or device
  void feel(glm::dvec2 lever) noexcept { lever_ = lever; }  // [m] where it is; once a frame, before update()
  void free_mouse() noexcept { mouse_leads_ = led_ = false; }
  void set_car(bool ignition, double hand_brake);  // as a lesson begins; hand_brake 0 to 1

 private:
  // An axis as it was: it counts from its first movement on.
  struct AxisWatch {
    std::optional<double> first;
    bool moved = false;
  };
  struct Source {  // what can be held down
    bool pad = false;
    int code = 0;
    bool operator<(const Source& other) const { return std::tie(pad, code) < std::tie(other.pad, other.code); }
  };

  void take_keys(const WindowInput& input, bool ui_has_keys);
  bool is_chord(const KeyEvent& key) const;
  void take_buttons(const WindowInput& input);
  void take_mouse(const WindowInput& input, bool ui_has_mouse);
  void press(Source source, bool ui_has_keys, bool chord);
  void let_go(Source source) { released_.insert(source); }
  void let_go_all() { released_ = down_; }
  void happen(Action action);
  bool is_held(Action action) const;
  bool stays_held(Action action) const;
  template <class Holds>
  bool any_source(Action action, const Holds& holds) const;
  void move_hand(const WindowInput& input, double seconds);
  void place_by_stick(glm::dvec2 stick);
  void read_pedals(const WindowInput& input);
  void aim_by_mouse(glm::dvec2 moved_px);
  void aim_by_speed(glm::dvec2 speed, double seconds);
  glm::dvec2 key_speed() const;
  void set_hand();
  std::optional<double> raw_axis(const WindowInput& input, const std::optional<AxisBinding>& axis, std::size_t watch);
  double stick(const WindowInput& input, const std::optional<AxisBinding>& axis, std::size_t watch);
  double pedal_axis(const WindowInput& input, const std::optional<AxisBinding>& axis, std::size_t watch);

  InputConfig config_;
  glm::dvec2 aim_{0.0};     // [m] where the hand wants to be: beyond reach it pushes
  glm::dvec2 lever_{0.0};   // [m] where it is
  double keys_rest_ = 1.0;  // [s] since keys or a stick moved the hand; 1: something else has moved it since
  HandTarget hand_;
  DriverControls controls_;
  std::vector<Action> pressed_;
  bool mouse_leads_ = false;
  bool led_ = false;           // in the frame before: what moved the mouse to where it takes hold is not the hand's
  bool click_ = false;         // the left button was down in the frame before
  bool focused_ = false;       // in the frame before
  std::set<Source> down_;      // in this frame, if only for a part of it
  std::set<Source> fresh_;     // of these, from this frame on
  std::set<Source> released_;  // of these, at its end
  std::array<AxisWatch, 5> watch_;     // lever_select, lever_shift, throttle, brake, clutch
  std::array<bool, 2> stick_leads_{};  // select, shift
};

}  // namespace gearshift
