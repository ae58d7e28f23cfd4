// Well-formed actions for the tests of the test runtime: one of each type, for both hands.
#pragma once

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "tests/engine/xr/runtime_client.h"

namespace gearshift::xr_test {

inline constexpr const char* kTouchController = "/interaction_profiles/oculus/touch_controller";
inline constexpr const char* kSimpleController = "/interaction_profiles/khr/simple_controller";

inline XrPath path(XrInstance instance, const std::string& text) {
  XrPath created = XR_NULL_PATH;
  REQUIRE(xrStringToPath(instance, text.c_str(), &created) == XR_SUCCESS);
  return created;
}

inline XrActionSetCreateInfo set_info(const char* name, const char* localized) {
  XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO};
  std::snprintf(info.actionSetName, sizeof info.actionSetName, "%s", name);
  std::snprintf(info.localizedActionSetName, sizeof info.localizedActionSetName, "%s", localized);
  return info;
}

inline XrActionCreateInfo action_info(const char* name, const char* localized, XrActionType type) {
  XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO};
  std::snprintf(info.actionName, sizeof info.actionName, "%s", name);
  std::snprintf(info.localizedActionName, sizeof info.localizedActionName, "%s", localized);
  info.actionType = type;
  return info;
}

struct Controls {
  explicit Controls(const Client& program) : instance(program.instance), session(program.session) {
    for (std::size_t side = 0; side < 2; ++side)
      hands[side] = path(instance, side == 0 ? "/user/hand/left" : "/user/hand/right");
    const XrActionSetCreateInfo info = set_info("cabin", "Cabin");
    REQUIRE(xrCreateActionSet(instance, &info, &set) == XR_SUCCESS);
    pull = action("pull", XR_ACTION_TYPE_FLOAT_INPUT);
    press = action("press", XR_ACTION_TYPE_BOOLEAN_INPUT);
    move = action("move", XR_ACTION_TYPE_VECTOR2F_INPUT);
    aim = action("aim", XR_ACTION_TYPE_POSE_INPUT);
    buzz = action("buzz", XR_ACTION_TYPE_VIBRATION_OUTPUT);
  }

  XrAction action(const char* name, XrActionType type) const {
    XrActionCreateInfo info = action_info(name, name, type);
    info.countSubactionPaths = 2;
    info.subactionPaths = hands;
    XrAction created = XR_NULL_HANDLE;
    REQUIRE(xrCreateAction(set, &info, &created) == XR_SUCCESS);
    return created;
  }

  XrResult suggest(const char* profile, const std::vector<std::pair<XrAction, std::string>>& bindings) const {
    std::vector<XrActionSuggestedBinding> list;
    list.reserve(bindings.size());
    for (const auto& [one, to] : bindings) list.push_back({one, path(instance, to)});
    const XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, nullptr,
                                                    path(instance, profile), static_cast<std::uint32_t>(list.size()),
                                                    list.data()};
    return xrSuggestInteractionProfileBindings(instance, &info);
  }
  XrResult suggest_all() const {
    return suggest(kTouchController, {{pull, "/user/hand/left/input/trigger/value"},
                                      {pull, "/user/hand/right/input/trigger"},
                                      {press, "/user/hand/right/input/a/click"},
                                      {press, "/user/hand/left/input/squeeze/value"},
                                      {move, "/user/hand/left/input/thumbstick"},
                                      {aim, "/user/hand/left/input/aim/pose"},
                                      {aim, "/user/hand/right/input/grip/pose"},
                                      {buzz, "/user/hand/right/output/haptic"}});
  }
  XrResult attach() const {
    const XrSessionActionSetsAttachInfo info{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set};
    return xrAttachSessionActionSets(session, &info);
  }
  XrResult sync() const {
    const XrActiveActionSet active{set, XR_NULL_PATH};
    const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
    return xrSyncActions(session, &info);
  }
  XrActionStateGetInfo get(XrAction what, int hand) const {
    return {XR_TYPE_ACTION_STATE_GET_INFO, nullptr, what, hand < 0 ? XR_NULL_PATH : hands[hand]};
  }
  XrActionStateFloat read_float(XrAction what, int hand) const {
    const XrActionStateGetInfo info = get(what, hand);
    XrActionStateFloat state{XR_TYPE_ACTION_STATE_FLOAT};
    REQUIRE(xrGetActionStateFloat(session, &info, &state) == XR_SUCCESS);
    return state;
  }
  XrActionStateBoolean read_bool(XrAction what, int hand) const {
    const XrActionStateGetInfo info = get(what, hand);
    XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
    REQUIRE(xrGetActionStateBoolean(session, &info, &state) == XR_SUCCESS);
    return state;
  }
  XrResult pulse(float amplitude, XrAction what, int hand) const {
    const XrHapticVibration vibration{XR_TYPE_HAPTIC_VIBRATION, nullptr, 50'000'000, 160.0f, amplitude};
    const XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO, nullptr, what, hand < 0 ? XR_NULL_PATH : hands[hand]};
    return xrApplyHapticFeedback(session, &info, reinterpret_cast<const XrHapticBaseHeader*>(&vibration));
  }

  XrInstance instance;
  XrSession session;
  XrPath hands[2] = {XR_NULL_PATH, XR_NULL_PATH};
  XrActionSet set = XR_NULL_HANDLE;
  XrAction pull, press, move, aim, buzz;
};

}  // namespace gearshift::xr_test
