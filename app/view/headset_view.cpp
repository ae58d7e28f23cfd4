#include "app/view/headset_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/view/cabin_view.h"
#include "app/view/desktop_mirror.h"
#include "app/view/ui_canvas.h"
#include "engine/render/renderer.h"

namespace gearshift {
namespace {

// [1] of the tangents: see RenderConfig::late_margin
constexpr float kLateMargin = 0.1f;
constexpr std::chrono::milliseconds kPatience(50);  // for a frame

GpuConfig shared_with(HeadsetRuntime& runtime) {
  GpuConfig config = gpu_config(true);
  config.maker = &runtime;
  return config;
}

// Even, and no more than it takes.
int scaled(int recommended, int largest, double scale) {
  const int wanted = static_cast<int>(std::lround(0.5 * scale * recommended)) * 2;
  return std::clamp(wanted, 2, std::max(2, largest));
}

glm::ivec2 scaled_eye(const HeadsetTraits& headset, double scale) {
  return {scaled(headset.eye.x, headset.largest.x, scale), scaled(headset.eye.y, headset.largest.y, scale)};
}

RenderConfig two_eyes(const HeadsetViewConfig& config, const HeadsetTraits& headset, const GpuTraits& gpu) {
  const glm::ivec2 eye = scaled_eye(headset, config.scale);
  RenderConfig render;
  render.eyes = 2;
  render.width = eye.x;
  render.height = eye.y;
  render.samples = config.samples;
  if (render.samples == 0) render.samples = gpu.is_cpu || !gpu.four_samples ? 1 : 4;
  render.keep_depth = headset.depth;
  render.late_margin = kLateMargin;
  return render;
}

std::array<View, 2> views_in(const EyePose& cabin_from_room, const HeadsetEyes& eyes, double near_plane) {
  std::array<View, 2> views;
  for (std::size_t eye = 0; eye < 2; ++eye)
    views[eye] = view_from(cabin_from_room * eyes.pose[eye], eyes.fov[eye], near_plane);
  return views;
}

}  // namespace

struct HeadsetView::State {
  State(const HeadsetViewConfig& wanted, std::unique_ptr<HeadsetRuntime> found, Window& shown_in, UiContext& ui)
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

  void make_mirror(Window& window, UiContext& ui);
  void show_instructor(const SeenPart& seen);
  void draw_cabin(const FrameScene& scene, const EyePose& seat, const HeadsetEyes& from, Renderer::Finish* finish);

  HeadsetViewConfig config;
  std::unique_ptr<HeadsetRuntime> runtime;
  Gpu gpu;
  Renderer renderer;
  HeadsetSession session;
  UiCanvas panel;
  std::optional<DesktopMirror> mirror;  // none: the window cannot show it, and the learner goes on
  FrameTimes times;
  std::optional<HeadsetFrame> frame;  // that has begun
  bool is_shown = false;              // of the last one
  std::string news;
  HeadsetEyes eyes, shown_eyes, at_origin;
  bool drawn = false;  // there is a picture to be mirrored
};

namespace {

// Copies what was drawn into the headset's images, and moves the eyes to where they are when nothing is left to be done.
class ToHeadset final : public Renderer::Finish {
 public:
  ToHeadset(HeadsetSession& session, const HeadsetFrame& frame, const HeadsetSession::Images& images, GpuImage& depth,
            UiCanvas& panel, const EyePose& seat, double near_plane)
      : session_(session),
        frame_(frame),
        images_(images),
        depth_(depth),
        panel_(panel),
        seat_(seat),
        near_plane_(near_plane) {}

  void record(VkCommandBuffer commands, GpuImage& colour, int slot) override {
    put(commands, colour, images_.colour);
    if (images_.depth) put(commands, depth_, images_.depth);
    if (images_.panel) {
      panel_.begin(commands);
      put(commands, panel_.draw(commands, slot), images_.panel);
    }
    session_.ready_to_give(commands);
  }

  std::span<const View> late_views() override {
    eyes_ = session_.locate(frame_);
    views_ = views_in(seat_, eyes_, near_plane_);
    return views_;
  }

  const HeadsetEyes& eyes() const { return eyes_; }

 private:
  static void put(VkCommandBuffer commands, const GpuImage& from, GpuImage* to) {
    transition(commands, *to, ImageUse::copy_to);
    copy_whole(commands, from, *to);
  }

  HeadsetSession& session_;
  const HeadsetFrame& frame_;
  HeadsetSession::Images images_;
  GpuImage& depth_;
  UiCanvas& panel_;
  EyePose seat_;
  double near_plane_;
  HeadsetEyes eyes_;
  std::array<View, 2> views_;
};

}  // namespace

void HeadsetView::State::make_mirror(Window& window, UiContext& ui) {
  try {
    mirror.emplace(gpu, window, ui, config.panel);
  } catch (const GpuLost&) {
    throw;
  } catch (const GpuError& error) {
    news = error.what();
  }
}

void HeadsetView::State::show_instructor(const SeenPart& seen) {
  try {
    mirror->show(renderer.colour(), seen);
  } catch (const GpuLost&) {
    throw;
  } catch (const GpuError& error) {
    mirror.reset();
    news = error.what();
  }
}

void HeadsetView::State::draw_cabin(const FrameScene& scene, const EyePose& seat, const HeadsetEyes& from,
                                    Renderer::Finish* finish) {
  const std::array<View, 2> views = views_in(seat, from, config.near_plane);
  if (finish != nullptr)
    renderer.draw(scene, views, {}, *finish);
  else
    renderer.draw(scene, views);
  drawn = true;
}

HeadsetView::HeadsetView(const HeadsetViewConfig& config, std::unique_ptr<HeadsetRuntime> runtime, Window& window,
                         UiContext& ui)
    : state_(std::make_unique<State>(config, std::move(runtime), window, ui)) {}

HeadsetView::~HeadsetView() {
  state_->gpu.wait_idle();
}

void HeadsetView::set_model(const Model& model) {
  state_->renderer.set_model(model);
}

bool HeadsetView::begin() {
  State& s = *state_;
  s.frame.reset();
  s.session.poll();
  if (!s.session.runs()) {
    s.times.pause();
    s.is_shown = false;
    return false;
  }
  s.frame = s.session.wait(kPatience);
  if (!s.frame) return true;
  s.is_shown = s.frame->is_shown;
  s.eyes = s.session.locate(*s.frame);
  return true;
}

bool HeadsetView::has_begun() const noexcept {
  return state_->frame.has_value();
}

bool HeadsetView::awaits() const noexcept {
  return state_->session.awaits();
}

void HeadsetView::leave_window() {
  state_->mirror.reset();
}

bool HeadsetView::is_shown() const noexcept {
  return state_->is_shown;
}

const HeadsetEyes& HeadsetView::eyes() const noexcept {
  return state_->eyes;
}

std::array<HeadsetHand, 2> HeadsetView::hands() {
  return state_->frame ? state_->session.hands(*state_->frame) : std::array<HeadsetHand, 2>{};
}

std::optional<SpaceChange> HeadsetView::take_change() {
  return state_->frame ? state_->session.take_change(*state_->frame) : std::nullopt;
}

void HeadsetView::draw(const FrameScene& scene, const EyePose& cabin_from_room, const HeadsetPanel* panel,
                       const SeenPart& seen) {
  State& s = *state_;
  const bool instructor_sees = s.mirror && s.mirror->is_due();
  HeadsetSession::Images images;
  if (s.frame && s.frame->is_shown) images = s.session.take_images(panel != nullptr);
  if (images.colour) {
    ToHeadset finish(s.session, *s.frame, images, s.renderer.depth(), s.panel, cabin_from_room, s.config.near_plane);
    s.draw_cabin(scene, cabin_from_room, s.eyes, &finish);
    s.eyes = s.shown_eyes = finish.eyes();
  } else if (instructor_sees) {
    s.draw_cabin(scene, cabin_from_room, is_shown() ? s.eyes : s.at_origin, nullptr);
  }
  if (s.frame) {
    // Without an image for now the last one is shown again, from where it was drawn.
    const bool shows = s.frame->is_shown;
    s.session.end(*s.frame, shows ? &s.shown_eyes : nullptr, s.config.near_plane, shows ? panel : nullptr);
    s.times.take(*s.frame, s.session.now_ns(), images.colour ? s.renderer.times().all : 0.0);
    s.frame.reset();
  }
  if (instructor_sees && s.drawn) s.show_instructor(seen);
}

const HeadsetTraits& HeadsetView::headset() const noexcept {
  return state_->runtime->traits();
}

HeadsetState HeadsetView::state() const noexcept {
  return state_->session.state();
}

bool HeadsetView::keeps_room() const noexcept {
  return state_->session.is_stage();
}

const HeadsetTiming& HeadsetView::timing() const noexcept {
  return state_->times.timing();
}

glm::ivec2 HeadsetView::eye_size() const noexcept {
  return {state_->renderer.config().width, state_->renderer.config().height};
}

std::string HeadsetView::take_news() {
  return std::exchange(state_->news, {});
}

std::uint64_t HeadsetView::validation_messages() const {
  return state_->gpu.validation_messages();
}

}  // namespace gearshift
