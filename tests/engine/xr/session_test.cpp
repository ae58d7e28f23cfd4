// A headset session through the real loader and Khronos' validation layer, on the scripted test runtime.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/xr/frame_times.h"
#include "tests/engine/xr/session_rig.h"

using namespace gearshift;
using namespace gearshift::engine;
using namespace gearshift::test;
using glm::dvec3;
using Kind = xr_test::Event::Kind;
using xr_test::FrameRecord;
using xr_test::LayerRecord;

namespace {

std::array<int, 3> colour_at(const Image& picture, int x, int y) {
  const std::uint8_t* p = picture.pixel(x, y);
  return {p[0], p[1], p[2]};
}

// The last frame that was displayed.
const FrameRecord& last_shown() {
  const auto& frames = xr_test::control().record.frames;
  const FrameRecord* found = nullptr;
  for (const FrameRecord& frame : frames)
    if (frame.projection() != nullptr) found = &frame;
  REQUIRE(found != nullptr);
  return *found;
}

// A head that looks around while it moves.
xr_test::Pose moving_head(double seconds) {
  return {dvec3(0.1 * std::sin(3.0 * seconds), 0.02 * std::cos(5.0 * seconds), -0.3 * seconds),
          glm::angleAxis(0.5 * std::sin(2.0 * seconds), dvec3(0, 1, 0)) *
              glm::angleAxis(0.3 * std::cos(4.0 * seconds), dvec3(1, 0, 0))};
}

double turn_between(const glm::dquat& a, const glm::dquat& b) {
  return 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(glm::normalize(a), glm::normalize(b)))));
}

}  // namespace

TEST_CASE("a correct session from first to last event: pictures, depth and panel arrive, per eye") {
  xr_test::Control& xr = xr_test::control();
  xr.start();
  xr.script.capture_every = 1;
  {
    SessionRig rig;
    CHECK(rig.session->state() == HeadsetState::idle);
    CHECK_FALSE(rig.session->is_running());
    rig.panel = HeadsetPanel{{{0.5, 1.2, -1.4}, glm::angleAxis(-0.4, dvec3(0, 1, 0))}, {1.5, 0.75}};
    REQUIRE(rig.reaches(HeadsetState::focused));
    for (int i = 0; i < 3; ++i) CHECK(rig.run_frame());
  }
  check_no_violations();
  const FrameRecord& frame = last_shown();
  REQUIRE(frame.layers.size() == 2);  // the cabin, and the panel in front of it
  const LayerRecord& eyes = *frame.projection();
  CHECK(colour_at(eyes.views[0].picture, 5, 5) == std::array{255, 0, 0});
  CHECK(colour_at(eyes.views[1].picture, 40, 30) == std::array{0, 255, 0});
  for (const xr_test::ViewRecord& view : eyes.views) {
    CHECK(view.rect.width == 48);
    CHECK(view.rect.height == 32);
    REQUIRE(view.depth.is_present);
    CHECK(view.depth.min_depth == 0.0f);  // infinitely far
    CHECK(std::isinf(view.depth.near_z));
    CHECK(view.depth.max_depth == 1.0f);
    CHECK(view.depth.far_z == 0.05f);
    REQUIRE(view.depth.values.size() == 48 * 32);
    CHECK(view.depth.values[100] == 0.25f);
  }
  const LayerRecord& quad = *frame.quad();
  CHECK(quad.width == 1.5f);
  CHECK(quad.height == 0.75f);
  CHECK((quad.flags & XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT) != 0);
  CHECK(glm::distance(quad.views[0].pose.position, dvec3(0.5, 1.2, -1.4)) < 1e-6);
  CHECK(colour_at(quad.views[0].picture, 3, 3) == std::array{0, 0, 255});
}

TEST_CASE("frames are submitted with the newest pose predicted for their display time") {
  xr_test::Control& xr = xr_test::control();
  xr.start();
  xr.script.head = moving_head;
  xr.script.early_error = 0.04;  // [m] error of the poses from each frame's first xrLocateViews
  {
    SessionRig rig;
    REQUIRE(rig.reaches(HeadsetState::focused));
    for (int i = 0; i < 20; ++i) (void)rig.run_frame();
  }
  check_no_violations();
  int checked_frames = 0;
  for (const FrameRecord& frame : xr.record.frames) {
    if (frame.projection() == nullptr) continue;
    ++checked_frames;
    CHECK(frame.locates == 2);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const xr_test::Pose head = moving_head(frame.time);
      // This pose is in STAGE space, whose origin is 1.2 m below the origin of the initial LOCAL space.
      const xr_test::Pose& reported = frame.projection()->views[eye].pose;
      const dvec3 position = head.position + head.orientation * dvec3(eye == 0 ? -0.0315 : 0.0315, 0.0, 0.0);
      CHECK(glm::distance(reported.position, position + dvec3(0.0, 1.2, 0.0)) < 1e-6);
      CHECK(turn_between(reported.orientation, head.orientation) < 1e-6);
    }
  }
  CHECK(checked_frames >= 20);
}

TEST_CASE("menu, another program, headset off and on, hidden: states are reported, and frames only while visible") {
  xr_test::Control& xr = xr_test::control();
  xr.start();
  xr.script.timeline = {xr_test::Event{0.2, Kind::visible},     xr_test::Event{0.3, Kind::focused},
                        xr_test::Event{0.4, Kind::hidden, 0.1}, xr_test::Event{0.6, Kind::synchronized},
                        xr_test::Event{0.7, Kind::visible},     xr_test::Event{0.8, Kind::focused},
                        xr_test::Event{1.0, Kind::stopping},    xr_test::Event{1.3, Kind::ready}};
  std::vector<HeadsetState> states;
  int empty_frames = 0;
  {
    SessionRig rig;
    for (int i = 0; i < 400 && (xr.record.frames.empty() || xr.record.frames.back().time < 1.8); ++i) {
      if (!rig.run_frame()) ++empty_frames;
      if (states.empty() || states.back() != rig.session->state()) states.push_back(rig.session->state());
    }
  }
  check_no_violations();
  // Some states may come and go between two iterations. So the observed states must be in order, and no lasting state
  // may be missing.
  std::string order;
  for (const HeadsetState state : states) order += std::string(to_string(state)) + " ";
  CAPTURE(order);
  const auto at = [&](const char* name, std::size_t from) { return order.find(name, from); };
  std::size_t position = 0;
  for (const char* name : {"focused", "visible", "focused", "synchronised", "visible", "focused", "idle", "focused"}) {
    position = at(name, position);
    REQUIRE(position != std::string::npos);
    ++position;
  }
  CHECK(empty_frames > 2);  // run_frame() returned an empty value while the headset was off
  int hidden = 0;
  for (const FrameRecord& frame : xr.record.frames) {
    CHECK((frame.projection() != nullptr) == frame.should_render);
    if (frame.time > 0.41 && frame.time < 0.49) hidden += !frame.should_render;
  }
  CHECK(hidden >= 6);
}

TEST_CASE("while tracking is lost, the lost part of the pose keeps its last value, and frames continue") {
  xr_test::Control& xr = xr_test::control();
  xr.start();
  xr.script.stage = false;
  bool placed = false, turned = false;
  double about = 0.0;  // [rad] yaw of the head; the head later looks backwards
  xr.script.head = [&](double seconds) {
    xr_test::Pose pose = moving_head(seconds);
    pose.orientation = glm::angleAxis(about, dvec3(0, 1, 0)) * pose.orientation;
    pose.position_valid = placed;
    pose.orientation_valid = turned;
    return pose;
  };
  {
    SessionRig rig;
    REQUIRE(rig.reaches(HeadsetState::focused));  // the session is focused although the head was never tracked
    CHECK_FALSE(rig.eyes.is_known);
    CHECK(glm::length(rig.eyes.pose[1].orientation) == doctest::Approx(1.0));
    CHECK(rig.eyes.pose[1].position.x - rig.eyes.pose[0].position.x == doctest::Approx(0.063));
    CHECK_FALSE(rig.session->is_stage());
    placed = turned = true;
    (void)rig.run_frame();
    CHECK(rig.eyes.is_known);
    CHECK(rig.eyes.is_tracked);
    const HeadsetEyes last = rig.eyes;
    placed = false;  // orientation only
    about = 2.5;
    for (int i = 0; i < 5; ++i) (void)rig.run_frame();
    CHECK_FALSE(rig.eyes.is_tracked);
    CHECK(rig.eyes.is_known);
    const auto middle = [](const HeadsetEyes& eyes) { return 0.5 * (eyes.pose[0].position + eyes.pose[1].position); };
    CHECK(glm::distance(middle(rig.eyes), middle(last)) < 1e-9);
    // The right eye is still on the right side of the head after the head has turned.
    const dvec3 aside = rig.eyes.pose[1].position - rig.eyes.pose[0].position;
    CHECK(glm::distance(aside, rig.eyes.pose[0].orientation * dvec3(0.063, 0.0, 0.0)) < 1e-6);
    CHECK(turn_between(rig.eyes.pose[0].orientation, last.pose[0].orientation) > 0.01);
    turned = false;
    const glm::dquat last_orientation = rig.eyes.pose[0].orientation;
    for (int i = 0; i < 5; ++i) (void)rig.run_frame();
    CHECK(turn_between(rig.eyes.pose[0].orientation, last_orientation) < 1e-9);
  }
  check_no_violations();
}

TEST_CASE("a moved origin is reported at its time, with the correct transform") {
  xr_test::Control& xr = xr_test::control();
  xr.start();
  const xr_test::Pose moved{dvec3(0.3, 0.0, -0.2), glm::angleAxis(0.7, dvec3(0, 1, 0))};
  xr.script.head = [](double) { return xr_test::Pose{dvec3(0.1, 0.2, 0.3)}; };  // no movement
  xr.script.timeline = {xr_test::change_space(0.5, xr_test::Space::stage, moved, 6),
                        xr_test::change_space(1.0, xr_test::Space::local, moved, 2)};
  {
    SessionRig rig;
    REQUIRE(rig.reaches(HeadsetState::focused));
    std::optional<SpaceChange> stage, local;
    for (int i = 0; i < 120; ++i) {
      const HeadsetEyes old = rig.eyes;
      const auto frame = rig.run_frame();
      REQUIRE(frame);
      const auto change = rig.session->take_due_space_change(*frame);
      const bool jumped = glm::distance(old.pose[0].position, rig.eyes.pose[0].position) > 1e-3;
      CAPTURE(i);
      if (!stage) CHECK(jumped == change.has_value());  // the change is reported in the frame in which the eyes jump
      if (change && change->is_session_space) {
        stage = change;
        REQUIRE(change->new_from_old);
        CHECK(glm::distance(*change->new_from_old * old.pose[0].position, rig.eyes.pose[0].position) < 1e-6);
      }
      if (change && !change->is_session_space) local = change;
    }
    CHECK(stage.has_value());
    CHECK(local.has_value());
  }
  check_no_violations();
}

TEST_CASE("a lost session or runtime throws HeadsetLost, and leaves nothing") {
  for (const bool instance : {false, true}) {
    CAPTURE(instance);
    xr_test::Control& xr = xr_test::control();
    xr.start();
    xr.script.timeline = {instance ? xr_test::Event{0.3, Kind::instance_loss}
                                   : xr_test::Event{0.3, Kind::loss_pending}};
    {
      SessionRig rig;
      const std::string reported = thrown<HeadsetLost>([&] {
        for (int i = 0; i < 100; ++i) (void)rig.run_frame();
      });
      // The loss is reported by its event or by the first failing call, whichever comes first. The two messages differ.
      const bool by_event =
          reported == (instance ? "the OpenXR runtime is shutting down" : "the connection to the headset was lost");
      const bool by_call =
          reported.find(instance ? "XR_ERROR_INSTANCE_LOST" : "XR_ERROR_SESSION_LOST") != std::string::npos;
      CAPTURE(reported);
      CHECK((by_event || by_call));
    }
    CHECK(xr_test::complaints() == "");
  }
}

// Each run makes one of the first calls of a function fail, in some runs in the middle of a frame. Checks that the
// error is reported with its kind, that acquired images are released correctly, and that everything can be recreated.
TEST_CASE("an error from any call is reported, and the next session works normally") {
  constexpr const char* kCalls[] = {"xrCreateSession",
                                    "xrCreateReferenceSpace",
                                    "xrCreateSwapchain",
                                    "xrEnumerateSwapchainImages",
                                    "xrBeginSession",
                                    "xrWaitFrame",
                                    "xrBeginFrame",
                                    "xrLocateViews",
                                    "xrAcquireSwapchainImage",
                                    "xrWaitSwapchainImage",
                                    "xrReleaseSwapchainImage",
                                    "xrEndFrame",
                                    "xrPollEvent",
                                    "xrCreateActionSet",
                                    "xrAttachSessionActionSets"};
  for (const char* call : kCalls) {
    for (int plan = 0; plan < 9; ++plan) {
      constexpr std::array kResults{XR_ERROR_RUNTIME_FAILURE, XR_ERROR_SESSION_LOST, XR_ERROR_OUT_OF_MEMORY};
      const XrResult result = kResults[static_cast<std::size_t>(plan % 3)];
      // Fails the 1st, 3rd or 5th call. For a call made once per swapchain (in the order eyes, depth, panel), these are
      // the call for the eyes, the call for the panel, and the call for depth in a later frame.
      const int nth = 1 + plan / 3 * 2;
      CAPTURE(nth);
      CAPTURE(call);
      CAPTURE(static_cast<int>(result));
      xr_test::Control& xr = xr_test::control();
      xr.start();
      xr.script.failures = {{call, result, nth}};
      const auto run = [&] {
        SessionRig rig;
        rig.panel = HeadsetPanel{{{0.0, 1.0, -1.0}, glm::dquat(1, 0, 0, 0)}, {1.0, 0.5}};
        for (int i = 0; i < 20; ++i) (void)rig.run_frame();
      };
      const bool lost = result != XR_ERROR_OUT_OF_MEMORY;
      const std::string reported = lost ? thrown<HeadsetLost>(run) : thrown<HeadsetError>(run);
      // Some functions are called only once, so a later call cannot fail. Depth images (the third and fourth query) are
      // optional, so their failure is reported only if the session or the runtime is lost.
      const bool of_depth = call == std::string("xrEnumerateSwapchainImages") && nth == 3 && !lost;
      const bool happens = xr.record.calls[call] >= nth && !of_depth;
      CHECK((reported.find(call) != std::string::npos) == happens);
      CHECK((reported.find("XR_ERROR_") != std::string::npos) == happens);
      CHECK(xr_test::complaints() == "");
    }
    CHECK(xr_test::control().record.live_handles == 0);
  }
  xr_test::control().start();
  {
    SessionRig rig;
    CHECK(rig.reaches(HeadsetState::focused));
  }
  check_no_violations();
}

TEST_CASE("no runtime, no headset, no Vulkan: one clear sentence each") {
  xr_test::Control& xr = xr_test::control();
  const std::string manifest = std::getenv("XR_RUNTIME_JSON");
  setenv("XR_RUNTIME_JSON", "/nowhere/runtime.json", 1);
  CHECK(thrown<HeadsetError>([] { HeadsetRuntime runtime; }).find("no OpenXR runtime found") != std::string::npos);
  setenv("XR_RUNTIME_JSON", manifest.c_str(), 1);
  xr.start();
  xr.script.headset = false;
  CHECK(thrown<HeadsetAbsent>([] { HeadsetRuntime runtime; }).find("no headset is connected") != std::string::npos);
  xr.start();
  xr.script.vulkan_enable2 = false;
  CHECK(thrown<HeadsetError>([] { HeadsetRuntime runtime; }).find("XR_KHR_vulkan_enable2") != std::string::npos);
  check_no_violations();
  // The loader remembers a runtime's extensions until an instance of this runtime is destroyed.
  XrInstanceCreateInfo plain{XR_TYPE_INSTANCE_CREATE_INFO};
  std::strcpy(plain.applicationInfo.applicationName, "plain");
  plain.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  XrInstance instance = XR_NULL_HANDLE;
  REQUIRE(xrCreateInstance(&plain, &instance) == XR_SUCCESS);
  xrDestroyInstance(instance);
}

TEST_CASE("optional features may be missing: depth, the clock, the stage, our preferred formats") {
  for (int missing = 0; missing < 5; ++missing) {
    CAPTURE(missing);
    xr_test::Control& xr = xr_test::control();
    xr.start();
    xr.script.capture_every = 1;
    if (missing == 0) xr.script.composition_layer_depth = false;
    if (missing == 1) xr.script.convert_timespec_time = false;
    if (missing == 2) xr.script.stage = false;
    if (missing == 3) xr.script.colour_formats = {VK_FORMAT_B8G8R8A8_SRGB};
    if (missing == 4) xr.script.depth_formats = {VK_FORMAT_D16_UNORM};
    {
      SessionRig rig;
      REQUIRE(rig.reaches(HeadsetState::focused));
      const auto frame = rig.run_frame();
      REQUIRE(frame);
      CHECK((frame->wait_end_ns == 0) == (missing == 1));
      CHECK(rig.session->is_stage() == (missing != 2));
    }
    check_no_violations();
    const auto& view = last_shown().projection()->views[0];
    CHECK(view.depth.is_present == (missing != 0 && missing != 4));
    CHECK(colour_at(view.picture, 5, 5) == std::array{255, 0, 0});
  }
  xr_test::control().start();
  xr_test::control().script.colour_formats = {VK_FORMAT_R8G8B8A8_UINT};
  CHECK(thrown<HeadsetError>([] { SessionRig rig; }).find("accepts neither") != std::string::npos);
}

TEST_CASE("hands point, click and scroll while focused, and not under another program's menu") {
  xr_test::Control& xr = xr_test::control();
  xr.start();
  xr.script.stage = false;
  const xr_test::Pose aim{dvec3(0.2, -0.3, -0.4), glm::angleAxis(0.6, dvec3(0, 1, 0))};
  xr.script.aim[1] = [&](double) { return aim; };
  xr.script.aim[0] = [](double) {
    xr_test::Pose lost;
    lost.position_valid = lost.orientation_valid = false;
    return lost;
  };
  xr.script.inputs["/user/hand/right/input/trigger/value"] = [](double seconds) { return seconds > 0.5 ? 1.0 : 0.0; };
  xr.script.inputs["/user/hand/right/input/thumbstick/y"] = [](double) { return 0.75; };
  xr.script.timeline = {xr_test::Event{1.0, Kind::visible}};
  {
    SessionRig rig;
    REQUIRE(rig.reaches(HeadsetState::focused));
    CHECK(rig.session->state() == HeadsetState::focused);
    for (int i = 0; i < 120; ++i) {
      rig.session->poll();
      const HeadsetFrame frame = rig.session->wait();
      const auto hands = rig.session->hands(frame);
      const double seconds = xr.record.frames.back().time;
      CAPTURE(seconds);
      if (seconds < 0.99) {
        CHECK_FALSE(hands[0].is_tracked);
        REQUIRE(hands[1].is_tracked);
        CHECK(glm::distance(hands[1].aim.position, aim.position) < 1e-6);
        CHECK(turn_between(hands[1].aim.orientation, aim.orientation) < 1e-6);
        CHECK(hands[1].selects == (seconds > 0.5));
        CHECK(hands[1].scroll.y == doctest::Approx(0.75));
      } else if (seconds > 1.05) {
        CHECK_FALSE(hands[1].is_tracked);
        CHECK_FALSE(hands[1].selects);
      }
      rig.session->end(frame, nullptr, kRigNear, nullptr);
    }
    CHECK(rig.session->state() == HeadsetState::visible);
  }
  check_no_violations();
}

// The runtime has its own copy of the registry's inputs, and refuses all others.
TEST_CASE("bindings are suggested for every controller whose extension the runtime offers, and for no other") {
  xr_test::Control& xr = xr_test::control();
  const std::set<std::string> core = {
      "/interaction_profiles/khr/simple_controller", "/interaction_profiles/oculus/touch_controller",
      "/interaction_profiles/valve/index_controller", "/interaction_profiles/htc/vive_controller",
      "/interaction_profiles/microsoft/motion_controller"};
  const std::vector<std::pair<std::string, std::set<std::string>>> extended = {
      {"XR_FB_touch_controller_pro", {"facebook/touch_controller_pro"}},
      {"XR_META_touch_controller_plus", {"meta/touch_controller_plus"}},
      {"XR_BD_controller_interaction",
       {"bytedance/pico_neo3_controller", "bytedance/pico4_controller", "bytedance/pico_g3_controller"}},
      {"XR_EXT_hp_mixed_reality_controller", {"hp/mixed_reality_controller"}},
      {"XR_HTC_vive_cosmos_controller_interaction", {"htc/vive_cosmos_controller"}},
      {"XR_HTC_vive_focus3_controller_interaction", {"htc/vive_focus3_controller"}},
      {"XR_ML_ml2_controller_interaction", {"ml/ml2_controller"}},
      {"XR_EXT_hand_interaction", {"ext/hand_interaction_ext"}},
      {"XR_MSFT_hand_interaction", {"microsoft/hand_interaction"}}};
  const auto suggested = [&](const std::vector<std::string>& offered) {
    xr.start();
    xr.script.controllers = offered;
    { const SessionRig rig; }
    check_no_violations();
    return xr.record.profiles;
  };
  CHECK(suggested({}) == core);
  std::vector<std::string> all;
  std::set<std::string> everything = core;
  for (const auto& [extension, profiles] : extended) {
    std::set<std::string> wanted = core;
    for (const std::string& profile : profiles) wanted.insert("/interaction_profiles/" + profile);
    everything.insert(wanted.begin(), wanted.end());
    all.push_back(extension);
    CAPTURE(extension);
    CHECK(suggested({extension}) == wanted);
  }
  CHECK(suggested(all) == everything);
}

TEST_CASE("a session that is closed while it runs ends as OpenXR asks for") {
  xr_test::Control& xr = xr_test::control();
  xr.start();
  {
    SessionRig rig;
    REQUIRE(rig.reaches(HeadsetState::focused));
  }
  check_no_violations();
  CHECK(xr.record.calls["xrRequestExitSession"] == 1);
  CHECK(xr.record.calls["xrEndSession"] == 1);
}

TEST_CASE("periods that a runtime drops are counted, and no others") {
  xr_test::Control& xr = xr_test::control();
  xr.start();
  xr.script.timeline = {xr_test::stall(0.3, 5), xr_test::stall(0.6, 2)};
  FrameTimes times;
  {
    SessionRig rig;
    for (int i = 0; i < 90; ++i)
      if (const auto frame = rig.run_frame()) times.add(*frame, rig.session->now_ns(), 1.0);
  }
  check_no_violations();
  CHECK(xr.record.dropped == 7);
  CHECK(times.timing().dropped == xr.record.dropped);
  CHECK(times.timing().period_ms == doctest::Approx(1e3 / 90.0));
}

namespace {

std::size_t open_files() {
  const auto all = std::filesystem::directory_iterator("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

// [KiB] resident memory private to the program
std::size_t resident() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("RssAnon:", 0) == 0) return std::stoul(line.substr(8));
  return 0;
}

}  // namespace

// 20 restarts; set GEARSHIFT_XR_RESTARTS=1000 for the long run.
TEST_CASE("restarting a session again and again leaks nothing") {
  const char* asked = std::getenv("GEARSHIFT_XR_RESTARTS");
  const int restarts = asked != nullptr ? std::atoi(asked) : 20;
  SessionRig rig(false);  // created once, so the test does not measure its runtime and GPU device
  xr_test::control().start();
  const auto again = [&] {
    rig.session.reset();
    rig.session = std::make_unique<HeadsetSession>(*rig.runtime, rig.gpu(), HeadsetConfig{kRigEye, kRigPanel});
    CHECK(rig.reaches(HeadsetState::focused));
    CHECK(rig.run_frame());
  };
  for (int i = 0; i < 5; ++i) again();  // the first restarts make allocations that later restarts reuse
  const std::size_t files = open_files(), memory = resident();
  const VkDeviceSize device = rig.gpu().allocated();
  const int handles = xr_test::control().record.live_handles;
  for (int i = 0; i < restarts; ++i) {
    again();
    xr_test::control().record.frames.clear();
  }
  MESSAGE(restarts << " restarts: " << static_cast<long>(resident()) - static_cast<long>(memory) << " KiB more");
  CHECK(open_files() == files);
  CHECK(rig.gpu().allocated() == device);
  CHECK(xr_test::control().record.live_handles == handles);
#if !defined(GEARSHIFT_TEST_SANITIZED)  // a sanitizer keeps freed memory; it detects leaks itself
  CHECK(resident() < memory + 1024);    // [KiB] limit that does not depend on the number of restarts
#endif
  CHECK(xr_test::complaints() == "");
}
