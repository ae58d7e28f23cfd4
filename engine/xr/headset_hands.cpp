#include "engine/xr/headset_hands.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

namespace gearshift::engine {
namespace {

// An interaction profile of the OpenXR registry (xr.xml): its path, the extension that it needs (null: none), and the
// input paths of the controller below /user/hand/left or /user/hand/right. null: the controller has no such input.
struct Profile {
  const char *name, *extension, *select, *menu_left, *menu_right, *scroll;
};
constexpr const char *kTrigger = "/input/trigger/value", *kClick = "/input/trigger/click", *kMenu = "/input/menu/click",
                     *kY = "/input/y/click", *kB = "/input/b/click", *kStick = "/input/thumbstick",
                     *kPad = "/input/trackpad";
constexpr const char* kPico = "XR_BD_controller_interaction";
// clang-format off
constexpr Profile kProfiles[] = {
    {"khr/simple_controller", nullptr, "/input/select/click", kMenu, kMenu, nullptr},
    {"oculus/touch_controller", nullptr, kTrigger, kY, kB, kStick},
    {"valve/index_controller", nullptr, kClick, kB, kB, kStick},
    {"htc/vive_controller", nullptr, kClick, kMenu, kMenu, kPad},
    {"microsoft/motion_controller", nullptr, kTrigger, kMenu, kMenu, kStick},
    {"facebook/touch_controller_pro", "XR_FB_touch_controller_pro", kTrigger, kY, kB, kStick},
    {"meta/touch_controller_plus", "XR_META_touch_controller_plus", kTrigger, kY, kB, kStick},
    {"bytedance/pico_neo3_controller", kPico, kTrigger, kY, kB, kStick},
    {"bytedance/pico4_controller", kPico, kTrigger, kY, kB, kStick},
    {"bytedance/pico_g3_controller", kPico, kTrigger, kMenu, kMenu, kStick},
    {"hp/mixed_reality_controller", "XR_EXT_hp_mixed_reality_controller", kTrigger, kMenu, kMenu, kStick},
    {"htc/vive_cosmos_controller", "XR_HTC_vive_cosmos_controller_interaction", kTrigger, kY, kB, kStick},
    {"htc/vive_focus3_controller", "XR_HTC_vive_focus3_controller_interaction", kTrigger, kY, kB, kStick},
    {"ml/ml2_controller", "XR_ML_ml2_controller_interaction", kTrigger, kMenu, kMenu, kPad},
    {"ext/hand_interaction_ext", "XR_EXT_hand_interaction", "/input/aim_activate_ext/value", nullptr, nullptr, nullptr},
    {"microsoft/hand_interaction", "XR_MSFT_hand_interaction", "/input/select/value", nullptr, nullptr, nullptr},
};
// clang-format on
constexpr const char* kHands[] = {"/user/hand/left", "/user/hand/right"};

}  // namespace

HeadsetHands::HeadsetHands(XrInstance instance, XrSession session, const std::vector<std::string>& extensions)
    : instance_(instance), session_(session) {
  XrActionSetCreateInfo set{XR_TYPE_ACTION_SET_CREATE_INFO};
  std::strcpy(set.actionSetName, "panel");
  std::strcpy(set.localizedActionSetName, "Panel");
  check(xrCreateActionSet(instance, &set, &set_), "xrCreateActionSet");
  for (std::size_t i = 0; i < 2; ++i) hand_[i] = path(kHands[i]);
  aim_ = make_action("aim", "Point", XR_ACTION_TYPE_POSE_INPUT);
  select_ = make_action("select", "Click", XR_ACTION_TYPE_BOOLEAN_INPUT);
  menu_ = make_action("menu", "Show or hide the panel", XR_ACTION_TYPE_BOOLEAN_INPUT);
  scroll_ = make_action("scroll", "Scroll", XR_ACTION_TYPE_VECTOR2F_INPUT);
  suggest_bindings(extensions);
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

// Suggests bindings for each controller whose extension is enabled. A profile unknown to the runtime is skipped.
void HeadsetHands::suggest_bindings(const std::vector<std::string>& extensions) {
  for (const Profile& profile : kProfiles) {
    if (profile.extension != nullptr &&
        std::find(extensions.begin(), extensions.end(), profile.extension) == extensions.end())
      continue;
    std::vector<XrActionSuggestedBinding> bindings;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto bind = [&](XrAction action, const char* input) {
        if (input != nullptr) bindings.push_back({action, path((std::string(kHands[i]) + input).c_str())});
      };
      bind(aim_, "/input/aim/pose");
      bind(select_, profile.select);
      bind(menu_, i == 0 ? profile.menu_left : profile.menu_right);
      bind(scroll_, profile.scroll);
    }
    XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING};
    info.interactionProfile = path((std::string("/interaction_profiles/") + profile.name).c_str());
    info.countSuggestedBindings = static_cast<std::uint32_t>(bindings.size());
    info.suggestedBindings = bindings.data();
    const XrResult result = xrSuggestInteractionProfileBindings(instance_, &info);
    if (result != XR_ERROR_PATH_UNSUPPORTED) check(result, "xrSuggestInteractionProfileBindings");
  }
}

std::vector<const char*> HeadsetHands::extensions() {
  std::vector<const char*> all;
  for (const Profile& profile : kProfiles) {
    const bool is_new =
        profile.extension != nullptr && (all.empty() || std::string_view(all.back()) != profile.extension);
    if (is_new) all.push_back(profile.extension);
  }
  return all;
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

bool HeadsetHands::is_pressed(XrAction action, XrPath hand, bool* is_active) const {
  XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO};
  info.action = action;
  info.subactionPath = hand;
  XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
  check(xrGetActionStateBoolean(session_, &info, &state), "xrGetActionStateBoolean");
  if (is_active != nullptr) *is_active = state.isActive == XR_TRUE;
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
  out.selects = is_pressed(select_, hand_[hand], &out.is_active);
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
