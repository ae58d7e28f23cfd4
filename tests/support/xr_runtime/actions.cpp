// Paths, controllers, actions and their values. An XrPath is the number of a path string in its instance.
#include <algorithm>
#include <regex>
#include <string_view>
#include <utility>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

// The controllers that the runtime knows, as in the OpenXR registry (xr.xml, interaction_profile): below
// /interaction_profiles/; the extension that it needs; its inputs on both hands, on the left, and on the right. The
// script's inputs are those of the Touch controller.
constexpr std::string_view kProfiles = "/interaction_profiles/";
constexpr std::string_view kTouch = "/interaction_profiles/oculus/touch_controller";
struct Controller {
  std::string_view profile, extension, both, left, right;
};
// clang-format off
constexpr Controller kControllers[] = {
    {"khr/simple_controller", "", "aim/pose grip/pose menu/click select/click", "", ""},
    {"oculus/touch_controller", "", "aim/pose grip/pose squeeze/value thumbstick thumbstick/click trigger/value", "menu/click x/click y/click", "a/click b/click"},
    {"valve/index_controller", "", "a/click aim/pose b/click grip/pose squeeze/value thumbstick thumbstick/click trackpad trigger/click trigger/value", "", ""},
    {"htc/vive_controller", "", "aim/pose grip/pose menu/click squeeze/click trackpad trackpad/click trigger/click trigger/value", "", ""},
    {"microsoft/motion_controller", "", "aim/pose grip/pose menu/click squeeze/click thumbstick thumbstick/click trackpad trackpad/click trigger/value", "", ""},
    {"facebook/touch_controller_pro", "XR_FB_touch_controller_pro", "aim/pose grip/pose squeeze/value thumbstick thumbstick/click trigger/value", "menu/click x/click y/click", "a/click b/click"},
    {"meta/touch_controller_plus", "XR_META_touch_controller_plus", "aim/pose grip/pose squeeze/value thumbstick thumbstick/click trigger/value", "menu/click x/click y/click", "a/click b/click"},
    {"bytedance/pico_neo3_controller", "XR_BD_controller_interaction", "aim/pose grip/pose menu/click squeeze/click squeeze/value thumbstick thumbstick/click trigger/click trigger/value", "x/click y/click", "a/click b/click"},
    {"bytedance/pico4_controller", "XR_BD_controller_interaction", "aim/pose grip/pose squeeze/click squeeze/value thumbstick thumbstick/click trigger/click trigger/value", "menu/click x/click y/click", "a/click b/click"},
    {"bytedance/pico_g3_controller", "XR_BD_controller_interaction", "aim/pose grip/pose menu/click thumbstick thumbstick/click trigger/click trigger/value", "", ""},
    {"hp/mixed_reality_controller", "XR_EXT_hp_mixed_reality_controller", "aim/pose grip/pose menu/click squeeze/value thumbstick thumbstick/click trigger/value", "x/click y/click", "a/click b/click"},
    {"htc/vive_cosmos_controller", "XR_HTC_vive_cosmos_controller_interaction", "aim/pose grip/pose squeeze/click thumbstick thumbstick/click trigger/click trigger/value", "menu/click x/click y/click", "a/click b/click"},
    {"htc/vive_focus3_controller", "XR_HTC_vive_focus3_controller_interaction", "aim/pose grip/pose squeeze/click squeeze/value thumbstick thumbstick/click trigger/click trigger/value", "menu/click x/click y/click", "a/click b/click"},
    {"ml/ml2_controller", "XR_ML_ml2_controller_interaction", "aim/pose grip/pose menu/click trackpad trackpad/click trigger/click trigger/value", "", ""},
    {"ext/hand_interaction_ext", "XR_EXT_hand_interaction", "aim/pose aim_activate_ext/value grasp_ext/value grip/pose pinch_ext/value", "", ""},
    {"microsoft/hand_interaction", "XR_MSFT_hand_interaction", "aim/pose grip/pose select/value squeeze/value", "", ""},
};
// clang-format on

// Null if the runtime does not know the profile.
const Controller* controller_of(std::string_view profile) {
  const auto* const found = std::find_if(std::begin(kControllers), std::end(kControllers), [&](const Controller& one) {
    return profile.starts_with(kProfiles) && profile.substr(kProfiles.size()) == one.profile;
  });
  return found == std::end(kControllers) ? nullptr : found;
}

// True if the controller has this input.
bool has_input(const Controller& controller, std::string_view path) {
  const std::string_view left = "/user/hand/left/input/", right = "/user/hand/right/input/";
  const bool is_left = path.starts_with(left);
  if (!is_left && !path.starts_with(right)) return false;
  const auto lists = [&](std::string_view inputs) {
    const std::string part = std::string(path.substr(is_left ? left.size() : right.size())) + ' ';
    return (' ' + std::string(inputs) + ' ').find(' ' + part) != std::string::npos;
  };
  return lists(controller.both) || lists(is_left ? controller.left : controller.right);
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
    const Controller* const controller = controller_of(profile);
    if (controller == nullptr) return XR_ERROR_PATH_UNSUPPORTED;  // the specification allows this
    const std::vector<std::string>& enabled = live(instance).extensions;
    require(controller->extension.empty() ||
                std::find(enabled.begin(), enabled.end(), controller->extension) != enabled.end(),
            "binding_path", profile + " needs its extension");
    const std::span bindings(info->suggestedBindings, info->countSuggestedBindings);
    for (const XrActionSuggestedBinding& one : bindings) {
      require(!live(live(one.action).parent).attached, "attach_order");
      const std::string& path = path_string(instance, one.binding);
      require(has_input(*controller, path), "binding_path", profile + " " + path);
    }
    state().control.record.profiles.insert(profile);
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
