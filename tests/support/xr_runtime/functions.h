// Every function of the runtime, by the name passed to xrGetInstanceProcAddr.
#pragma once

#include <type_traits>

#include "tests/support/xr_runtime/vulkan.h"

// Function names without the prefix "xr", for the core and for each extension.
// clang-format off
#define GEARSHIFT_XR_CORE(_)                                                                                           \
  _(EnumerateInstanceExtensionProperties) _(CreateInstance) _(DestroyInstance) _(GetInstanceProperties) _(PollEvent)   \
  _(ResultToString) _(StructureTypeToString) _(GetSystem) _(GetSystemProperties) _(EnumerateEnvironmentBlendModes)     \
  _(CreateSession) _(DestroySession) _(EnumerateReferenceSpaces) _(CreateReferenceSpace)                               \
  _(GetReferenceSpaceBoundsRect) _(CreateActionSpace) _(LocateSpace) _(DestroySpace) _(EnumerateViewConfigurations)    \
  _(GetViewConfigurationProperties) _(EnumerateViewConfigurationViews) _(EnumerateSwapchainFormats) _(CreateSwapchain) \
  _(DestroySwapchain) _(EnumerateSwapchainImages) _(AcquireSwapchainImage) _(WaitSwapchainImage)                       \
  _(ReleaseSwapchainImage) _(BeginSession) _(EndSession) _(RequestExitSession) _(WaitFrame) _(BeginFrame) _(EndFrame)  \
  _(LocateViews) _(StringToPath) _(PathToString) _(CreateActionSet) _(DestroyActionSet) _(CreateAction)                \
  _(DestroyAction) _(SuggestInteractionProfileBindings) _(AttachSessionActionSets) _(GetCurrentInteractionProfile)     \
  _(GetActionStateBoolean) _(GetActionStateFloat) _(GetActionStateVector2f) _(GetActionStatePose) _(SyncActions)       \
  _(EnumerateBoundSourcesForAction) _(GetInputSourceLocalizedName) _(ApplyHapticFeedback) _(StopHapticFeedback)
#define GEARSHIFT_XR_VULKAN_ENABLE2(_)                                                                                 \
  _(GetVulkanGraphicsRequirements2KHR) _(CreateVulkanInstanceKHR) _(GetVulkanGraphicsDevice2KHR)                       \
  _(CreateVulkanDeviceKHR)
#define GEARSHIFT_XR_CONVERT_TIMESPEC_TIME(_)                                                                          \
  _(ConvertTimespecTimeToTimeKHR) _(ConvertTimeToTimespecTimeKHR)
// clang-format on

namespace gearshift::xr_test::xr {

// Declares each function with its OpenXR type, for example XrResult WaitFrame(XrSession, const XrFrameWaitInfo*,
// XrFrameState*); NOLINTBEGIN(bugprone-macro-parentheses): a declared name cannot have parentheses
#define GEARSHIFT_XR_DECLARE(name) std::remove_pointer_t<PFN_xr##name> name;
GEARSHIFT_XR_CORE(GEARSHIFT_XR_DECLARE)
GEARSHIFT_XR_VULKAN_ENABLE2(GEARSHIFT_XR_DECLARE)
GEARSHIFT_XR_CONVERT_TIMESPEC_TIME(GEARSHIFT_XR_DECLARE)
#undef GEARSHIFT_XR_DECLARE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace gearshift::xr_test::xr
