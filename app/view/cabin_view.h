// The cabin on a screen or in memory: GPU, renderer, panel, and a swapchain where there is a window.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <glm/vec2.hpp>

#include "app/view/seen_part.h"
#include "engine/model/model.h"
#include "engine/render/renderer.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"

namespace gearshift {

struct ViewConfig {
  int width = 1280, height = 720;  // [px] of the whole picture; a window's own size counts where there is one
  int samples = 0;                 // 1, 4, or 0: 4 on a GPU, 1 on a software driver
  bool stereo = false;             // both eyes side by side
  double eye_distance = 0.063;     // [m] between the eyes
  double screen_distance = 2.0;    // [m] at which both eyes see the same
  double near_plane = 0.05;        // [m]
};

// [px] of the picture that one eye sees of a whole picture of that size: at least 1 x 1. The panel is drawn into it.
glm::ivec2 eye_size(const ViewConfig& config, glm::ivec2 whole);
// Where in that eye's picture the mouse is over which it stands. [px]
glm::dvec2 in_eye(const ViewConfig& config, glm::dvec2 mouse, glm::ivec2 whole);

// A frustum through a picture of that size whose middle is the part's: the field lies across the part's shorter side.
// [rad] A part narrower than a fifth of the picture is none: then the whole picture's.
Fov fov_around(double field, glm::dvec2 size, const SeenPart& part);

// How a GpuConfig is made here: validation where GEARSHIFT_VALIDATION is set, each message one line on stderr; the
// pipeline cache lies in the user's cache folder.
GpuConfig gpu_config(bool with_window);

class CabinView {
 public:
  // ui may be null: no panel. The window (where there is one) and ui must outlive the view. Throws GpuError.
  CabinView(const ViewConfig& config, Window* window, UiContext* ui);
  ~CabinView();

  void set_model(const Model& model);

  // False where nothing can be shown now: minimised, being resized.
  bool begin();
  // Between begin() and the end of the frame: draws, and shows it in the window. field: across the shorter side of what
  // an eye sees of its picture. [deg] Throws GpuLost.
  void draw(const FrameScene& scene, const EyePose& head, double field, const SeenPart& seen = {});

  Image picture();  // of the last frame: both eyes side by side where stereo. Waits
  const Renderer& renderer() const;
  const GpuTraits& gpu() const;
  std::uint64_t validation_messages() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
