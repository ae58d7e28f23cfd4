// Draws the cabin in a window or in memory: GPU, renderer, panel, and a swapchain if there is a window.
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
  int width = 1280, height = 720;  // [px] size of the whole image; unused with a window, which has its own size
  int samples = 0;                 // samples per pixel: 1 or 4; 0 means 4 on a GPU, 1 on a software driver
  bool stereo = false;             // render both eyes side by side
  double eye_distance = 0.063;     // [m]
  double screen_distance = 2.0;    // [m] distance from the eyes at which the parallax is zero
  double near_plane = 0.05;        // [m]
};

// [px] Size of the image for one eye, at least 1 x 1, if the full image has the size `full_size`. The panel is drawn
// into the image for each eye.
glm::ivec2 eye_size(const ViewConfig& config, glm::ivec2 full_size);
// [px] Returns the mouse position within the eye's image that the mouse is over.
glm::dvec2 mouse_in_eye(const ViewConfig& config, glm::dvec2 mouse, glm::ivec2 full_size);

// Returns a frustum for an image of this size, centred in the visible region. `field` [rad]: field of view across the
// region's shorter side. If the region is narrower than a fifth of the image, the whole image is used instead.
engine::Fov fov_around(double field, glm::dvec2 size, const VisibleRegion& part);

// The GPU configuration of this program. If the environment variable GEARSHIFT_VALIDATION is set, validation is on and
// prints each message as one line on stderr. The pipeline cache is in the user's cache folder.
engine::GpuConfig gpu_config(bool with_window);

class CabinView {
 public:
  // `window`: null to render in memory. `ui`: null if no panel is drawn. Window and UI must outlive the view. Throws
  // GpuError.
  CabinView(const ViewConfig& config, engine::Window* window, engine::UiContext* ui);
  ~CabinView();

  void set_model(const engine::Model& model);

  // Returns false if nothing can be shown in this frame, e.g. while the window is minimised or being resized.
  bool begin();
  // Call after begin() has returned true. Draws, and presents the image if there is a window. `field` [deg]: field of
  // view across the shorter side of the visible region. Throws GpuLost.
  void draw(const engine::FrameScene& scene, const engine::EyePose& head, double field,
            const VisibleRegion& region = {});

  engine::Image picture();  // the last frame, with both eyes side by side if stereo; waits for the GPU
  const engine::Renderer& renderer() const;
  const engine::GpuTraits& gpu() const;
  std::uint64_t validation_messages() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::cabin
