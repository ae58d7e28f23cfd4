// Action sets and actions: creation, binding, attachment.
#include <algorithm>
#include <string_view>

#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/profiles.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

template <class Table, class Sibling>
void check_names(const Table& table, const char* name, const char* localized, Sibling sibling) {
  require(is_path_part(name), "name_valid", name);
  require(localized[0] != '\0', "localized_valid", name);
  const auto clashes = [&](auto same) {
    return !table.find_all([&](const auto& one) { return sibling(one) && same(one); }).empty();
  };
  require(!clashes([&](const auto& one) { return one.name == name; }), "name_unique", name);
  require(!clashes([&](const auto& one) { return one.localized == localized; }), "localized_unique", localized);
}

void check_binding(const InstanceObject& instance, const std::string& profile,
                   const XrActionSuggestedBinding& binding) {
  const ActionObject& action = live(binding.action);
  require(!live(action.set).attached, "suggest_before_attach");
  const std::string& path = path_string(instance, binding.binding);
  require(has_source(profile, path), "binding_path", path);
}

}  // namespace

void drop_action_set(State& s, XrActionSet handle) {
  for (const XrAction action : s.actions.find_all([&](const ActionObject& one) { return one.set == handle; })) {
    s.actions.erase(action);  // no leak: destroying a set also destroys its actions
  }
  s.action_sets.erase(handle);
}

namespace xr {

XrResult XRAPI_CALL CreateActionSet(XrInstance instance, const XrActionSetCreateInfo* info, XrActionSet* set) {
  return call("xrCreateActionSet", [&](State& s) {
    live(instance);
    check_names(s.action_sets, info->actionSetName, info->localizedActionSetName,
                [&](const ActionSetObject& one) { return one.instance == instance; });
    *set = s.action_sets.add(
        {.instance = instance, .name = info->actionSetName, .localized = info->localizedActionSetName});
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL DestroyActionSet(XrActionSet set) {
  return call("xrDestroyActionSet", [&](State& s) {
    drop_action_set(s, set);
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL CreateAction(XrActionSet set, const XrActionCreateInfo* info, XrAction* action) {
  return call("xrCreateAction", [&](State& s) {
    const ActionSetObject& action_set = live(set);
    require(!action_set.attached, "action_before_attach");
    check_names(s.actions, info->actionName, info->localizedActionName,
                [&](const ActionObject& one) { return one.set == set; });
    ActionObject created{
        .set = set, .name = info->actionName, .localized = info->localizedActionName, .type = info->actionType};
    for (std::uint32_t i = 0; i < info->countSubactionPaths; ++i) {
      require(path_string(live(action_set.instance), info->subactionPaths[i]).starts_with("/user/"), "subaction_path");
      created.subactions.push_back(info->subactionPaths[i]);
    }
    *action = s.actions.add(std::move(created));
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL DestroyAction(XrAction action) {
  return call("xrDestroyAction", [&](State& s) {
    s.actions.erase(action);
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL SuggestInteractionProfileBindings(XrInstance instance,
                                                      const XrInteractionProfileSuggestedBinding* info) {
  return call("xrSuggestInteractionProfileBindings", [&](State&) {
    InstanceObject& object = live(instance);
    const std::string& profile = path_string(object, info->interactionProfile);
    if (!knows_profile(profile)) return XR_ERROR_PATH_UNSUPPORTED;  // OpenXR allows runtimes without this controller
    std::vector<XrActionSuggestedBinding> bindings;
    for (std::uint32_t i = 0; i < info->countSuggestedBindings; ++i) {
      check_binding(object, profile, info->suggestedBindings[i]);
      bindings.push_back(info->suggestedBindings[i]);
    }
    object.suggestions[profile] = std::move(bindings);
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL AttachSessionActionSets(XrSession session, const XrSessionActionSetsAttachInfo* info) {
  return call("xrAttachSessionActionSets", [&](State&) {
    SessionObject& object = live(session);
    require(!object.has_attached, "attach_once");
    for (std::uint32_t i = 0; i < info->countActionSets; ++i) live(info->actionSets[i]);
    for (std::uint32_t i = 0; i < info->countActionSets; ++i) {
      live(info->actionSets[i]).attached = true;
      object.attached.push_back(info->actionSets[i]);
    }
    object.has_attached = true;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL GetCurrentInteractionProfile(XrSession session, XrPath user, XrInteractionProfileState* state) {
  return call("xrGetCurrentInteractionProfile", [&](State&) {
    const SessionObject& object = live(session);
    require(object.has_attached, "set_attached");
    InstanceObject& instance = live(object.instance);
    const bool has = hand_of(user, instance) >= 0 && !object.profile.empty();
    state->interactionProfile = has ? path_number(instance, object.profile) : XR_NULL_PATH;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL CreateActionSpace(XrSession session, const XrActionSpaceCreateInfo* info, XrSpace* space) {
  return call("xrCreateActionSpace", [&](State& s) {
    live(session);
    const ActionObject& action = live(info->action);
    require(action.type == XR_ACTION_TYPE_POSE_INPUT, "action_type", action.name);
    check_subaction(action, info->subactionPath);
    require_unit_pose(info->poseInActionSpace, "poseInActionSpace");
    *space = s.spaces.add({.session = session,
                           .type = Space::action,
                           .pose = from_xr(info->poseInActionSpace),
                           .action = info->action,
                           .subaction = info->subactionPath});
    count_live();
    return XR_SUCCESS;
  });
}

}  // namespace xr
}  // namespace gearshift::xr_test
