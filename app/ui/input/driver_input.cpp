#include "app/ui/input/driver_input.h"

#include <algorithm>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <glm/common.hpp>

#include "app/ui/input/key_names.h"

namespace gearshift::ui {
namespace {

constexpr double kMinAxisMove = 0.02;  // [1] axis motion smaller than this is noise
constexpr double kPushTravel = 0.05;   // [m] mouse motion beyond the hand's reach at which the push is `max_push`
constexpr double kBeyondGate = 0.02;   // [m] reach of the hand beyond the gate, see hand_reach()

enum WatchedAxis : std::size_t { select_axis, shift_axis, throttle_axis, brake_axis, clutch_axis };

bool is_once(Action action) {
  const auto& actions = all_actions();
  const auto info =
      std::find_if(actions.begin(), actions.end(), [&](const ActionInfo& a) { return a.action == action; });
  return info != actions.end() && !info->held;
}

constexpr double kMaxKeyLead = 0.05;  // [m] maximum lead of the hand over the lever: 25 N at the hand's 500 N/m
constexpr double kRestDelay = 0.3;    // [s] time from the release of keys or stick until kRestLead applies
constexpr double kRestLead = 0.005;   // [m] maximum lead after kRestDelay: 2.5 N, enough to hold the lever off centre

}  // namespace

glm::dvec2 hand_reach(const haptics::Gate& gate, const haptics::DeviceSpec& device) noexcept {
  glm::dvec2 reach{std::max(-gate.select_min, gate.select_max), 0.0};
  for (const haptics::Slot& slot : haptics::slots(gate)) reach.y = std::max(reach.y, slot.end);
  return glm::min(reach + kBeyondGate, device.workspace);
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
  }
  was_focused_ = input.focused;
  update_keys(input, ui_has_keys);
  update_buttons(input);
  update_mouse(input, ui_has_mouse);
  move_hand(input, seconds);
  read_pedals(input);
}

// Applies the frame's key events. release() takes effect in the next update(), so a key that is pressed and released
// between two frames is held for one frame.
void DriverInput::update_keys(const engine::WindowInput& input, bool ui_has_keys) {
  for (const engine::KeyEvent& key : input.keys) {
    const Source source{false, key.key};
    if (key.down)
      press(source, ui_has_keys, is_chord(key));
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
  for (const auto& [action, buttons] : config_.bindings.pad_buttons) {
    for (const int button : buttons) {
      const auto index = static_cast<std::size_t>(button);
      const bool down = std::any_of(input.pads.begin(), input.pads.end(), [this, index](const engine::PadState& pad) {
        const bool is_there = index < pad.buttons.size() && matches_stick(pad, config_.bindings.button_stick);
        return is_there && pad.buttons[index] != 0;
      });
      const Source source{true, button};
      if (down)
        press(source, false, false);
      else
        release(source);
    }
  }
}

void DriverInput::press(Source source, bool ui_has_keys, bool chord) {
  const auto& bound = source.pad ? config_.bindings.pad_buttons : config_.bindings.keys;
  const auto found = std::find_if(bound.begin(), bound.end(), [&](const auto& binding) {
    return std::find(binding.second.begin(), binding.second.end(), source.code) != binding.second.end();
  });
  if (found == bound.end()) return;
  const Action action = found->first;
  const bool stops = action == Action::stop && (!ui_has_keys || !types_text(source.code));
  const bool frees = action == Action::grab_mouse && mouse_moves_lever_;
  if ((ui_has_keys || chord) && !stops && !frees) return;
  const bool was_down = down_.contains(source) && !released_.contains(source);
  down_.insert(source);
  released_.erase(source);
  if (!was_down) newly_down_.insert(source);
  if (!was_down && is_once(action)) trigger(action);
}

void DriverInput::trigger(Action action) {
  pressed_.push_back(action);
  if (action == Action::grab_mouse) mouse_moves_lever_ = !mouse_moves_lever_;
  if (action == Action::hand_brake) controls_.pedals.hand_brake = controls_.pedals.hand_brake > 0.5 ? 0.0 : 1.0;
  if (action == Action::ignition) controls_.ignition = !controls_.ignition;
}

template <class Holds>
bool DriverInput::any_bound_source(Action action, const Holds& holds) const {
  const auto any = [&](const std::map<Action, std::vector<int>>& bound, bool pad) {
    const auto found = bound.find(action);
    return found != bound.end() && std::any_of(found->second.begin(), found->second.end(), [&](int code) {
             return holds(Source{pad, code});
           });
  };
  return any(config_.bindings.keys, false) || any(config_.bindings.pad_buttons, true);
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
  return {is_held_at_end(Action::throttle), is_held_at_end(Action::throttle_light), is_held_at_end(Action::brake),
          is_held_at_end(Action::clutch), is_held_at_end(Action::clutch_hold)};
}

void DriverInput::update_mouse(const engine::WindowInput& input, bool ui_has_mouse) {
  const bool clicked = input.mouse_down[0] && !was_clicked_;
  was_clicked_ = input.mouse_down[0];
  if (clicked && !ui_has_mouse) mouse_moves_lever_ = true;
}

void DriverInput::move_hand(const engine::WindowInput& input, double seconds) {
  if (mouse_moved_lever_ && mouse_moves_lever_) aim_by_mouse(input.mouse_moved);
  mouse_moved_lever_ = mouse_moves_lever_;
  const Bindings& bindings = config_.bindings;
  const glm::dvec2 at{stick(input, bindings.lever_select, select_axis), stick(input, bindings.lever_shift, shift_axis)};
  const bool moves = bindings.lever_mode == LeverMode::moves;
  aim_by_speed(key_speed() + (moves ? bindings.stick_speed * at * glm::abs(at) : glm::dvec2(0.0)), seconds);
  if (!moves) aim_by_stick(at);
  set_hand();
  hand_.pressed_down = is_held(Action::push_down);
  hand_.lifted = is_held(Action::lift);
}

// Moving the mouse away from the user (pointer up) moves the hand forward.
void DriverInput::aim_by_mouse(glm::dvec2 moved_px) {
  const double metres = 1e-3 * config_.bindings.mouse_mm_per_px;
  const glm::dvec2 aim = aim_ + metres * glm::dvec2{moved_px.x, -moved_px.y};
  if (!std::isfinite(aim.x) || !std::isfinite(aim.y)) return;
  const glm::dvec2 farthest = config_.reach + kPushTravel;
  aim_ = glm::clamp(aim, -farthest, farthest);
  if (moved_px != glm::dvec2(0.0)) since_key_motion_ = kRestDelay;
}

glm::dvec2 DriverInput::key_speed() const {
  const auto direction = [this](Action plus, Action minus) { return double(is_held(plus)) - double(is_held(minus)); };
  return config_.bindings.key_speed * glm::dvec2{direction(Action::lever_right, Action::lever_left),
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
}

void DriverInput::aim_by_stick(glm::dvec2 stick) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const int i = static_cast<int>(axis);
    const bool deflected = stick[i] != 0.0;
    if (deflected || stick_controls_[axis]) aim_[i] = stick[i] * config_.reach[i];
    if (deflected) since_key_motion_ = kRestDelay;
    stick_controls_[axis] = deflected;
  }
}

void DriverInput::set_hand() {
  hand_.position = glm::clamp(aim_, -config_.reach, config_.reach);
  hand_.push = (aim_ - hand_.position) / kPushTravel * config_.max_push;
}

void DriverInput::recentre(glm::dvec2 lever) {
  aim_ = glm::clamp(lever, -config_.reach, config_.reach);
  set_hand();
}

void DriverInput::set_reach(glm::dvec2 reach) {
  config_.reach = reach;
  recentre(aim_);
}

void DriverInput::set_car(bool ignition, double hand_brake) {
  controls_.ignition = ignition;
  controls_.pedals.hand_brake = hand_brake;
}

// Returns the axis's raw value; empty until the axis has moved.
std::optional<double> DriverInput::raw_axis(const engine::WindowInput& input, const std::optional<AxisBinding>& axis,
                                            std::size_t watch) {
  if (!axis) return std::nullopt;
  const engine::PadState* pad = find_stick(input.pads, *axis);
  const auto number = static_cast<std::size_t>(axis->axis);
  AxisWatch& state = watch_[watch];
  if (pad == nullptr || number >= pad->axes.size() || !std::isfinite(pad->axes[number])) {
    state = {};
    return std::nullopt;
  }
  const double raw = static_cast<double>(pad->axes[number]);
  if (!state.first) state = {raw, pad->is_pad, false};
  const bool changed = std::abs(raw - *state.first) > kMinAxisMove;
  if (changed && !state.is_reported) {
    state = {raw, true, false};
  } else if (changed) {
    state.moved = true;
  }
  return state.moved ? std::optional(raw) : std::nullopt;
}

double DriverInput::stick(const engine::WindowInput& input, const std::optional<AxisBinding>& axis, std::size_t watch) {
  const std::optional<double> raw = raw_axis(input, axis, watch);
  return raw ? lever_value(*axis, *raw) : 0.0;
}

double DriverInput::pedal_axis(const engine::WindowInput& input, const std::optional<AxisBinding>& axis,
                               std::size_t watch) {
  const std::optional<double> raw = raw_axis(input, axis, watch);
  return raw ? pedal_value(*axis, *raw) : 0.0;
}

void DriverInput::read_pedals(const engine::WindowInput& input) {
  const Bindings& bindings = config_.bindings;
  controls_.pedals.throttle = pedal_axis(input, bindings.throttle, throttle_axis);
  controls_.pedals.brake = pedal_axis(input, bindings.brake, brake_axis);
  controls_.pedals.clutch = pedal_axis(input, bindings.clutch, clutch_axis);
  controls_.starter = is_held(Action::starter);
}

}  // namespace gearshift::ui
