// Every function of the runtime, by the name that xrGetInstanceProcAddr is asked for.
#pragma once

#include <type_traits>

#include "tests/support/xr_runtime/vulkan.h"

// name in OpenXR without "xr", the extension that brings it or nullptr
#define GEARSHIFT_XR_FUNCTIONS(_)                                                                                      \
  _(EnumerateInstanceExtensionProperties, nullptr)                                                                     \
  _(CreateInstance, nullptr)                                                                                           \
  _(DestroyInstance, nullptr)                                                                                          \
  _(GetInstanceProperties, nullptr) _(PollEvent, nullptr) _(ResultToString, nullptr) _(StructureTypeToString, nullptr) \
      _(GetSystem, nullptr) _(GetSystemProperties, nullptr) _(EnumerateEnvironmentBlendModes, nullptr)                 \
          _(CreateSession, nullptr) _(DestroySession, nullptr) _(EnumerateReferenceSpaces, nullptr) _(                 \
              CreateReferenceSpace, nullptr) _(GetReferenceSpaceBoundsRect, nullptr) _(CreateActionSpace, nullptr)     \
              _(LocateSpace, nullptr) _(DestroySpace, nullptr) _(EnumerateViewConfigurations, nullptr) _(              \
                  GetViewConfigurationProperties, nullptr) _(EnumerateViewConfigurationViews, nullptr)                 \
                  _(EnumerateSwapchainFormats, nullptr) _(CreateSwapchain, nullptr) _(DestroySwapchain, nullptr) _(    \
                      EnumerateSwapchainImages, nullptr) _(AcquireSwapchainImage, nullptr)                             \
                      _(WaitSwapchainImage, nullptr) _(ReleaseSwapchainImage, nullptr) _(BeginSession, nullptr) _(     \
                          EndSession, nullptr) _(RequestExitSession, nullptr) _(WaitFrame, nullptr)                    \
                          _(BeginFrame, nullptr) _(EndFrame, nullptr) _(LocateViews, nullptr) _(StringToPath, nullptr) \
                              _(PathToString, nullptr) _(CreateActionSet, nullptr) _(DestroyActionSet, nullptr)        \
                                  _(CreateAction, nullptr) _(DestroyAction, nullptr) _(                                \
                                      SuggestInteractionProfileBindings, nullptr) _(AttachSessionActionSets, nullptr)  \
                                      _(GetCurrentInteractionProfile, nullptr) _(GetActionStateBoolean, nullptr) _(    \
                                          GetActionStateFloat, nullptr) _(GetActionStateVector2f, nullptr)             \
                                          _(GetActionStatePose, nullptr) _(SyncActions, nullptr) _(                    \
                                              EnumerateBoundSourcesForAction, nullptr)                                 \
                                              _(GetInputSourceLocalizedName, nullptr) _(ApplyHapticFeedback, nullptr)  \
                                                  _(StopHapticFeedback, nullptr)                                       \
                                                      _(GetVulkanGraphicsRequirements2KHR, "XR_KHR_vulkan_enable2")    \
                                                          _(CreateVulkanInstanceKHR, "XR_KHR_vulkan_enable2")          \
                                                              _(GetVulkanGraphicsDevice2KHR, "XR_KHR_vulkan_enable2")  \
                                                                  _(CreateVulkanDeviceKHR, "XR_KHR_vulkan_enable2")    \
                                                                      _(ConvertTimespecTimeToTimeKHR,                  \
                                                                        "XR_KHR_convert_timespec_time")                \
                                                                          _(ConvertTimeToTimespecTimeKHR,              \
                                                                            "XR_KHR_convert_timespec_time")

namespace gearshift::xr_test::xr {

// Each has the type that OpenXR gives it: XrResult WaitFrame(XrSession, const XrFrameWaitInfo*, XrFrameState*);
#define GEARSHIFT_XR_DECLARE(name, extension) std::remove_pointer_t<PFN_xr##name> name;
GEARSHIFT_XR_FUNCTIONS(GEARSHIFT_XR_DECLARE)
#undef GEARSHIFT_XR_DECLARE

}  // namespace gearshift::xr_test::xr
