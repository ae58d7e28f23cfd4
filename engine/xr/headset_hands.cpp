#include "engine/xr/headset_hands.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>

namespace gearshift::engine {
namespace {

// An interaction profile: its path, and the input paths of the controller below /user/hand/left or /user/hand/right.
// null: the controller has no such input.
struct Profile {
  const char *name, *select, *menu, *scroll;
};
constexpr Profile kProfiles[] = {
    {"/interaction_profiles/khr/simple_controller", "/input/select/click", "/input/menu/click", nullptr},
    {"/interaction_profiles/oculus/touch_controller", "/input/trigger/value", nullptr, "/input/thumbstick"},
    {"/interaction_profiles/valve/index_controller", "/input/trigger/click", "/input/b/click", "/input/thumbstick"},
    {"/interaction_profiles/htc/vive_controller", "/input/trigger/click", "/input/menu/click", "/input/trackpad"},
    {"/interaction_profiles/microsoft/motion_controller", "/input/trigger/value", "/input/menu/click",
     "/input/thumbstick"},
};
// The menu buttons of the left and right hand differ on this controller.
constexpr const char* kTouch = "/interaction_profiles/oculus/touch_controller";
constexpr const char* kTouchMenus[] = {"/input/y/click", "/input/b/click"};
constexpr const char* kHands[] = {"/user/hand/left", "/user/hand/right"};

}  // namespace

HeadsetHands::HeadsetHands(XrInstance instance, XrSession session) : instance_(instance), session_(session) {
  XrActionSetCreateInfo set{XR_TYPE_ACTION_SET_CREATE_INFO};
  std::strcpy(set.actionSetName, "panel");
  std::strcpy(set.localizedActionSetName, "Panel");
  check(xrCreateActionSet(instance, &set, &set_), "xrCreateActionSet");
  for (std::size_t i = 0; i < 2; ++i) hand_[i] = path(kHands[i]);
  aim_ = make_action("aim", "Point", XR_ACTION_TYPE_POSE_INPUT);
  select_ = make_action("select", "Click", XR_ACTION_TYPE_BOOLEAN_INPUT);
  menu_ = make_action("menu", "Show or hide the panel", XR_ACTION_TYPE_BOOLEAN_INPUT);
  scroll_ = make_action("scroll", "Scroll", XR_ACTION_TYPE_VECTOR2F_INPUT);
  suggest_bindings();
  XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO};
  attach.countActionSets = 1;
  attach.actionSets = &set_;
  check(xrAttachSessionActionSets(session, &attach), "xrAttachSessionActionSets");
  for (std::size_t i = 0; i < 2; ++i) {
    XrActionSpaceCreateInfo space{XR_TYPE_ACTION_SPACE_CREATE_INFO};
    space.action = aim_;
    space.subactionPath = hand_[i];
    space.poseInActionSpace = xr_pose({});
    check(xrCreateActionSpace(session, &space, &aim_space_[i]), "xrCreateActionSpace");
  }
}

HeadsetHands::~HeadsetHands() {
  for (const XrSpace space : aim_space_) xrDestroySpace(space);
  xrDestroyActionSet(set_);  // also destroys its actions
}

XrPath HeadsetHands::path(const char* text) const {
  XrPath path = XR_NULL_PATH;
  check(xrStringToPath(instance_, text, &path), "xrStringToPath");
  return path;
}

XrAction HeadsetHands::make_action(const char* name, const char* label, XrActionType type) {
  XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO};
  info.actionType = type;
  std::snprintf(info.actionName, sizeof info.actionName, "%s", name);
  std::snprintf(info.localizedActionName, sizeof info.localizedActionName, "%s", label);
  info.countSubactionPaths = static_cast<std::uint32_t>(hand_.size());
  info.subactionPaths = hand_.data();
  XrAction action = XR_NULL_HANDLE;
  check(xrCreateAction(set_, &info, &action), "xrCreateAction");
  return action;
}

// Suggests bindings for each controller profile. A profile unknown to the runtime is skipped.
void HeadsetHands::suggest_bindings() {
  for (const Profile& profile : kProfiles) {
    std::vector<XrActionSuggestedBinding> bindings;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto bind = [&](XrAction action, const char* input) {
        if (input != nullptr) bindings.push_back({action, path((std::string(kHands[i]) + input).c_str())});
      };
      const bool is_touch = std::strcmp(profile.name, kTouch) == 0;
      bind(aim_, "/input/aim/pose");
      bind(select_, profile.select);
      bind(menu_, is_touch ? kTouchMenus[i] : profile.menu);
      bind(scroll_, profile.scroll);
    }
    XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING};
    info.interactionProfile = path(profile.name);
    info.countSuggestedBindings = static_cast<std::uint32_t>(bindings.size());
    info.suggestedBindings = bindings.data();
    const XrResult result = xrSuggestInteractionProfileBindings(instance_, &info);
    if (result != XR_ERROR_PATH_UNSUPPORTED) check(result, "xrSuggestInteractionProfileBindings");
  }
}

void HeadsetHands::sync() {
  const XrActiveActionSet active{set_, XR_NULL_PATH};
  XrActionsSyncInfo sync{XR_TYPE_ACTIONS_SYNC_INFO};
  sync.countActiveActionSets = 1;
  sync.activeActionSets = &active;
  const XrResult result = xrSyncActions(session_, &sync);
  check(result, "xrSyncActions");
  is_focused_ = result != XR_SESSION_NOT_FOCUSED;
}

std::array<HeadsetHand, 2> HeadsetHands::read(XrSpace space, XrTime time) const {
  if (!is_focused_) return {};
  return {read(0, space, time), read(1, space, time)};
}

bool HeadsetHands::is_pressed(XrAction action, XrPath hand) const {
  XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO};
  info.action = action;
  info.subactionPath = hand;
  XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
  check(xrGetActionStateBoolean(session_, &info, &state), "xrGetActionStateBoolean");
  return state.isActive == XR_TRUE && state.currentState == XR_TRUE;
}

HeadsetHand HeadsetHands::read(std::size_t hand, XrSpace space, XrTime time) const {
  HeadsetHand out;
  XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
  check(xrLocateSpace(aim_space_[hand], space, time, &location), "xrLocateSpace");
  constexpr XrSpaceLocationFlags kBoth = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  out.is_tracked = (location.locationFlags & kBoth) == kBoth;
  out.is_position_tracked = (location.locationFlags & XR_SPACE_LOCATION_POSITION_TRACKED_BIT) != 0;
  if (out.is_tracked) out.aim = pose_of(location.pose);
  out.selects = is_pressed(select_, hand_[hand]);
  out.menu = is_pressed(menu_, hand_[hand]);
  XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO};
  info.action = scroll_;
  info.subactionPath = hand_[hand];
  XrActionStateVector2f stick{XR_TYPE_ACTION_STATE_VECTOR2F};
  check(xrGetActionStateVector2f(session_, &info, &stick), "xrGetActionStateVector2f");
  if (stick.isActive == XR_TRUE) out.scroll = {stick.currentState.x, stick.currentState.y};
  return out;
}

}  // namespace gearshift::engine
