// Spaces and views: poses at a given time.
#include <algorithm>
#include <cmath>

#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

Pose origin_at(const State& s, Space space, XrTime time) {
  Pose origin = space == Space::stage ? s.control.script.stage_origin : Pose{};
  const auto changes = s.origins.find(space);
  if (changes == s.origins.end()) return origin;
  for (const OriginChange& change : changes->second) {
    if (change.time <= time) origin = change.origin;
  }
  return origin;
}

XrSpaceLocationFlags location_flags(const Pose& pose) {
  XrSpaceLocationFlags flags = 0;
  if (pose.position_valid) flags |= XR_SPACE_LOCATION_POSITION_VALID_BIT;
  if (pose.orientation_valid) flags |= XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  if (pose.tracked && pose.position_valid) flags |= XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  if (pose.tracked && pose.orientation_valid) flags |= XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  return flags;
}

Pose relative(const State& s, const SpaceObject& space, const SpaceObject& base, XrTime time) {
  return inverse(world_pose(s, base, time)) * world_pose(s, space, time);
}

void velocity(const State& s, const SpaceObject& space, const SpaceObject& base, XrTime time, XrSpaceVelocity& out) {
  constexpr XrDuration kVelocityInterval = 1'000'000;  // [ns]
  const Pose previous = relative(s, space, base, time - kVelocityInterval),
             next = relative(s, space, base, time + kVelocityInterval);
  const double interval = 2e-9 * static_cast<double>(kVelocityInterval);
  const glm::dvec3 linear = (next.position - previous.position) / interval;
  const glm::dquat turn = next.orientation * glm::conjugate(previous.orientation);
  // A small rotation by the vector r [rad] has the quaternion (1, r / 2). The sign of `half` selects the shorter of the
  // two equal rotations.
  const double half = turn.w < 0.0 ? -2.0 : 2.0;
  out.velocityFlags = previous.position_valid && next.position_valid ? XR_SPACE_VELOCITY_LINEAR_VALID_BIT : 0;
  if (previous.orientation_valid && next.orientation_valid) out.velocityFlags |= XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;
  const auto xr_vector = [](const glm::dvec3& v) {
    return XrVector3f{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  out.linearVelocity = xr_vector(linear);
  out.angularVelocity = xr_vector(glm::dvec3(turn.x, turn.y, turn.z) * half / interval);
}

Space reference_type(const Script& script, XrReferenceSpaceType type) {
  if (type == XR_REFERENCE_SPACE_TYPE_VIEW) return Space::view;
  if (type == XR_REFERENCE_SPACE_TYPE_LOCAL) return Space::local;
  require(type == XR_REFERENCE_SPACE_TYPE_STAGE && script.stage, "reference_space", std::to_string(type));
  return Space::stage;
}

std::vector<XrReferenceSpaceType> reference_types(const Script& script) {
  std::vector types{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL};
  if (script.stage) types.push_back(XR_REFERENCE_SPACE_TYPE_STAGE);
  return types;
}

XrFovf xr_fov(const Fov& fov) {
  return {static_cast<float>(fov.left), static_cast<float>(fov.right), static_cast<float>(fov.up),
          static_cast<float>(fov.down)};
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
  const bool finite =
      std::isfinite(value.position.x) && std::isfinite(value.position.y) && std::isfinite(value.position.z);
  require(finite && std::abs(norm - 1.0) <= kMaxNormError, "pose_unit", what);
}

Pose head_at(const State& s, double t) {
  Pose head = s.control.script.head(t);
  for (const Gap& gap : s.control.script.tracking_gaps) {
    if (t < gap.from || t >= gap.until) continue;
    head.tracked = false;
    head.position_valid = head.position_valid && gap.valid;
    head.orientation_valid = head.orientation_valid && gap.valid;
  }
  return head;
}

Pose world_pose(const State& s, const SpaceObject& space, XrTime time) {
  const double t = seconds(s, time);
  switch (space.type) {
    case Space::view:
      return head_at(s, t) * space.pose;
    case Space::action:
      return action_pose(s, space, t) * space.pose;
    default:
      return origin_at(s, space.type, time) * space.pose;
  }
}

namespace xr {

XrResult XRAPI_CALL EnumerateReferenceSpaces(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                             XrReferenceSpaceType* types) {
  return call("xrEnumerateReferenceSpaces", [&](State& s) {
    live(session);
    return fill(capacity, count, types, reference_types(s.control.script));
  });
}

XrResult XRAPI_CALL CreateReferenceSpace(XrSession session, const XrReferenceSpaceCreateInfo* info, XrSpace* space) {
  return call("xrCreateReferenceSpace", [&](State& s) {
    live(session);
    const Space type = reference_type(s.control.script, info->referenceSpaceType);
    require_unit_pose(info->poseInReferenceSpace, "poseInReferenceSpace");
    *space = s.spaces.add({.session = session, .type = type, .pose = from_xr(info->poseInReferenceSpace)});
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL GetReferenceSpaceBoundsRect(XrSession session, XrReferenceSpaceType type, XrExtent2Df* bounds) {
  return call("xrGetReferenceSpaceBoundsRect", [&](State& s) {
    live(session);
    const bool stage = reference_type(s.control.script, type) == Space::stage;
    *bounds = stage ? XrExtent2Df{2.0f, 2.0f} : XrExtent2Df{0.0f, 0.0f};
    return stage ? XR_SUCCESS : XR_SPACE_BOUNDS_UNAVAILABLE;
  });
}

XrResult XRAPI_CALL DestroySpace(XrSpace space) {
  return call("xrDestroySpace", [&](State& s) {
    s.spaces.erase(space);
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL LocateSpace(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location) {
  return call("xrLocateSpace", [&](State& s) {
    const SpaceObject &located = live(space), &base_space = live(base);
    require(time > 0, "time_positive");
    const Pose pose = relative(s, located, base_space, time);
    location->locationFlags = location_flags(pose);
    location->pose = to_xr(pose);
    if (const void* const chain = find_chained(location, XR_TYPE_SPACE_VELOCITY)) {
      velocity(s, located, base_space, time, *const_cast<XrSpaceVelocity*>(static_cast<const XrSpaceVelocity*>(chain)));
    }
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL LocateViews(XrSession session, const XrViewLocateInfo* info, XrViewState* view_state,
                                std::uint32_t capacity, std::uint32_t* count, XrView* views) {
  return call("xrLocateViews", [&](State& s) {
    live(session);
    require_stereo(info->viewConfigurationType);
    require(info->displayTime > 0, "time_positive");
    const SpaceObject& base = live(info->space);
    const SpaceObject head{.session = session, .type = Space::view};
    Pose pose = relative(s, head, base, info->displayTime);
    std::vector<FrameRecord>& frames = s.control.record.frames;
    const bool counts = capacity != 0 && !frames.empty();
    if (counts && frames.back().locates == 0) pose.position.x += s.control.script.early_error;
    view_state->viewStateFlags = location_flags(pose);
    const XrResult result =
        fill(capacity, count, views, std::vector<std::size_t>{0, 1}, [&](XrView& to, std::size_t eye) {
          const double side = (eye == 0 ? -0.5 : 0.5) * s.control.script.eye_distance;
          to.pose = to_xr(pose * Pose{.position = {side, 0.0, 0.0}});
          to.fov = xr_fov(s.control.script.fov[eye]);
        });
    if (counts && result == XR_SUCCESS) ++frames.back().locates;
    return result;
  });
}

}  // namespace xr
}  // namespace gearshift::xr_test
