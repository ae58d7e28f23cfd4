// Each rule of the test runtime rejects one planted violation and reports nothing else.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include "tests/engine/xr/runtime_controls.h"

namespace gearshift::xr_test {
namespace {

struct PlantedViolation {
  const char* rule;
  std::function<XrResult()> act;  // makes the violating call and returns its result
};

// Violations recorded before the program is destroyed.
std::vector<Violation> recorded_violations;

template <class Program, class Act>
std::function<XrResult()> in(
    Act act, void (*before)(Program&) = [](Program&) {}) {
  return [=] {
    Program program;
    before(program);
    const XrResult result = act(program);
    recorded_violations = control().record.violations;
    return result;
  };
}

PlantedViolation machine(const char* rule, XrResult (*act)(Machine&)) {
  return {rule, in<Machine>(act)};
}
PlantedViolation session(const char* rule, XrResult (*act)(Client&)) {
  return {rule, in<Client>(act)};
}
template <class Act>
PlantedViolation focused_session(const char* rule, Act act) {
  return {rule, in<Client>(act, [](Client& program) { program.begin_and_focus(); })};
}
PlantedViolation controls(const char* rule, XrResult (*act)(Client&, Controls&)) {
  return focused_session(rule, [=](Client& program) {
    Controls created(program);
    return act(program, created);
  });
}
// A correctly drawn frame that is submitted after `corrupt` has modified it.
PlantedViolation submitted(const char* rule, void (*corrupt)(Client&)) {
  return focused_session(rule, [=](Client& program) {
    REQUIRE(program.wait() == XR_SUCCESS);
    REQUIRE(program.begin_frame() == XR_SUCCESS);
    REQUIRE(program.locate() == XR_SUCCESS);
    program.draw_all();
    corrupt(program);
    return program.end_frame();
  });
}

XrResult create_session(const Machine& program, const void* binding) {
  const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, binding, 0, program.system};
  XrSession created = XR_NULL_HANDLE;
  return xrCreateSession(program.instance, &info, &created);
}

XrResult get_system(const Machine& program, XrSystemGetInfo info, bool with_id = true) {
  XrSystemId system = XR_NULL_SYSTEM_ID;
  return xrGetSystem(program.instance, &info, with_id ? &system : nullptr);
}
constexpr XrSystemGetInfo kHeadset{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};

XrResult create_swapchain(const Client& program, XrSwapchainCreateInfo info) {
  XrSwapchain created = XR_NULL_HANDLE;
  return xrCreateSwapchain(program.session, &info, &created);
}

XrResult create_set(const Machine& program, const char* name, const char* localized) {
  const XrActionSetCreateInfo info = set_info(name, localized);
  XrActionSet created = XR_NULL_HANDLE;
  return xrCreateActionSet(program.instance, &info, &created);
}

XrSwapchainCreateInfo colour_info() {
  return Client::chain_info(VK_FORMAT_R8G8B8A8_SRGB, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 1);
}

const std::vector<PlantedViolation>& any_function() {
  static const std::vector<PlantedViolation> cases{
      session("time_positive",
              [](Client& program) {
                XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
                return xrLocateSpace(program.local, program.local, 0, &location);
              }),
  };
  return cases;
}

const std::vector<PlantedViolation>& life() {
  static const std::vector<PlantedViolation> cases{
      machine("system_id",
              [](Machine& program) {
                XrSystemProperties properties{XR_TYPE_SYSTEM_PROPERTIES};
                return xrGetSystemProperties(program.instance, program.system + 1, &properties);
              }),
      machine("form_factor",
              [](Machine& program) {
                XrSystemGetInfo info = kHeadset;
                info.formFactor = XR_FORM_FACTOR_HANDHELD_DISPLAY;
                return get_system(program, info);
              }),
      session(
          "view_configuration",
          [](Client& program) {
            program.poll();
            const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_MONO};
            return xrBeginSession(program.session, &info);
          }),
      machine("graphics_requirements",
              [](Machine& program) {
                program.open_vulkan();
                const XrGraphicsBindingVulkan2KHR binding = program.binding();
                return create_session(program, &binding);
              }),
      machine("graphics_binding",
              [](Machine& program) {
                program.get_requirements();
                program.open_vulkan();
                XrGraphicsBindingVulkan2KHR binding = program.binding();
                binding.physicalDevice = VK_NULL_HANDLE;
                return create_session(program, &binding);
              }),
      {"session_ready",
       [] {
         control().script.polls_before_ready = 5;
         Client program;
         const XrResult result = program.begin();
         recorded_violations = control().record.violations;
         return result;
       }},
      session("session_begun_twice",
              [](Client& program) {
                program.begin();
                return program.begin();
              }),
      focused_session("session_stopping", [](Client& program) { return xrEndSession(program.session); }),
      session("session_running", [](Client& program) { return program.wait(); }),
      session("session_running", [](Client& program) { return xrRequestExitSession(program.session); }),
      focused_session("session_running",
                      [](Client& program) {
                        xrRequestExitSession(program.session);
                        xrEndSession(program.session);
                        return program.wait();
                      }),
  };
  return cases;
}

const std::vector<PlantedViolation>& frames() {
  static const std::vector<PlantedViolation> cases{
      focused_session("wait_twice",
                      [](Client& program) {
                        program.wait();
                        return program.wait();
                      }),
      focused_session("wait_before_begin", [](Client& program) { return program.begin_frame(); }),
      focused_session("begin_before_end",
                      [](Client& program) {
                        program.wait();
                        return program.end_frame(false);
                      }),
      submitted("end_time", [](Client& program) { ++program.frame.predictedDisplayTime; }),
      focused_session("blend_mode",
                      [](Client& program) {
                        program.wait();
                        program.begin_frame();
                        XrFrameEndInfo info = program.end_info();
                        info.layerCount = 0;
                        info.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
                        return xrEndFrame(program.session, &info);
                      }),
      submitted("layer_count", [](Client& program) { program.layers.resize(17, program.layers[1]); }),
      submitted("layer_type",
                [](Client& program) {
                  // This layer type belongs to an extension that is not enabled.
                  program.quad.type = XR_TYPE_COMPOSITION_LAYER_CYLINDER_KHR;
                }),
      submitted("view_count", [](Client& program) { program.projection.viewCount = 1; }),
      submitted("pose_unit", [](Client& program) { program.projections[1].pose.orientation.w = 0.9f; }),
      submitted("pose_unit",
                [](Client& program) { program.quad.pose.position.x = std::numeric_limits<float>::infinity(); }),
      submitted("fov", [](Client& program) { program.projections[0].fov = {}; }),
      submitted("fov", [](Client& program) { program.projections[0].fov.angleUp = std::nanf(""); }),
      submitted("image_rect", [](Client& program) { ++program.projections[0].subImage.imageRect.extent.width; }),
      submitted("image_rect", [](Client& program) { program.quad.subImage.imageRect.extent.height = 0; }),
      submitted("image_array_index", [](Client& program) { program.projections[0].subImage.imageArrayIndex = 2; }),
      submitted("image_released",
                [](Client& program) {
                  program.quad.subImage.swapchain =
                      program.chain(VK_FORMAT_R8G8B8A8_SRGB, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, 1).handle;
                }),
      submitted("image_held",
                [](Client& program) {
                  std::uint32_t index = 0;
                  xrAcquireSwapchainImage(program.panel.handle, nullptr, &index);
                }),
      submitted("depth_info", [](Client& program) { program.depths[0].maxDepth = 0.0f; }),
      submitted("depth_info", [](Client& program) { program.depths[0].farZ = program.depths[0].nearZ; }),
      submitted("depth_info", [](Client& program) { program.depths[1].subImage = program.projections[1].subImage; }),
  };
  return cases;
}

const std::vector<PlantedViolation>& swapchains() {
  static const std::vector<PlantedViolation> cases{
      session("swapchain_format",
              [](Client& program) {
                XrSwapchainCreateInfo info = colour_info();
                info.format = VK_FORMAT_R4G4_UNORM_PACK8;
                return create_swapchain(program, info);
              }),
      session("swapchain_size",
              [](Client& program) {
                XrSwapchainCreateInfo info = colour_info();
                info.width = 5000;
                return create_swapchain(program, info);
              }),
      session("swapchain_size",
              [](Client& program) {
                XrSwapchainCreateInfo info = colour_info();
                info.sampleCount = 0;
                return create_swapchain(program, info);
              }),
      session("swapchain_usage",
              [](Client& program) {
                XrSwapchainCreateInfo info = colour_info();
                info.usageFlags |= XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
                return create_swapchain(program, info);
              }),
      session("acquire_order",
              [](Client& program) {
                std::uint32_t index = 0;
                for (int i = 0; i < 3; ++i) xrAcquireSwapchainImage(program.eyes.handle, nullptr, &index);
                return xrAcquireSwapchainImage(program.eyes.handle, nullptr, &index);
              }),
      session("image_wait_order",
              [](Client& program) {
                const XrSwapchainImageWaitInfo info{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
                return xrWaitSwapchainImage(program.eyes.handle, &info);
              }),
      session("release_order",
              [](Client& program) {
                std::uint32_t index = 0;
                xrAcquireSwapchainImage(program.eyes.handle, nullptr, &index);
                return xrReleaseSwapchainImage(program.eyes.handle, nullptr);
              }),
      session("destroyed_in_use",
              [](Client& program) {
                std::uint32_t index = 0;
                xrAcquireSwapchainImage(program.panel.handle, nullptr, &index);
                const XrResult result = xrDestroySwapchain(program.panel.handle);
                program.panel.handle = XR_NULL_HANDLE;
                return result;
              }),
      {"reference_space",
       [] {
         control().script.stage = false;
         const Client program;
         const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr,
                                               XR_REFERENCE_SPACE_TYPE_STAGE, kIdentity};
         XrSpace space = XR_NULL_HANDLE;
         const XrResult result = xrCreateReferenceSpace(program.session, &info, &space);
         recorded_violations = control().record.violations;
         return result;
       }},
  };
  return cases;
}

const std::vector<PlantedViolation>& names() {
  static const std::vector<PlantedViolation> cases{
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
      machine("path_known",
              [](Machine& program) {
                std::uint32_t count = 0;
                return xrPathToString(program.instance, 1234, 0, &count, nullptr);
              }),
      machine("name_valid", [](Machine& program) { return create_set(program, "Cabin", "Cabin"); }),
      machine("name_unique",
              [](Machine& program) {
                create_set(program, "cabin", "Cabin");
                return create_set(program, "cabin", "Other");
              }),
      machine("localized_valid", [](Machine& program) { return create_set(program, "cabin", ""); }),
      machine("localized_unique",
              [](Machine& program) {
                create_set(program, "cabin", "Cabin");
                return create_set(program, "other", "Cabin");
              }),
  };
  return cases;
}

const std::vector<PlantedViolation>& actions() {
  static const std::vector<PlantedViolation> cases{
      controls("binding_path",
               [](Client&, Controls& created) {
                 return created.suggest(kSimpleController, {{created.pull, "/user/hand/left/input/trigger/value"}});
               }),
      controls("subaction_path",
               [](Client& program, Controls& created) {
                 created.suggest_all();
                 created.attach();
                 created.sync();
                 XrActionStateGetInfo info = created.get(created.pull, 0);
                 info.subactionPath = path(program.instance, "/user/head");
                 XrActionStateFloat state{XR_TYPE_ACTION_STATE_FLOAT};
                 return xrGetActionStateFloat(program.session, &info, &state);
               }),
      controls("suggest_before_attach",
               [](Client&, Controls& created) {
                 created.attach();
                 return created.suggest_all();
               }),
      controls("action_before_attach",
               [](Client&, Controls& created) {
                 created.attach();
                 const XrActionCreateInfo info = action_info("late", "Late", XR_ACTION_TYPE_BOOLEAN_INPUT);
                 XrAction late = XR_NULL_HANDLE;
                 return xrCreateAction(created.set, &info, &late);
               }),
      controls("attach_once",
               [](Client&, Controls& created) {
                 created.attach();
                 return created.attach();
               }),
      controls("set_attached", [](Client&, Controls& created) { return created.sync(); }),
      controls("action_type",
               [](Client& program, Controls& created) {
                 created.attach();
                 created.sync();
                 const XrActionStateGetInfo info = created.get(created.pull, 0);
                 XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
                 return xrGetActionStateBoolean(program.session, &info, &state);
               }),
      controls("haptic",
               [](Client&, Controls& created) {
                 created.suggest_all();
                 created.attach();
                 return created.pulse(1.5f, created.buzz, 1);
               }),
  };
  return cases;
}

// Khronos' validation layer must report the call, and stop it before it reaches the runtime. The names are those of the
// specification's valid usage.
struct InvalidCall {
  const char* usage;
  std::function<XrResult()> act;
};

const std::vector<InvalidCall>& invalid_calls() {
  static const std::vector<InvalidCall> cases{
      {"VUID-XrSystemGetInfo-type-type", in<Machine>([](Machine& program) {
         XrSystemGetInfo info = kHeadset;
         info.type = XR_TYPE_SESSION_CREATE_INFO;
         return get_system(program, info);
       })},
      {"VUID-XrSystemGetInfo-next-next", in<Machine>([](Machine& program) {
         const XrFrameWaitInfo foreign{XR_TYPE_FRAME_WAIT_INFO};
         XrSystemGetInfo info = kHeadset;
         info.next = &foreign;
         return get_system(program, info);
       })},
      {"VUID-XrSystemGetInfo-formFactor-parameter", in<Machine>([](Machine& program) {
         XrSystemGetInfo info = kHeadset;
         info.formFactor = static_cast<XrFormFactor>(7);
         return get_system(program, info);
       })},
      {"VUID-xrGetSystem-systemId-parameter",
       in<Machine>([](Machine& program) { return get_system(program, kHeadset, false); })},
      {"VUID-xrCreateSession-next-parameter", in<Machine>([](Machine& program) {
         program.get_requirements();
         return create_session(program, nullptr);
       })},
      {"VUID-xrLocateSpace-space-parameter", in<Client>([](Client& program) {
         const XrSpace space = program.reference(XR_REFERENCE_SPACE_TYPE_VIEW);
         xrDestroySpace(space);
         XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
         return xrLocateSpace(space, program.local, 1, &location);
       })},
      {"VUID-XrSwapchainCreateInfo-usageFlags-parameter", in<Client>([](Client& program) {
         XrSwapchainCreateInfo info = colour_info();
         info.usageFlags |= 0x4000;
         return create_swapchain(program, info);
       })},
      {"VUID-XrCompositionLayerProjection-space-parameter",
       submitted("", [](Client& program) { program.projection.space = XR_NULL_HANDLE; }).act},
      {"VUID-XrCompositionLayerQuad-next-next", submitted("",
                                                          [](Client& program) {
                                                            static const XrFrameWaitInfo foreign{
                                                                XR_TYPE_FRAME_WAIT_INFO};
                                                            program.quad.next = &foreign;
                                                          })
                                                    .act},
  };
  return cases;
}

TEST_CASE("Khronos' validation layer reports invalid calls, so its silence elsewhere means something") {
  for (const InvalidCall& planted : invalid_calls()) {
    CAPTURE(std::string(planted.usage));
    control().start();
    recorded_violations.clear();
    CHECK(XR_FAILED(planted.act()));
    CHECK(recorded_violations.empty());
    const std::string reported = complaints();
    CAPTURE(reported);
    CHECK(reported.find("[VALID_ERROR | " + std::string(planted.usage)) != std::string::npos);
  }
}

TEST_CASE("the runtime refuses a program that runs without the validation layer") {
  control().start();
  const std::string layer = std::getenv("XR_ENABLE_API_LAYERS");
  unsetenv("XR_ENABLE_API_LAYERS");
  XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
  std::strcpy(info.applicationInfo.applicationName, "unchecked");
  info.applicationInfo.apiVersion = XR_CURRENT_API_VERSION;
  XrInstance instance = XR_NULL_HANDLE;
  CHECK(xrCreateInstance(&info, &instance) == XR_ERROR_VALIDATION_FAILURE);
  setenv("XR_ENABLE_API_LAYERS", layer.c_str(), 1);
  CHECK(complaints().find("validated") == 0);
}

TEST_CASE("each rule rejects a planted violation, and no other rule reports") {
  std::set<std::string> shown{"validated"};  // the test case above violates it
  for (const auto* const cases : {&any_function(), &life(), &frames(), &swapchains(), &names(), &actions()}) {
    for (const PlantedViolation& planted : *cases) {
      CAPTURE(planted.rule);
      Control& xr = control();
      xr.start();
      recorded_violations.clear();
      const XrResult result = planted.act();
      REQUIRE(recorded_violations.size() == 1);
      CHECK(recorded_violations[0].rule == planted.rule);
      control().record.violations.clear();
      CHECK(complaints() == "");
      for (const Rule& one : xr.rules) {
        if (one.id == recorded_violations[0].rule) CHECK(result == one.result);
      }
      shown.insert(planted.rule);
    }
  }
  for (const Rule& one : control().rules) CHECK_MESSAGE(shown.contains(one.id), one.id << ": no planted violation");
}

TEST_CASE("legal calls are not violations") {
  Control& xr = control();
  xr.start();
  Client program;
  const Controls controls(program);
  REQUIRE(controls.suggest_all() == XR_SUCCESS);
  CHECK(controls.suggest("/interaction_profiles/valve/index_controller", {}) == XR_ERROR_PATH_UNSUPPORTED);
  REQUIRE(controls.attach() == XR_SUCCESS);
  CHECK(controls.sync() == XR_SESSION_NOT_FOCUSED);
  program.begin_and_focus();
  REQUIRE(program.wait() == XR_SUCCESS);
  REQUIRE(program.begin_frame() == XR_SUCCESS);
  REQUIRE(program.wait() == XR_SUCCESS);
  CHECK(program.begin_frame() == XR_FRAME_DISCARDED);
  CHECK(program.end_frame(false) == XR_SUCCESS);
  CHECK(xr.record.frames[4].discarded);
  CHECK_FALSE(xr.record.frames[5].discarded);
  std::uint32_t count = 0;
  std::int64_t one = 0;
  CHECK(xrEnumerateSwapchainFormats(program.session, 1, &count, &one) == XR_ERROR_SIZE_INSUFFICIENT);
  CHECK(count == 5);
  CHECK(xr.record.violations.empty());
}

}  // namespace
}  // namespace gearshift::xr_test
