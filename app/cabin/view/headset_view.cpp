#include "app/cabin/view/headset_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/cabin/view/cabin_view.h"
#include "app/cabin/view/desktop_mirror.h"
#include "app/cabin/view/ui_canvas.h"
#include "engine/render/renderer.h"
#include "engine/xr/headset_thread.h"

namespace gearshift::cabin {
namespace {

using Clock = std::chrono::steady_clock;

// [1] see RenderConfig::late_margin
constexpr float kLateMargin = 0.1f;
constexpr std::chrono::milliseconds kCallTimeout(50);    // longest wait for the runtime
constexpr std::chrono::milliseconds kHeldTimeout(5);     // the same while it has already been waited for in vain
constexpr std::chrono::milliseconds kQueueTimeout(400);  // longest wait for the queue at the end
constexpr std::chrono::milliseconds kCloseTimeout(600);  // longest wait for the end of the session
constexpr std::chrono::seconds kLostAfter(5);            // see HeadsetView::begin()

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

// The objects of the runtime and the GPU that belong to a headset. Only its HeadsetThread makes and destroys them.
struct HeadsetParts {
  explicit HeadsetParts(const HeadsetViewConfig& config)
      : gpu(shared_with(runtime)),
        renderer(gpu, two_eyes(config, runtime.traits(), gpu.traits())),
        session(runtime, gpu, {{renderer.config().width, renderer.config().height}, config.panel}) {}

  engine::HeadsetRuntime runtime;
  engine::Gpu gpu;
  engine::Renderer renderer;
  engine::HeadsetSession session;
};

// Results of the headset's thread. The thread writes them during a call; the view reads them after the call.
struct Handover {
  std::unique_ptr<HeadsetParts> parts;
  engine::HeadsetState state = engine::HeadsetState::idle;
  bool is_running = false, is_stage = false;
  std::optional<bool> is_present;
  std::optional<engine::HeadsetFrame> frame;
  engine::HeadsetEyes eyes, late_eyes;
  std::array<engine::HeadsetHand, 2> hands{};
  std::vector<engine::SpaceChange> changes;
  engine::HeadsetSession::Images images;
  std::int64_t ended_ns = 0;
};

// Destroys the parts when the thread ends, on that thread.
struct OpeningHeadset::State {
  explicit State(const HeadsetViewConfig& wanted) : config(wanted) {
    opening = thread.start([config = wanted, handover = handover] {
      handover->parts = std::make_unique<HeadsetParts>(config);
      handover->eyes = handover->parts->session.eyes();
      handover->is_stage = handover->parts->session.is_stage();
    });
  }
  ~State() {
    std::future<void> closed = thread.start([handover = handover] { handover->parts.reset(); });
    if (!opening.valid() && !hangs) closed.wait_for(kCloseTimeout);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  HeadsetViewConfig config;
  std::shared_ptr<Handover> handover = std::make_shared<Handover>();
  engine::HeadsetThread thread;
  std::future<void> opening;  // valid until it is open, or has failed
  bool hangs = false;         // a call is in progress for longer than it should
};

OpeningHeadset::OpeningHeadset(const HeadsetViewConfig& config) : state_(std::make_unique<State>(config)) {}
OpeningHeadset::~OpeningHeadset() = default;

bool OpeningHeadset::is_open() {
  if (!state_->opening.valid()) return true;
  if (state_->opening.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  state_->opening.get();
  return true;
}

struct HeadsetView::State {
  State(std::unique_ptr<OpeningHeadset> opened, engine::Window& shown_in, engine::UiContext& ui)
      : headset(std::move(opened)),
        config(headset->state_->config),
        at(*headset->state_->handover),
        parts(*at.parts),
        panel(parts.gpu, ui),
        eyes(at.eyes),
        at_origin(at.eyes) {
    panel.fit({static_cast<std::uint32_t>(config.panel.x), static_cast<std::uint32_t>(config.panel.y)});
    make_mirror(shown_in, ui);
  }
  ~State() {
    // A runtime that hangs in a call may keep the queue locked. It then submits nothing more, either.
    std::unique_lock lock(parts.gpu.queue_mutex(), std::defer_lock);
    const Clock::time_point end = Clock::now() + kQueueTimeout;
    while (!lock.try_lock() && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    parts.gpu.wait_idle();
    headset->state_->hangs = is_held;
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void make_mirror(engine::Window& window, engine::UiContext& ui);
  void show_mirror(const VisibleRegion& region);
  void draw_cabin(const engine::FrameScene& scene, const engine::EyePose& seat, const engine::HeadsetEyes& from,
                  engine::Renderer::Finish* finish);

  // The calls that the headset's thread makes in a frame, in this order.
  enum class Step { none, begin, acquire, locate, end };
  template <class Work>
  void start(Step next, Work work);
  bool is_done(Step wanted);  // waits; false: the runtime has not returned in time, or another step is in progress
  void throw_if_lost() const;
  bool take_begun();
  void acquire(bool with_panel);
  engine::HeadsetEyes locate();
  void end(const engine::HeadsetEyes* drawn_from, const engine::HeadsetPanel* hung);
  bool finish_end();
  void draw_frame(const engine::FrameScene& scene, const engine::EyePose& seat, const engine::HeadsetPanel* hung);
  void draw_mirror(const engine::FrameScene& scene, const engine::EyePose& seat, const VisibleRegion& region);

  std::unique_ptr<OpeningHeadset> headset;
  HeadsetViewConfig config;
  Handover& at;
  HeadsetParts& parts;
  UiCanvas panel;
  std::optional<DesktopMirror> mirror;  // empty if the window has failed, which does not affect the headset
  engine::FrameTimes times;
  Step step = Step::none;  // in progress, or just done
  std::future<void> call;  // valid while `step` is in progress
  Clock::time_point called_at;
  bool is_held = false;      // see HeadsetView::is_held()
  bool is_acquired = false;  // images were acquired for `frame`
  engine::HeadsetState state = engine::HeadsetState::idle;
  std::optional<bool> is_present;
  bool is_running = false;
  std::optional<engine::HeadsetFrame> frame;  // the current frame, from begin() until draw()
  engine::HeadsetFrame ended;                 // the newest frame that was submitted
  bool is_shown = false;                      // true if the headset displays the newest frame
  double gpu_ms = 0.0;
  std::string message;
  engine::HeadsetEyes eyes, shown_eyes, at_origin;
  bool drawn = false;        // true once there is an image to mirror
  bool drawn_frame = false;  // the image is that of the newest draw()
};

namespace {

// Ends a frame: copies the rendered images into the headset's images, and updates the eye poses as late as possible.
class HeadsetFinish final : public engine::Renderer::Finish {
 public:
  // `locate`: returns the eyes' newest poses.
  HeadsetFinish(engine::HeadsetSession& session, std::function<engine::HeadsetEyes()> locate,
                const engine::HeadsetSession::Images& images, engine::GpuImage& depth, UiCanvas& panel,
                const engine::EyePose& seat, double near_plane)
      : session_(session),
        locate_(std::move(locate)),
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
    eyes_ = locate_();
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
  std::function<engine::HeadsetEyes()> locate_;
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
    mirror.emplace(parts.gpu, window, ui, config.panel);
  } catch (const engine::GpuLost&) {
    throw;
  } catch (const engine::GpuError& error) {
    message = error.what();
  }
}

void HeadsetView::State::show_mirror(const VisibleRegion& region) {
  try {
    mirror->show(parts.renderer.colour(), region);
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
    parts.renderer.draw(scene, views, {}, *finish);
  else
    parts.renderer.draw(scene, views);
  drawn = true;
}

template <class Work>
void HeadsetView::State::start(Step next, Work work) {
  step = next;
  called_at = Clock::now();
  call = headset->state_->thread.start([work, shared = headset->state_->handover] { work(*shared, *shared->parts); });
}

bool HeadsetView::State::is_done(Step wanted) {
  if (step != wanted) return false;
  if (!call.valid()) return true;
  if (call.wait_for(is_held ? kHeldTimeout : kCallTimeout) != std::future_status::ready) {
    is_held = true;
    return false;
  }
  is_held = false;
  call.get();
  return true;
}

// A frame may be held back for ever, for example while nobody wears the headset.
void HeadsetView::State::throw_if_lost() const {
  if (Clock::now() - called_at < kLostAfter || parts.session.is_waiting()) return;
  throw engine::HeadsetLost(
      fmt::format("{} has not answered for {} s", parts.runtime.traits().runtime, kLostAfter.count()));
}

// Begins a frame if the session is running. Returns false while the runtime has not begun it.
bool HeadsetView::State::take_begun() {
  if (step == Step::none) {
    start(Step::begin, [](Handover& to, HeadsetParts& of) {
      to.frame.reset();
      of.session.poll();
      to.state = of.session.state();
      to.is_running = of.session.is_running();
      to.is_present = of.session.is_present();
      if (!to.is_running) return;
      to.frame = of.session.wait();
      to.eyes = of.session.locate(*to.frame);
      while (const std::optional<engine::SpaceChange> change = of.session.take_due_space_change(*to.frame))
        to.changes.push_back(*change);
      to.hands = of.session.hands(*to.frame);
    });
  }
  if (!is_done(Step::begin)) return false;
  step = Step::none;
  state = at.state;
  is_present = at.is_present;
  is_running = at.is_running;
  frame = at.frame;
  if (frame) {
    is_acquired = false;
    is_shown = frame->should_render;
    eyes = at.eyes;
  }
  return true;
}

void HeadsetView::State::acquire(bool with_panel) {
  if (step == Step::none)
    start(Step::acquire,
          [with_panel](Handover& to, HeadsetParts& of) { to.images = of.session.acquire_images(with_panel); });
  is_acquired = is_done(Step::acquire);
}

// The newest poses of the eyes; those of the frame's begin if the runtime does not return in time.
engine::HeadsetEyes HeadsetView::State::locate() {
  start(Step::locate, [frame = *frame](Handover& to, HeadsetParts& of) { to.late_eyes = of.session.locate(frame); });
  return is_done(Step::locate) ? at.late_eyes : eyes;
}

// `drawn_from`: null if nothing is to be shown.
void HeadsetView::State::end(const engine::HeadsetEyes* drawn_from, const engine::HeadsetPanel* hung) {
  const auto copy = [](const auto* value) { return value ? std::optional(*value) : std::nullopt; };
  start(Step::end, [frame = *frame, from = copy(drawn_from), panel = copy(hung), near_plane = config.near_plane](
                       Handover& to, HeadsetParts& of) {
    of.session.end(frame, from ? &*from : nullptr, near_plane, panel ? &*panel : nullptr);
    to.ended_ns = of.session.now_ns();
  });
  ended = *frame;
  frame.reset();
}

// Returns false while the runtime has not returned from the frame's end.
bool HeadsetView::State::finish_end() {
  if (!is_done(Step::end)) return false;
  step = Step::none;
  times.add(ended, at.ended_ns, gpu_ms);
  return true;
}

void HeadsetView::State::draw_frame(const engine::FrameScene& scene, const engine::EyePose& seat,
                                    const engine::HeadsetPanel* hung) {
  const bool shows = frame->should_render;
  drawn_frame = is_acquired && at.images.colour != nullptr;
  if (drawn_frame) {
    HeadsetFinish finish(
        parts.session, [this] { return locate(); }, at.images, parts.renderer.depth(), panel, seat, config.near_plane);
    const std::lock_guard lock(parts.gpu.queue_mutex());
    draw_cabin(scene, seat, eyes, &finish);
    eyes = shown_eyes = finish.eyes();
  }
  gpu_ms = drawn_frame ? parts.renderer.times().all : 0.0;
  // If no image could be acquired, the headset shows the previous image again, with the eye poses from which that
  // image was drawn.
  end(shows ? &shown_eyes : nullptr, shows ? hung : nullptr);
  (void)finish_end();
}

void HeadsetView::State::draw_mirror(const engine::FrameScene& scene, const engine::EyePose& seat,
                                     const VisibleRegion& region) {
  if (!mirror || !mirror->is_due()) return;
  const std::unique_lock lock(parts.gpu.queue_mutex(), std::try_to_lock);
  if (!lock) return;  // the runtime may be using the queue
  if (!drawn_frame) draw_cabin(scene, seat, is_shown ? eyes : at_origin, nullptr);
  if (drawn) show_mirror(region);
}

HeadsetView::HeadsetView(std::unique_ptr<OpeningHeadset> opened, engine::Window& window, engine::UiContext& ui)
    : state_(std::make_unique<State>(std::move(opened), window, ui)) {}

HeadsetView::~HeadsetView() = default;

bool HeadsetView::set_model(const engine::Model& model) {
  const std::unique_lock lock(state_->parts.gpu.queue_mutex(), std::try_to_lock);
  if (lock) state_->parts.renderer.set_model(model);
  return lock.owns_lock();
}

bool HeadsetView::begin() {
  State& s = *state_;
  if (s.step == State::Step::acquire) {  // of an earlier frame
    if (s.is_done(State::Step::acquire))
      s.is_acquired = true;
    else
      s.throw_if_lost();
    return true;
  }
  if (s.step == State::Step::end && !s.finish_end()) {
    s.throw_if_lost();
    return true;
  }
  if (!s.take_begun()) {
    s.throw_if_lost();
    return s.is_running;
  }
  if (s.is_running) return true;
  s.times.pause();
  s.is_shown = false;
  return false;
}

bool HeadsetView::has_begun() const noexcept {
  return state_->frame.has_value() && !state_->call.valid();
}

bool HeadsetView::is_held() const noexcept {
  return state_->is_held;
}

bool HeadsetView::is_shown() const noexcept {
  return state_->is_shown;
}

const engine::HeadsetEyes& HeadsetView::eyes() const noexcept {
  return state_->eyes;
}

const std::array<engine::HeadsetHand, 2>& HeadsetView::hands() const noexcept {
  return state_->at.hands;
}

std::optional<engine::SpaceChange> HeadsetView::take_due_space_change() {
  std::vector<engine::SpaceChange>& changes = state_->at.changes;
  if (changes.empty()) return std::nullopt;
  const engine::SpaceChange first = changes.front();
  changes.erase(changes.begin());
  return first;
}

void HeadsetView::draw(const engine::FrameScene& scene, const engine::EyePose& cabin_from_room,
                       const engine::HeadsetPanel* panel, const VisibleRegion& region) {
  State& s = *state_;
  const bool has_frame = has_begun();
  s.drawn_frame = false;
  if (has_frame && s.frame->should_render && !s.is_acquired) s.acquire(panel != nullptr);
  if (has_begun()) s.draw_frame(scene, cabin_from_room, panel);
  s.draw_mirror(scene, cabin_from_room, region);
}

const engine::HeadsetTraits& HeadsetView::headset() const noexcept {
  return state_->parts.runtime.traits();
}

engine::HeadsetState HeadsetView::state() const noexcept {
  return state_->state;
}

std::optional<bool> HeadsetView::is_present() const noexcept {
  return state_->is_running ? state_->is_present : false;
}

bool HeadsetView::is_room_persistent() const noexcept {
  return state_->at.is_stage;
}

const engine::HeadsetTiming& HeadsetView::timing() const noexcept {
  return state_->times.timing();
}

glm::ivec2 HeadsetView::eye_size() const noexcept {
  return {state_->parts.renderer.config().width, state_->parts.renderer.config().height};
}

std::string HeadsetView::take_message() {
  return std::exchange(state_->message, {});
}

std::uint64_t HeadsetView::validation_messages() const {
  return state_->parts.gpu.validation_messages();
}

}  // namespace gearshift::cabin
