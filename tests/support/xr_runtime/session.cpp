// Sessions: creation, begin, end, exit requests.
#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

template <class Table, class Drop>
void drop_children(State& s, XrSession session, const Table& table, const char* kind, Drop drop) {
  for (const auto handle : table.find_all([&](const auto& one) { return one.session == session; })) {
    leak(s, kind, "session");
    drop(handle);
  }
}

// True if the event belongs to the session. All session events store their session right after the event header.
bool is_event_of(const XrEventDataBuffer& event, XrSession session) {
  return event.type != XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING &&
         reinterpret_cast<const XrEventDataSessionStateChanged&>(event).session == session;
}

Graphics bind(State& s, const XrSessionCreateInfo& info) {
  const auto* const binding =
      static_cast<const XrGraphicsBindingVulkanKHR*>(find_chained(&info, XR_TYPE_GRAPHICS_BINDING_VULKAN_KHR));
  require(binding != nullptr, "graphics_binding", "there is none");
  const auto created = s.vulkan_devices.find(binding->device);
  require(created != s.vulkan_devices.end(), "graphics_binding", "the device is not of xrCreateVulkanDeviceKHR");
  require(created->second == binding->physicalDevice, "graphics_binding", "physicalDevice");
  require(s.vulkan_physicals.at(created->second) == binding->instance, "graphics_binding", "instance");
  const PFN_vkGetInstanceProcAddr get = s.vulkan_instances.at(binding->instance);
  return open_graphics(*binding, get);
}

}  // namespace

void drop_session(State& s, XrSession handle) {
  SessionObject& session = *s.sessions.find(handle);
  drop_children(s, handle, s.swapchains, "swapchain", [&](XrSwapchain one) { drop_swapchain(s, one); });
  drop_children(s, handle, s.spaces, "space", [&](XrSpace one) { s.spaces.erase(one); });
  close_graphics(session.graphics);
  s.sessions.erase(handle);
}

namespace xr {

XrResult XRAPI_CALL CreateSession(XrInstance instance, const XrSessionCreateInfo* info, XrSession* session) {
  return call("xrCreateSession", [&](State& s) {
    const InstanceObject& owner = live(instance);
    require_system(info->systemId);
    require(owner.requirements_queried, "graphics_requirements");
    if (s.sessions.size() != 0) return XR_ERROR_LIMIT_REACHED;
    SessionObject created{.instance = instance, .graphics = bind(s, *info)};
    created.polls_before_ready = s.control.script.polls_before_ready;
    *session = s.sessions.add(std::move(created));
    SessionObject& object = *s.sessions.find(*session);
    set_state(s, *session, object, XR_SESSION_STATE_IDLE);
    if (object.polls_before_ready == 0) set_state(s, *session, object, XR_SESSION_STATE_READY);
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL DestroySession(XrSession session) {
  return call("xrDestroySession", [&](State& s) {
    drop_session(s, session);
    std::erase_if(s.events, [&](const XrEventDataBuffer& event) { return is_event_of(event, session); });
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL BeginSession(XrSession session, const XrSessionBeginInfo* info) {
  return call("xrBeginSession", [&](State& s) {
    SessionObject& object = live(session);
    require(!object.running, "session_begun_twice");
    require(object.state == XR_SESSION_STATE_READY, "session_ready");
    require_stereo(info->primaryViewConfigurationType);
    if (s.begin == 0) s.begin = monotonic_now();
    object.running = true;
    object.stop_requested = false;
    object.waits = 0;
    object.last_display = 0;
    log_line("begin");
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL EndSession(XrSession session) {
  return call("xrEndSession", [&](State& s) {
    SessionObject& object = live(session);
    require(object.running, "session_running");
    require(object.state == XR_SESSION_STATE_STOPPING, "session_stopping");
    object.running = object.stop_requested = false;
    object.waited.reset();
    object.begun.reset();
    log_line("end");
    set_state(s, session, object, XR_SESSION_STATE_IDLE);
    if (object.exit_requested) {
      set_state(s, session, object, XR_SESSION_STATE_EXITING);
    } else if (object.ready_requested) {
      object.ready_requested = false;
      set_state(s, session, object, XR_SESSION_STATE_READY);
    }
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL RequestExitSession(XrSession session) {
  return call("xrRequestExitSession", [&](State& s) {
    SessionObject& object = live(session);
    require(object.running, "session_running");
    object.exit_requested = true;
    object.stop_requested = true;
    advance_state(s, session, object);
    return XR_SUCCESS;
  });
}

}  // namespace xr
}  // namespace gearshift::xr_test
