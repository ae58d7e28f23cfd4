// The states of a session, and how the timeline's events change them, always in a legal order.
#include <algorithm>
#include <string>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

const char* state_name(XrSessionState state) {
  static constexpr const char* kNames[] = {"UNKNOWN", "IDLE",     "READY",        "SYNCHRONIZED", "VISIBLE",
                                           "FOCUSED", "STOPPING", "LOSS_PENDING", "EXITING"};
  return kNames[state];
}

void change_origin(State& s, XrSession handle, const Event& event) {
  std::vector<OriginChange>& changes = s.origins[event.space];
  const Pose at_first = event.space == Space::stage ? s.control.script.stage_origin : Pose{};
  const Pose previous = changes.empty() ? at_first : changes.back().origin;
  const XrTime time = display_time(s, s.next_step + event.frames_ahead);
  changes.push_back({time, previous * event.pose});
  const bool stage = event.space == Space::stage;
  XrEventDataReferenceSpaceChangePending pending{XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING};
  pending.session = handle;
  pending.referenceSpaceType = stage ? XR_REFERENCE_SPACE_TYPE_STAGE : XR_REFERENCE_SPACE_TYPE_LOCAL;
  pending.changeTime = time;
  pending.poseValid = XR_TRUE;
  pending.poseInPreviousSpace = to_xr(event.pose);
  push_event(s, pending);
  log_line(std::string("event REFERENCE_SPACE_CHANGE_PENDING ") + (stage ? "STAGE" : "LOCAL"));
}

void lose_instances(State& s) {
  for (const XrInstance handle : s.instances.find_all([](const InstanceObject&) { return true; })) {
    s.instances.find(handle)->lost = true;
    XrEventDataInstanceLossPending loss{XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING};
    loss.lossTime = now(s);
    push_event(s, loss);
    log_line("event INSTANCE_LOSS_PENDING");
  }
}

void step_down(State& s, XrSession handle, SessionObject& session, XrSessionState target) {
  while (session.state > target && session.state <= XR_SESSION_STATE_FOCUSED) {
    set_state(s, handle, session, static_cast<XrSessionState>(session.state - 1));
  }
}

void stop(State& s, XrSession handle, SessionObject& session) {
  if (!session.running) return;
  session.stop_requested = true;
  advance_state(s, handle, session);
}

void request_exit(State& s, XrSession handle, SessionObject& session) {
  session.exit_requested = true;
  if (session.running) return stop(s, handle, session);
  if (session.state == XR_SESSION_STATE_IDLE) set_state(s, handle, session, XR_SESSION_STATE_EXITING);
}

void play_for_session(State& s, const Event& event, XrSession handle, SessionObject& session) {
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
    case Event::Kind::stopping:
      return stop(s, handle, session);
    case Event::Kind::ready:
      session.ready_requested = true;
      break;
    case Event::Kind::exit:
      return request_exit(s, handle, session);
    case Event::Kind::loss_pending:
      set_state(s, handle, session, XR_SESSION_STATE_LOSS_PENDING);
      session.lost = true;
      return;
    case Event::Kind::space_change:
      return change_origin(s, handle, event);
    default:
      break;
  }
  if (session.running) step_down(s, handle, session, session.target_state);
  if (session.ready_requested && session.state == XR_SESSION_STATE_IDLE) {
    session.ready_requested = false;
    set_state(s, handle, session, XR_SESSION_STATE_READY);
  }
}

void play_event(State& s, const Event& event) {
  if (event.kind == Event::Kind::instance_loss) return lose_instances(s);
  if (event.kind == Event::Kind::hidden) s.hidden_until = event.at + event.span;
  if (event.kind == Event::Kind::stall) stall_periods(s, event.periods);
  if (event.kind == Event::Kind::profile) s.control.script.profile = event.profile;
  for (const XrSession handle : s.sessions.find_all([](const SessionObject& one) { return !one.lost; })) {
    play_for_session(s, event, handle, *s.sessions.find(handle));
  }
}

}  // namespace

void set_state(State& s, XrSession handle, SessionObject& session, XrSessionState next) {
  session.state = next;
  s.control.record.state = next;
  XrEventDataSessionStateChanged changed{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED};
  changed.session = handle;
  changed.state = next;
  changed.time = now(s);
  push_event(s, changed);
  log_line(std::string("state ") + state_name(next));
}

void play_timeline(State& s, double until) {
  if (s.begin == 0 && s.sessions.size() == 0) return;
  if (s.begin == 0) until = -1.0;  // before the first xrBeginSession, only events with the time -1 are due
  std::vector<Event>& timeline = s.control.script.timeline;
  constexpr double kNanosecond = 1e-9;  // [s] tolerance; display times are rounded to nanoseconds
  while (true) {
    const auto next =
        std::min_element(timeline.begin(), timeline.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
    if (next == timeline.end() || next->at > until + kNanosecond) return;
    const Event event = *next;
    timeline.erase(next);
    play_event(s, event);
  }
}

void advance_state(State& s, XrSession handle, SessionObject& session) {
  if (session.stop_requested) {
    step_down(s, handle, session, XR_SESSION_STATE_SYNCHRONIZED);
    if (session.state != XR_SESSION_STATE_STOPPING) set_state(s, handle, session, XR_SESSION_STATE_STOPPING);
    return;
  }
  // The session becomes SYNCHRONIZED only after a first xrWaitFrame. From then on, each frame moves the state one step
  // towards the target state.
  if (session.waits < 1 || session.state >= XR_SESSION_STATE_STOPPING) return;
  if (session.state < session.target_state) {
    set_state(s, handle, session, static_cast<XrSessionState>(session.state + 1));
  } else {
    step_down(s, handle, session, session.target_state);
  }
}

}  // namespace gearshift::xr_test
