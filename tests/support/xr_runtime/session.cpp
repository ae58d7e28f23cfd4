// Sessions: their states, how the timeline's events change them, always in a legal order, and display time. XrTime is
// CLOCK_MONOTONIC; the script's clock is the time since the first xrBeginSession.
#include <algorithm>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

XrTime monotonic_now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1'000'000'000 + time.tv_nsec;
}

void change_origin(State& s, XrSession handle, const Event& event) {
  auto& changes = s.origins[event.space];
  const Pose at_first = event.space == Space::stage ? s.control.script.stage_origin : Pose{};
  const Pose previous = changes.empty() ? at_first : changes.back().second;
  const XrTime time = display_time(s, s.next_step + event.frames_ahead);
  changes.push_back({time, previous * event.pose});
  XrEventDataReferenceSpaceChangePending pending{XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING};
  pending.session = handle;
  pending.referenceSpaceType = static_cast<XrReferenceSpaceType>(event.space);
  pending.changeTime = time;
  pending.poseValid = XR_TRUE;
  pending.poseInPreviousSpace = to_xr(event.pose);
  push_event(s, pending);
}

// XR_EXT_user_presence; the numbers are those of the registry, because Debian 12's headers lack it.
void send_presence(State& s, XrSession handle, bool is_present) {
  if (!s.control.script.user_presence) return;
  struct {
    XrStructureType type = static_cast<XrStructureType>(1000470000);
    const void* next = nullptr;
    XrSession session = XR_NULL_HANDLE;
    XrBool32 is_present = XR_FALSE;
  } event;
  event.session = handle;
  event.is_present = is_present ? XR_TRUE : XR_FALSE;
  push_event(s, event);
}

void lose_instance(State& s) {
  s.all<XrInstance>().begin()->second.lost = true;
  XrEventDataInstanceLossPending loss{XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING};
  loss.lossTime = now(s);
  push_event(s, loss);
}

void step_down(State& s, XrSession handle, XrSessionState target) {
  const XrSessionState& state = s.all<XrSession>().at(handle).state;
  while (state > target && state <= XR_SESSION_STATE_FOCUSED)
    set_state(s, handle, static_cast<XrSessionState>(state - 1));
}

void play_for_session(State& s, const Event& event, XrSession handle, Object<XrSession>& session) {
  switch (event.kind) {
    case Event::Kind::focused:
      session.target_state = XR_SESSION_STATE_FOCUSED;
      break;
    case Event::Kind::visible:
      session.target_state = XR_SESSION_STATE_VISIBLE;
      break;
    case Event::Kind::synchronized:
      session.target_state = XR_SESSION_STATE_SYNCHRONIZED;
      break;
    case Event::Kind::ready:
      session.ready_requested = true;
      break;
    case Event::Kind::exit:
      session.exit_requested = true;
      [[fallthrough]];
    case Event::Kind::stopping:
      if (!session.running) return;
      session.stop_requested = true;
      return advance_state(s, handle);
    case Event::Kind::loss_pending:
      set_state(s, handle, XR_SESSION_STATE_LOSS_PENDING);
      session.lost = true;
      return;
    case Event::Kind::absent:
    case Event::Kind::present:
      return send_presence(s, handle, event.kind == Event::Kind::present);
    case Event::Kind::space_change:
      return change_origin(s, handle, event);
    default:
      break;
  }
  if (session.running) step_down(s, handle, session.target_state);
  if (session.ready_requested && session.state == XR_SESSION_STATE_IDLE) {
    session.ready_requested = false;
    set_state(s, handle, XR_SESSION_STATE_READY);
  }
}

void play_event(State& s, const Event& event) {
  if (event.kind == Event::Kind::instance_loss) return lose_instance(s);
  if (event.kind == Event::Kind::hidden) s.hidden_until = event.at + event.span;
  if (event.kind == Event::Kind::stall) {
    s.control.record.dropped += static_cast<std::uint64_t>(event.periods);
    s.next_step += event.periods;
  }
  for (auto& [handle, session] : s.all<XrSession>()) {
    if (!session.lost) play_for_session(s, event, handle, session);
  }
}

}  // namespace

double seconds(const State& s, XrTime time) {
  return s.begin == 0 ? 0.0 : static_cast<double>(time - s.begin) * 1e-9;
}

XrTime display_time(const State& s, std::int64_t step) {
  return s.begin + step * kPeriodNs;
}

XrTime now(const State& s) {
  if (s.begin == 0 || s.control.script.pacing == Pacing::real) return monotonic_now();
  return display_time(s, std::max<std::int64_t>(s.next_step - 1, 0));
}

std::int64_t next_display_period(State& s, bool counts_drops) {
  if (s.control.script.pacing == Pacing::real) {
    const std::int64_t free = (monotonic_now() - s.begin) / kPeriodNs + 1;
    // A frame must begin one period before its display time. Periods for which this is already too late count as
    // dropped.
    if (counts_drops && free > s.next_step) s.control.record.dropped += static_cast<std::uint64_t>(free - s.next_step);
    s.next_step = std::max(free, s.next_step);
    const XrTime time = display_time(s, s.next_step - 1);
    const timespec until{.tv_sec = time / 1'000'000'000, .tv_nsec = time % 1'000'000'000};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
  }
  return s.next_step++;
}

void set_state(State& s, XrSession handle, XrSessionState next) {
  static constexpr const char* kNames[] = {"UNKNOWN", "IDLE",     "READY",        "SYNCHRONIZED", "VISIBLE",
                                           "FOCUSED", "STOPPING", "LOSS_PENDING", "EXITING"};
  s.all<XrSession>().at(handle).state = next;
  s.control.record.state = next;
  XrEventDataSessionStateChanged changed{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED};
  changed.session = handle;
  changed.state = next;
  changed.time = now(s);
  push_event(s, changed);
  log_line(std::string("state ") + kNames[next]);
}

void play_timeline(State& s, double until) {
  if (s.begin == 0) return;
  std::vector<Event>& timeline = s.control.script.timeline;
  constexpr double kTolerance = 1e-6;  // [s] the period is rounded to nanoseconds
  while (true) {
    const auto next =
        std::min_element(timeline.begin(), timeline.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
    if (next == timeline.end() || next->at > until + kTolerance) return;
    const Event event = *next;
    timeline.erase(next);
    play_event(s, event);
  }
}

void advance_state(State& s, XrSession handle) {
  const Object<XrSession>& session = s.all<XrSession>().at(handle);
  if (session.stop_requested) {
    step_down(s, handle, XR_SESSION_STATE_SYNCHRONIZED);
    if (session.state != XR_SESSION_STATE_STOPPING) set_state(s, handle, XR_SESSION_STATE_STOPPING);
    return;
  }
  // The session becomes SYNCHRONIZED only after a first xrWaitFrame. From then on, each frame moves the state one step
  // towards the target state.
  if (session.waits < 1 || session.state >= XR_SESSION_STATE_STOPPING) return;
  if (session.state < session.target_state) {
    set_state(s, handle, static_cast<XrSessionState>(session.state + 1));
  } else {
    step_down(s, handle, session.target_state);
  }
}

void drop_session(XrSession handle) {
  drop_leaked<XrSwapchain>(handle, drop_swapchain);
  drop_leaked<XrSpace>(handle, drop<XrSpace>);
  close_graphics(state().all<XrSession>().at(handle).graphics);
  drop(handle);
}

XrResult XRAPI_CALL xr::CreateSession(XrInstance instance, const XrSessionCreateInfo* info, XrSession* session) {
  return call("xrCreateSession", [&](State& s) {
    require(live(instance).requirements_queried, "graphics", "xrGetVulkanGraphicsRequirements2KHR was not called");
    if (!s.all<XrSession>().empty()) return XR_ERROR_LIMIT_REACHED;
    *session = add<XrSession>({.parent = instance,
                               .graphics = open_graphics(*info),
                               .polls_before_ready = s.control.script.polls_before_ready});
    set_state(s, *session, XR_SESSION_STATE_IDLE);
    if (s.control.script.polls_before_ready == 0) set_state(s, *session, XR_SESSION_STATE_READY);
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL xr::DestroySession(XrSession session) {
  return call("xrDestroySession", [&](State& s) {
    drop_session(session);
    s.events.clear();
  });
}

XrResult XRAPI_CALL xr::RequestExitSession(XrSession session) {
  return call("xrRequestExitSession", [&](State& s) {
    Object<XrSession>& object = live(session);
    require(object.running, "session_state");
    object.exit_requested = object.stop_requested = true;
    advance_state(s, session);
  });
}

XrResult XRAPI_CALL xr::BeginSession(XrSession session, const XrSessionBeginInfo* info) {
  return call("xrBeginSession", [&](State& s) {
    Object<XrSession>& object = live(session);
    require(!object.running && object.state == XR_SESSION_STATE_READY, "session_state");
    require(info->primaryViewConfigurationType == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, "offered");
    if (s.begin == 0) s.begin = monotonic_now();
    object.running = true;
    object.stop_requested = false;
    object.waits = 0;
  });
}

XrResult XRAPI_CALL xr::EndSession(XrSession session) {
  return call("xrEndSession", [&](State& s) {
    Object<XrSession>& object = live(session);
    require(object.running && object.state == XR_SESSION_STATE_STOPPING, "session_state");
    object.running = object.stop_requested = false;
    object.waited.reset();
    object.begun.reset();
    set_state(s, session, XR_SESSION_STATE_IDLE);
    if (object.exit_requested) {
      set_state(s, session, XR_SESSION_STATE_EXITING);
    } else if (object.ready_requested) {
      object.ready_requested = false;
      set_state(s, session, XR_SESSION_STATE_READY);
    }
  });
}

}  // namespace gearshift::xr_test
