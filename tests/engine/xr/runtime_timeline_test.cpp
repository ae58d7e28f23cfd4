// Checks that the OpenXR test runtime executes its script: poses, states, spaces, losses, planted failures, pacing.
#include <algorithm>
#include <chrono>

#include "tests/engine/xr/runtime_client.h"

namespace gearshift::xr_test {
namespace {

using TimelineStates = std::vector<XrSessionState>;
constexpr double kPeriod = 1.0 / 90.0;

// Runs until the state is reached; returns the states on the way.
TimelineStates run_until(Client& program, XrSessionState state) {
  TimelineStates all;
  for (int i = 0; i < 100 && program.state != state; ++i) {
    for (const XrSessionState one : program.poll()) all.push_back(one);
    if (program.state != state) program.run_frame();
  }
  REQUIRE(program.state == state);
  return all;
}

XrSpaceLocation located(XrSpace space, XrSpace base, XrTime time) {
  XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
  REQUIRE(xrLocateSpace(space, base, time, &location) == XR_SUCCESS);
  return location;
}

TEST_CASE("the head follows the script, and the first location of a frame may be off") {
  Control& xr = control();
  xr.start();
  xr.script.head = [](double t) {
    return Pose{.position = {t, 1.0, 0.0}, .orientation = glm::angleAxis(90 * kDegree, glm::dvec3(0, 1, 0))};
  };
  xr.script.early_error = 0.25;
  xr.script.tracking_gaps = {{10.5 * kPeriod, 11.5 * kPeriod, false}, {11.5 * kPeriod, 12.5 * kPeriod, true}};
  Client program;
  program.begin_and_focus();
  for (int i = 4; i < 13; ++i) {
    REQUIRE(program.wait() == XR_SUCCESS);
    REQUIRE(program.begin_frame() == XR_SUCCESS);
    REQUIRE(program.locate() == XR_SUCCESS);
    const float early = program.views[0].pose.position.x;
    REQUIRE(program.locate() == XR_SUCCESS);
    const XrViewStateFlags flags = program.view_state.viewStateFlags;
    CHECK((flags & XR_VIEW_STATE_POSITION_VALID_BIT) == (i == 11 ? 0u : XR_VIEW_STATE_POSITION_VALID_BIT));
    CHECK((flags & XR_VIEW_STATE_POSITION_TRACKED_BIT) == (i > 10 ? 0u : XR_VIEW_STATE_POSITION_TRACKED_BIT));
    // The head is turned left by 90 degrees, so the right eye is on the -z side.
    CHECK(program.views[1].pose.position.x == doctest::Approx(i * kPeriod));
    CHECK(program.views[1].pose.position.z == doctest::Approx(-0.0315));
    CHECK(early - program.views[0].pose.position.x == doctest::Approx(0.25));
    REQUIRE(program.end_frame(false) == XR_SUCCESS);
  }
  CHECK(xr.record.frames.back().locates == 2);
  CHECK(xr.record.violations.empty());
}

TEST_CASE("a menu, a headset taken off and put on, and the exit: each in a legal order") {
  Control& xr = control();
  xr.start();
  xr.script.timeline = {visible(0.1),  focused(0.2),     synchronized(0.3), focused(0.4),
                        stopping(0.5), hidden(0.7, 0.1), ready(0.6),        xr_test::exit(0.9)};
  Client program;
  program.begin_and_focus();
  CHECK(run_until(program, XR_SESSION_STATE_VISIBLE) == TimelineStates{XR_SESSION_STATE_VISIBLE});
  CHECK(run_until(program, XR_SESSION_STATE_FOCUSED) == TimelineStates{XR_SESSION_STATE_FOCUSED});
  CHECK(run_until(program, XR_SESSION_STATE_SYNCHRONIZED) ==
        TimelineStates{XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_SYNCHRONIZED});
  program.run_frame();
  CHECK_FALSE(xr.record.frames.back().should_render);
  run_until(program, XR_SESSION_STATE_STOPPING);
  REQUIRE(xrEndSession(program.session) == XR_SUCCESS);
  int polls = 0;
  while (program.state != XR_SESSION_STATE_READY && ++polls < 100) program.poll();
  CHECK(polls == doctest::Approx(0.1 / kPeriod).epsilon(0.3));
  REQUIRE(program.begin() == XR_SUCCESS);
  run_until(program, XR_SESSION_STATE_STOPPING);
  REQUIRE(xrEndSession(program.session) == XR_SUCCESS);
  CHECK(program.poll() == TimelineStates{XR_SESSION_STATE_IDLE, XR_SESSION_STATE_EXITING});
  for (const FrameRecord& frame : xr.record.frames) {
    if (frame.time >= 0.7 && frame.time < 0.8) CHECK_FALSE(frame.should_render);
  }
  CHECK(xr.record.violations.empty());
}

TEST_CASE("a space changes exactly at the time that its event names") {
  Control& xr = control();
  xr.start();
  xr.script.timeline = {change_space(0.1, Space::local, {.position = {1.0, 0.0, 0.0}}, 4)};
  Client program;
  const XrSpace stage = program.reference(XR_REFERENCE_SPACE_TYPE_STAGE);
  XrTime change = 0;
  program.on_event = [&](const XrEventDataBuffer& event) {
    if (event.type != XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING) return;
    const auto& pending = reinterpret_cast<const XrEventDataReferenceSpaceChangePending&>(event);
    CHECK(pending.referenceSpaceType == XR_REFERENCE_SPACE_TYPE_LOCAL);
    CHECK(pending.poseInPreviousSpace.position.x == 1.0f);
    change = pending.changeTime;
  };
  program.begin_and_focus();
  while (change == 0) program.run(1);
  CHECK(change > program.frame.predictedDisplayTime);
  CHECK(located(stage, program.local, change - 1).pose.position.x == 0.0f);
  CHECK(located(stage, program.local, change).pose.position.x == -1.0f);
  CHECK(located(stage, program.local, change).pose.position.y == -1.2f);
  xrDestroySpace(stage);
  CHECK(xr.record.violations.empty());
}

TEST_CASE("a lost session can only be destroyed; a new one works") {
  Control& xr = control();
  xr.start();
  xr.script.timeline = {lose_session(0.1)};
  {
    Client program;
    program.begin_and_focus();
    while (program.wait() == XR_SUCCESS) {
      program.begin_frame();
      program.end_frame(false);
    }
    CHECK(program.poll() == TimelineStates{XR_SESSION_STATE_LOSS_PENDING});
    CHECK(program.wait() == XR_ERROR_SESSION_LOST);
    CHECK(program.locate() == XR_ERROR_SESSION_LOST);
  }
  Client next;
  next.begin_and_focus();
  CHECK(xr.record.violations.empty());
}

TEST_CASE("a session may be lost before it begins") {
  Control& xr = control();
  xr.start();
  xr.script.timeline = {lose_session(-1.0)};
  Client program;
  CHECK(program.poll() == TimelineStates{XR_SESSION_STATE_IDLE, XR_SESSION_STATE_READY, XR_SESSION_STATE_LOSS_PENDING});
  CHECK(program.begin() == XR_ERROR_SESSION_LOST);
  CHECK(xr.record.violations.empty());
}

TEST_CASE("a lost instance can only be destroyed") {
  Control& xr = control();
  xr.start();
  xr.script.timeline = {lose_instance(0.1)};
  Client program;
  bool reported = false;
  program.on_event = [&](const XrEventDataBuffer& event) {
    reported = reported || event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING;
  };
  program.begin_and_focus();
  while (program.wait() == XR_SUCCESS) {
    program.begin_frame();
    program.end_frame(false);
  }
  CHECK(program.wait() == XR_ERROR_INSTANCE_LOST);
  program.poll();
  CHECK(reported);
  XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
  CHECK(xrPollEvent(program.instance, &event) == XR_ERROR_INSTANCE_LOST);
  program.close();
  CHECK(xrDestroyInstance(program.instance) == XR_SUCCESS);
  program.instance = XR_NULL_HANDLE;
  CHECK(xr.record.live_handles() == 0);
  CHECK(xr.record.violations.empty());
}

TEST_CASE("a planted failure occurs at its call, and leaks are reported") {
  Control& xr = control();
  xr.start();
  xr.script.failures = {{"xrWaitFrame", XR_ERROR_RUNTIME_FAILURE, 2},
                        {"xrAcquireSwapchainImage", XR_ERROR_SESSION_LOST}};
  {
    Client program;
    program.poll();
    program.begin();
    program.run_frame();
    CHECK(program.wait() == XR_ERROR_RUNTIME_FAILURE);
    program.run_frame();
    std::uint32_t index = 0;
    CHECK(xrAcquireSwapchainImage(program.eyes.handle, nullptr, &index) == XR_ERROR_SESSION_LOST);
    program.reference(XR_REFERENCE_SPACE_TYPE_VIEW);
  }
  CHECK(xr.record.leaks == std::vector<std::string>{"space of session"});
  CHECK(xr.record.live_handles() == 0);
}

TEST_CASE("without a headset there is no system, and missing extensions are not listed") {
  Control& xr = control();
  xr.start();
  xr.script.composition_layer_depth = false;
  std::uint32_t count = 0;
  REQUIRE(xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr) == XR_SUCCESS);
  std::vector<XrExtensionProperties> offered(count, {XR_TYPE_EXTENSION_PROPERTIES});
  xrEnumerateInstanceExtensionProperties(nullptr, count, &count, offered.data());
  const auto has = [&](const char* name) {
    return std::any_of(offered.begin(), offered.end(),
                       [&](const auto& one) { return !std::strcmp(one.extensionName, name); });
  };
  CHECK(has("XR_KHR_vulkan_enable2"));
  CHECK_FALSE(has("XR_KHR_composition_layer_depth"));
  const Machine program({"XR_KHR_convert_timespec_time"});
  xr.script.headset = false;
  const XrSystemGetInfo info{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
  XrSystemId system = XR_NULL_SYSTEM_ID;
  CHECK(xrGetSystem(program.instance, &info, &system) == XR_ERROR_FORM_FACTOR_UNAVAILABLE);
  char name[XR_MAX_RESULT_STRING_SIZE];
  CHECK(xrResultToString(program.instance, XR_ERROR_FORM_FACTOR_UNAVAILABLE, name) == XR_SUCCESS);
  CHECK(std::string(name) == "XR_ERROR_FORM_FACTOR_UNAVAILABLE");
  const auto convert =
      xr_function<PFN_xrConvertTimeToTimespecTimeKHR>(program.instance, "xrConvertTimeToTimespecTimeKHR");
  timespec time{};
  CHECK(convert(program.instance, 3'000'000'005, &time) == XR_SUCCESS);
  CHECK(time.tv_sec == 3);
  CHECK(time.tv_nsec == 5);
  CHECK(xr.record.violations.empty());
}

TEST_CASE("a stalled runtime drops display periods") {
  Control& xr = control();
  xr.start();
  xr.script.timeline = {stall(5 * kPeriod, 3)};
  Client program;
  program.begin_and_focus();
  program.run(2);
  CHECK(xr.record.frames[4].time == doctest::Approx(4 * kPeriod));
  CHECK(xr.record.frames[5].time == doctest::Approx(8 * kPeriod));
  CHECK(xr.record.dropped == 3);
}

TEST_CASE("with real pacing a frame waits for its period, and a late one drops some") {
  Control& xr = control();
  xr.start();
  xr.script.pacing = Pacing::real;
  xr.script.period = 0.02;
  Client program;
  program.poll();
  REQUIRE(program.begin() == XR_SUCCESS);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 10; ++i) program.run_frame();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  CHECK(took.count() > 8 * 0.02);  // nine periods, minus the part of the first one that had already passed
  const std::uint64_t before = xr.record.dropped;
  const timespec nap{.tv_sec = 0, .tv_nsec = 100'000'000};
  nanosleep(&nap, nullptr);
  program.run_frame();
  CHECK(xr.record.dropped >= before + 4);
  const double steps = (xr.record.frames[10].time - xr.record.frames[9].time) / 0.02;
  CHECK(steps >= 5.0 - 1e-6);
  CHECK(steps == doctest::Approx(std::round(steps)).epsilon(1e-6));
  CHECK(xr.record.violations.empty());
}

}  // namespace
}  // namespace gearshift::xr_test
