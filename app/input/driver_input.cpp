#include "app/input/driver_input.h"

#include <algorithm>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <glm/common.hpp>

#include "app/input/key_names.h"

namespace gearshift {
namespace {

constexpr double kMoved = 0.02;       // [1] of an axis: less is noise
constexpr double kPushTravel = 0.05;  // [m] of the mouse beyond reach, from no push to most_push
constexpr double kBeyondGate = 0.02;  // [m]

enum WatchedAxis : std::size_t { select_axis, shift_axis, throttle_axis, brake_axis, clutch_axis };

bool is_once(Action action) {
  const auto& actions = all_actions();
  const auto info =
      std::find_if(actions.begin(), actions.end(), [&](const ActionInfo& a) { return a.action == action; });
  return info != actions.end() && !info->held;
}

constexpr double kKeyLead = 0.05;  // [m] of the hand before the lever, by keys or stick: 25 N of a grip
constexpr double kWaits = 0.3;     // [s] after them the lever has come as far as it comes ...
constexpr double kRests = 0.005;   // [m] ... and the hand rests so near to it: 2.5 N hold it against its centring

}  // namespace

glm::dvec2 hand_reach(const Gate& gate, const DeviceSpec& device) noexcept {
  glm::dvec2 reach{std::max(-gate.select_min, gate.select_max), 0.0};
  for (const Slot& slot : slots(gate)) reach.y = std::max(reach.y, slot.end);
  return glm::min(reach + kBeyondGate, device.workspace);
}

DriverInput::DriverInput(const InputConfig& config) : config_(config) {
  controls_.ignition = true;
}

void DriverInput::update(const WindowInput& input, double seconds, bool ui_has_mouse, bool ui_has_keys) {
  seconds = std::isfinite(seconds) ? std::max(seconds, 0.0) : 0.0;
  pressed_.clear();
  for (const Source& source : released_) down_.erase(source);
  released_.clear();
  fresh_.clear();
  if (focused_ && !input.focused) {
    let_go_all();
    mouse_leads_ = false;
  }
  focused_ = input.focused;
  take_keys(input, ui_has_keys);
  take_buttons(input);
  take_mouse(input, ui_has_mouse);
  move_hand(input, seconds);
  read_pedals(input);
}

// A key that goes down and up between two frames is held for one.
void DriverInput::take_keys(const WindowInput& input, bool ui_has_keys) {
  for (const KeyEvent& key : input.keys) {
    const Source source{false, key.key};
    if (key.down)
      press(source, ui_has_keys, is_chord(key));
    else
      let_go(source);
  }
}

// Ctrl and Alt make another key of it, unless they are bound themselves.
bool DriverInput::is_chord(const KeyEvent& key) const {
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

void DriverInput::take_buttons(const WindowInput& input) {
  for (const auto& [action, buttons] : config_.bindings.pad_buttons) {
    for (const int button : buttons) {
      const auto index = static_cast<std::size_t>(button);
      const bool down = std::any_of(input.pads.begin(), input.pads.end(), [this, index](const PadState& pad) {
        const bool is_there = index < pad.buttons.size() && is_meant(pad, config_.bindings.button_stick);
        return is_there && pad.buttons[index] != 0;
      });
      const Source source{true, button};
      if (down)
        press(source, false, false);
      else
        let_go(source);
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
  const bool frees = action == Action::grab_mouse && mouse_leads_;
  if ((ui_has_keys || chord) && !stops && !frees) return;
  const bool was_down = down_.contains(source) && !released_.contains(source);
  down_.insert(source);
  released_.erase(source);
  if (!was_down) fresh_.insert(source);
  if (!was_down && is_once(action)) happen(action);
}

void DriverInput::happen(Action action) {
  pressed_.push_back(action);
  if (action == Action::grab_mouse) mouse_leads_ = !mouse_leads_;
  if (action == Action::hand_brake) controls_.hand_brake = controls_.hand_brake > 0.5 ? 0.0 : 1.0;
  if (action == Action::ignition) controls_.ignition = !controls_.ignition;
}

template <class Holds>
bool DriverInput::any_source(Action action, const Holds& holds) const {
  const auto any = [&](const std::map<Action, std::vector<int>>& bound, bool pad) {
    const auto found = bound.find(action);
    return found != bound.end() && std::any_of(found->second.begin(), found->second.end(), [&](int code) {
             return holds(Source{pad, code});
           });
  };
  return any(config_.bindings.keys, false) || any(config_.bindings.pad_buttons, true);
}

// For a part of this frame at least.
bool DriverInput::is_held(Action action) const {
  return any_source(action, [this](Source source) { return down_.contains(source); });
}

// At its end, or so shortly that nobody would know of it.
bool DriverInput::stays_held(Action action) const {
  return any_source(action, [this](Source source) {
    return down_.contains(source) && (!released_.contains(source) || fresh_.contains(source));
  });
}

FootKeys DriverInput::foot_keys() const {
  return {stays_held(Action::throttle), stays_held(Action::throttle_light), stays_held(Action::brake),
          stays_held(Action::clutch), stays_held(Action::clutch_hold)};
}

void DriverInput::take_mouse(const WindowInput& input, bool ui_has_mouse) {
  const bool clicked = input.mouse_down[0] && !click_;
  click_ = input.mouse_down[0];
  if (clicked && !ui_has_mouse) mouse_leads_ = true;
}

void DriverInput::move_hand(const WindowInput& input, double seconds) {
  if (led_ && mouse_leads_) aim_by_mouse(input.mouse_moved);
  led_ = mouse_leads_;
  const Bindings& bindings = config_.bindings;
  const glm::dvec2 at{stick(input, bindings.lever_select, select_axis), stick(input, bindings.lever_shift, shift_axis)};
  const bool moves = bindings.lever_mode == LeverMode::moves;
  aim_by_speed(key_speed() + (moves ? bindings.stick_speed * at * glm::abs(at) : glm::dvec2(0.0)), seconds);
  if (!moves) place_by_stick(at);
  set_hand();
  hand_.pressed_down = is_held(Action::push_down);
  hand_.lifted = is_held(Action::lift);
}

// On the desk the mouse goes forward where the pointer goes up.
void DriverInput::aim_by_mouse(glm::dvec2 moved_px) {
  const double metres = 1e-3 * config_.bindings.mouse_mm_per_px;
  const glm::dvec2 aim = aim_ + metres * glm::dvec2{moved_px.x, -moved_px.y};
  if (!std::isfinite(aim.x) || !std::isfinite(aim.y)) return;
  const glm::dvec2 farthest = config_.reach + kPushTravel;
  aim_ = glm::clamp(aim, -farthest, farthest);
  if (moved_px != glm::dvec2(0.0)) keys_rest_ = kWaits;
}

glm::dvec2 DriverInput::key_speed() const {
  const auto direction = [this](Action plus, Action minus) { return double(is_held(plus)) - double(is_held(minus)); };
  return config_.bindings.key_speed * glm::dvec2{direction(Action::lever_right, Action::lever_left),
                                                 direction(Action::lever_forward, Action::lever_back)};
}

// What is held a little long must not push: it ends at the reach, and not far before a lever that is held up.
void DriverInput::aim_by_speed(glm::dvec2 speed, double seconds) {
  const bool moves = speed != glm::dvec2(0.0);
  if (moves) {
    keys_rest_ = 0.0;
    const glm::dvec2 near = glm::clamp(aim_ + seconds * speed, lever_ - kKeyLead, lever_ + kKeyLead);
    aim_ = glm::clamp(near, -config_.reach, config_.reach);
  } else if (keys_rest_ < kWaits) {
    keys_rest_ += seconds;
    if (keys_rest_ >= kWaits) aim_ = glm::clamp(aim_, lever_ - kRests, lever_ + kRests);
  }
}

void DriverInput::place_by_stick(glm::dvec2 stick) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const int i = static_cast<int>(axis);
    const bool deflected = stick[i] != 0.0;
    if (deflected || stick_leads_[axis]) aim_[i] = stick[i] * config_.reach[i];
    if (deflected) keys_rest_ = kWaits;
    stick_leads_[axis] = deflected;
  }
}

void DriverInput::set_hand() {
  hand_.position = glm::clamp(aim_, -config_.reach, config_.reach);
  hand_.push = (aim_ - hand_.position) / kPushTravel * config_.most_push;
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
  controls_.hand_brake = hand_brake;
}

// Raw value, once the axis has moved.
std::optional<double> DriverInput::raw_axis(const WindowInput& input, const std::optional<AxisBinding>& axis,
                                            std::size_t watch) {
  if (!axis) return std::nullopt;
  const PadState* pad = find_stick(input.pads, *axis);
  const auto number = static_cast<std::size_t>(axis->axis);
  AxisWatch& seen = watch_[watch];
  if (pad == nullptr || number >= pad->axes.size() || !std::isfinite(pad->axes[number])) {
    seen = {};
    return std::nullopt;
  }
  const double raw = static_cast<double>(pad->axes[number]);
  if (!seen.first) seen.first = raw;
  seen.moved = seen.moved || std::abs(raw - *seen.first) > kMoved;
  return seen.moved ? std::optional(raw) : std::nullopt;
}

double DriverInput::stick(const WindowInput& input, const std::optional<AxisBinding>& axis, std::size_t watch) {
  const std::optional<double> raw = raw_axis(input, axis, watch);
  return raw ? lever_value(*axis, *raw) : 0.0;
}

double DriverInput::pedal_axis(const WindowInput& input, const std::optional<AxisBinding>& axis, std::size_t watch) {
  const std::optional<double> raw = raw_axis(input, axis, watch);
  return raw ? pedal_value(*axis, *raw) : 0.0;
}

void DriverInput::read_pedals(const WindowInput& input) {
  const Bindings& bindings = config_.bindings;
  controls_.throttle = pedal_axis(input, bindings.throttle, throttle_axis);
  controls_.brake = pedal_axis(input, bindings.brake, brake_axis);
  controls_.clutch = pedal_axis(input, bindings.clutch, clutch_axis);
  controls_.starter = is_held(Action::starter);
}

}  // namespace gearshift
