// Paths, controllers, actions and their values. An XrPath is the number of a path string in its instance.
#include <algorithm>
#include <regex>
#include <string_view>
#include <utility>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

// The controllers that the runtime knows, with their inputs as in the OpenXR specification's section "Interaction
// Profile Paths". The script's inputs are those of the Touch controller.
constexpr std::string_view kTouch = "/interaction_profiles/oculus/touch_controller";
struct Input {
  std::string_view profile;
  std::string_view hands;  // controllers that have the path: "l", "r" or "lr"
  std::string_view path;
};
constexpr std::string_view kSimple = "/interaction_profiles/khr/simple_controller";
constexpr Input kInputs[] = {
    {kSimple, "lr", "input/select/click"},    {kSimple, "lr", "input/menu/click"},   {kSimple, "lr", "input/aim/pose"},
    {kSimple, "lr", "input/grip/pose"},       {kTouch, "l", "input/x/click"},        {kTouch, "l", "input/y/click"},
    {kTouch, "l", "input/menu/click"},        {kTouch, "r", "input/a/click"},        {kTouch, "r", "input/b/click"},
    {kTouch, "lr", "input/squeeze/value"},    {kTouch, "lr", "input/trigger/value"}, {kTouch, "lr", "input/thumbstick"},
    {kTouch, "lr", "input/thumbstick/click"}, {kTouch, "lr", "input/grip/pose"},     {kTouch, "lr", "input/aim/pose"},
};

// True if the controller has this input.
bool has_input(std::string_view profile, std::string_view path) {
  const std::string_view left = "/user/hand/left/", right = "/user/hand/right/";
  const bool is_left = path.starts_with(left);
  if (!is_left && !path.starts_with(right)) return false;
  const std::string_view part = path.substr(is_left ? left.size() : right.size());
  return std::any_of(std::begin(kInputs), std::end(kInputs), [&](const Input& one) {
    return one.profile == profile && one.path == part && one.hands.find(is_left ? 'l' : 'r') != std::string_view::npos;
  });
}

// True if the text is one or several parts of a path: lower-case letters, digits, and - _ . but not only dots.
bool is_path(const std::string& text) {
  static const std::regex path("(/[a-z0-9._-]*[a-z0-9_-][a-z0-9._-]*)+");
  return std::regex_match(text, path);
}

const std::string& path_string(XrInstance instance, XrPath path) {
  const std::vector<std::string>& paths = live(instance).paths;
  require(path >= 1 && path <= paths.size(), "path_format", std::to_string(path));
  return paths[path - 1];
}

// Returns the input path to which an action is bound on one of the Touch controllers; empty if it is not bound.
std::string source_of(XrAction action, XrPath hand) {
  const XrInstance instance = live(live(action).parent).parent;
  for (const XrActionSuggestedBinding& binding : live(instance).suggestions[std::string(kTouch)]) {
    const std::string& path = path_string(instance, binding.binding);
    if (binding.action == action && path.starts_with(path_string(instance, hand) + "/")) return path;
  }
  return {};
}

float scripted_value(const Script& script, const std::string& path, double t) {
  const auto input = script.inputs.find(path);
  return input == script.inputs.end() ? 0.0f : static_cast<float>(input->second(t));
}

ActionValue read_source(const Script& script, XrActionType type, const std::string& path, double t) {
  if (path.empty()) return {};
  if (type == XR_ACTION_TYPE_VECTOR2F_INPUT)
    return {scripted_value(script, path + "/x", t), scripted_value(script, path + "/y", t), true};
  constexpr float kPressed = 0.5f;
  return {scripted_value(script, path, t) >= kPressed ? 1.0f : 0.0f, 0.0f, true};
}

const ActionValue& value_of(XrSession session, const XrActionStateGetInfo& info, XrActionType type) {
  require(live(session).attached && live(live(info.action).parent).attached, "attach_order");
  const Object<XrAction>& action = live(info.action);
  require(action.type == type && action.values.contains(info.subactionPath), "action_type");
  return action.values.at(info.subactionPath);
}

}  // namespace

void drop_action_set(XrActionSet handle) {
  for_children<XrAction>(handle, drop<XrAction>);  // no leak: destroying a set also destroys its actions
  drop(handle);
}

Pose action_pose(const Object<XrSpace>& space, double t) {
  if (!live(space.action).values.at(space.subaction).active)
    return {.position_valid = false, .orientation_valid = false, .tracked = false};
  const std::string source = source_of(space.action, space.subaction);
  return state().control.script.aim[source.starts_with("/user/hand/left/") ? 0 : 1](t);
}

XrResult XRAPI_CALL xr::StringToPath(XrInstance instance, const char* text, XrPath* path) {
  return call("xrStringToPath", [&](State&) {
    require(is_path(text), "path_format", text);
    std::vector<std::string>& paths = live(instance).paths;
    const auto known = std::find(paths.begin(), paths.end(), text);
    *path = static_cast<XrPath>(known - paths.begin()) + 1;
    if (known == paths.end()) paths.emplace_back(text);
  });
}

XrResult XRAPI_CALL xr::CreateActionSet(XrInstance instance, const XrActionSetCreateInfo* info, XrActionSet* set) {
  return call("xrCreateActionSet", [&](State&) {
    live(instance);
    require(is_path(std::string("/") + info->actionSetName), "path_format", info->actionSetName);
    *set = add<XrActionSet>({.parent = instance});
  });
}

XrResult XRAPI_CALL xr::DestroyActionSet(XrActionSet set) {
  return call("xrDestroyActionSet", [&](State&) { drop_action_set(set); });
}

XrResult XRAPI_CALL xr::CreateAction(XrActionSet set, const XrActionCreateInfo* info, XrAction* action) {
  return call("xrCreateAction", [&](State&) {
    require(!live(set).attached, "attach_order");
    require(is_path(std::string("/") + info->actionName), "path_format", info->actionName);
    Object<XrAction> created{.parent = set, .type = info->actionType};
    for (std::uint32_t i = 0; i < info->countSubactionPaths; ++i) created.values[info->subactionPaths[i]] = {};
    *action = add<XrAction>(std::move(created));
  });
}

XrResult XRAPI_CALL xr::SuggestInteractionProfileBindings(XrInstance instance,
                                                          const XrInteractionProfileSuggestedBinding* info) {
  return call("xrSuggestInteractionProfileBindings", [&](State&) {
    const std::string& profile = path_string(instance, info->interactionProfile);
    if (profile != kSimple && profile != kTouch) return XR_ERROR_PATH_UNSUPPORTED;  // the specification allows this
    const std::span bindings(info->suggestedBindings, info->countSuggestedBindings);
    for (const XrActionSuggestedBinding& one : bindings) {
      require(!live(live(one.action).parent).attached, "attach_order");
      const std::string& path = path_string(instance, one.binding);
      require(has_input(profile, path), "binding_path", path);
    }
    live(instance).suggestions[profile].assign(bindings.begin(), bindings.end());
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL xr::AttachSessionActionSets(XrSession session, const XrSessionActionSetsAttachInfo* info) {
  return call("xrAttachSessionActionSets", [&](State&) {
    require(!live(session).attached, "attach_order");
    for (std::uint32_t i = 0; i < info->countActionSets; ++i) live(info->actionSets[i]).attached = true;
    live(session).attached = true;
  });
}

XrResult XRAPI_CALL xr::CreateActionSpace(XrSession session, const XrActionSpaceCreateInfo* info, XrSpace* space) {
  return call("xrCreateActionSpace", [&](State&) {
    live(session);
    const Object<XrAction>& action = live(info->action);
    require(action.type == XR_ACTION_TYPE_POSE_INPUT && action.values.contains(info->subactionPath), "action_type");
    require_unit_pose(info->poseInActionSpace, "poseInActionSpace");
    *space = add<XrSpace>({.parent = session,
                           .type = Space::action,
                           .pose = from_xr(info->poseInActionSpace),
                           .action = info->action,
                           .subaction = info->subactionPath});
  });
}

XrResult XRAPI_CALL xr::SyncActions(XrSession session, const XrActionsSyncInfo* info) {
  return call("xrSyncActions", [&](State& s) {
    const bool focused = live(session).state == XR_SESSION_STATE_FOCUSED;
    if (focused && !std::exchange(live(session).synced, true)) {
      XrEventDataInteractionProfileChanged changed{XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED};
      changed.session = session;
      push_event(s, changed);
    }
    for (std::uint32_t i = 0; i < info->countActiveActionSets; ++i) {
      const XrActionSet set = info->activeActionSets[i].actionSet;
      require(live(session).attached && live(set).attached, "attach_order");
      for_children<XrAction>(set, [&](XrAction handle) {
        Object<XrAction>& action = live(handle);
        for (auto& [hand, value] : action.values) {
          value = focused ? read_source(s.control.script, action.type, source_of(handle, hand), seconds(s, now(s)))
                          : ActionValue{};
        }
      });
    }
    return focused ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
  });
}

XrResult XRAPI_CALL xr::GetActionStateBoolean(XrSession session, const XrActionStateGetInfo* info,
                                              XrActionStateBoolean* state) {
  return call("xrGetActionStateBoolean", [&](State&) {
    const ActionValue& value = value_of(session, *info, XR_ACTION_TYPE_BOOLEAN_INPUT);
    state->currentState = value.x > 0.0f ? XR_TRUE : XR_FALSE;
    state->isActive = value.active ? XR_TRUE : XR_FALSE;
  });
}

XrResult XRAPI_CALL xr::GetActionStateVector2f(XrSession session, const XrActionStateGetInfo* info,
                                               XrActionStateVector2f* state) {
  return call("xrGetActionStateVector2f", [&](State&) {
    const ActionValue& value = value_of(session, *info, XR_ACTION_TYPE_VECTOR2F_INPUT);
    state->currentState = {value.x, value.y};
    state->isActive = value.active ? XR_TRUE : XR_FALSE;
  });
}

}  // namespace gearshift::xr_test
