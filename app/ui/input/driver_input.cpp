#include "app/ui/input/driver_input.h"

#include <algorithm>
#include <cmath>
#include <variant>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <glm/common.hpp>

#include "app/ui/input/bound_controllers.h"
#include "app/ui/input/key_names.h"
#include "haptics/gate/aisle.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift::ui {
namespace {

constexpr double kMinAxisMove = 0.02;    // [1] axis motion smaller than this is noise
constexpr double kPushTravel = 0.05;     // [m] mouse motion beyond the hand's reach at which the push is `max_push`
constexpr double kStepPull = 0.6;        // [1] deflection of a stick at which a step counts, see LeverMode::steps
constexpr double kStepReturn = 0.3;      // [1] deflection below which the next step may begin
constexpr double kTakesOver = 0.5;       // [1] a handbrake pulled this far replaces the switched one
constexpr double kThrottleSteps = 10.0;  // [1] number of steps of the whole travel
constexpr double kRepeatDelay = 0.4;     // [s] how long a key of the throttle is held before it repeats
constexpr double kRepeatTime = 0.1;      // [s] between its steps
constexpr double kAtHand = 0.1;          // [1] a pedal pressed further than this is in use
constexpr double kBeyondGate = 0.02;     // [m] reach of the hand beyond the gate, see hand_reach()

bool is_once(Action action) {
  const auto& actions = all_actions();
  const auto info =
      std::find_if(actions.begin(), actions.end(), [&](const ActionInfo& a) { return a.action == action; });
  return info != actions.end() && !info->held;
}

constexpr double kMaxKeyLead = 0.05;  // [m] maximum lead of the hand over the lever: 25 N at the hand's 500 N/m
constexpr double kRestDelay = 0.3;    // [s] time from the release of keys or stick until kRestLead applies
constexpr double kRestLead = 0.005;   // [m] maximum lead after kRestDelay: 2.5 N, enough to hold the lever off centre

bool is_down(const engine::Controller& controller, int button) {
  const auto index = static_cast<std::size_t>(button);
  return index < controller.buttons.size() && controller.buttons[index] != 0;
}

int held_gear(const ControllerButtons& shifter, const engine::Controller& controller) {
  for (const auto& [gear, buttons] : shifter.gears)
    for (const int button : buttons)
      if (is_down(controller, button)) return gear;
  return haptics::kNeutralGear;
}

// Where to aim if a lever that stays in place is in a gear: at the gear's rest position. At the lever's own end the hand
// would lean on the gear with up to 33 N.
glm::dvec2 without_leaning(const haptics::Gate& gate, glm::dvec2 lever, glm::dvec2 aim) {
  const int index = haptics::slot_at(gate, lever);
  if (index == haptics::kNoSlot) return aim;
  const haptics::Slot& slot = haptics::slot_of(gate, index);
  if (haptics::is_mechanism(gate)) {
    const bool is_engaged = haptics::depth_in(gate, index, lever) >= slot.engage_depth;
    return is_engaged && haptics::depth_in(gate, index, aim) >= slot.engage_depth ? slot.at : aim;
  }
  const double side = static_cast<double>(static_cast<int>(slot.side));
  const bool is_engaged = side * lever.y >= slot.engage_depth, stays = side * aim.y >= slot.engage_depth;
  const bool is_same_column = haptics::nearest_column(gate, aim.x) == slot.column;
  return is_engaged && stays && is_same_column ? haptics::rest_position(gate, slot.gear) : aim;
}

}  // namespace

glm::dvec2 hand_reach(const haptics::Gate& gate, const haptics::DeviceSpec& device) noexcept {
  return glm::min(haptics::half_extent(gate) + kBeyondGate, device.workspace);
}

DriverInput::DriverInput(const InputConfig& config) : config_(config) {
  controls_.ignition = true;
}

void DriverInput::update(const engine::WindowInput& input, double seconds, bool ui_has_mouse, bool ui_has_keys) {
  seconds = std::isfinite(seconds) ? std::max(seconds, 0.0) : 0.0;
  pressed_.clear();
  for (const Source& source : released_) down_.erase(source);
  released_.clear();
  newly_down_.clear();
  if (was_focused_ && !input.focused) {
    release_all();
    mouse_moves_lever_ = false;
    held_throttle_ = 0.0;
  }
  was_focused_ = input.focused;
  update_keys(input, ui_has_keys);
  update_buttons(input);
  update_mouse(input, ui_has_mouse);
  repeat_throttle(seconds);
  move_hand(input, seconds);
  read_pedals(input);
  retry_gear();
}

// Applies the frame's key events. release() takes effect in the next update(), so a key that is pressed and released
// between two frames is held for one frame.
void DriverInput::update_keys(const engine::WindowInput& input, bool ui_has_keys) {
  for (const engine::InputEvent& event : input.events) {
    const auto* const key = std::get_if<engine::KeyEvent>(&event);
    if (key == nullptr) continue;
    const Source source{kKeyboard, key->key};
    if (key->down)
      press(source, ui_has_keys, is_chord(*key));
    else
      release(source);
  }
}

// True for a key pressed with Ctrl or Alt held, unless that modifier is itself bound to an action.
bool DriverInput::is_chord(const engine::KeyEvent& key) const {
  const auto binds = [this](int left, int right) {
    return std::any_of(config_.bindings.keys.begin(), config_.bindings.keys.end(), [&](const auto& binding) {
      const std::vector<int>& codes = binding.second;
      return std::find(codes.begin(), codes.end(), left) != codes.end() ||
             std::find(codes.begin(), codes.end(), right) != codes.end();
    });
  };
  return (key.control && !binds(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL)) ||
         (key.alt && !binds(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT));
}

void DriverInput::update_buttons(const engine::WindowInput& input) {
  const Bindings& bindings = config_.bindings;
  const std::vector<const engine::Controller*> pads = free_gamepads(bindings, input.controllers);
  for (const auto& [action, buttons] : bindings.pad_buttons)
    for (const int button : buttons) {
      const bool down = std::any_of(pads.begin(), pads.end(), [&](const engine::Controller* pad) {
        return pad->gamepad->buttons[static_cast<std::size_t>(button)] != 0;
      });
      set_button({kGamepads, button}, down, !has_pads_);
    }
  has_pads_ = !pads.empty();
  shifters_.resize(bindings.controllers.size());
  for (std::size_t i = 0; i < bindings.controllers.size(); ++i) {
    const ControllerButtons& bound = bindings.controllers[i];
    const engine::Controller* one = find_controller(bindings, bound.of, bound.which, input.controllers);
    for (const auto& [action, buttons] : bound.actions)
      for (const int button : buttons)
        set_button({static_cast<int>(i), button}, one != nullptr && is_down(*one, button), !shifters_[i]);
    follow_shifter(bound, one, shifters_[i]);
  }
}

void DriverInput::set_button(Source source, bool down, bool is_new) {
  if (!down) return release(source);
  if (is_new) down_.insert(source);
  press(source, false, false);
}

// Moves the hand when a shifter's own lever has moved. `one`: null if it is not plugged in. `last`: the shifter's gear in
// the last frame; empty if it was not plugged in.
void DriverInput::follow_shifter(const ControllerButtons& bound, const engine::Controller* one,
                                 std::optional<int>& last) {
  if (one == nullptr) {
    if (last && is_gear_of_shifter_) gear_hand_.release();
    last.reset();
    return;
  }
  const int gear = held_gear(bound, *one);
  if (last && gear != *last) {
    gear_hand_.shift_to(gear, engaged_, lever_);
    is_gear_of_shifter_ = true;
  }
  last = gear;
}

// With the clutch pressed, what held the lever may let go.
void DriverInput::retry_gear() {
  const bool is_down = controls_.pedals.clutch > 0.5 || is_held(Action::clutch);
  const bool is_pressed = is_down && !was_clutch_down_;
  was_clutch_down_ = is_down;
  const std::optional<MissedGear> missed = is_pressed ? missed_gear() : std::nullopt;
  if (missed && missed->of_shifter)
    gear_hand_.shift_to(missed->gear, engaged_, lever_);
  else if (missed)
    gear_hand_.try_again(engaged_, lever_);
}

std::optional<DriverInput::MissedGear> DriverInput::missed_gear() const {
  if (gear_hand_.is_moving()) return std::nullopt;
  std::optional<MissedGear> wanted;
  if (gear_hand_.is_active()) wanted = {gear_hand_.selected_gear(), engaged_, is_gear_of_shifter_};
  for (const std::optional<int>& gear : shifters_)
    if (gear.value_or(haptics::kNeutralGear) != haptics::kNeutralGear) wanted = {*gear, engaged_, true};
  return wanted && wanted->gear != engaged_ ? wanted : std::nullopt;
}

const std::map<Action, std::vector<int>>& DriverInput::bound_on(int device) const {
  const Bindings& bindings = config_.bindings;
  if (device == kKeyboard) return bindings.keys;
  return device == kGamepads ? bindings.pad_buttons : bindings.controllers[static_cast<std::size_t>(device)].actions;
}

void DriverInput::press(Source source, bool ui_has_keys, bool chord) {
  const auto& bound = bound_on(source.device);
  const auto found = std::find_if(bound.begin(), bound.end(), [&](const auto& binding) {
    return std::find(binding.second.begin(), binding.second.end(), source.code) != binding.second.end();
  });
  if (found == bound.end()) return;
  const Action action = found->first;
  const bool stops = action == Action::stop && (!ui_has_keys || !types_text(source.code));
  const bool frees = (action == Action::grab_mouse || action == Action::free_mouse) && mouse_moves_lever_;
  if ((ui_has_keys || chord) && !stops && !frees) return;
  const bool was_down = down_.contains(source) && !released_.contains(source);
  down_.insert(source);
  released_.erase(source);
  if (was_down) return;
  newly_down_.insert(source);
  at_hand_ = source.device == kKeyboard   ? DeviceAtHand::keyboard
             : source.device == kGamepads ? DeviceAtHand::pad
                                          : DeviceAtHand::controller;
  if (is_once(action)) trigger(action);
}

bool DriverInput::stops(const engine::KeyEvent& key, bool ui_has_keys) const {
  const auto& bound = bound_on(kKeyboard);
  const auto stop = bound.find(Action::stop);
  const bool is_bound =
      stop != bound.end() && std::find(stop->second.begin(), stop->second.end(), key.key) != stop->second.end();
  return key.down && is_bound && (!ui_has_keys || !types_text(key.key));
}

void DriverInput::trigger(Action action) {
  pressed_.push_back(action);
  if (action == Action::grab_mouse) mouse_moves_lever_ = !mouse_moves_lever_;
  if (action == Action::free_mouse) mouse_moves_lever_ = false;
  if (action == Action::throttle_more || action == Action::throttle_less) {
    step_throttle(action == Action::throttle_more ? 1 : -1);
    throttle_key_held_ = -kRepeatDelay;
  }
  if (action == Action::hand_brake) hand_brake_switch_ = controls_.pedals.hand_brake > 0.5 ? 0.0 : 1.0;
  if (action == Action::shift_up || action == Action::shift_down) {
    gear_hand_.shift_by(action == Action::shift_up ? 1 : -1, engaged_, lever_);
    is_gear_of_shifter_ = false;
  }
  if (action == Action::ignition) controls_.ignition = !controls_.ignition;
}

void DriverInput::step_throttle(int steps) {
  held_throttle_ = std::clamp(std::round(held_throttle_ * kThrottleSteps + steps) / kThrottleSteps, 0.0, 1.0);
}

// Presses count at once, so the frame rate does not matter. A held key repeats; the right foot leaves for the brake.
void DriverInput::repeat_throttle(double seconds) {
  const int direction = int(is_held_at_end(Action::throttle_more)) - int(is_held_at_end(Action::throttle_less));
  throttle_key_held_ = direction == 0 ? -kRepeatDelay : throttle_key_held_ + seconds;
  for (; throttle_key_held_ >= kRepeatTime; throttle_key_held_ -= kRepeatTime) step_throttle(direction);
  if (is_held_at_end(Action::brake)) held_throttle_ = 0.0;
}

template <class Holds>
bool DriverInput::any_bound_source(Action action, const Holds& holds) const {
  for (int device = kKeyboard; device < static_cast<int>(config_.bindings.controllers.size()); ++device) {
    const auto& bound = bound_on(device);
    const auto found = bound.find(action);
    const bool any = found != bound.end() && std::any_of(found->second.begin(), found->second.end(), [&](int code) {
                       return holds(Source{device, code});
                     });
    if (any) return true;
  }
  return false;
}

// True if the action's key or button was held for at least part of this frame.
bool DriverInput::is_held(Action action) const {
  return any_bound_source(action, [this](Source source) { return down_.contains(source); });
}

// True if the action's key or button is held at the end of this frame, or was pressed and released within it, so that
// a short press is not lost.
bool DriverInput::is_held_at_end(Action action) const {
  return any_bound_source(action, [this](Source source) {
    return down_.contains(source) && (!released_.contains(source) || newly_down_.contains(source));
  });
}

haptics::PedalKeys DriverInput::pedal_keys() const {
  return {is_held_at_end(Action::throttle),
          is_held_at_end(Action::throttle_light),
          is_held_at_end(Action::brake),
          is_held_at_end(Action::clutch),
          is_held_at_end(Action::clutch_hold),
          0.0,
          held_throttle_};
}

void DriverInput::update_mouse(const engine::WindowInput& input, bool ui_has_mouse) {
  const bool clicked = input.mouse_down[0] && !was_clicked_;
  was_clicked_ = input.mouse_down[0];
  if (clicked && !ui_has_mouse) mouse_moves_lever_ = true;
}

void DriverInput::move_hand(const engine::WindowInput& input, double seconds) {
  const bool mouse_moves = mouse_moved_lever_ && mouse_moves_lever_;
  mouse_moved_lever_ = mouse_moves_lever_;
  const Bindings& bindings = config_.bindings;
  const glm::dvec2 at{stick(input, &Bindings::lever_select), stick(input, &Bindings::lever_shift)};
  const bool moves = bindings.lever.mode == LeverMode::moves, places = bindings.lever.mode == LeverMode::places;
  if (bindings.lever.mode == LeverMode::steps) shift_by_stick(at.y);
  const glm::dvec2 speed = key_speed() + (moves ? bindings.lever.speed * at * glm::abs(at) : glm::dvec2(0.0));
  const bool takes_over = speed != glm::dvec2(0.0) || (mouse_moves && input.mouse_moved != glm::dvec2(0.0)) ||
                          (places && at != glm::dvec2(0.0));
  if (takes_over) gear_hand_.release();
  if (gear_hand_.is_active()) {
    hand_ = gear_hand_.next(seconds, lever_, engaged_);
    aim_ = hand_.position;
    since_key_motion_ = kRestDelay;
  } else {
    if (mouse_moves) aim_by_mouse(input.mouse_moved);
    aim_by_speed(speed, seconds);
    if (places) aim_by_stick(at);
    set_hand();
  }
  hand_.pressed_down = hand_.pressed_down || is_held(Action::push_down);
  hand_.lifted = hand_.lifted || is_held(Action::lift);
}

// Moving the mouse away from the user (pointer up) moves the hand forward.
void DriverInput::aim_by_mouse(glm::dvec2 moved_px) {
  const double metres = 1e-3 * config_.bindings.pace.mouse_mm_per_px;
  const glm::dvec2 aim = aim_ + metres * glm::dvec2{moved_px.x, -moved_px.y};
  if (!std::isfinite(aim.x) || !std::isfinite(aim.y)) return;
  const glm::dvec2 farthest = config_.reach + kPushTravel;
  aim_ = glm::clamp(aim, -farthest, farthest);
  if (moved_px != glm::dvec2(0.0)) since_key_motion_ = kRestDelay;
}

glm::dvec2 DriverInput::key_speed() const {
  const auto direction = [this](Action plus, Action minus) { return double(is_held(plus)) - double(is_held(minus)); };
  return config_.bindings.pace.key_speed * glm::dvec2{direction(Action::lever_right, Action::lever_left),
                                                      direction(Action::lever_forward, Action::lever_back)};
}

// Moves the hand at `speed` for `seconds`, within its reach and at most kMaxKeyLead from the lever, so that a key held
// too long does not push hard on a blocked lever. kRestDelay after the motion, moves the hand once, to at most
// kRestLead from the lever.
void DriverInput::aim_by_speed(glm::dvec2 speed, double seconds) {
  const bool moves = speed != glm::dvec2(0.0);
  if (moves) {
    since_key_motion_ = 0.0;
    const glm::dvec2 near = glm::clamp(aim_ + seconds * speed, lever_ - kMaxKeyLead, lever_ + kMaxKeyLead);
    aim_ = glm::clamp(near, -config_.reach, config_.reach);
  } else if (since_key_motion_ < kRestDelay) {
    since_key_motion_ += seconds;
    if (since_key_motion_ >= kRestDelay) aim_ = glm::clamp(aim_, lever_ - kRestLead, lever_ + kRestLead);
  }
  const bool is_pulling = moves || mouse_moves_lever_ || config_.bindings.lever.mode == LeverMode::places;
  if (gate_ && haptics::is_sequential(*gate_) && !is_pulling) aim_ = lever_;
}

// A lever that springs back passes a stroke's threshold once per stroke.
void DriverInput::shift_by_stick(double shift) {
  const double depth = std::abs(shift);
  if (depth > kStepPull && !is_stick_pulled_) trigger(shift < 0.0 ? Action::shift_up : Action::shift_down);
  if (depth > kStepPull) is_stick_pulled_ = true;
  if (depth < kStepReturn) is_stick_pulled_ = false;
}

void DriverInput::aim_by_stick(glm::dvec2 stick) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const int i = static_cast<int>(axis);
    const bool deflected = stick[i] != 0.0;
    if (deflected || stick_controls_[axis]) aim_[i] = stick[i] * config_.reach[i];
    if (deflected) since_key_motion_ = kRestDelay;
    stick_controls_[axis] = deflected;
  }
  if (gate_) aim_ = without_leaning(*gate_, lever_, aim_);
}

void DriverInput::set_hand() {
  hand_ = {};
  hand_.position = glm::clamp(aim_, -config_.reach, config_.reach);
  hand_.push = (aim_ - hand_.position) / kPushTravel * config_.max_push;
}

void DriverInput::recentre(glm::dvec2 lever) {
  gear_hand_.release();
  aim_ = glm::clamp(lever, -config_.reach, config_.reach);
  set_hand();
}

void DriverInput::set_gate(const haptics::Gate& gate, const haptics::DeviceSpec& device) {
  config_.reach = hand_reach(gate, device);
  gate_ = gate;
  gear_hand_.set_gate(gate);
  recentre(aim_);
}

void DriverInput::rebind(const Bindings& bindings) {
  config_.bindings = bindings;
  ++rebinds_;
  watch_ = {};
  shifters_.clear();
  is_stick_pulled_ = true;
  has_pads_ = false;
  for (std::set<Source>* sources : {&down_, &newly_down_, &released_})
    std::erase_if(*sources, [](const Source& source) { return source.device != kKeyboard; });
}

void DriverInput::set_car(bool ignition, double hand_brake) {
  controls_.ignition = ignition;
  controls_.pedals.hand_brake = hand_brake_switch_ = hand_brake;
  held_throttle_ = 0.0;
  screen_pedals_ = {};
}

// The right foot has one pedal at a time.
void DriverInput::move_pedal(double haptics::Pedals::*pedal, double pressed) {
  screen_pedals_.*pedal = std::clamp(std::isfinite(pressed) ? pressed : 0.0, 0.0, 1.0);
  if (pedal == &haptics::Pedals::brake) screen_pedals_.throttle = held_throttle_ = 0.0;
  if (pedal == &haptics::Pedals::throttle) screen_pedals_.brake = 0.0;
}

void DriverInput::shift_to(int gear) {
  gear_hand_.shift_to(gear, engaged_, lever_);
  is_gear_of_shifter_ = false;
}

// Returns the axis's raw value; empty until the axis has moved.
std::optional<double> DriverInput::raw_axis(const engine::WindowInput& input, const std::optional<AxisBinding>& axis,
                                            AxisWatch& watch) const {
  const std::optional<double> raw = axis ? raw_value(config_.bindings, *axis, input.controllers) : std::nullopt;
  if (!raw) {
    watch = {};
    return std::nullopt;
  }
  const bool is_any_pad = axis->of.stick.empty();
  if (!watch.first) watch = {raw, is_any_pad, false};
  const bool changed = std::abs(*raw - *watch.first) > kMinAxisMove;
  if (changed && !watch.is_reported) {
    watch = {raw, true, false};
  } else if (changed) {
    watch.moved = true;
  }
  return watch.moved ? raw : std::nullopt;
}

DriverInput::AxisWatch& DriverInput::watch_of(std::optional<AxisBinding> Bindings::*axis) {
  const auto found =
      std::find_if(std::begin(kAxes), std::end(kAxes), [&](const auto& info) { return info.axis == axis; });
  return watch_[static_cast<std::size_t>(found - std::begin(kAxes))];
}

double DriverInput::stick(const engine::WindowInput& input, std::optional<AxisBinding> Bindings::*axis) {
  const std::optional<AxisBinding>& bound = config_.bindings.*axis;
  const std::optional<double> raw = raw_axis(input, bound, watch_of(axis));
  return raw ? lever_value(*bound, *raw) : 0.0;
}

double DriverInput::pedal_axis(const engine::WindowInput& input, std::optional<AxisBinding> Bindings::*axis) {
  const std::optional<AxisBinding>& bound = config_.bindings.*axis;
  const std::optional<double> raw = raw_axis(input, bound, watch_of(axis));
  const double pressed = raw ? pedal_value(*bound, *raw) : 0.0;
  if (pressed > kAtHand) at_hand_ = bound->of.stick.empty() ? DeviceAtHand::pad : DeviceAtHand::controller;
  return pressed;
}

void DriverInput::read_pedals(const engine::WindowInput& input) {
  haptics::Pedals& pedals = controls_.pedals;
  if (is_held(Action::clutch)) screen_pedals_.clutch = 0.0;
  if (is_held(Action::brake) || is_held(Action::throttle_more)) screen_pedals_.brake = screen_pedals_.throttle = 0.0;
  pedals.throttle = std::max(pedal_axis(input, &Bindings::throttle), screen_pedals_.throttle);
  pedals.brake = std::max(pedal_axis(input, &Bindings::brake), screen_pedals_.brake);
  pedals.clutch = std::max(pedal_axis(input, &Bindings::clutch), screen_pedals_.clutch);
  const double pulled = std::max(pedal_axis(input, &Bindings::hand_brake), double(is_held(Action::hand_brake_hold)));
  if (pulled > kTakesOver) hand_brake_switch_ = 0.0;
  pedals.hand_brake = std::max(hand_brake_switch_, pulled);
  controls_.starter = holds_starter();
}

}  // namespace gearshift::ui
