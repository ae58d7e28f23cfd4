#include "app/cabin/view/headset_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/cabin/view/cabin_view.h"
#include "app/cabin/view/desktop_mirror.h"
#include "app/cabin/view/ui_canvas.h"
#include "engine/render/renderer.h"

namespace gearshift::cabin {
namespace {

// [1] see RenderConfig::late_margin
constexpr float kLateMargin = 0.1f;
constexpr std::chrono::milliseconds kFrameTimeout(50);

engine::GpuConfig shared_with(engine::HeadsetRuntime& runtime) {
  engine::GpuConfig config = gpu_config(true);
  config.factory = &runtime;
  return config;
}

// The scaled size [px], rounded to an even number and limited to `largest`, the runtime's maximum.
int scaled(int recommended, int largest, double scale) {
  const int wanted = static_cast<int>(std::lround(0.5 * scale * recommended)) * 2;
  return std::clamp(wanted, 2, std::max(2, largest));
}

glm::ivec2 scaled_eye(const engine::HeadsetTraits& headset, double scale) {
  return {scaled(headset.eye.x, headset.largest.x, scale), scaled(headset.eye.y, headset.largest.y, scale)};
}

engine::RenderConfig two_eyes(const HeadsetViewConfig& config, const engine::HeadsetTraits& headset,
                              const engine::GpuTraits& gpu) {
  const glm::ivec2 eye = scaled_eye(headset, config.scale);
  engine::RenderConfig render;
  render.eyes = 2;
  render.width = eye.x;
  render.height = eye.y;
  render.samples = config.samples;
  if (render.samples == 0) render.samples = gpu.is_cpu || !gpu.four_samples ? 1 : 4;
  render.keep_depth = headset.depth;
  render.late_margin = kLateMargin;
  return render;
}

std::array<engine::View, 2> views_in(const engine::EyePose& cabin_from_room, const engine::HeadsetEyes& eyes,
                                     double near_plane) {
  std::array<engine::View, 2> views;
  for (std::size_t eye = 0; eye < 2; ++eye)
    views[eye] = engine::view_from(cabin_from_room * eyes.pose[eye], eyes.fov[eye], near_plane);
  return views;
}

}  // namespace

struct HeadsetView::State {
  State(const HeadsetViewConfig& wanted, std::unique_ptr<engine::HeadsetRuntime> found, engine::Window& shown_in,
        engine::UiContext& ui)
      : config(wanted),
        runtime(std::move(found)),
        gpu(shared_with(*runtime)),
        renderer(gpu, two_eyes(config, runtime->traits(), gpu.traits())),
        session(*runtime, gpu, {{renderer.config().width, renderer.config().height}, config.panel}),
        panel(gpu, ui),
        eyes(session.eyes()),
        at_origin(session.eyes()) {
    panel.fit({static_cast<std::uint32_t>(config.panel.x), static_cast<std::uint32_t>(config.panel.y)});
    make_mirror(shown_in, ui);
  }

  void make_mirror(engine::Window& window, engine::UiContext& ui);
  void show_mirror(const VisibleRegion& region);
  void draw_cabin(const engine::FrameScene& scene, const engine::EyePose& seat, const engine::HeadsetEyes& from,
                  engine::Renderer::Finish* finish);

  HeadsetViewConfig config;
  std::unique_ptr<engine::HeadsetRuntime> runtime;
  engine::Gpu gpu;
  engine::Renderer renderer;
  engine::HeadsetSession session;
  UiCanvas panel;
  std::optional<DesktopMirror> mirror;  // empty if the window has failed, which does not affect the headset
  engine::FrameTimes times;
  std::optional<engine::HeadsetFrame> frame;  // the current frame, from begin() until draw()
  bool is_shown = false;                      // true if the headset displays the newest frame
  std::string message;
  engine::HeadsetEyes eyes, shown_eyes, at_origin;
  bool drawn = false;  // true once there is an image to mirror
};

namespace {

// Ends a frame: copies the rendered images into the headset's images, and updates the eye poses as late as possible.
class HeadsetFinish final : public engine::Renderer::Finish {
 public:
  HeadsetFinish(engine::HeadsetSession& session, const engine::HeadsetFrame& frame,
                const engine::HeadsetSession::Images& images, engine::GpuImage& depth, UiCanvas& panel,
                const engine::EyePose& seat, double near_plane)
      : session_(session),
        frame_(frame),
        images_(images),
        depth_(depth),
        panel_(panel),
        seat_(seat),
        near_plane_(near_plane) {}

  void record(VkCommandBuffer commands, engine::GpuImage& colour, int slot) override {
    put(commands, colour, images_.colour);
    if (images_.depth) put(commands, depth_, images_.depth);
    if (images_.panel) {
      panel_.begin(commands);
      put(commands, panel_.draw(commands, slot), images_.panel);
    }
    session_.transition_for_release(commands);
  }

  std::span<const engine::View> late_views() override {
    eyes_ = session_.locate(frame_);
    views_ = views_in(seat_, eyes_, near_plane_);
    return views_;
  }

  const engine::HeadsetEyes& eyes() const { return eyes_; }

 private:
  static void put(VkCommandBuffer commands, const engine::GpuImage& from, engine::GpuImage* to) {
    engine::transition(commands, *to, engine::ImageUse::copy_to);
    engine::copy_image(commands, from, *to);
  }

  engine::HeadsetSession& session_;
  const engine::HeadsetFrame& frame_;
  engine::HeadsetSession::Images images_;
  engine::GpuImage& depth_;
  UiCanvas& panel_;
  engine::EyePose seat_;
  double near_plane_;
  engine::HeadsetEyes eyes_;
  std::array<engine::View, 2> views_;
};

}  // namespace

void HeadsetView::State::make_mirror(engine::Window& window, engine::UiContext& ui) {
  try {
    mirror.emplace(gpu, window, ui, config.panel);
  } catch (const engine::GpuLost&) {
    throw;
  } catch (const engine::GpuError& error) {
    message = error.what();
  }
}

void HeadsetView::State::show_mirror(const VisibleRegion& region) {
  try {
    mirror->show(renderer.colour(), region);
  } catch (const engine::GpuLost&) {
    throw;
  } catch (const engine::GpuError& error) {
    mirror.reset();
    message = error.what();
  }
}

void HeadsetView::State::draw_cabin(const engine::FrameScene& scene, const engine::EyePose& seat,
                                    const engine::HeadsetEyes& from, engine::Renderer::Finish* finish) {
  const std::array<engine::View, 2> views = views_in(seat, from, config.near_plane);
  if (finish != nullptr)
    renderer.draw(scene, views, {}, *finish);
  else
    renderer.draw(scene, views);
  drawn = true;
}

HeadsetView::HeadsetView(const HeadsetViewConfig& config, std::unique_ptr<engine::HeadsetRuntime> runtime,
                         engine::Window& window, engine::UiContext& ui)
    : state_(std::make_unique<State>(config, std::move(runtime), window, ui)) {}

HeadsetView::~HeadsetView() {
  state_->gpu.wait_idle();
}

void HeadsetView::set_model(const engine::Model& model) {
  state_->renderer.set_model(model);
}

bool HeadsetView::begin() {
  State& s = *state_;
  s.frame.reset();
  s.session.poll();
  if (!s.session.is_running()) {
    s.times.pause();
    s.is_shown = false;
    return false;
  }
  s.frame = s.session.wait(kFrameTimeout);
  if (!s.frame) return true;
  s.is_shown = s.frame->should_render;
  s.eyes = s.session.locate(*s.frame);
  return true;
}

bool HeadsetView::has_begun() const noexcept {
  return state_->frame.has_value();
}

bool HeadsetView::is_waiting() const noexcept {
  return state_->session.is_waiting();
}

void HeadsetView::release_window() {
  state_->mirror.reset();
}

bool HeadsetView::is_shown() const noexcept {
  return state_->is_shown;
}

const engine::HeadsetEyes& HeadsetView::eyes() const noexcept {
  return state_->eyes;
}

std::array<engine::HeadsetHand, 2> HeadsetView::hands() {
  return state_->frame ? state_->session.hands(*state_->frame) : std::array<engine::HeadsetHand, 2>{};
}

std::optional<engine::SpaceChange> HeadsetView::take_due_space_change() {
  return state_->frame ? state_->session.take_due_space_change(*state_->frame) : std::nullopt;
}

void HeadsetView::draw(const engine::FrameScene& scene, const engine::EyePose& cabin_from_room,
                       const engine::HeadsetPanel* panel, const VisibleRegion& region) {
  State& s = *state_;
  const bool mirror_is_due = s.mirror && s.mirror->is_due();
  engine::HeadsetSession::Images images;
  if (s.frame && s.frame->should_render) images = s.session.acquire_images(panel != nullptr);
  if (images.colour) {
    HeadsetFinish finish(s.session, *s.frame, images, s.renderer.depth(), s.panel, cabin_from_room,
                         s.config.near_plane);
    s.draw_cabin(scene, cabin_from_room, s.eyes, &finish);
    s.eyes = s.shown_eyes = finish.eyes();
  } else if (mirror_is_due) {
    s.draw_cabin(scene, cabin_from_room, is_shown() ? s.eyes : s.at_origin, nullptr);
  }
  if (s.frame) {
    // If no image could be acquired, the headset shows the previous image again, with the eye poses from which that
    // image was drawn.
    const bool shows = s.frame->should_render;
    s.session.end(*s.frame, shows ? &s.shown_eyes : nullptr, s.config.near_plane, shows ? panel : nullptr);
    s.times.add(*s.frame, s.session.now_ns(), images.colour ? s.renderer.times().all : 0.0);
    s.frame.reset();
  }
  if (mirror_is_due && s.drawn) s.show_mirror(region);
}

const engine::HeadsetTraits& HeadsetView::headset() const noexcept {
  return state_->runtime->traits();
}

engine::HeadsetState HeadsetView::state() const noexcept {
  return state_->session.state();
}

bool HeadsetView::is_room_persistent() const noexcept {
  return state_->session.is_stage();
}

const engine::HeadsetTiming& HeadsetView::timing() const noexcept {
  return state_->times.timing();
}

glm::ivec2 HeadsetView::eye_size() const noexcept {
  return {state_->renderer.config().width, state_->renderer.config().height};
}

std::string HeadsetView::take_message() {
  return std::exchange(state_->message, {});
}

std::uint64_t HeadsetView::validation_messages() const {
  return state_->gpu.validation_messages();
}

}  // namespace gearshift::cabin
