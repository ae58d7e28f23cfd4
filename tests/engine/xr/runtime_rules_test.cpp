// Planted violations: Khronos' validation layer reports those that it checks, the test runtime those that the layer does
// not check. So the silence of both in all other tests means something.
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <set>

#include "tests/engine/xr/runtime_client.h"

namespace gearshift::xr_test {
namespace {

struct Planted {
  const char* rule;               // of the runtime, or the name of the valid usage in the specification
  std::function<XrResult()> act;  // makes the violating call and returns its result
};

template <class Program, class Act>
std::function<XrResult()> in(
    Act act, void (*before)(Program&) = [](Program&) {}) {
  return [=] {
    Program program;
    before(program);
    return act(program);
  };
}
template <class Act>
Planted machine(const char* rule, Act act) {
  return {rule, in<Machine>(act)};
}
template <class Act>
Planted session(const char* rule, Act act) {
  return {rule, in<Client>(act)};
}
template <class Act>
Planted focused(const char* rule, Act act) {
  return {rule, in<Client>(act, [](Client& program) { program.focus(); })};
}
Planted controls(const char* rule, XrResult (*act)(Controls&)) {
  return session(rule, [=](Client& program) {
    Controls created(program);
    return act(created);
  });
}
// A correct frame that is submitted after `corrupt` has modified it.
Planted submitted(const char* rule, void (*corrupt)(Client&)) {
  return focused(rule, [=](Client& program) {
    REQUIRE(program.wait() == XR_SUCCESS);
    REQUIRE(program.begin_frame() == XR_SUCCESS);
    for (const XrSwapchain one : {program.eyes, program.depth, program.panel}) Client::show_image(one);
    corrupt(program);
    return program.end_frame();
  });
}

XrResult create_session(const Machine& program, const void* binding) {
  const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, binding, 0, program.system};
  XrSession created = XR_NULL_HANDLE;
  return xrCreateSession(program.instance, &info, &created);
}

constexpr XrSystemGetInfo kHeadset{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
XrResult get_system(const Machine& program, XrSystemGetInfo info, bool with_id = true) {
  XrSystemId system = XR_NULL_SYSTEM_ID;
  return xrGetSystem(program.instance, &info, with_id ? &system : nullptr);
}

// A call that creates a swapchain; `corrupt` has modified its parameters.
Planted swapchain(const char* rule, void (*corrupt)(XrSwapchainCreateInfo&)) {
  return session(rule, [=](Client& program) {
    auto info = Client::swapchain_info(VK_FORMAT_R8G8B8A8_SRGB, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 1);
    corrupt(info);
    XrSwapchain created = XR_NULL_HANDLE;
    return xrCreateSwapchain(program.session, &info, &created);
  });
}

XrResult locate(XrSpace space, XrSpace base, XrTime time) {
  XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
  return xrLocateSpace(space, base, time, &location);
}

XrResult acquire(XrSwapchain swapchain) {
  std::uint32_t index = 0;
  return xrAcquireSwapchainImage(swapchain, nullptr, &index);
}

const std::vector<Planted>& invalid_for_layer() {
  static const XrFrameWaitInfo foreign{XR_TYPE_FRAME_WAIT_INFO};
  static const std::vector<Planted> cases{
      machine("VUID-XrSystemGetInfo-type-type",
              [](Machine& program) {
                XrSystemGetInfo info = kHeadset;
                info.type = XR_TYPE_SESSION_CREATE_INFO;
                return get_system(program, info);
              }),
      machine("VUID-XrSystemGetInfo-next-next",
              [](Machine& program) {
                XrSystemGetInfo info = kHeadset;
                info.next = &foreign;
                return get_system(program, info);
              }),
      machine("VUID-XrSystemGetInfo-formFactor-parameter",
              [](Machine& program) {
                XrSystemGetInfo info = kHeadset;
                info.formFactor = static_cast<XrFormFactor>(7);
                return get_system(program, info);
              }),
      machine("VUID-xrGetSystem-systemId-parameter",
              [](Machine& program) { return get_system(program, kHeadset, false); }),
      machine("VUID-xrCreateSession-next-parameter", [](Machine& program) { return create_session(program, nullptr); }),
      session("VUID-xrLocateSpace-space-parameter",
              [](Client& program) {
                const XrSpace space = program.reference(XR_REFERENCE_SPACE_TYPE_VIEW);
                xrDestroySpace(space);
                return locate(space, program.local, 1);
              }),
      swapchain("VUID-XrSwapchainCreateInfo-usageFlags-parameter",
                [](XrSwapchainCreateInfo& info) { info.usageFlags |= 0x4000; }),
      submitted("VUID-XrCompositionLayerProjection-space-parameter",
                [](Client& program) { program.projection.space = XR_NULL_HANDLE; }),
      submitted("VUID-XrCompositionLayerProjectionView-type-type",
                [](Client& program) { program.projections[1].type = XR_TYPE_VIEW; }),
      submitted("VUID-XrCompositionLayerProjection-viewCount-arraylength",
                [](Client& program) { program.projection.viewCount = 0; }),
      submitted("VUID-XrCompositionLayerQuad-next-next", [](Client& program) { program.quad.next = &foreign; }),
  };
  return cases;
}

const std::vector<Planted>& life() {
  static const std::vector<Planted> cases{
      machine("offered",
              [](Machine& program) {
                XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES};
                return xrGetSystemProperties(program.instance, program.system + 1, &properties);
              }),
      session("offered", [](Client& program) { return program.begin(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO); }),
      swapchain("offered", [](XrSwapchainCreateInfo& info) { info.format = VK_FORMAT_R4G4_UNORM_PACK8; }),
      machine("graphics",
              [](Machine& program) {
                program.open_vulkan();
                const XrGraphicsBindingVulkan2KHR binding = program.binding();
                return create_session(program, &binding);
              }),
      machine("graphics",
              [](Machine& program) {
                program.get_requirements();
                program.open_vulkan();
                XrGraphicsBindingVulkan2KHR binding = program.binding();
                binding.physicalDevice = VK_NULL_HANDLE;
                return create_session(program, &binding);
              }),
      {"session_state",
       [] {
         control().script.polls_before_ready = 5;
         const Client program;
         return program.begin();
       }},
      session("session_state",
              [](Client& program) {
                program.begin();
                return program.begin();
              }),
      focused("session_state", [](Client& program) { return xrEndSession(program.session); }),
      session("session_state", [](Client& program) { return program.wait(); }),
      focused("frame_order",
              [](Client& program) {
                program.wait();
                return program.wait();
              }),
      focused("frame_order", [](Client& program) { return program.begin_frame(); }),
      focused("frame_order",
              [](Client& program) {
                program.wait();
                return program.end_frame(false);
              }),
      session("frame_time", [](Client& program) { return locate(program.local, program.local, 0); }),
      swapchain("swapchain_size", [](XrSwapchainCreateInfo& info) { info.width = 5000; }),
      swapchain("swapchain_size", [](XrSwapchainCreateInfo& info) { info.sampleCount = 0; }),
  };
  return cases;
}

const std::vector<Planted>& frames() {
  static const std::vector<Planted> cases{
      submitted("frame_time", [](Client& program) { ++program.frame.predictedDisplayTime; }),
      submitted("offered", [](Client& program) { program.blend = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE; }),
      submitted("layers", [](Client& program) { program.layers.resize(17, program.layers[1]); }),
      submitted("layers", [](Client& program) { program.quad.type = XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR; }),
      submitted("layers", [](Client& program) { program.projection.viewCount = 1; }),
      submitted("pose_unit", [](Client& program) { program.projections[1].pose.orientation.w = 0.9f; }),
      submitted("pose_unit",
                [](Client& program) { program.quad.pose.position.x = std::numeric_limits<float>::infinity(); }),
      submitted("fov", [](Client& program) { program.projections[0].fov = {}; }),
      submitted("fov", [](Client& program) { program.projections[0].fov.angleUp = std::nanf(""); }),
      submitted("image_rect", [](Client& program) { ++program.projections[0].subImage.imageRect.extent.width; }),
      submitted("image_rect", [](Client& program) { program.quad.subImage.imageRect.extent.height = 0; }),
      submitted("image_rect", [](Client& program) { program.projections[0].subImage.imageArrayIndex = 2; }),
      submitted("depth_info", [](Client& program) { program.depths[0].maxDepth = 0.0f; }),
      submitted("depth_info", [](Client& program) { program.depths[0].farZ = program.depths[0].nearZ; }),
      submitted("depth_info", [](Client& program) { program.depths[1].subImage = program.projections[1].subImage; }),
      submitted("image_order",
                [](Client& program) {
                  program.quad.subImage.swapchain =
                      program.swapchain(VK_FORMAT_R8G8B8A8_SRGB, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 1);
                }),
      submitted("image_order", [](Client& program) { acquire(program.panel); }),
      session("image_order",
              [](Client& program) {
                for (int i = 0; i < 3; ++i) acquire(program.eyes);
                return acquire(program.eyes);
              }),
      session("image_order",
              [](Client& program) {
                const XrSwapchainImageWaitInfo info{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
                return xrWaitSwapchainImage(program.eyes, &info);
              }),
      session("image_order",
              [](Client& program) {
                acquire(program.eyes);
                return xrReleaseSwapchainImage(program.eyes, nullptr);
              }),
  };
  return cases;
}

const std::vector<Planted>& actions() {
  static const std::vector<Planted> cases{
      machine("path_format",
              [](Machine& program) {
                XrPath created = XR_NULL_PATH;
                return xrStringToPath(program.instance, "/User/hand", &created);
              }),
      machine("path_format",
              [](Machine& program) {
                XrPath created = XR_NULL_PATH;
                return xrStringToPath(program.instance, "/user/hand/", &created);
              }),
      controls("path_format",
               [](Controls& created) {
                 XrAction action = XR_NULL_HANDLE;
                 return created.make("Press it", action);
               }),
      controls("binding_path",
               [](Controls& created) {
                 return created.suggest(Controls::kSimpleController, "/user/hand/left/input/trigger/value");
               }),
      controls("attach_order",
               [](Controls& created) {
                 created.attach();
                 return created.suggest(Controls::kSimpleController, "/user/hand/left/input/select/click");
               }),
      controls("attach_order",
               [](Controls& created) {
                 created.attach();
                 XrAction late = XR_NULL_HANDLE;
                 return created.make("late", late);
               }),
      controls("attach_order",
               [](Controls& created) {
                 created.attach();
                 return created.attach();
               }),
      controls("attach_order", [](Controls& created) { return created.sync(); }),
      controls("action_type",
               [](Controls& created) {
                 created.attach();
                 created.sync();
                 const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, created.press, created.hand};
                 XrActionStateVector2f state{XR_TYPE_ACTION_STATE_VECTOR2F};
                 return xrGetActionStateVector2f(created.program.session, &info, &state);
               }),
  };
  return cases;
}

}  // namespace

TEST_CASE("Khronos' validation layer reports each invalid call, and stops it before the runtime") {
  for (const Planted& planted : invalid_for_layer()) {
    const std::string usage = planted.rule;
    CAPTURE(usage);
    control().start();
    CHECK(XR_FAILED(planted.act()));
    CHECK(control().record.violations.empty());
    const std::string reported = complaints();
    CAPTURE(reported);
    CHECK(reported.find("[VALID_ERROR | " + usage + " |") != std::string::npos);
  }
}

TEST_CASE("each rule of the runtime rejects a planted violation, on which the layer and the other rules are silent") {
  std::set<std::string> shown{"validated"};  // violated in the next test case
  for (const auto* const cases : {&life(), &frames(), &actions()}) {
    for (const Planted& planted : *cases) {
      const std::string rule = planted.rule;
      CAPTURE(rule);
      control().start();
      const XrResult result = planted.act();
      const std::string reported = complaints();
      CAPTURE(reported);
      CHECK(reported.find(rule + ": ") == 0);
      CHECK(reported.find('\n') == reported.size() - 1);
      for (const Rule& one : control().rules) {
        if (one.id == rule) CHECK(result == one.result);
      }
      shown.insert(rule);
    }
  }
  for (const Rule& one : control().rules) CHECK_MESSAGE(shown.contains(one.id), one.id << ": no planted violation");
}

TEST_CASE("the runtime refuses a program that runs without the validation layer") {
  control().start();
  const char* const enabled = std::getenv("XR_ENABLE_API_LAYERS");
  REQUIRE(enabled != nullptr);
  const std::string layer = enabled;
  unsetenv("XR_ENABLE_API_LAYERS");
  const XrInstanceCreateInfo info = instance_info();
  XrInstance instance = XR_NULL_HANDLE;
  CHECK(xrCreateInstance(&info, &instance) == XR_ERROR_VALIDATION_FAILURE);
  setenv("XR_ENABLE_API_LAYERS", layer.c_str(), 1);
  CHECK(complaints().find("validated") == 0);
}

TEST_CASE("a swapchain that is destroyed with an acquired image, and objects left to their parent, are reported") {
  control().start();
  {
    const Client program;
    acquire(program.panel);
    CHECK(xrDestroySwapchain(program.panel) == XR_SUCCESS);
  }
  CHECK(complaints().find("image_order: xrDestroySwapchain") == 0);
  CHECK(control().record.leaks == 3);  // a space and two swapchains
  CHECK(control().record.live_handles == 0);
}

TEST_CASE("with real pacing a frame waits for its period, and a late one drops some") {
  Control& xr = control();
  xr.start();
  xr.script.pacing = Pacing::real;
  {
    Client program;
    REQUIRE(program.begin() == XR_SUCCESS);
    const auto run_frame = [&] {
      REQUIRE(program.wait() == XR_SUCCESS);
      REQUIRE(program.begin_frame() == XR_SUCCESS);
      REQUIRE(program.end_frame(false) == XR_SUCCESS);
    };
    timespec start{}, end{};
    clock_gettime(CLOCK_MONOTONIC, &start);
    for (int i = 0; i < 10; ++i) run_frame();
    clock_gettime(CLOCK_MONOTONIC, &end);
    const double took =
        static_cast<double>(end.tv_sec - start.tv_sec) + 1e-9 * static_cast<double>(end.tv_nsec - start.tv_nsec);
    CHECK(took > 8 * kPeriod);  // nine periods, minus the part of the first one that had already passed
    const std::uint64_t before = xr.record.dropped;
    const timespec nap{.tv_sec = 0, .tv_nsec = 100'000'000};  // nine periods
    nanosleep(&nap, nullptr);
    run_frame();
    CHECK(xr.record.dropped >= before + 8);
    const double steps = (xr.record.frames[10].time - xr.record.frames[9].time) / kPeriod;
    CHECK(steps == doctest::Approx(std::round(steps)).epsilon(1e-6));
  }
  CHECK(complaints() == "");
}

}  // namespace gearshift::xr_test
