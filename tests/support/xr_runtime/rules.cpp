// The rules that the runtime checks. Tests in tests/engine/xr/runtime_rules_test.cpp violate each rule.
#include "tests/support/xr_runtime/rules.h"

#include <stdexcept>

namespace gearshift::xr_test {
namespace {

constexpr Rule kRules[] = {
    // Rules for all functions. Khronos' validation layer checks handles, pointers, structures and enumeration values.
    {"validated", XR_ERROR_VALIDATION_FAILURE, "Validation Layer", "the program runs under Khronos' validation layer"},
    {"time_positive", XR_ERROR_TIME_INVALID, "Time", "an XrTime of zero or less is invalid"},
    // System and session.
    {"system_id", XR_ERROR_SYSTEM_INVALID, "Getting the XrSystemId", "systemId must be one that xrGetSystem gave"},
    {"form_factor", XR_ERROR_FORM_FACTOR_UNSUPPORTED, "xrGetSystem", "formFactor must be one that the runtime knows"},
    {"view_configuration", XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED, "View Configurations",
     "viewConfigurationType must be one that the system supports and the session began with"},
    {"graphics_requirements", XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING, "XR_KHR_vulkan_enable2",
     "xrGetVulkanGraphicsRequirements2KHR must be called before xrCreateSession"},
    {"graphics_binding", XR_ERROR_GRAPHICS_DEVICE_INVALID, "XrGraphicsBindingVulkan2KHR",
     "xrCreateSession needs a device that xrCreateVulkanDeviceKHR made of the runtime's physical device"},
    {"session_ready", XR_ERROR_SESSION_NOT_READY, "xrBeginSession", "xrBeginSession is for the state READY alone"},
    {"session_begun_twice", XR_ERROR_SESSION_RUNNING, "xrBeginSession", "the session must not be running already"},
    {"session_stopping", XR_ERROR_SESSION_NOT_STOPPING, "xrEndSession", "xrEndSession is for the state STOPPING alone"},
    {"session_running", XR_ERROR_SESSION_NOT_RUNNING, "Session Lifecycle",
     "frames, the session's end and the request for it need a running session"},
    // Frames.
    {"wait_twice", XR_ERROR_VALIDATION_FAILURE, "xrWaitFrame",
     "each xrWaitFrame must be followed by its xrBeginFrame; a second one would block forever"},
    {"wait_before_begin", XR_ERROR_CALL_ORDER_INVALID, "xrBeginFrame", "xrBeginFrame needs an xrWaitFrame of its own"},
    {"begin_before_end", XR_ERROR_CALL_ORDER_INVALID, "xrEndFrame", "xrEndFrame needs an xrBeginFrame"},
    {"end_time", XR_ERROR_TIME_INVALID, "XrFrameEndInfo",
     "displayTime is the predicted display time of the frame that xrBeginFrame began"},
    {"blend_mode", XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED, "XrFrameEndInfo",
     "environmentBlendMode must be one that xrEnumerateEnvironmentBlendModes gave"},
    // Layers.
    {"layer_count", XR_ERROR_LAYER_LIMIT_EXCEEDED, "XrFrameEndInfo", "layerCount must not exceed maxLayerCount"},
    {"layer_type", XR_ERROR_LAYER_INVALID, "XrFrameEndInfo", "a layer must not be of a type that is not enabled"},
    {"view_count", XR_ERROR_VALIDATION_FAILURE, "XrCompositionLayerProjection",
     "viewCount must be the number of views of the session's view configuration"},
    {"pose_unit", XR_ERROR_POSE_INVALID, "XrPosef", "an orientation must be a unit quaternion, a position finite"},
    {"fov", XR_ERROR_VALIDATION_FAILURE, "XrFovf", "angles lie between -pi/2 and pi/2 and span something"},
    {"image_rect", XR_ERROR_SWAPCHAIN_RECT_INVALID, "XrSwapchainSubImage",
     "imageRect must have an extent and lie inside the swapchain's images"},
    {"image_array_index", XR_ERROR_VALIDATION_FAILURE, "XrSwapchainSubImage",
     "imageArrayIndex must be less than the swapchain's arraySize"},
    {"image_released", XR_ERROR_LAYER_INVALID, "XrSwapchainSubImage",
     "a submitted swapchain must have had an image released"},
    {"image_held", XR_ERROR_LAYER_INVALID, "xrReleaseSwapchainImage",
     "what is drawn for a frame is released before xrEndFrame, or the picture before it is shown"},
    {"depth_info", XR_ERROR_VALIDATION_FAILURE, "XrCompositionLayerDepthInfoKHR",
     "0 <= minDepth < maxDepth <= 1, nearZ and farZ are not negative and differ, the swapchain's format is a depth's"},
    // Swapchains.
    {"swapchain_format", XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "xrCreateSwapchain",
     "format must be one that xrEnumerateSwapchainFormats gave"},
    {"swapchain_size", XR_ERROR_VALIDATION_FAILURE, "XrSwapchainCreateInfo",
     "extent, samples, layers and levels must be at least one and within the system's limits"},
    {"swapchain_usage", XR_ERROR_VALIDATION_FAILURE, "XrSwapchainCreateInfo",
     "usageFlags fit the format: no depth attachment of a colour format, nor the other way round"},
    {"acquire_order", XR_ERROR_CALL_ORDER_INVALID, "xrAcquireSwapchainImage",
     "not more images may be acquired at a time than the swapchain has"},
    {"image_wait_order", XR_ERROR_CALL_ORDER_INVALID, "xrWaitSwapchainImage",
     "an image must be acquired, and the one waited for before be released"},
    {"release_order", XR_ERROR_CALL_ORDER_INVALID, "xrReleaseSwapchainImage",
     "an image is released after it was waited for"},
    {"destroyed_in_use", XR_SUCCESS, "xrDestroySwapchain", "no image of a destroyed swapchain may still be in use"},
    // Spaces.
    {"reference_space", XR_ERROR_REFERENCE_SPACE_UNSUPPORTED, "xrCreateReferenceSpace",
     "referenceSpaceType must be one that xrEnumerateReferenceSpaces gave"},
    // Paths and actions.
    {"path_format", XR_ERROR_PATH_FORMAT_INVALID, "Well-Formed Path Strings",
     "a path begins with a slash and has nothing but a-z 0-9 - _ . in its parts"},
    {"path_known", XR_ERROR_PATH_INVALID, "XrPath", "an XrPath must come from xrStringToPath of this instance"},
    {"binding_path", XR_ERROR_PATH_UNSUPPORTED, "Interaction Profile Paths",
     "a suggested binding must be a path that the interaction profile has"},
    {"subaction_path", XR_ERROR_PATH_UNSUPPORTED, "XrActionCreateInfo",
     "a subaction path is a user path, and the action was created with it"},
    {"name_valid", XR_ERROR_NAME_INVALID, "Well-Formed Path Strings",
     "the name of an action or a set is one part of a path"},
    {"name_unique", XR_ERROR_NAME_DUPLICATED, "xrCreateAction", "the name must be unique among its kind"},
    {"localized_valid", XR_ERROR_LOCALIZED_NAME_INVALID, "xrCreateAction", "the localized name must not be empty"},
    {"localized_unique", XR_ERROR_LOCALIZED_NAME_DUPLICATED, "xrCreateAction",
     "the localized name must be unique among its kind"},
    {"suggest_before_attach", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "xrSuggestInteractionProfileBindings",
     "bindings are suggested before the action's set is attached"},
    {"action_before_attach", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "xrCreateAction",
     "actions are created before their set is attached"},
    {"attach_once", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "xrAttachSessionActionSets",
     "a session's action sets are attached once"},
    {"set_attached", XR_ERROR_ACTIONSET_NOT_ATTACHED, "xrSyncActions",
     "an action set must be attached to the session before it is synced or read"},
    {"action_type", XR_ERROR_ACTION_TYPE_MISMATCH, "xrGetActionStateBoolean",
     "an action must have the type that is asked for"},
    {"haptic", XR_ERROR_VALIDATION_FAILURE, "XrHapticVibration",
     "amplitude lies between 0 and 1, duration is positive or XR_MIN_HAPTIC_DURATION, frequency is not negative"},
};

}  // namespace

std::span<const Rule> rules() {
  return kRules;
}

const Rule& rule(const char* id) {
  for (const Rule& one : kRules) {
    if (std::string_view(one.id) == id) return one;
  }
  throw std::logic_error(std::string("no such rule: ") + id);
}

}  // namespace gearshift::xr_test
