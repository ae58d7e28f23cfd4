// Values of actions: synchronising, reading, vibration.
#include <algorithm>
#include <cmath>

#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/profiles.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

// Returns the input paths to which an action is bound on the session's controllers. `subaction`: only those below this
// path; XR_NULL_PATH: all.
std::vector<std::string> sources(const SessionObject& session, XrAction action, XrPath subaction) {
  const InstanceObject& instance = live(session.instance);
  const auto suggested = instance.suggestions.find(session.profile);
  std::vector<std::string> found;
  if (suggested == instance.suggestions.end()) return found;
  const std::string user = subaction == XR_NULL_PATH ? "" : path_string(instance, subaction) + "/";
  for (const XrActionSuggestedBinding& binding : suggested->second) {
    const std::string& path = path_string(instance, binding.binding);
    if (binding.action == action && path.starts_with(user)) found.push_back(path);
  }
  return found;
}

ActionValue read_source(const Script& script, XrActionType type, const std::string& path, double t) {
  ActionValue value{.active = true};
  if (type == XR_ACTION_TYPE_VECTOR2F_INPUT) {
    value.x = read_scalar(script, path + "/x", t);
    value.y = read_scalar(script, path + "/y", t);
  } else {
    value.x = read_scalar(script, path, t);
  }
  constexpr float kPressed = 0.5f;
  if (type == XR_ACTION_TYPE_BOOLEAN_INPUT) value.x = value.x >= kPressed ? 1.0f : 0.0f;
  return value;
}

// If several inputs are bound to the action, its value is that of the input farthest from rest.
void sync_value(State& s, const SessionObject& session, XrAction handle, ActionObject& action, XrPath subaction) {
  ActionValue next;
  for (const std::string& path : sources(session, handle, subaction)) {
    const ActionValue one = read_source(s.control.script, action.type, path, seconds(s, now(s)));
    if (!next.active || std::hypot(one.x, one.y) > std::hypot(next.x, next.y)) next = one;
  }
  const ActionValue& last = action.values[subaction];
  next.changed = next.active && last.active && (next.x != last.x || next.y != last.y);
  next.change_time = next.changed ? now(s) : last.change_time;
  action.values[subaction] = next;
}

void sync_action(State& s, const SessionObject& session, XrAction handle) {
  ActionObject& action = *s.actions.find(handle);
  sync_value(s, session, handle, action, XR_NULL_PATH);
  for (const XrPath subaction : action.subactions) sync_value(s, session, handle, action, subaction);
}

// Marks the actions of all sets that are not in `active` as inactive and unchanged.
void clear_values(State& s, const SessionObject& session, const std::vector<XrActionSet>& active) {
  for (const XrActionSet set : session.attached) {
    if (std::find(active.begin(), active.end(), set) != active.end()) continue;
    for (const XrAction one : s.actions.find_all([&](const ActionObject& action) { return action.set == set; })) {
      for (auto& [subaction, value] : s.actions.find(one)->values) value.active = value.changed = false;
    }
  }
}

// Called by xrSyncActions. Selects the script's profile if the program suggested bindings for it. Otherwise selects the
// simple controller's profile if the program suggested bindings for that. Otherwise, or if the script has no profile,
// selects none. Reports a change by an event.
void choose_profile(State& s, XrSession handle, SessionObject& session) {
  const auto& suggestions = live(session.instance).suggestions;
  const std::string& current = s.control.script.profile;
  const std::string simple = "/interaction_profiles/khr/simple_controller";
  std::string next;
  if (suggestions.contains(current)) {
    next = current;
  } else if (!current.empty() && suggestions.contains(simple)) {
    next = simple;
  }
  if (next == session.profile) return;
  session.profile = next;
  XrEventDataInteractionProfileChanged changed{XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED};
  changed.session = handle;
  push_event(s, changed);
  log_line("event INTERACTION_PROFILE_CHANGED " + next);
}

bool is_attached(const SessionObject& session, XrActionSet set) {
  return std::find(session.attached.begin(), session.attached.end(), set) != session.attached.end();
}

const ActionObject& require_readable(const SessionObject& session, XrAction handle, XrPath subaction,
                                     XrActionType type) {
  const ActionObject& action = live(handle);
  require(is_attached(session, action.set), "set_attached");
  require(action.type == type, "action_type", action.name);
  check_subaction(action, subaction);
  return action;
}

ActionValue value_of(const ActionObject& action, XrPath subaction) {
  const auto value = action.values.find(subaction);
  return value == action.values.end() || !value->second.active ? ActionValue{} : value->second;
}

template <class Out, class Write>
XrResult get_state(const char* function, XrSession session, const XrActionStateGetInfo* info, Out* out,
                   XrActionType action_type, Write write) {
  return call(function, [&](State&) {
    const SessionObject& object = live(session);
    const ActionValue value =
        value_of(require_readable(object, info->action, info->subactionPath, action_type), info->subactionPath);
    write(value);
    out->isActive = value.active ? XR_TRUE : XR_FALSE;
    return XR_SUCCESS;
  });
}

template <class Out>
void write_change(Out* out, const ActionValue& value) {
  out->changedSinceLastSync = value.changed ? XR_TRUE : XR_FALSE;
  out->lastChangeTime = value.change_time;
}

}  // namespace

void check_subaction(const ActionObject& action, XrPath subaction) {
  if (subaction == XR_NULL_PATH) return;
  path_string(live(live(action.set).instance), subaction);
  const bool declared =
      std::find(action.subactions.begin(), action.subactions.end(), subaction) != action.subactions.end();
  require(declared, "subaction_path", action.name);
}

Pose action_pose(const State& s, const SpaceObject& space, double t) {
  const Pose untracked{.position_valid = false, .orientation_valid = false, .tracked = false};
  const ActionObject* const action = s.actions.find(space.action);
  if (action == nullptr || !value_of(*action, space.subaction).active) return untracked;
  for (const std::string& path : sources(live(space.session), space.action, space.subaction)) {
    const Hand& hand = s.control.script.hands[path.starts_with("/user/hand/left/") ? 0 : 1];
    if (path.find("/input/aim") != std::string::npos) return hand.aim(t);
    if (path.find("/input/grip") != std::string::npos) return hand.grip(t);
  }
  return untracked;
}

namespace xr {

XrResult XRAPI_CALL SyncActions(XrSession session, const XrActionsSyncInfo* info) {
  return call("xrSyncActions", [&](State& s) {
    SessionObject& object = live(session);
    for (std::uint32_t i = 0; i < info->countActiveActionSets; ++i) {
      live(info->activeActionSets[i].actionSet);
      require(is_attached(object, info->activeActionSets[i].actionSet), "set_attached");
    }
    if (object.state != XR_SESSION_STATE_FOCUSED) {
      clear_values(s, object, {});
      return XR_SESSION_NOT_FOCUSED;
    }
    choose_profile(s, session, object);
    std::vector<XrActionSet> active;
    for (std::uint32_t i = 0; i < info->countActiveActionSets; ++i)
      active.push_back(info->activeActionSets[i].actionSet);
    clear_values(s, object, active);
    for (const XrAction one : s.actions.find_all([&](const ActionObject& action) {
           return std::find(active.begin(), active.end(), action.set) != active.end();
         })) {
      sync_action(s, object, one);
    }
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL GetActionStateBoolean(XrSession session, const XrActionStateGetInfo* info,
                                          XrActionStateBoolean* state) {
  return get_state("xrGetActionStateBoolean", session, info, state, XR_ACTION_TYPE_BOOLEAN_INPUT,
                   [&](const ActionValue& value) {
                     state->currentState = value.x > 0.0f ? XR_TRUE : XR_FALSE;
                     write_change(state, value);
                   });
}

XrResult XRAPI_CALL GetActionStateFloat(XrSession session, const XrActionStateGetInfo* info,
                                        XrActionStateFloat* state) {
  return get_state("xrGetActionStateFloat", session, info, state, XR_ACTION_TYPE_FLOAT_INPUT,
                   [&](const ActionValue& value) {
                     state->currentState = value.x;
                     write_change(state, value);
                   });
}

XrResult XRAPI_CALL GetActionStateVector2f(XrSession session, const XrActionStateGetInfo* info,
                                           XrActionStateVector2f* state) {
  return get_state("xrGetActionStateVector2f", session, info, state, XR_ACTION_TYPE_VECTOR2F_INPUT,
                   [&](const ActionValue& value) {
                     state->currentState = {value.x, value.y};
                     write_change(state, value);
                   });
}

XrResult XRAPI_CALL GetActionStatePose(XrSession session, const XrActionStateGetInfo* info, XrActionStatePose* state) {
  return get_state("xrGetActionStatePose", session, info, state, XR_ACTION_TYPE_POSE_INPUT, [](const ActionValue&) {});
}

XrResult XRAPI_CALL EnumerateBoundSourcesForAction(XrSession session, const XrBoundSourcesForActionEnumerateInfo* info,
                                                   std::uint32_t capacity, std::uint32_t* count, XrPath* paths) {
  return call("xrEnumerateBoundSourcesForAction", [&](State&) {
    const SessionObject& object = live(session);
    require(is_attached(object, live(info->action).set), "set_attached");
    InstanceObject& instance = live(object.instance);
    return fill(capacity, count, paths, sources(object, info->action, XR_NULL_PATH),
                [&](XrPath& to, const std::string& from) { to = path_number(instance, from); });
  });
}

XrResult XRAPI_CALL GetInputSourceLocalizedName(XrSession session, const XrInputSourceLocalizedNameGetInfo* info,
                                                std::uint32_t capacity, std::uint32_t* count, char* buffer) {
  return call("xrGetInputSourceLocalizedName", [&](State&) {
    const SessionObject& object = live(session);
    require(object.has_attached, "set_attached");
    // A localized name for display, made of the path's parts; programs must not parse it.
    std::string name = path_string(live(object.instance), info->sourcePath).substr(1);
    std::replace(name.begin(), name.end(), '/', ' ');
    return fill_text(capacity, count, buffer, name);
  });
}

XrResult XRAPI_CALL ApplyHapticFeedback(XrSession session, const XrHapticActionInfo* info,
                                        const XrHapticBaseHeader* haptic) {
  return call("xrApplyHapticFeedback", [&](State& s) {
    const SessionObject& object = live(session);
    require_readable(object, info->action, info->subactionPath, XR_ACTION_TYPE_VIBRATION_OUTPUT);
    const auto& pulse = reinterpret_cast<const XrHapticVibration&>(*haptic);
    const bool has_duration = pulse.duration > 0 || pulse.duration == XR_MIN_HAPTIC_DURATION;
    require(has_duration && pulse.amplitude >= 0.0f && pulse.amplitude <= 1.0f && pulse.frequency >= 0.0f, "haptic");
    if (object.state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
    const double length = pulse.duration > 0 ? static_cast<double>(pulse.duration) * 1e-9 : 0.0;
    for (const std::string& path : sources(object, info->action, info->subactionPath)) {
      const int hand = path.starts_with("/user/hand/left/") ? 0 : 1;
      s.control.record.pulses.push_back({hand, length, pulse.frequency, pulse.amplitude});
      log_line("pulse " + path);
    }
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL StopHapticFeedback(XrSession session, const XrHapticActionInfo* info) {
  return call("xrStopHapticFeedback", [&](State&) {
    const SessionObject& object = live(session);
    require_readable(object, info->action, info->subactionPath, XR_ACTION_TYPE_VIBRATION_OUTPUT);
    return object.state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
  });
}

}  // namespace xr
}  // namespace gearshift::xr_test
