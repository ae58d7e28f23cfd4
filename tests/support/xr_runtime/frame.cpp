// The frame loop: xrWaitFrame, xrBeginFrame, xrEndFrame.
#include <string>

#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/layers.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

void discard(State& s, const FrameState& frame) {
  FrameRecord& record = s.control.record.frames[frame.record];
  record.discarded = true;
  log_line("frame " + std::to_string(record.index) + " discarded");
}

std::string frame_line(const FrameRecord& record) {
  std::string line = "frame " + std::to_string(record.index) + " t=" + std::to_string(record.time) +
                     (record.should_render ? " shown" : " hidden") + " layers=" + std::to_string(record.layers.size()) +
                     " locates=" + std::to_string(record.locates);
  if (record.projection() != nullptr)
    line += record.projection()->views[0].depth.is_present ? " projection+depth" : " projection";
  if (record.quad() != nullptr) line += " quad";
  return line;
}

bool is_shown(const State& s, const SessionObject& session, double t) {
  const bool visible = session.state == XR_SESSION_STATE_VISIBLE || session.state == XR_SESSION_STATE_FOCUSED;
  return visible && t >= s.hidden_until;
}

}  // namespace

namespace xr {

XrResult XRAPI_CALL WaitFrame(XrSession session, const XrFrameWaitInfo*, XrFrameState* state) {
  return call("xrWaitFrame", [&](State& s) {
    SessionObject& object = live(session);
    require(object.running, "session_running");
    require(!object.waited, "wait_twice");
    // Handle the events that are due before choosing the display time, because an event `stall` delays it.
    const bool steps = s.control.script.pacing == Pacing::stepped;
    play_timeline(s, steps ? seconds(s, display_time(s, s.next_step)) : seconds(s, now(s)));
    live(session);  // rejects the call if an event lost the session
    advance_state(s, session, object);
    const XrTime time = display_time(s, next_display_period(s, object.last_display));
    ++object.waits;
    object.last_display = time;
    FrameRecord record{.index = s.control.record.frames.size(), .time = seconds(s, time), .display_time = time};
    record.should_render = is_shown(s, object, record.time);
    object.waited = FrameState{time, s.control.record.frames.size()};
    state->predictedDisplayTime = time;
    state->predictedDisplayPeriod = period(s);
    state->shouldRender = record.should_render ? XR_TRUE : XR_FALSE;
    s.control.record.frames.push_back(std::move(record));
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL BeginFrame(XrSession session, const XrFrameBeginInfo*) {
  return call("xrBeginFrame", [&](State& s) {
    SessionObject& object = live(session);
    require(object.running, "session_running");
    require(object.waited.has_value(), "wait_before_begin");
    const bool discarded = object.begun.has_value();
    if (discarded) discard(s, *object.begun);
    object.begun = object.waited;
    object.waited.reset();
    return discarded ? XR_FRAME_DISCARDED : XR_SUCCESS;
  });
}

XrResult XRAPI_CALL EndFrame(XrSession session, const XrFrameEndInfo* info) {
  return call("xrEndFrame", [&](State& s) {
    SessionObject& object = live(session);
    require(object.running, "session_running");
    require(object.begun.has_value(), "begin_before_end");
    require(info->displayTime > 0, "time_positive");
    require(info->displayTime == object.begun->time, "end_time");
    require(info->environmentBlendMode == XR_ENVIRONMENT_BLEND_MODE_OPAQUE, "blend_mode");
    require(info->layerCount <= XR_MIN_COMPOSITION_LAYERS_SUPPORTED, "layer_count");
    FrameRecord& record = s.control.record.frames[object.begun->record];
    record.layers = read_layers(*info);
    record.ended = true;
    capture_frame(s, *info, object, record);
    object.begun.reset();
    log_line(frame_line(record));
    write_pictures(record);
    return XR_SUCCESS;
  });
}

}  // namespace xr
}  // namespace gearshift::xr_test
