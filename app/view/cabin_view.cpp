#include "app/view/cabin_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "app/print_out.h"
#include "app/user_cache.h"
#include "engine/window/swapchain.h"

namespace gearshift {
namespace {

RenderConfig render_config(const ViewConfig& config, int width, int height) {
  RenderConfig render;
  const glm::ivec2 eye = eye_size(config, {width, height});
  render.eyes = config.stereo ? 2 : 1;
  render.width = eye.x;
  render.height = eye.y;
  render.samples = config.samples;
  return render;
}

std::vector<View> views_of(const ViewConfig& config, const EyePose& head, const Fov& centre) {
  if (!config.stereo) return {view_from(head, centre, config.near_plane)};
  const StereoEyes eyes = stereo_eyes(head, centre, config.eye_distance, config.screen_distance);
  return {view_from(eyes.pose[0], eyes.fov[0], config.near_plane),
          view_from(eyes.pose[1], eyes.fov[1], config.near_plane)};
}

// Blits the eyes into the window's image.
class Show final : public Renderer::Finish {
 public:
  Show(Swapchain& swapchain, bool stereo) : swapchain_(swapchain), stereo_(stereo) {
    wait_for = swapchain.acquired();
    then_signal = swapchain.rendered();
  }
  void record(VkCommandBuffer commands, GpuImage& colour, int) override {
    const std::array<ShownLayer, 2> both{{{0, 0.0f, 0.5f}, {1, 0.5f, 1.0f}}};
    const std::array<ShownLayer, 1> one{{{0, 0.0f, 1.0f}}};
    if (stereo_) {
      swapchain_.record(commands, colour, both);
    } else {
      swapchain_.record(commands, colour, one);
    }
  }

 private:
  Swapchain& swapchain_;
  bool stereo_;
};

}  // namespace

glm::ivec2 eye_size(const ViewConfig& config, glm::ivec2 whole) {
  return {std::max(1, whole.x / (config.stereo ? 2 : 1)), std::max(1, whole.y)};
}

glm::dvec2 in_eye(const ViewConfig& config, glm::dvec2 mouse, glm::ivec2 whole) {
  return {std::fmod(mouse.x, eye_size(config, whole).x), mouse.y};
}

Fov fov_around(double field, glm::dvec2 size, const SeenPart& part) {
  constexpr double kLeastPart = 0.2;
  const glm::dvec2 share = part.high - part.low;
  const SeenPart seen = std::min(share.x, share.y) < kLeastPart ? SeenPart{} : part;
  const glm::dvec2 low = seen.low * size, high = seen.high * size, middle = 0.5 * (low + high);
  const double per_px = 2.0 * std::tan(field / 2.0) / std::min(high.x - low.x, high.y - low.y);
  return {-std::atan(middle.x * per_px), std::atan((size.x - middle.x) * per_px),
          -std::atan((size.y - middle.y) * per_px), std::atan(middle.y * per_px)};
}

GpuConfig gpu_config(bool with_window) {
  GpuConfig config;
  config.swapchain = with_window;
  if (with_window) config.instance_extensions = Window::instance_extensions();
  config.validation = std::getenv("GEARSHIFT_VALIDATION") != nullptr;
  config.on_validation = [](std::string_view text) { print_problem("validation: {}", text); };
  config.pipeline_cache = user_cache_file("pipelines.bin");
  return config;
}

struct CabinView::State {
  State(const ViewConfig& view, Window* shown_in, UiContext* ui)
      : config(view),
        window(shown_in),
        gpu(gpu_config(shown_in != nullptr)),
        renderer(gpu, render_config(choose_samples(), view.width, view.height)) {
    if (window) swapchain.emplace(gpu, *window);
    if (ui) overlay.emplace(gpu, *ui);
  }

  const ViewConfig& choose_samples() {
    if (config.samples == 0) config.samples = gpu.traits().is_cpu || !gpu.traits().four_samples ? 1 : 4;
    return config;
  }

  // The picture follows the window.
  void fit() {
    const VkExtent2D extent = swapchain->extent();
    const RenderConfig wanted = render_config(config, static_cast<int>(extent.width), static_cast<int>(extent.height));
    const RenderConfig& now = renderer.config();
    if (wanted.width != now.width || wanted.height != now.height) renderer.resize(wanted);
  }

  ViewConfig config;
  Window* window;
  Gpu gpu;
  Renderer renderer;
  std::optional<Swapchain> swapchain;
  std::optional<UiOverlay> overlay;
};

CabinView::CabinView(const ViewConfig& config, Window* window, UiContext* ui)
    : state_(std::make_unique<State>(config, window, ui)) {}

CabinView::~CabinView() {
  state_->gpu.wait_idle();
}

void CabinView::set_model(const Model& model) {
  state_->renderer.set_model(model);
}

bool CabinView::begin() {
  if (!state_->swapchain) return true;
  if (!state_->swapchain->acquire()) return false;
  state_->fit();
  return true;
}

void CabinView::draw(const FrameScene& scene, const EyePose& head, double field, const SeenPart& seen) {
  State& s = *state_;
  const RenderConfig& now = s.renderer.config();
  const Fov centre = fov_around(field * std::numbers::pi / 180.0, {now.width, now.height}, seen);
  const std::vector<View> views = views_of(s.config, head, centre);
  std::vector<Overlay*> overlays;
  if (s.overlay) overlays.push_back(&*s.overlay);
  if (!s.swapchain) {
    s.renderer.draw(scene, views, overlays);
    return;
  }
  Show show(*s.swapchain, s.config.stereo);
  s.renderer.draw(scene, views, overlays, show);
  s.swapchain->present();
}

Image CabinView::picture() {
  Image left = state_->renderer.read_eye(0);
  return state_->config.stereo ? side_by_side(left, state_->renderer.read_eye(1)) : left;
}

const Renderer& CabinView::renderer() const {
  return state_->renderer;
}

const GpuTraits& CabinView::gpu() const {
  return state_->gpu.traits();
}

std::uint64_t CabinView::validation_messages() const {
  return state_->gpu.validation_messages();
}

}  // namespace gearshift
