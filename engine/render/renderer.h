// Draws a frame: sun's shadow, mirror, opaque, masked, sky, glass, one eye or two; tone-mapped into an image of its own.
//
// Each eye's picture is a layer of colour(): it is shown by blitting it to a window, read back as a PNG, or copied to a
// headset. Both eyes are drawn in one pass where the device lets a vertex shader choose the layer, else eye by eye;
// multisampled layers are resolved by vkCmdResolveImage (an inline resolve into layer 1 stays black on one driver).
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

namespace gearshift {

enum class EyePasses { automatic, layered, one_by_one };

struct RenderConfig {
  int width = 1280, height = 720;  // [px] of one eye
  int eyes = 1;                    // 1 or 2
  int samples = 1;                 // 1 or 4
  EyePasses eye_passes = EyePasses::automatic;
  int shadow_side = 2048;   // [texels] 0: no shadow
  int mirror_height = 96;   // [px] 0: the mirror shows its material only
  bool normal_maps = true;  // false: a test's negative control
  bool keep_depth = false;  // depth() can be copied: for who projects the picture again
  // [1] of the tangents of the half angles: how much wider than the views things are looked for, where Finish has later
  // views. A head that turns at 300 deg/s turns by 3 deg in 10 ms, a tenth at the side of a 90 deg picture.
  float late_margin = 0.0f;
};

// Time on the GPU of the passes of the last finished frame. [ms] 0 without timestamps
struct PassTimes {
  double shadow = 0.0, depth = 0.0, mirror = 0.0, main = 0.0, overlay = 0.0, all = 0.0;
};

class Renderer {
 public:
  // Lights and pipelines. Throws GpuError; std::invalid_argument for a config out of range.
  Renderer(Gpu& gpu, const RenderConfig& config);
  ~Renderer();

  void set_model(const Model& model);  // uploads; may be called again. Waits for the frames in flight
  // The day sky, and what a car's cabin leaves of it, until then. indoors: for nodes that stand there; empty: the same
  // as in the open. Waits for the frames in flight.
  void set_environment(const Radiance& open, const Radiance& indoors = {});
  void resize(const RenderConfig& config);  // size, eyes, samples. Waits for the frames in flight
  const RenderConfig& config() const noexcept;

  // Records and submits one frame: views.size() == eyes. Overlays are drawn on every eye in order. Returns the timeline
  // value. Afterwards colour() is in ImageUse::copy_from.
  std::uint64_t draw(const FrameScene& scene, std::span<const View> views, std::span<Overlay* const> overlays = {});

  // The same, handing the command buffer over before it is submitted: a window appends its blit, an XR session its copy.
  struct Finish {
    virtual ~Finish() = default;
    // slot: which of the kFramesInFlight this frame is, for an overlay of one's own.
    virtual void record(VkCommandBuffer commands, GpuImage& colour, int slot) = 0;
    // The eyes as they stand now, asked for when all is recorded and just before it is submitted: what is drawn is drawn
    // from there. Empty: from where it was. They turn and move no further than late_margin allows for.
    virtual std::span<const View> late_views() { return {}; }
    VkSemaphore wait_for = VK_NULL_HANDLE;
    VkSemaphore then_signal = VK_NULL_HANDLE;
  };
  std::uint64_t draw(const FrameScene& scene, std::span<const View> views, std::span<Overlay* const> overlays,
                     Finish& finish);

  GpuImage& colour() noexcept;  // one layer an eye, kColourFormat
  // One layer an eye, kDepthFormat: near plane / distance. Of several samples the first. In copy_from after draw(), where
  // the config keeps it.
  GpuImage& depth() noexcept;
  Image read_eye(int eye);  // waits
  const PassTimes& times() const noexcept;
  int draws() const noexcept;     // of the last frame's main pass
  bool layered() const noexcept;  // both eyes in one pass

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
