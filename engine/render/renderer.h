// Draws a frame for one or two eyes: sun shadow, mirror, opaque and masked surfaces, sky, glass. The tone-mapped
// picture is in an image that the renderer owns.
//
// Each eye's picture is a layer of colour(), which can be blitted to a window, read back as a PNG, or copied to a
// headset. Both eyes are drawn in one pass if the device lets a vertex shader select the layer, otherwise eye by eye.
// Multisampled layers are resolved by vkCmdResolveImage, because lavapipe of Mesa 22.3 leaves a resolve attachment for
// layer 1 black.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/gpu/gpu.h"
#include "engine/gpu/gpu_image.h"
#include "engine/gpu/overlay.h"
#include "engine/light/environment.h"
#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"

namespace gearshift::engine {

enum class EyePasses { automatic, layered, one_by_one };

struct RenderConfig {
  int width = 1280, height = 720;  // [px] per eye
  int eyes = 1;                    // 1 or 2
  int samples = 1;                 // 1 or 4
  EyePasses eye_passes = EyePasses::automatic;
  int shadow_side = 2048;   // [texels] 0: no shadows
  int mirror_height = 96;   // [px] 0: the mirror shows only its material
  bool normal_maps = true;  // false only as the negative control of a test
  bool keep_depth = false;  // keeps depth() for copying, e.g. for reprojection
  // [1] Fraction by which the culling frusta are widened (tangents of the half angles), because Finish::late_views()
  // may still turn the views. Example: a head that turns at 300 deg/s moves 3 deg in 10 ms. A picture 90 deg wide then
  // needs about 0.1, because tan(48 deg) / tan(45 deg) = 1.11.
  float late_margin = 0.0f;
};

// GPU time [ms] of the passes of the last completed frame; 0 if the device has no timestamps.
struct PassTimes {
  double shadow = 0.0, depth = 0.0, mirror = 0.0, main = 0.0, overlay = 0.0, all = 0.0;
};

class Renderer {
 public:
  // Creates lights and pipelines. Throws GpuError, or std::invalid_argument for a config out of range.
  Renderer(Gpu& gpu, const RenderConfig& config);
  ~Renderer();

  void set_model(const Model& model);  // uploads the model; may be called again. Waits for the frames in flight
  // Replaces the default environment, which is a day sky and the light that reaches a car's cabin. `indoors` lights the
  // nodes marked as indoors; if empty, `open` is used for them. Waits for the frames in flight.
  void set_environment(const Radiance& open, const Radiance& indoors = {});
  void resize(const RenderConfig& config);  // applies a changed configuration. Waits for the frames in flight
  const RenderConfig& config() const noexcept;

  // Records and submits one frame. `views` holds one view per eye. Overlays are drawn in order, on every eye. Returns
  // the timeline value of the submission. Afterwards colour() is in ImageUse::copy_from.
  std::uint64_t draw(const FrameScene& scene, std::span<const View> views, std::span<Overlay* const> overlays = {});

  // Hooks that run before the submission. A window records its blit here, an XR session its copy.
  struct Finish {
    virtual ~Finish() = default;
    // `slot`: index of this frame, 0 to kFramesInFlight - 1, for the caller's per-frame buffers.
    virtual void record(VkCommandBuffer commands, GpuImage& colour, int slot) = 0;
    // Latest views of the eyes, requested after recording and just before the submission. They replace the views passed
    // to draw(), from which they may differ by no more than late_margin allows. Empty: keep the views passed to draw().
    virtual std::span<const View> late_views() { return {}; }
    VkSemaphore wait_for = VK_NULL_HANDLE;
    VkSemaphore then_signal = VK_NULL_HANDLE;
  };
  std::uint64_t draw(const FrameScene& scene, std::span<const View> views, std::span<Overlay* const> overlays,
                     Finish& finish);

  GpuImage& colour() noexcept;  // one layer per eye, kColourFormat
  // One layer per eye, in kDepthFormat. Each value is near plane / distance; with multisampling, it is the first
  // sample's value. After draw(), the image is in ImageUse::copy_from if the config has keep_depth.
  GpuImage& depth() noexcept;
  Image read_eye(int eye);  // waits for the GPU
  const PassTimes& times() const noexcept;
  int draws() const noexcept;     // draw calls in the last frame's main pass
  bool layered() const noexcept;  // both eyes are drawn in one pass

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::engine
