// The cabin in a window or in memory: GPU, renderer, panel, and a swapchain if there is a window.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <glm/vec2.hpp>

#include "app/cabin/view/visible_region.h"
#include "engine/model/model.h"
#include "engine/render/renderer.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"

namespace gearshift::cabin {

struct ViewConfig {
  int width = 1280, height = 720;  // [px] whole image; with a window, its size is used instead
  int samples = 0;                 // 1, 4, or 0: 4 on a GPU, 1 on a software driver
  bool stereo = false;             // render both eyes side by side
  double eye_distance = 0.063;     // [m]
  double screen_distance = 2.0;    // [m] distance of zero parallax
  double near_plane = 0.05;        // [m]
};

// [px] Size of one eye's image for a whole image of that size, at least 1 x 1. The panel is drawn into it.
glm::ivec2 eye_size(const ViewConfig& config, glm::ivec2 whole);
// The mouse position within the eye image that it is over. [px]
glm::dvec2 mouse_in_eye(const ViewConfig& config, glm::dvec2 mouse, glm::ivec2 whole);

// A frustum for an image of that size, centred in the visible region. field [rad]: across the region's shorter side. If
// the region is narrower than a fifth of the image, the whole image is used.
engine::Fov fov_around(double field, glm::dvec2 size, const VisibleRegion& part);

// The app's GpuConfig: validation if GEARSHIFT_VALIDATION is set, with each message as one line on stderr; the pipeline
// cache is in the user's cache folder.
engine::GpuConfig gpu_config(bool with_window);

class CabinView {
 public:
  // ui may be null (no panel), window may be null (renders in memory). Both must outlive the view. Throws GpuError.
  CabinView(const ViewConfig& config, engine::Window* window, engine::UiContext* ui);
  ~CabinView();

  void set_model(const engine::Model& model);

  // False if nothing can be shown now, e.g. while minimised or being resized.
  bool begin();
  // Call after begin(): draws and presents in the window. field [deg]: across the shorter side of the visible region.
  // Throws GpuLost.
  void draw(const engine::FrameScene& scene, const engine::EyePose& head, double field,
            const VisibleRegion& region = {});

  engine::Image picture();  // the last frame; both eyes side by side if stereo. Waits for the GPU
  const engine::Renderer& renderer() const;
  const engine::GpuTraits& gpu() const;
  std::uint64_t validation_messages() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::cabin
