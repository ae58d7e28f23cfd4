#include "app/cabin/view/cabin_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "app/base/console.h"
#include "app/base/user_cache.h"
#include "engine/window/swapchain.h"

namespace gearshift::cabin {
namespace {

engine::RenderConfig render_config(const ViewConfig& config, int width, int height) {
  engine::RenderConfig render;
  const glm::ivec2 eye = eye_size(config, {width, height});
  render.eyes = config.stereo ? 2 : 1;
  render.width = eye.x;
  render.height = eye.y;
  render.samples = config.samples;
  return render;
}

std::vector<engine::View> views_of(const ViewConfig& config, const engine::EyePose& head, const engine::Fov& centre) {
  if (!config.stereo) return {engine::view_from(head, centre, config.near_plane)};
  const engine::StereoEyes eyes = engine::stereo_eyes(head, centre, config.eye_distance, config.screen_distance);
  return {engine::view_from(eyes.pose[0], eyes.fov[0], config.near_plane),
          engine::view_from(eyes.pose[1], eyes.fov[1], config.near_plane)};
}

// Copies the rendered image, or the images of both eyes, into the window's image.
class PresentFinish final : public engine::Renderer::Finish {
 public:
  PresentFinish(engine::Swapchain& swapchain, bool stereo) : swapchain_(swapchain), stereo_(stereo) {
    wait_for = swapchain.acquired();
    then_signal = swapchain.rendered();
  }
  void record(VkCommandBuffer commands, engine::GpuImage& colour, int) override {
    const std::array<engine::ShownLayer, 2> both{{{0, 0.0f, 0.5f}, {1, 0.5f, 1.0f}}};
    const std::array<engine::ShownLayer, 1> one{{{0, 0.0f, 1.0f}}};
    if (stereo_) {
      swapchain_.record(commands, colour, both);
    } else {
      swapchain_.record(commands, colour, one);
    }
  }

 private:
  engine::Swapchain& swapchain_;
  bool stereo_;
};

}  // namespace

glm::ivec2 eye_size(const ViewConfig& config, glm::ivec2 full_size) {
  return {std::max(1, full_size.x / (config.stereo ? 2 : 1)), std::max(1, full_size.y)};
}

glm::dvec2 mouse_in_eye(const ViewConfig& config, glm::dvec2 mouse, glm::ivec2 full_size) {
  return {std::fmod(mouse.x, eye_size(config, full_size).x), mouse.y};
}

engine::Fov fov_around(double field, glm::dvec2 size, const VisibleRegion& part) {
  constexpr double kMinRegion = 0.2;
  const glm::dvec2 extent = part.high - part.low;
  const VisibleRegion region = std::min(extent.x, extent.y) < kMinRegion ? VisibleRegion{} : part;
  const glm::dvec2 low = region.low * size, high = region.high * size, middle = 0.5 * (low + high);
  const double per_px = 2.0 * std::tan(field / 2.0) / std::min(high.x - low.x, high.y - low.y);
  return {-std::atan(middle.x * per_px), std::atan((size.x - middle.x) * per_px),
          -std::atan((size.y - middle.y) * per_px), std::atan(middle.y * per_px)};
}

engine::GpuConfig gpu_config(bool with_window) {
  engine::GpuConfig config;
  config.swapchain = with_window;
  if (with_window) config.instance_extensions = engine::Window::instance_extensions();
  config.validation = std::getenv("GEARSHIFT_VALIDATION") != nullptr;
  config.on_validation = [](std::string_view text) { base::print_message("validation: {}", text); };
  config.pipeline_cache = base::user_cache_file("pipelines.bin");
  return config;
}

struct CabinView::State {
  State(const ViewConfig& view, engine::Window* shown_in, engine::UiContext* ui)
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

  // Resizes the rendered image to the window's size.
  void fit() {
    const VkExtent2D extent = swapchain->extent();
    const engine::RenderConfig wanted =
        render_config(config, static_cast<int>(extent.width), static_cast<int>(extent.height));
    const engine::RenderConfig& now = renderer.config();
    if (wanted.width != now.width || wanted.height != now.height) renderer.resize(wanted);
  }

  ViewConfig config;
  engine::Window* window;
  engine::Gpu gpu;
  engine::Renderer renderer;
  std::optional<engine::Swapchain> swapchain;
  std::optional<engine::UiOverlay> overlay;
};

CabinView::CabinView(const ViewConfig& config, engine::Window* window, engine::UiContext* ui)
    : state_(std::make_unique<State>(config, window, ui)) {}

CabinView::~CabinView() {
  state_->gpu.wait_idle();
}

void CabinView::set_model(const engine::Model& model) {
  state_->renderer.set_model(model);
}

bool CabinView::begin() {
  if (!state_->swapchain) return true;
  if (!state_->swapchain->acquire()) return false;
  state_->fit();
  return true;
}

void CabinView::draw(const engine::FrameScene& scene, const engine::EyePose& head, double field,
                     const VisibleRegion& region) {
  State& s = *state_;
  const engine::RenderConfig& now = s.renderer.config();
  const engine::Fov centre = fov_around(field * std::numbers::pi / 180.0, {now.width, now.height}, region);
  const std::vector<engine::View> views = views_of(s.config, head, centre);
  std::vector<engine::Overlay*> overlays;
  if (s.overlay) overlays.push_back(&*s.overlay);
  if (!s.swapchain) {
    s.renderer.draw(scene, views, overlays);
    return;
  }
  PresentFinish show(*s.swapchain, s.config.stereo);
  s.renderer.draw(scene, views, overlays, show);
  s.swapchain->present();
}

engine::Image CabinView::picture() {
  engine::Image left = state_->renderer.read_eye(0);
  return state_->config.stereo ? engine::side_by_side(left, state_->renderer.read_eye(1)) : left;
}

const engine::Renderer& CabinView::renderer() const {
  return state_->renderer;
}

const engine::GpuTraits& CabinView::gpu() const {
  return state_->gpu.traits();
}

std::uint64_t CabinView::validation_messages() const {
  return state_->gpu.validation_messages();
}

}  // namespace gearshift::cabin
