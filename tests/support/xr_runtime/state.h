// The whole state of the runtime. There is one per process. It survives when the OpenXR loader closes the library.
#pragma once

#include <time.h>
#include <vulkan/vulkan.h>

#include <bit>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <openxr/openxr_platform.h>

#include "tests/support/xr_runtime/control.h"

// Fields left out of a designated initializer are zero, as Vulkan requires for unused fields.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

// The functions that engine/xr calls, without the prefix "xr".
// clang-format off
#define GEARSHIFT_XR_FUNCTIONS(_)                                                                                      \
  _(EnumerateInstanceExtensionProperties) _(CreateInstance) _(DestroyInstance) _(GetInstanceProperties) _(PollEvent)   \
  _(GetSystem) _(GetSystemProperties) _(EnumerateEnvironmentBlendModes) _(EnumerateViewConfigurationViews)             \
  _(CreateSession) _(DestroySession) _(RequestExitSession) _(EnumerateReferenceSpaces) _(CreateReferenceSpace) _(CreateActionSpace)          \
  _(LocateSpace) _(DestroySpace) _(EnumerateSwapchainFormats) _(CreateSwapchain) _(DestroySwapchain)                   \
  _(EnumerateSwapchainImages) _(AcquireSwapchainImage) _(WaitSwapchainImage) _(ReleaseSwapchainImage) _(BeginSession)  \
  _(EndSession) _(WaitFrame) _(BeginFrame) _(EndFrame) _(LocateViews) _(StringToPath) _(CreateActionSet)               \
  _(DestroyActionSet) _(CreateAction) _(SuggestInteractionProfileBindings) _(AttachSessionActionSets)                  \
  _(GetActionStateBoolean) _(GetActionStateVector2f) _(SyncActions) _(GetVulkanGraphicsRequirements2KHR)               \
  _(CreateVulkanInstanceKHR) _(GetVulkanGraphicsDevice2KHR) _(CreateVulkanDeviceKHR) _(ConvertTimespecTimeToTimeKHR)
// clang-format on

namespace gearshift::xr_test {
namespace xr {

// Declares each function with its OpenXR type, for example XrResult WaitFrame(XrSession, const XrFrameWaitInfo*,
// XrFrameState*); NOLINTBEGIN(bugprone-macro-parentheses): a declared name cannot have parentheses
#define GEARSHIFT_XR_DECLARE(name) std::remove_pointer_t<PFN_xr##name> name;
GEARSHIFT_XR_FUNCTIONS(GEARSHIFT_XR_DECLARE)
#undef GEARSHIFT_XR_DECLARE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace xr

struct SwapchainImage {
  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  bool has_layout = false;  // already in the layout that XR_KHR_vulkan_enable2 promises
};

struct Graphics {
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
};

struct ActionValue {  // value at the last xrSyncActions
  float x = 0.0f, y = 0.0f;
  bool active = false;
};

template <class Handle>
struct Object;

template <>
struct Object<XrInstance> {
  std::vector<std::string> paths{};                                            // XrPath: index in this list, plus one
  std::map<std::string, std::vector<XrActionSuggestedBinding>> suggestions{};  // by interaction profile
  std::vector<std::string> extensions{};                                       // enabled
  bool requirements_queried = false;
  bool lost = false;
};

template <>
struct Object<XrSession> {
  XrInstance parent = XR_NULL_HANDLE;
  Graphics graphics{};
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  XrSessionState target_state = XR_SESSION_STATE_FOCUSED;  // the state that the runtime is advancing to
  int polls_before_ready = 0;
  bool running = false, lost = false;
  bool exit_requested = false, stop_requested = false, ready_requested = false;
  int waits = 0;                          // number of xrWaitFrame calls since xrBeginSession
  std::optional<std::size_t> waited{};    // index of the frame that was waited for, but not begun yet
  std::optional<std::size_t> begun{};     // index of the frame that was begun, but not ended yet
  bool attached = false, synced = false;  // has its action sets; has read them with focus
};

template <>
struct Object<XrSpace> {
  XrSession parent = XR_NULL_HANDLE;
  Space type = Space::local;
  Pose pose{};                       // pose in the reference space or the action space
  XrAction action = XR_NULL_HANDLE;  // for action spaces
  XrPath subaction = XR_NULL_PATH;
};

template <>
struct Object<XrSwapchain> {
  XrSession parent = XR_NULL_HANDLE;
  XrSwapchainCreateInfo info{};
  std::vector<SwapchainImage> images{};
  std::deque<std::uint32_t> acquired{};  // indices of acquired images, oldest first
  bool waited = false;
  std::uint32_t next = 0;
  std::optional<std::uint32_t> released{};  // index of the image that was released last
};

template <>
struct Object<XrActionSet> {
  XrInstance parent = XR_NULL_HANDLE;
  bool attached = false;
};

template <>
struct Object<XrAction> {
  XrActionSet parent = XR_NULL_HANDLE;
  XrActionType type = XR_ACTION_TYPE_BOOLEAN_INPUT;
  std::map<XrPath, ActionValue> values{};  // by subaction path
};

template <class Handle>
using Table = std::map<Handle, Object<Handle>>;  // live objects of one kind

struct State {
  Control control;
  std::recursive_mutex mutex;
  const char* function = "";  // name of the OpenXR function that is running
  std::tuple<Table<XrInstance>, Table<XrSession>, Table<XrSpace>, Table<XrSwapchain>, Table<XrActionSet>,
             Table<XrAction>>
      tables;
  std::deque<XrEventDataBuffer> events{};
  // The script's clock.
  XrTime begin = 0;            // time of the first xrBeginSession; 0: not yet begun
  std::int64_t next_step = 0;  // number of the next display period
  double hidden_until = -1.0;  // [s]
  std::map<Space, std::vector<std::pair<XrTime, Pose>>> origins{};  // from this time on, in the initial LOCAL space
  // The Vulkan instance, and the devices created through the runtime.
  VkInstance vulkan_instance = VK_NULL_HANDLE;
  VkPhysicalDevice vulkan_physical = VK_NULL_HANDLE;
  VkDevice vulkan_device = VK_NULL_HANDLE;

  template <class Handle>
  Table<Handle>& all() {
    return std::get<Table<Handle>>(tables);
  }
};
State& state();

// ---- prologue of each call (call.cpp)

struct CallRejected {  // thrown to return this result from the OpenXR function
  XrResult result;
};
[[noreturn]] void reject_call(XrResult result);
XrResult write_violation(const char* rule, const std::string& detail = {});  // returns the rule's result
// If the condition does not hold, records the violation and returns the rule's result from the OpenXR function.
inline void require(bool holds, const char* rule, const std::string& detail = {}) {
  if (!holds) reject_call(write_violation(rule, detail));
}
std::optional<XrResult> injected_failure(const char* function);
void hang_if_injected(const char* function);  // call without the lock
void log_line(const std::string& line);       // writes to log.txt in a flow test

template <class Body>
XrResult call(const char* function, Body&& body) {
  State& s = state();
  hang_if_injected(function);
  const std::lock_guard lock(s.mutex);
  s.function = function;
  ++s.control.record.calls[function];
  try {
    if (const auto failure = injected_failure(function)) return *failure;
    if constexpr (std::is_void_v<decltype(body(s))>) {
      body(s);
      return XR_SUCCESS;
    } else {
      return body(s);
    }
  } catch (const CallRejected& rejected) {
    return rejected.result;
  } catch (const std::exception& error) {
    log_line(std::string("error ") + function + ": " + error.what());
    return XR_ERROR_RUNTIME_FAILURE;
  }
}

// Adds an object. Handles are never reused, and are scrambled so that a number next to a handle is not a valid handle.
template <class Handle>
Handle add(Object<Handle> object) {
  static std::uint64_t count = 0;
  const auto handle = std::bit_cast<Handle>((++count * 0x9e3779b97f4a7c15u) | 1u);
  state().all<Handle>().emplace(handle, std::move(object));
  ++state().control.record.live_handles;
  return handle;
}

template <class Handle>
void drop(Handle handle) {
  state().control.record.live_handles -= static_cast<int>(state().all<Handle>().erase(handle));
}

// Calls `use` with each object that has this parent. `use` may drop the object.
template <class Handle, class Parent, class Function>
void for_children(Parent parent, Function use) {
  Table<Handle>& table = state().all<Handle>();
  for (auto next = table.begin(); next != table.end();) {
    const auto& [handle, object] = *next++;
    if (object.parent == parent) use(handle);
  }
}

// Drops objects that the program left to their parent's destruction.
template <class Handle, class Parent, class Function>
void drop_leaked(Parent parent, Function drop_one) {
  for_children<Handle>(parent, [&](Handle handle) {
    drop_one(handle);
    ++state().control.record.leaks;
    log_line("leak");
  });
}

// Returns the object of a handle; rejects the call if the handle is not live, or if its instance or session is lost.
template <class Handle>
Object<Handle>& live(Handle handle) {
  Table<Handle>& table = state().all<Handle>();
  const auto found = table.find(handle);
  if (found == table.end()) reject_call(XR_ERROR_HANDLE_INVALID);
  constexpr bool is_instance = std::is_same_v<Handle, XrInstance>;
  if constexpr (!is_instance) live(found->second.parent);
  if constexpr (is_instance || std::is_same_v<Handle, XrSession>) {
    if (found->second.lost) reject_call(is_instance ? XR_ERROR_INSTANCE_LOST : XR_ERROR_SESSION_LOST);
  }
  return found->second;
}

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

// ---- time, session states and events (session.cpp)

template <class T>
void push_event(State& s, const T& event) {
  static_assert(sizeof(T) <= sizeof(XrEventDataBuffer));
  XrEventDataBuffer buffer{XR_TYPE_EVENT_DATA_BUFFER, nullptr, {}};
  *reinterpret_cast<T*>(&buffer) = event;
  s.events.push_back(buffer);
}

inline constexpr XrDuration kPeriodNs = 11'111'111;
double seconds(const State& s, XrTime time);  // on the script's clock
XrTime display_time(const State& s, std::int64_t step);
XrTime now(const State& s);                                     // with Pacing::stepped: the last display time returned
std::int64_t next_display_period(State& s, bool counts_drops);  // sleeps with Pacing::real; counts dropped periods
void set_state(State& s, XrSession handle, XrSessionState next);
void play_timeline(State& s, double until);      // handles the events until this time [s]
void advance_state(State& s, XrSession handle);  // makes one legal step towards the target state

// ---- poses (space.cpp, actions.cpp)

Pose from_xr(const XrPosef& pose);
XrPosef to_xr(const Pose& pose);
void require_unit_pose(const XrPosef& pose, const char* what);
Pose action_pose(const Object<XrSpace>& space, double t);

void drop_session(XrSession handle);       // with its children (session.cpp)
void drop_action_set(XrActionSet handle);  // with its actions (actions.cpp)

// ---- swapchains, and Vulkan on the program's device; these functions throw std::runtime_error (swapchain.cpp)

void drop_swapchain(XrSwapchain handle);
Graphics open_graphics(const XrSessionCreateInfo& info);
void close_graphics(const Graphics& graphics);
bool is_depth(std::int64_t format);
// Reads a rectangle of the image that was released last: four bytes per pixel, rows from the top.
std::vector<std::uint8_t> read_pixels(const XrSwapchainSubImage& region);

// ---- flows

const char* out_folder();              // of a flow test; otherwise nullptr (call.cpp)
Script read_script(const char* file);  // throws std::runtime_error (script.cpp)

}  // namespace gearshift::xr_test
