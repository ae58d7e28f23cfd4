// The OpenXR C API for this library: errors as exceptions, conversions of poses. Include it only in engine/xr.
#pragma once

#include <time.h>

#include <cstdint>
#include <vector>

#include "engine/gpu/vulkan.h"

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
#include <openxr/openxr_reflection.h>

#include "engine/scene/view.h"
#include "engine/xr/headset_error.h"

// XR_EXT_user_presence, which Debian 12's headers lack.
#ifndef XR_EXT_user_presence
#define XR_EXT_USER_PRESENCE_EXTENSION_NAME "XR_EXT_user_presence"
inline constexpr auto XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT = static_cast<XrStructureType>(1000470000);
struct XrEventDataUserPresenceChangedEXT {
  XrStructureType type;
  const void* next;
  XrSession session;
  XrBool32 isUserPresent;
};
#endif

namespace gearshift::engine {

// Throws HeadsetLost if the session or the instance is lost, and HeadsetError for any other error: "WHAT failed:
// XR_ERROR_...". Does not throw for success codes such as XR_TIMEOUT_EXPIRED, XR_SESSION_NOT_FOCUSED or
// XR_FRAME_DISCARDED.
void check(XrResult result, const char* what);

// OpenXR's two-call idiom for lists of unknown length. `blank`: an element whose member `type` is set.
template <class T, class Query>
std::vector<T> list_of(const char* what, const T& blank, Query query) {
  std::uint32_t count = 0;
  check(query(0u, &count, static_cast<T*>(nullptr)), what);
  std::vector<T> items(count, blank);
  check(query(count, &count, items.data()), what);
  items.resize(count);
  return items;
}

// Loads a function of an enabled extension.
template <class Function>
Function load(XrInstance instance, const char* name) {
  PFN_xrVoidFunction function = nullptr;
  check(xrGetInstanceProcAddr(instance, name, &function), name);
  return reinterpret_cast<Function>(function);
}

inline XrPosef xr_pose(const EyePose& pose) {
  const glm::vec3 p(pose.position);
  const glm::quat q(glm::normalize(pose.orientation));
  return {{q.x, q.y, q.z, q.w}, {p.x, p.y, p.z}};
}

inline EyePose pose_of(const XrPosef& pose) {
  const XrQuaternionf& q = pose.orientation;
  const XrVector3f& p = pose.position;
  return {{p.x, p.y, p.z}, glm::normalize(glm::dquat(q.w, q.x, q.y, q.z))};
}

inline Fov fov_of(const XrFovf& fov) {
  return {fov.angleLeft, fov.angleRight, fov.angleDown, fov.angleUp};
}

inline XrFovf xr_fov(const Fov& fov) {
  return {static_cast<float>(fov.left), static_cast<float>(fov.right), static_cast<float>(fov.up),
          static_cast<float>(fov.down)};
}

}  // namespace gearshift::engine
