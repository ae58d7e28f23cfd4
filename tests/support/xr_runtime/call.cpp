// Code that runs in every OpenXR function: rules, injected failures, the log; the functions that the OpenXR loader gets.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

// Rules that Khronos' validation layer does not check, although breaking them may cost a picture on a real headset.
constexpr Rule kRules[] = {
    {"validated", XR_ERROR_VALIDATION_FAILURE, "the layer checks handles, pointers, structures, enumeration values"},
    {"offered", XR_ERROR_VALIDATION_FAILURE, "a value must be one that the runtime offers: system, space, blend mode"},
    {"graphics", XR_ERROR_GRAPHICS_DEVICE_INVALID, "the runtime's requirements are queried, its device is used"},
    {"session_state", XR_ERROR_SESSION_NOT_RUNNING, "begun when READY, ended when STOPPING, frames only in between"},
    {"frame_order", XR_ERROR_CALL_ORDER_INVALID, "xrWaitFrame, xrBeginFrame, xrEndFrame; otherwise frames block"},
    {"frame_time", XR_ERROR_TIME_INVALID, "a frame ends with its predicted display time, or reprojection is wrong"},
    {"layers", XR_ERROR_LAYER_INVALID, "at most 16 layers of enabled types, with a view for each eye"},
    {"pose_unit", XR_ERROR_POSE_INVALID, "orientations are unit quaternions, positions are finite"},
    {"fov", XR_ERROR_VALIDATION_FAILURE, "the angles lie between -pi/2 and pi/2 and span something"},
    {"image_rect", XR_ERROR_SWAPCHAIN_RECT_INVALID, "the submitted rectangle lies inside the swapchain's images"},
    {"depth_info", XR_ERROR_VALIDATION_FAILURE, "0 <= minDepth < maxDepth <= 1, nearZ and farZ differ, a depth format"},
    {"image_order", XR_ERROR_CALL_ORDER_INVALID, "images are acquired, waited for and released before they are shown"},
    {"swapchain_size", XR_ERROR_VALIDATION_FAILURE, "extent, samples, layers and levels within the system's limits"},
    {"path_format", XR_ERROR_PATH_FORMAT_INVALID, "paths and names have only a-z 0-9 - _ . in their parts"},
    {"binding_path", XR_ERROR_PATH_UNSUPPORTED, "a suggested binding is a path that the controller has"},
    {"attach_order", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "actions and bindings, then attached once, then read"},
    {"action_type", XR_ERROR_ACTION_TYPE_MISMATCH, "an action is read with its own type, for a hand that it declares"},
};

void restart(Control& control) {
  State& s = state();
  const std::lock_guard lock(s.mutex);
  control.record = {.live_handles = control.record.live_handles};
  control.ends_hangs = false;
  s.events.clear();
  s.begin = 0;
  s.next_step = 0;
  s.hidden_until = -1.0;
  s.origins.clear();
}

// Aborts on an error, because a test with an incomplete script would prove nothing.
void read_flow_script(Control& control) noexcept {
  if (const char* const file = std::getenv("GEARSHIFT_XR_SCRIPT")) control.script = read_script(file);
}

// Debian has no header with this structure: the loader's document "Loader/Runtime Interface Negotiation".
struct RuntimeRequest {
  int structure_type;
  std::uint32_t structure_version;
  std::size_t structure_size;
  std::uint32_t interface_version;
  XrVersion api_version;
  PFN_xrGetInstanceProcAddr get_function;
};

struct Function {
  std::string_view name;
  PFN_xrVoidFunction address;
};
const Function functions[] = {
#define GEARSHIFT_XR_ENTRY(name) {"xr" #name, reinterpret_cast<PFN_xrVoidFunction>(&xr::name)},
    GEARSHIFT_XR_FUNCTIONS(GEARSHIFT_XR_ENTRY)
#undef GEARSHIFT_XR_ENTRY
};

XrResult XRAPI_CALL get_function(XrInstance, const char* name, PFN_xrVoidFunction* address) {
  *address = nullptr;
  if (std::string_view(name) == "xrGetInstanceProcAddr") *address = reinterpret_cast<PFN_xrVoidFunction>(&get_function);
  for (const Function& one : functions) {
    if (one.name == name) *address = one.address;
  }
  return *address == nullptr ? XR_ERROR_FUNCTION_UNSUPPORTED : XR_SUCCESS;
}

}  // namespace

State& state() {
  static State* const one = [] {
    auto* const created = new State;  // never deleted, because it must outlive the destructors of the loader
    created->control.rules = kRules;
    created->control.restart = restart;
    created->control.read_script = read_script;
    read_flow_script(created->control);
    return created;
  }();
  return *one;
}

void reject_call(XrResult result) {
  throw CallRejected{result};
}

XrResult write_violation(const char* id, const std::string& detail) {
  State& s = state();
  for (const Rule& rule : kRules) {
    if (std::string_view(rule.id) != id) continue;
    const std::string line = std::string(id) + ": " + s.function + ": " + rule.law + "; " + detail;
    s.control.record.violations.push_back(line);
    log_line("violation " + line);
    return rule.result;
  }
  throw std::logic_error(std::string("no such rule: ") + id);
}

std::optional<XrResult> injected_failure(const char* function) {
  std::vector<Failure>& failures = state().control.script.failures;
  for (auto failure = failures.begin(); failure != failures.end(); ++failure) {
    if (failure->function != function || --failure->nth > 0) continue;
    const XrResult result = failure->result;
    failures.erase(failure);
    if (state().control.script.prints)
      for (int i = 0; i < 8; ++i) std::fprintf(stderr, "ERROR [ipc_client_connect] Failed to connect to socket!\n");
    log_line(std::string("planted ") + function + " " + std::to_string(result));
    return result;
  }
  return std::nullopt;
}

void hang_if_injected(const char* function) {
  State& s = state();
  const double span = [&] {
    const std::lock_guard lock(s.mutex);
    std::vector<Hang>& hangs = s.control.script.hangs;
    for (auto hang = hangs.begin(); hang != hangs.end(); ++hang) {
      if (hang->function != function || (hang->at > 0.0 && seconds(s, now(s)) < hang->at)) continue;
      const double found = hang->span;
      hangs.erase(hang);
      log_line(std::string("hangs ") + function);
      return found;
    }
    return 0.0;
  }();
  if (span <= 0.0) return;
  ++s.control.hanging;
  const auto begun = std::chrono::steady_clock::now();
  while (!s.control.ends_hangs &&
         std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() < span)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  --s.control.hanging;
}

const char* out_folder() {
  return std::getenv("GEARSHIFT_XR_OUT");
}

void log_line(const std::string& line) {
  if (out_folder() == nullptr) return;
  // The file is closed after each line, so that no line is lost if the program crashes.
  std::ofstream(std::filesystem::path(out_folder()) / "log.txt", std::ios::app) << line << "\n";
}

const void* find_chained(const void* value, XrStructureType type) {
  const auto next_of = [](const void* structure) { return static_cast<const XrBaseInStructure*>(structure)->next; };
  const XrBaseInStructure* next = next_of(value);
  while (next != nullptr && next->type != type) next = next->next;
  return next;
}

}  // namespace gearshift::xr_test

// NOLINTBEGIN(readability-identifier-naming): the loader requires this name
extern "C" __attribute__((visibility("default"))) XrResult XRAPI_CALL
xrNegotiateLoaderRuntimeInterface(const void*, gearshift::xr_test::RuntimeRequest* request) {
  request->interface_version = 1;
  request->api_version = XR_CURRENT_API_VERSION;
  request->get_function = gearshift::xr_test::get_function;
  return XR_SUCCESS;
}
// NOLINTEND(readability-identifier-naming)

extern "C" __attribute__((visibility("default"))) gearshift::xr_test::Control* gearshift_xr_test_control() {
  return &gearshift::xr_test::state().control;
}
