// The whole state of the runtime. There is one per process. It survives when the OpenXR loader closes the library.
#pragma once

#include <bit>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tests/support/xr_runtime/control.h"
#include "tests/support/xr_runtime/vulkan.h"

namespace gearshift::xr_test {

struct InstanceObject {
  static constexpr const char* kKind = "instance";
  std::set<std::string> extensions{};
  std::vector<std::string> paths{};                                            // XrPath: index in this list, plus one
  std::map<std::string, std::vector<XrActionSuggestedBinding>> suggestions{};  // by interaction profile
  bool requirements_queried = false;
  bool lost = false;
};

struct FrameState {
  XrTime time = 0;
  std::size_t record = 0;  // index in Record::frames
};

struct SessionObject {
  static constexpr const char* kKind = "session";
  XrInstance instance = XR_NULL_HANDLE;
  Graphics graphics{};
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  XrSessionState target_state = XR_SESSION_STATE_FOCUSED;  // the state that the runtime is advancing to
  int polls_before_ready = 0;
  bool running = false, lost = false;
  bool exit_requested = false, stop_requested = false, ready_requested = false;
  int waits = 0;                       // number of xrWaitFrame calls since xrBeginSession
  std::optional<FrameState> waited{};  // frame that was waited for, but not begun yet
  std::optional<FrameState> begun{};   // frame that was begun, but not ended yet
  XrTime last_display = 0;
  std::vector<XrActionSet> attached{};
  bool has_attached = false;
  std::string profile{};  // interaction profile of the current controllers
};

struct SpaceObject {
  static constexpr const char* kKind = "space";
  XrSession session = XR_NULL_HANDLE;
  Space type = Space::local;
  Pose pose{};                       // pose in the reference space or the action space
  XrAction action = XR_NULL_HANDLE;  // for action spaces
  XrPath subaction = XR_NULL_PATH;
};

struct SwapchainObject {
  static constexpr const char* kKind = "swapchain";
  XrSession session = XR_NULL_HANDLE;
  XrSwapchainCreateInfo info{};
  std::vector<SwapchainImage> images{};
  std::deque<std::uint32_t> acquired{};  // indices of acquired images, oldest first
  bool waited = false;
  std::uint32_t next = 0;
  std::optional<std::uint32_t> released{};  // index of the image that was released last
};

struct ActionSetObject {
  static constexpr const char* kKind = "action set";
  XrInstance instance = XR_NULL_HANDLE;
  std::string name{}, localized{};
  bool attached = false;
};

struct ActionValue {  // value at the last xrSyncActions
  float x = 0.0f, y = 0.0f;
  bool active = false, changed = false;
  XrTime change_time = 0;
};

struct ActionObject {
  static constexpr const char* kKind = "action";
  XrActionSet set = XR_NULL_HANDLE;
  std::string name{}, localized{};
  XrActionType type = XR_ACTION_TYPE_BOOLEAN_INPUT;
  std::vector<XrPath> subactions{};
  std::map<XrPath, ActionValue> values{};  // by subaction path; XR_NULL_PATH: for all paths together
};

// Live objects of one kind. Handles are never reused, so that the use of a destroyed handle is detected.
template <class Handle, class Object>
class Table {
 public:
  Handle add(Object object) {
    static std::uint64_t count = 0;
    // Scrambles the count, so that a number next to a handle is not a valid handle.
    const auto id = (++count * 0x9e3779b97f4a7c15u) | 1u;
    const auto handle = std::bit_cast<Handle>(id);
    objects_.emplace(handle, std::make_unique<Object>(std::move(object)));
    return handle;
  }
  Object* find(Handle handle) const {
    const auto found = objects_.find(handle);
    return found == objects_.end() ? nullptr : found->second.get();
  }
  void erase(Handle handle) { objects_.erase(handle); }
  int size() const { return static_cast<int>(objects_.size()); }
  template <class Predicate>
  std::vector<Handle> find_all(Predicate predicate) const {
    std::vector<Handle> found;
    for (const auto& [handle, object] : objects_) {
      if (predicate(*object)) found.push_back(handle);
    }
    return found;
  }

 private:
  std::unordered_map<Handle, std::unique_ptr<Object>> objects_;
};

struct OriginChange {
  XrTime time = 0;
  Pose origin{};  // in the initial LOCAL space
};

struct State {
  Control control;
  std::recursive_mutex mutex;
  const char* function = "";  // name of the OpenXR function that is running
  Table<XrInstance, InstanceObject> instances;
  Table<XrSession, SessionObject> sessions;
  Table<XrSpace, SpaceObject> spaces;
  Table<XrSwapchain, SwapchainObject> swapchains;
  Table<XrActionSet, ActionSetObject> action_sets;
  Table<XrAction, ActionObject> actions;
  std::deque<XrEventDataBuffer> events{};
  // The script's clock.
  XrTime begin = 0;            // time of the first xrBeginSession; 0: not yet begun
  std::int64_t next_step = 0;  // number of the next display period
  double hidden_until = -1.0;  // [s]
  std::map<Space, std::vector<OriginChange>> origins{};
  // Vulkan objects created through the runtime.
  std::map<VkInstance, PFN_vkGetInstanceProcAddr> vulkan_instances{};
  std::map<VkPhysicalDevice, VkInstance> vulkan_physicals{};
  std::map<VkDevice, VkPhysicalDevice> vulkan_devices{};
};
State& state();

// ---- prologue of each call (call.cpp)

struct CallRejected {  // thrown to return this result from the OpenXR function
  XrResult result;
};
[[noreturn]] void reject_call(XrResult result);
XrResult write_violation(const char* rule, const std::string& detail);  // returns the result that the rule specifies
// If the condition does not hold, records the violation and returns the rule's result from the OpenXR function.
inline void require(bool holds, const char* rule, const std::string& detail = {}) {
  if (!holds) reject_call(write_violation(rule, detail));
}
std::optional<XrResult> injected_failure(const char* function);
void log_line(const std::string& line);  // adds the line to the record, and in a flow test also to a file
void count_live();

template <class Body>
XrResult call(const char* function, Body&& body) {
  State& s = state();
  const std::lock_guard lock(s.mutex);
  s.function = function;
  ++s.control.record.calls[function];
  try {
    if (const auto failure = injected_failure(function)) return *failure;
    return body(s);
  } catch (const CallRejected& rejected) {
    return rejected.result;
  } catch (const std::exception& error) {
    log_line(std::string("error ") + function + ": " + error.what());
    return XR_ERROR_RUNTIME_FAILURE;
  }
}

// Return the object of a handle; reject the call if the handle is not live, or if its instance or session is lost.
InstanceObject& live(XrInstance handle);
SessionObject& live(XrSession handle);
SpaceObject& live(XrSpace handle);
SwapchainObject& live(XrSwapchain handle);
ActionSetObject& live(XrActionSet handle);
ActionObject& live(XrAction handle);

const void* find_chained(const void* value, XrStructureType type);  // nullptr if the chain does not contain the type

// The two-call idiom of the OpenXR section "Buffer Size Parameters".
template <class Out, class Items, class Write>
XrResult fill(std::uint32_t capacity, std::uint32_t* count, Out* out, const Items& items, Write write) {
  *count = static_cast<std::uint32_t>(items.size());
  if (capacity == 0) return XR_SUCCESS;
  if (capacity < *count) return XR_ERROR_SIZE_INSUFFICIENT;
  for (std::size_t i = 0; i < items.size(); ++i) write(out[i], items[i]);
  return XR_SUCCESS;
}
template <class Out, class Items>
XrResult fill(std::uint32_t capacity, std::uint32_t* count, Out* out, const Items& items) {
  return fill(capacity, count, out, items, [](Out& to, const auto& from) { to = static_cast<Out>(from); });
}

// ---- time (clock.cpp)

XrTime monotonic_now();
XrDuration period(const State& s);
double seconds(const State& s, XrTime time);  // on the script's clock
XrTime display_time(const State& s, std::int64_t step);
XrTime now(const State& s);                               // with Pacing::stepped: the last display time returned
std::int64_t next_display_period(State& s, XrTime last);  // sleeps with Pacing::real; counts dropped periods
void stall_periods(State& s, int periods);

// ---- session life (life.cpp)

template <class T>
void push_event(State& s, const T& event) {
  static_assert(sizeof(T) <= sizeof(XrEventDataBuffer));
  XrEventDataBuffer buffer{XR_TYPE_EVENT_DATA_BUFFER, nullptr, {}};
  *reinterpret_cast<T*>(&buffer) = event;
  s.events.push_back(buffer);
}
void set_state(State& s, XrSession handle, SessionObject& session, XrSessionState next);
void play_timeline(State& s, double until);  // handles the events until this time [s]
// Makes one legal step towards the target state.
void advance_state(State& s, XrSession handle, SessionObject& session);

// ---- spaces (space.cpp)

Pose from_xr(const XrPosef& pose);
XrPosef to_xr(const Pose& pose);
void require_unit_pose(const XrPosef& pose, const char* what);
Pose head_at(const State& s, double t);
Pose world_pose(const State& s, const SpaceObject& space, XrTime time);  // pose in the initial LOCAL space

// ---- paths, actions (paths.cpp, actions.cpp, input.cpp)

const std::string& path_string(const InstanceObject& instance, XrPath path);
XrPath path_number(InstanceObject& instance, const std::string& text);
bool is_path_part(std::string_view part);
int hand_of(XrPath path, const InstanceObject& instance);  // -1: not a hand
XrResult fill_text(std::uint32_t capacity, std::uint32_t* count, char* buffer, const std::string& text);
void check_subaction(const ActionObject& action, XrPath subaction);
Pose action_pose(const State& s, const SpaceObject& space, double t);

// ---- system (instance.cpp)

void require_system(XrSystemId system);
void require_stereo(XrViewConfigurationType type);

// ---- destruction: parents destroy their children

void drop_session(State& s, XrSession handle);
void drop_swapchain(State& s, XrSwapchain handle);
void drop_action_set(State& s, XrActionSet handle);
void leak(State& s, const char* kind, const char* parent);

// ---- capture (capture.cpp) and flows (flow.cpp)

void capture_frame(State& s, const XrFrameEndInfo& info, const SessionObject& session, FrameRecord& record);
void write_pictures(const FrameRecord& record);  // only in a flow test
void write_log(const std::string& line);
void read_flow_script(Control& control);  // from GEARSHIFT_XR_SCRIPT

}  // namespace gearshift::xr_test
