// Hands and their buttons, as OpenXR actions.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/xr/headset_session.h"
#include "engine/xr/openxr.h"

namespace gearshift::engine {

class HeadsetHands {
 public:
  // `extensions`: those that are enabled.
  HeadsetHands(XrInstance instance, XrSession session, const std::vector<std::string>& extensions);
  ~HeadsetHands();
  HeadsetHands(const HeadsetHands&) = delete;
  HeadsetHands& operator=(const HeadsetHands&) = delete;

  static std::vector<const char*> extensions();  // those that controllers need; to be enabled where they are offered
  void sync();                                   // reads the controllers' state from the runtime
  std::array<HeadsetHand, 2> read(XrSpace space, XrTime time) const;  // as of the last sync()

 private:
  XrAction make_action(const char* name, const char* label, XrActionType type);
  void suggest_bindings(const std::vector<std::string>& extensions);
  XrPath path(const char* text) const;
  bool is_pressed(XrAction action, XrPath hand, bool* is_active = nullptr) const;
  HeadsetHand read(std::size_t hand, XrSpace space, XrTime time) const;

  XrInstance instance_;
  XrSession session_;
  XrActionSet set_ = XR_NULL_HANDLE;
  std::array<XrPath, 2> hand_{};  // left, right
  XrAction aim_ = XR_NULL_HANDLE, select_ = XR_NULL_HANDLE, menu_ = XR_NULL_HANDLE, scroll_ = XR_NULL_HANDLE;
  std::array<XrSpace, 2> aim_space_{};
  bool is_focused_ = false;  // at the last sync()
};

}  // namespace gearshift::engine
