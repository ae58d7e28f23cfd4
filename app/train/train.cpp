#include "app/train/train.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "app/devices/stop_signals.h"
#include "app/output_folder.h"
#include "app/print_out.h"
#include "app/train/gear_lines.h"
#include "app/train/lesson_lines.h"
#include "app/train/look_around.h"
#include "app/train/pointing_hand.h"
#include "app/train/shared_input.h"
#include "app/train/ui_scale.h"
#include "app/view/desktop_mirror.h"
#include "engine/gpu/instance.h"
#include "engine/ui/ui.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kOffscreenRate = 30.0;         // [1/s] frames of simulated time
constexpr int kSettling = 3;                    // frames of a panel until each part has its height
constexpr double kFastestFrame = 1.0 / 144;     // [s] where the display does not hold the frames back
constexpr double kLongestFrame = 0.25;          // [s] a frame that took longer moves car and pedals on by this
constexpr std::chrono::seconds kViewRetry{1};   // between attempts to make a picture anew
constexpr std::chrono::seconds kViewHolds{10};  // a picture that held so long is news when it is lost

// What the panel leaves of a picture of that size.
SeenPart seen_beside(const Panel& panel, glm::dvec2 size) {
  const ControlRect middle = panel.middle();
  return {middle.min / size, middle.max / size};
}

// The same with what lies over the cabin for the learner.
SeenPart card_in(const Panel& panel, glm::dvec2 size) {
  const ControlRect between = panel.between();
  return {between.min / size, between.max / size};
}

std::vector<KeyHint> key_hints(const Bindings& bindings) {
  std::vector<KeyHint> hints;
  for (const DrivingKey& key : driving_keys(bindings)) hints.push_back({std::string(key.does), key.key});
  return hints;
}

void tell_unkept(const std::string& problem) {
  if (!problem.empty()) print_problem("{}", printable(problem));
}

// One frame after another in a window: poll, lead, read, panel, place, show.
class WindowTrainer {
 public:
  explicit WindowTrainer(const TrainSetup& setup)
      : setup_(setup),
        window_(setup.view.width, setup.view.height, "gearshift"),
        headset_(setup.headset ? std::make_unique<WornHeadset>(*setup.headset, window_, ui_) : nullptr),
        view_(first_view()),  // before the lever runs
        session_(setup.choice),
        shared_(setup.bindings),
        input_(shared_.driver()),
        look_(setup.choice.camera, setup.choice.drive),
        last_frame_(Clock::now()) {
    panel_.set_visible(setup.panel);
    session_.set_keys(key_hints(setup.bindings));
    if (!setup.replay.empty()) session_.look_at(setup.replay, setup.shift, setup.from);
  }

  bool done() const {
    const bool left = headset_ && headset_->wants_exit();
    return quit_ || left || window_.wants_close() || StopSignals::asked();
  }

  // The lesson is left, what was being recorded is closed, and what came of both is told. Returns the exit code.
  int finish() {
    tell_unkept(session_.settle());
    print_lines(lines_.news(session_.coach().view()), session_.lever_time());
    if (!session_.take_new_trainer()) health_ = session_.trainer().health();  // since the newest frame, too
    print_health(health_);
    if (!session_.recording()) return 0;
    const bool whole = session_.end_recording();
    if (whole) print_out("{}\n", session_.message());
    if (!whole) print_problem("{}", session_.message());
    return whole ? 0 : 1;
  }

  void frame() {
    pace();
    poll();
    act();
    lead();
    session_.advance(seconds_);
    print_events(session_.events(), !session_.trainer().device().measures_hand_force);
    print_lines(lines_.news(session_.coach().view()), session_.lever_time());
    tell_message();
    draw_panel();
    look();
    session_.place();
    show();
  }

 private:
  // [px] Of the picture that the panel is drawn into.
  glm::ivec2 panel_size() const {
    return wears() ? setup_.headset->view.panel : eye_size(setup_.view, window_.framebuffer());
  }

  glm::dvec2 mouse_at_panel(glm::dvec2 mouse) const {
    const glm::ivec2 window = window_.framebuffer();
    return wears() ? in_mirrored_panel(mouse, panel_size(), window) : in_eye(setup_.view, mouse, window);
  }

  bool wears() const { return headset_ && headset_->is_open(); }
  bool is_worn() const { return headset_ && headset_->is_worn(); }  // now

  std::unique_ptr<CabinView> desktop_view() { return std::make_unique<CabinView>(setup_.view, &window_, &ui_); }

  std::unique_ptr<CabinView> first_view() {
    if (headset_ && headset_->is_found() && headset_->open()) return nullptr;
    return desktop_view();
  }

  // A headset where one is found, else the window alone: the window shows one of them.
  void find_view() {
    if (headset_ && headset_->is_found()) {
      view_.reset();
      (void)headset_->open();
      fresh_view_ = true;
    }
    if (headset_) tell_news(headset_->take_news());
    if (!wears() && !view_) make_desktop_view();
  }

  // At once, but where the device is lost again and again.
  void make_desktop_view() {
    const Clock::time_point now = Clock::now();
    if (now < next_view_) return;
    next_view_ = now + kViewRetry;
    try {
      view_ = desktop_view();
      fresh_view_ = true;
    } catch (const GpuLost& lost) {
      lose_view(lost);
    }
  }

  void lose_view(const GpuLost& lost) {
    view_.reset();
    const Clock::time_point now = Clock::now();
    if (now > view_quiet_until_) print_problem("{}; the picture is made anew, the lever goes on", lost.what());
    view_quiet_until_ = now + kViewHolds;
  }

  // What the panel says, on stdout for who does not see it.
  void tell_message() {
    if (session_.message() == told_message_) return;
    told_message_ = session_.message();
    if (!told_message_.empty()) print_lines({printable(told_message_)}, session_.lever_time());
  }

  void tell_news(const std::string& news) {
    if (news.empty()) return;
    print_problem("{}", printable(news));
    session_.tell(news);
  }

  // The headset's display sets the pace while somebody wears it. Else sleeps before input is read, not after: what is seen
  // is as new as can be.
  void pace() {
    find_view();
    const auto next =
        last_frame_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kFastestFrame));
    if (!wears() || !headset_->begin(session_.stage())) std::this_thread::sleep_until(next);
    const Clock::time_point now = Clock::now();
    const double passed = std::chrono::duration<double>(now - last_frame_).count();
    session_.set_frame_ms(1e3 * passed);
    seconds_ = std::min(passed, kLongestFrame);
    last_frame_ = now;
  }

  void poll() {
    input_.feel(session_.trainer().snapshot().lever);
    session_.set_mouse_leads(input_.mouse_leads());
    const WindowInput& polled = window_.poll();
    if (wears() && headset_->take_opened()) panel_.set_visible(true);
    pointer_ = pointer_at_panel();
    pointing_.follow(polled, input_.mouse_leads(), pointer_, panel_size(), seconds_);
    shared_.update(polled, seconds_, mouse_at_panel(polled.mouse), panel_, ui_, pointing_.pointer());
    if (setup_.choice.stick) input_.free_mouse();
    look_.turn(shared_.turned());
  }

  // Of a hand: where nothing of the panel stands it points through it.
  std::optional<WornHeadset::Pointer> pointer_at_panel() const {
    if (!wears() || !headset_->pointer()) return std::nullopt;
    const std::optional<WornHeadset::Pointer>& pointer = headset_->pointer();
    const bool is_there = panel_.covers(pointer->hit.at * glm::dvec2(panel_size()));
    return is_there ? pointer : std::nullopt;
  }

  // Who wears a headset looks with the head alone: no camera is moved for him.
  void look() {
    const bool points = is_worn() && (pointer_ || !headset_->pointer());
    session_.set_pointer(points ? headset_->beam() : std::nullopt);
    if (is_worn()) {
      session_.set_ears(headset_->head());
      session_.set_seen_offset(headset_->touch_error());
      return;
    }
    session_.set_seen_offset(0.0);
    if (look_.follow_shift(session_.replays_shift())) session_.look_from(look_.place());
    session_.set_ears(look_.pose());
  }

  // Another gate, hand or device: the person's hand is where the lever is.
  void lead() {
    if (session_.take_new_trainer()) {
      print_health(std::exchange(health_, std::nullopt));
      Trainer& trainer = session_.trainer();
      input_.set_reach(hand_reach(trainer.gate(), trainer.device()));
      input_.recentre(trainer.snapshot().lever);
      session_.set_foot_pace(foot_pace());
    }
    if (const std::optional<CarSwitches> car = session_.take_switches()) input_.set_car(car->ignition, car->hand_brake);
    session_.lead(input_.hand(), input_.controls(), input_.foot_keys());
  }

  FootPace foot_pace() const {
    FootPace pace;
    pace.pedal_time = setup_.bindings.pedal_time;
    pace.slip_time = setup_.bindings.clutch_slip_time;
    const std::optional<CarSpec>& car = session_.car_spec();
    if (!car) return pace;
    pace.clutch_closed = car->clutch.closed;
    pace.clutch_bite = car->clutch.bite;
    return pace;
  }

  void act() {
    for (const Action action : input_.pressed()) act(action);
    window_.capture_mouse(input_.mouse_leads());
  }

  void act(Action action) {
    PanelRequests requests;
    switch (action) {
      case Action::stop:
        requests.stop = true;
        break;
      case Action::arm:
        requests.arm = true;
        go_on(requests.lesson);
        break;
      case Action::record:
        requests.record = true;
        break;
      case Action::recentre:
        look_.recentre();
        if (headset_) headset_->recentre();
        input_.recentre(session_.trainer().snapshot().lever);
        break;
      case Action::full_screen:
        window_.set_full_screen(!window_.full_screen());
        break;
      case Action::help:
        help_ = !help_;
        panel_.show_help(help_, help_text(setup_.bindings));
        break;
      case Action::panel:
        panel_.set_visible(!panel_.visible());
        break;
      case Action::next_camera:
        if (wears()) break;
        look_.next();
        session_.look_from(look_.place());
        break;
      case Action::undo:
        panel_.undo();
        break;
      case Action::redo:
        panel_.redo();
        break;
      case Action::grab_mouse:
        if (!session_.replays()) break;
        requests.look.close = true;
        input_.free_mouse();
        break;
      case Action::quit:
        quit_ = true;
        break;
      default:
        break;  // the driver's own: held by DriverInput
    }
    session_.obey(requests);
  }

  // The lesson that is offered begins; after one that was passed comes the next, else the same again.
  void go_on(LessonRequests& lesson) const {
    const CoachView& coach = session_.coach().view();
    if (session_.replays()) return;
    const bool goes_further = coach.result.passed && !coach.next.empty() && coach.next != coach.lesson;
    if (coach.phase == LessonPhase::offered) lesson.begin = true;
    if (coach.phase != LessonPhase::over) return;
    if (goes_further)
      lesson.offer = coach.next;
    else
      lesson.begin = true;
  }

  void draw_panel() {
    const glm::ivec2 size = panel_size();
    const float scale = wears() ? UiScale::in_headset(size.x, panel_.visible())
                                : ui_scale_.follow(window_.framebuffer().y, window_.content_scale());
    ui_.begin(
        {static_cast<float>(size.x), static_cast<float>(size.y), static_cast<float>(std::max(seconds_, 1e-4)), scale});
    session_.set_headset(wears() ? std::optional(headset_->report()) : std::nullopt);
    const PanelInput& input = session_.panel_input();
    health_ = input.health;
    const PanelRequests requests = panel_.draw(input);
    ui_.end();
    help_ = panel_.shows_help();
    if (requests.reset_view) look_.recentre();
    if (wears()) headset_->obey(requests.headset, session_.trainer().config().preset.haptics.ghost_offset);
    session_.obey(requests);
  }

  void show() {
    if (wears()) {
      if (session_.take_new_model() || fresh_view_) headset_->set_model(session_.stage().model());
      fresh_view_ = false;
      if (!wears()) return;  // it was lost with that
      headset_->draw(session_.stage().scene(), seen_beside(panel_, panel_size()), card_in(panel_, panel_size()),
                     look_.pose());
      return;
    }
    if (!view_) return;  // headset or device was lost
    try {
      if (session_.take_new_model() || fresh_view_) view_->set_model(session_.stage().model());
      fresh_view_ = false;
      if (view_->begin())
        view_->draw(session_.stage().scene(), look_.pose(), look_.field(), seen_beside(panel_, panel_size()));
    } catch (const GpuLost& lost) {
      lose_view(lost);
    }
  }

  TrainSetup setup_;
  Window window_;
  const Instance driver_{GpuConfig{}};  // the Vulkan driver stays loaded while views come and go
  UiContext ui_;
  UiScale ui_scale_;
  Panel panel_;
  std::unique_ptr<WornHeadset> headset_;  // null: nobody asked for one
  std::unique_ptr<CabinView> view_;       // null while one is worn
  Session session_;
  std::optional<WornHeadset::Pointer> pointer_;  // at something of the panel
  PointingHand pointing_;
  SharedInput shared_;
  DriverInput& input_;
  LookAround look_;
  LessonLines lines_;
  Clock::time_point last_frame_;
  double seconds_ = 1.0 / 60.0;  // [s] that this frame stands for
  bool help_ = false;
  bool quit_ = false;
  bool fresh_view_ = true;
  Clock::time_point next_view_{}, view_quiet_until_{};
  std::optional<LoopHealth> health_;  // of the lever that runs, in the newest frame
  std::string told_message_;
};

// A hand that drives a lesson by itself has nothing to do after it, and who looks at a drive has seen it.
bool is_done(const Session& session) {
  return session.coach().view().phase == LessonPhase::over || session.replay_is_over();
}

}  // namespace

int train_in_window(const TrainSetup& setup) {
  const StopSignals signals;
  WindowTrainer trainer(setup);
  try {
    while (!trainer.done()) trainer.frame();
  } catch (...) {
    (void)trainer.finish();
    throw;
  }
  return trainer.finish();
}

int train_offscreen(const TrainSetup& setup, const OffscreenSetup& offscreen) {
  const StopSignals signals;
  Session session(setup.choice);
  if (!session.message().empty()) print_problem("{}", session.message());
  const LookAround look(setup.choice.camera, setup.choice.drive);
  UiContext ui;
  Panel panel;
  panel.set_visible(setup.panel);
  if (!setup.replay.empty()) session.look_at(setup.replay, setup.shift, setup.from);
  CabinView view(setup.view, nullptr, &ui);
  make_folder(offscreen.folder);
  const double seconds = 1.0 / kOffscreenRate;
  const glm::ivec2 eye = eye_size(setup.view, {setup.view.width, setup.view.height});
  LessonLines lines;
  const auto draw = [&] {
    ui.begin({static_cast<float>(eye.x), static_cast<float>(eye.y), static_cast<float>(seconds),
              UiScale().follow(eye.y, 1.0f)});
    session.obey(panel.draw(session.panel_input()));
    ui.end();
  };
  const auto wants_more = [&] { return session.time() < offscreen.seconds && !is_done(session); };
  while (wants_more() && !StopSignals::asked()) {
    session.advance(seconds);
    print_events(session.events(), !session.trainer().device().measures_hand_force);
    print_lines(lines.news(session.coach().view()), session.lever_time());
    draw();
    session.place();
  }
  const bool is_cut = wants_more();
  for (int i = 0; i < kSettling; ++i) draw();
  tell_unkept(session.settle());
  print_lines(lines.news(session.coach().view()), session.lever_time());
  view.set_model(session.stage().model());  // nobody sees the frames before the last
  view.begin();
  view.draw(session.stage().scene(), look.pose(), look.field(), seen_beside(panel, eye));
  const std::filesystem::path picture = offscreen.folder / "train.png";
  write_png(picture, view.picture());
  print_out("{}\n", picture.string());
  if (is_cut) print_problem("ended after {:.1f} of {:g} s", session.time(), offscreen.seconds);
  return is_cut ? 1 : 0;
}

}  // namespace gearshift
