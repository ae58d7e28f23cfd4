// Spaces and views: poses at a given time.
#include <algorithm>
#include <cmath>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

Pose head_at(const Script& script, double t) {
  Pose head = script.head(t);
  for (const Gap& gap : script.tracking_gaps) {
    if (t < gap.from || t >= gap.until) continue;
    head.tracked = head.position_valid = head.orientation_valid = false;
  }
  return head;
}

Pose origin_at(const State& s, Space space, XrTime time) {
  Pose origin = space == Space::stage ? s.control.script.stage_origin : Pose{};
  const auto changes = s.origins.find(space);
  if (changes == s.origins.end()) return origin;
  for (const auto& [from, changed] : changes->second) {
    if (from <= time) origin = changed;
  }
  return origin;
}

Pose world_pose(const State& s, const Object<XrSpace>& space, XrTime time) {  // in the initial LOCAL space
  const double t = seconds(s, time);
  switch (space.type) {
    case Space::view:
      return head_at(s.control.script, t) * space.pose;
    case Space::action:
      return action_pose(space, t) * space.pose;
    default:
      return origin_at(s, space.type, time) * space.pose;
  }
}

Pose relative(const State& s, const Object<XrSpace>& space, const Object<XrSpace>& base, XrTime time) {
  require(time > 0, "frame_time");
  return inverse(world_pose(s, base, time)) * world_pose(s, space, time);
}

XrSpaceLocationFlags location_flags(const Pose& pose) {
  XrSpaceLocationFlags flags = 0;
  if (pose.position_valid) flags |= XR_SPACE_LOCATION_POSITION_VALID_BIT;
  if (pose.orientation_valid) flags |= XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  if (pose.tracked && pose.position_valid) flags |= XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  if (pose.tracked && pose.orientation_valid) flags |= XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  return flags;
}

std::vector<XrReferenceSpaceType> reference_types(const Script& script) {
  std::vector types{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL};
  if (script.stage) types.push_back(XR_REFERENCE_SPACE_TYPE_STAGE);
  return types;
}

}  // namespace

Pose from_xr(const XrPosef& pose) {
  const XrVector3f& p = pose.position;
  const XrQuaternionf& q = pose.orientation;
  return {{p.x, p.y, p.z}, {q.w, q.x, q.y, q.z}};
}

XrPosef to_xr(const Pose& pose) {
  const auto f = [](double value) { return static_cast<float>(value); };
  const glm::dquat& q = pose.orientation;
  return {{f(q.x), f(q.y), f(q.z), f(q.w)}, {f(pose.position.x), f(pose.position.y), f(pose.position.z)}};
}

void require_unit_pose(const XrPosef& pose, const char* what) {
  const Pose value = from_xr(pose);
  const double norm = glm::dot(value.orientation, value.orientation);
  constexpr double kMaxNormError = 0.02;  // tolerance of the squared norm: the norm must be within 1 % of 1
  const bool finite = std::isfinite(value.position.x + value.position.y + value.position.z);
  require(finite && std::abs(norm - 1.0) <= kMaxNormError, "pose_unit", what);
}

XrResult XRAPI_CALL xr::EnumerateReferenceSpaces(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                                 XrReferenceSpaceType* types) {
  return call("xrEnumerateReferenceSpaces", [&](State& s) {
    live(session);
    return fill(capacity, count, types, reference_types(s.control.script));
  });
}

XrResult XRAPI_CALL xr::CreateReferenceSpace(XrSession session, const XrReferenceSpaceCreateInfo* info,
                                             XrSpace* space) {
  return call("xrCreateReferenceSpace", [&](State& s) {
    live(session);
    const std::vector<XrReferenceSpaceType> types = reference_types(s.control.script);
    require(std::find(types.begin(), types.end(), info->referenceSpaceType) != types.end(), "offered");
    require_unit_pose(info->poseInReferenceSpace, "poseInReferenceSpace");
    *space = add<XrSpace>({.parent = session,
                           .type = static_cast<Space>(info->referenceSpaceType),
                           .pose = from_xr(info->poseInReferenceSpace)});
  });
}

XrResult XRAPI_CALL xr::DestroySpace(XrSpace space) {
  return call("xrDestroySpace", [&](State&) { drop(space); });
}

XrResult XRAPI_CALL xr::LocateSpace(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location) {
  return call("xrLocateSpace", [&](State& s) {
    const Pose pose = relative(s, live(space), live(base), time);
    location->locationFlags = location_flags(pose);
    location->pose = to_xr(pose);
  });
}

XrResult XRAPI_CALL xr::LocateViews(XrSession session, const XrViewLocateInfo* info, XrViewState* view_state,
                                    std::uint32_t capacity, std::uint32_t* count, XrView* views) {
  return call("xrLocateViews", [&](State& s) {
    live(session);
    require(info->viewConfigurationType == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, "offered");
    const Object<XrSpace> head{.parent = session, .type = Space::view};
    Pose pose = relative(s, head, live(info->space), info->displayTime);
    std::vector<FrameRecord>& frames = s.control.record.frames;
    if (!frames.empty() && ++frames.back().locates == 1) pose.position.x += s.control.script.early_error;
    view_state->viewStateFlags = location_flags(pose);
    return fill(capacity, count, views, std::vector<std::size_t>{0, 1}, [&](XrView& to, std::size_t eye) {
      const double side = (eye == 0 ? -0.5 : 0.5) * kEyeDistance;
      to.pose = to_xr(pose * Pose{.position = {side, 0.0, 0.0}});
      const Fov& fov = s.control.script.fov[eye];
      to.fov = {static_cast<float>(fov.left), static_cast<float>(fov.right), static_cast<float>(fov.up),
                static_cast<float>(fov.down)};
    });
  });
}

}  // namespace gearshift::xr_test
