#include "app/session/train.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>

#include <fmt/core.h>

#include "app/base/console.h"
#include "app/base/output_folder.h"
#include "app/base/stop_signals.h"
#include "app/cabin/view/desktop_mirror.h"
#include "app/session/cabin_camera.h"
#include "app/session/controls_assistant.h"
#include "app/session/event_lines.h"
#include "app/session/frame_thread.h"
#include "app/session/lesson_lines.h"
#include "app/session/panel_hand_pointer.h"
#include "app/session/shared_input.h"
#include "app/session/ui_scale.h"
#include "app/ui/panel/key_legend.h"
#include "engine/gpu/instance.h"
#include "engine/ui/ui.h"
#include "engine/xr/headset_thread.h"
#include "haptics/files/atomic_file.h"
#include "haptics/files/printable.h"
#include "haptics/rt/monotonic_clock.h"

namespace gearshift::session {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kOffscreenRate = 30.0;                  // [1/s] frames per simulated second
constexpr int kSettling = 3;                             // frames until every part of the panel has its final height
constexpr double kMinFrameTime = 1.0 / 144;              // [s] shortest frame if the display does not limit the rate
constexpr double kMaxFrameTime = 0.25;                   // [s] car and pedals advance by at most this per frame
constexpr std::chrono::seconds kLabelInterval{1};        // between updates of the keys' labels
constexpr std::chrono::seconds kReplyStays{3};           // how long the answer to an early key is shown
constexpr std::chrono::seconds kQuitAsks{10};            // in which the key is pressed again to quit during a lesson
constexpr std::chrono::seconds kViewRetry{1};            // pause between attempts to recreate the view
constexpr std::chrono::milliseconds kHeadsetEnds{100};   // longest wait for a headset's thread at the program's end
constexpr std::chrono::milliseconds kMaxSignalled{700};  // longest wait for a frame after a signal to end
constexpr std::chrono::milliseconds kStopTakes{20};      // until the motors have their last command
constexpr std::string_view kLapse =
    "your controls could not be read for 0.2 s, so the motors are off; press Enter to turn the forces on again";
constexpr std::chrono::seconds kViewHolds{10};  // no message is printed if the view is lost again within this time

// The part of the cabin's picture that panel and lesson card leave free. `size` [px]: size of the picture.
cabin::VisibleRegion free_region(const ui::Panel& panel, glm::dvec2 size) {
  const ui::ControlRect middle = panel.cabin_area();
  return {middle.min / size, middle.max / size};
}

// The part of the cabin's picture that the panel's columns and bar leave free. It contains the lesson card.
cabin::VisibleRegion card_region(const ui::Panel& panel, glm::dvec2 size) {
  const ui::ControlRect between = panel.central_area();
  return {between.min / size, between.max / size};
}

std::vector<ui::KeyHint> key_hints(const ui::DriverInput& input, const std::vector<engine::Controller>& all) {
  std::vector<ui::KeyHint> hints;
  for (const ui::DrivingKey& key : ui::driving_keys(input.bindings(), input.at_hand(), all))
    hints.push_back({std::string(key.action), key.key});
  return hints;
}

constexpr std::string_view kEngineerView = "engineer";  // content of TrainSetup::view_file

ui::PanelView first_view(const TrainSetup& setup) {
  if (setup.panel_view) return *setup.panel_view;
  std::ifstream file(setup.view_file);
  std::string kept;
  return file >> kept && kept == kEngineerView ? ui::PanelView::engineer : ui::PanelView::learner;
}

void print_unsaved(const std::string& problem) {
  if (!problem.empty()) base::print_message("{}", haptics::printable(problem));
}

class WindowTrainer {
 public:
  explicit WindowTrainer(const TrainSetup& setup)
      : setup_(setup),
        window_(setup.view.width, setup.view.height, "gearshift"),
        headset_(setup.headset ? std::make_unique<LearnerHeadset>(*setup.headset, window_, ui_) : nullptr),
        view_(desktop_view()),  // made before session_, which starts the haptic loop
        session_(setup.choice),
        shared_(setup.bindings),
        input_(shared_.driver()),
        controls_(input_, setup.own_bindings, setup.declined_controllers, setup.shipped_bindings),
        look_(setup.choice.camera, setup.choice.drive),
        kept_view_(first_view(setup)),
        last_frame_(Clock::now()) {
    panel_.set_view(kept_view_);
    panel_.set_visible(setup.panel);
    if (!setup.replay.empty()) session_.open_replay(setup.replay, setup.shift, setup.from);
  }

  bool done() const {
    const bool left = headset_ && headset_->wants_exit();
    return quit_ || left || window_.wants_close() || base::StopSignals::requested();
  }

  // Ends a running lesson early, closes the recording and reports the results. Returns the exit code.
  int finish() {
    print_unsaved(session_.save_and_stop());
    print_lines(lines_.new_lines(session_.coach().view()), session_.lever_time());
    if (!session_.lever().take_new_runtime()) {
      (void)session_.runtime().read_frame();  // the cycles after the last frame
      health_ = session_.runtime().health();
    }
    print_health(health_);
    if (!session_.recording()) return 0;
    const bool is_complete = session_.end_recording();
    if (is_complete) base::print_out("{}\n", session_.message());
    if (!is_complete) base::print_message("{}", session_.message());
    return is_complete ? 0 : 1;
  }

  void frame() {
    beside_input([this] { pace(); });
    poll();
    act();
    set_driver();
    beside_input([this] { session_.advance(seconds_); });
    print_events(session_.events(), !session_.runtime().device().measures_hand_force, session_.runtime().gate());
    print_lines(lines_.new_lines(session_.coach().view()), session_.lever_time());
    print_session_message();
    const ui::PanelCommands commands = draw_panel();
    beside_input([&] {
      session_.apply(commands);
      look();
      update_cabin();
      show();
    });
  }

 private:
  // Size [px] of the picture into which the panel is drawn.
  glm::ivec2 panel_size() const {
    return wears() ? setup_.headset->view.panel : cabin::eye_size(setup_.view, window_.framebuffer());
  }

  glm::dvec2 mouse_at_panel(glm::dvec2 mouse) const {
    const glm::ivec2 window = window_.framebuffer();
    return wears() ? cabin::in_mirrored_panel(mouse, panel_size(), window)
                   : cabin::mouse_in_eye(setup_.view, mouse, window);
  }

  // Does work that may take long, while STOP and the watch on the controls go on. See FrameThread::run().
  void beside_input(const std::function<void()>& work) {
    frame_thread_.run(work, [this] { glance(); });
  }

  void glance() {
    for (const engine::InputEvent& event : window_.glance()) {
      const auto* const key = std::get_if<engine::KeyEvent>(&event);
      if (key != nullptr && input_.stops(*key, panel_has_keys_)) setup_.choice.watch->stop();
    }
    setup_.choice.watch->note_read(haptics::monotonic_ns());
    if (!base::StopSignals::requested()) return;
    if (!signalled_at_) signalled_at_ = Clock::now();
    if (Clock::now() - *signalled_at_ > kMaxSignalled) end_at_once();
  }

  // The display or a disk hangs, and the user wants the program to end.
  [[noreturn]] void end_at_once() {
    setup_.choice.watch->stop();
    std::this_thread::sleep_for(kStopTakes);
    base::print_message("ended without saving, because the display or a disk did not answer");
    std::fflush(stdout);
    std::_Exit(1);
  }

  bool wears() const { return headset_ && headset_->is_open(); }
  bool is_worn() const { return headset_ && headset_->is_worn(); }  // the user sees the headset's pictures

  std::unique_ptr<cabin::CabinView> desktop_view() {
    return std::make_unique<cabin::CabinView>(setup_.view, &window_, &ui_);
  }

  // Switches to a headset if one is found; otherwise makes sure that the window has a desktop view. A headset uses the
  // window as its mirror, so only one of the two views may exist.
  void find_view() {
    if (headset_ && headset_->is_found()) {
      view_.reset();
      (void)headset_->open();
      fresh_view_ = true;
    }
    if (headset_) report_message(headset_->take_message());
    if (!wears() && !view_) make_desktop_view();
  }

  // Tries at most once per kViewRetry, because the GPU may be lost repeatedly.
  void make_desktop_view() {
    const Clock::time_point now = Clock::now();
    if (now < next_view_) return;
    next_view_ = now + kViewRetry;
    try {
      view_ = desktop_view();
      fresh_view_ = true;
    } catch (const engine::GpuLost& lost) {
      lose_view(lost);
    }
  }

  void lose_view(const engine::GpuLost& lost) {
    view_.reset();
    const Clock::time_point now = Clock::now();
    if (now > view_quiet_until_)
      base::print_message("{}; restarting the display. The lever keeps running.", lost.what());
    view_quiet_until_ = now + kViewHolds;
  }

  // Repeats the panel's message on stdout, for users who do not see the panel.
  void print_session_message() {
    if (session_.message() == printed_message_) return;
    printed_message_ = session_.message();
    if (!printed_message_.empty()) print_lines({haptics::printable(printed_message_)}, session_.lever_time());
  }

  void report_message(const std::string& news) {
    if (news.empty()) return;
    base::print_message("{}", haptics::printable(news));
    session_.set_message(news);
  }

  // Waits for the next frame. While the headset is worn, its display sets the time; otherwise the next frame comes at
  // least kMinFrameTime after the previous one. The wait comes before input is read, to keep the latency from input to
  // picture short.
  void pace() {
    find_view();
    const auto next =
        last_frame_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kMinFrameTime));
    if (!wears() || !headset_->begin(session_.stage())) std::this_thread::sleep_until(next);
    const Clock::time_point now = Clock::now();
    const double passed = std::chrono::duration<double>(now - last_frame_).count();
    session_.set_frame_ms(1e3 * passed);
    seconds_ = std::min(passed, kMaxFrameTime);
    last_frame_ = now;
  }

  void poll() {
    const haptics::HapticSnapshot& felt = session_.runtime().snapshot();
    input_.feel(felt.lever, felt.gear);
    session_.set_mouse_leads(input_.mouse_moves_lever());
    session_.set_held_throttle(input_.held_throttle());
    const engine::WindowInput& polled = window_.poll();
    setup_.choice.watch->note_read(haptics::monotonic_ns());
    if (setup_.choice.watch->take_lapse()) report_message(std::string(kLapse));
    if (wears() && headset_->take_opened()) panel_.set_view(ui::PanelView::engineer);
    pointer_ = pointer_at_panel();
    pointing_.follow(polled, input_.mouse_moves_lever(), pointer_, panel_size(), seconds_);
    // The stick that is the lever may be listed, too, until the program has opened it.
    controllers_ = polled.controllers;
    std::erase_if(controllers_, [this](const auto& one) { return one.id == setup_.stick_id; });
    controls_.update(controllers_, seconds_);
    engine::WindowInput left;
    const bool is_setting_up = controls_.is_setting_up();
    if (is_setting_up) {
      left = polled;
      report(controls_.take(left, panel_.has_keyboard() || input_.mouse_moves_lever()));
    }
    shared_.update(
        is_setting_up ? left : polled, seconds_, [this](glm::dvec2 at) { return mouse_at_panel(at); }, panel_, ui_,
        pointing_.pointer());
    if (setup_.choice.stick) input_.release_mouse();
    report_controllers();
    update_key_labels();
    answer_early_input();
    look_.turn(shared_.turned());
  }

  // The layout of the keyboard may change while the program runs; GLFW has no event for this.
  void update_key_labels() {
    if (last_frame_ < next_labels_ && input_.at_hand() == labelled_) return;
    next_labels_ = last_frame_ + kLabelInterval;
    labelled_ = input_.at_hand();
    session_.set_keys(key_hints(input_, controllers_));
    if (help_) show_help();
  }

  // Says at once which control comes first, and for a moment after.
  void answer_early_input() {
    const auto has = [&](ui::Action action) {
      return std::find(input_.pressed().begin(), input_.pressed().end(), action) != input_.pressed().end();
    };
    ui::EarlyInput early;
    early.starter = input_.holds_starter();
    early.shifts = has(ui::Action::shift_up) || has(ui::Action::shift_down);
    early.throttle = has(ui::Action::throttle_more) || input_.pedal_keys().throttle;
    std::string reply = session_.is_replaying() ? "" : ui::early_reply(early, session_.car(), session_.keys());
    if (!reply.empty()) reply_until_ = last_frame_ + kReplyStays;
    if (!reply.empty() || last_frame_ > reply_until_) session_.set_reply(std::move(reply));
  }

  // Keeps the view that the user has chosen. The next start without the file shows the learner's view.
  void keep_view() {
    if (wears() || panel_.view() == kept_view_ || panel_.view() == ui::PanelView::hidden) return;
    kept_view_ = panel_.view();
    if (setup_.view_file.empty()) return;
    try {
      std::filesystem::create_directories(setup_.view_file.parent_path());
      haptics::write_text_file(setup_.view_file, kept_view_ == ui::PanelView::engineer ? "engineer\n" : "learner\n");
    } catch (const std::exception& refused) {
      report_message(refused.what());
    }
  }

  // During a lesson the first press asks, on the lesson's card.
  void quit() {
    const bool drives = session_.coach().view().phase == lessons::LessonPhase::driving;
    const bool asks = drives && panel_.view() != ui::PanelView::hidden && last_frame_ > quit_until_;
    quit_until_ = last_frame_ + kQuitAsks;
    if (!asks) quit_ = true;
    if (!asks) return;
    session_.set_reply("Press the key again to quit; this ends the lesson. Otherwise drive on.");
    reply_until_ = quit_until_;
  }

  void drive(const ui::DriveCommand& command) {
    if (const auto* pedal = std::get_if<ui::MovePedal>(&command)) input_.move_pedal(pedal->pedal, pedal->to);
    if (const auto* shift = std::get_if<ui::ShiftTo>(&command)) input_.shift_to(shift->gear);
    if (const auto* starter = std::get_if<ui::HoldStarter>(&command)) input_.hold_starter(starter->on);
    if (const auto* press = std::get_if<ui::Press>(&command)) input_.perform(press->control);
  }

  void report(const std::string& message) {
    if (!message.empty()) report_message(message);
  }

  // On the console; in the window, card and note show them.
  void report_controllers() {
    if (controls_.sentences() == reported_) return;
    for (const std::string& sentence : controls_.sentences()) {
      const bool is_known = std::find(reported_.begin(), reported_.end(), sentence) != reported_.end();
      if (!is_known) base::print_message("{}", haptics::printable(sentence));
    }
    reported_ = controls_.sentences();
  }

  // Where the hand points at the panel; empty if it does not, or if this part of the panel has no controls.
  std::optional<LearnerHeadset::Pointer> pointer_at_panel() const {
    if (!wears() || !headset_->pointer()) return std::nullopt;
    const std::optional<LearnerHeadset::Pointer>& pointer = headset_->pointer();
    const bool is_there = panel_.covers(pointer->hit.at * glm::dvec2(panel_size()));
    return is_there ? pointer : std::nullopt;
  }

  // Moves the desktop camera. While the headset is worn, only the head sets the view, so the camera does not move.
  void look() {
    session_.set_visual_offset(is_worn() ? headset_->touch_error() : 0.0);
    if (!is_worn() && look_.follow_shift(session_.is_replaying_shift())) session_.set_camera(look_.place());
  }

  void update_cabin() {
    const bool points = is_worn() && (pointer_ || !headset_->pointer());
    session_.update_cabin(is_worn() ? headset_->head() : look_.pose(), points ? headset_->beam() : std::nullopt);
  }

  // Passes the user's input to the session. After a change of gate, car, hand or device, the hand starts at the lever's
  // position.
  void set_driver() {
    LeverInForce& lever = session_.lever();
    if (lever.take_new_runtime()) {
      print_health(std::exchange(health_, std::nullopt));
      runtime::Runtime& runtime = lever.runtime();
      input_.set_gate(runtime.gate(), runtime.device());
      input_.recentre(runtime.snapshot().lever);
    }
    if (const std::optional<CarSwitches> car = lever.take_switches()) input_.set_car(car->ignition, car->hand_brake);
    lever.set_driver(input_.hand(), input_.controls(), input_.pedal_keys());
  }

  void act() {
    for (const ui::Action action : input_.pressed()) act(action);
    window_.capture_mouse(input_.mouse_moves_lever());
  }

  void apply(const ui::PanelCommands& commands) {
    beside_input([&] { session_.apply(commands); });
  }

  void act(ui::Action action) {
    switch (action) {
      case ui::Action::stop:
        session_.apply(ui::Stop{});
        break;
      case ui::Action::arm:
        if (std::string message; controls_.press_enter(message))
          report(message);
        else
          apply(enter_commands());
        break;
      case ui::Action::record:
        apply({ui::ToggleRecording{}});
        break;
      case ui::Action::recentre:
        look_.recentre();
        if (headset_) headset_->recentre();
        input_.recentre(session_.runtime().snapshot().lever);
        break;
      case ui::Action::full_screen:
        window_.set_full_screen(!window_.full_screen());
        break;
      case ui::Action::help:
        help_ = !help_;
        show_help();
        break;
      case ui::Action::panel:
        if (is_worn())
          headset_->toggle_panel();
        else
          panel_.set_view(panel_.view() == ui::PanelView::learner ? ui::PanelView::engineer : ui::PanelView::learner);
        break;
      case ui::Action::lessons:
        panel_.toggle_lessons();
        break;
      case ui::Action::next_camera:
        if (wears()) break;
        look_.next();
        session_.set_camera(look_.place());
        break;
      case ui::Action::undo:
        panel_.undo();
        break;
      case ui::Action::redo:
        panel_.redo();
        break;
      case ui::Action::grab_mouse:
        if (!session_.is_replaying()) break;
        session_.apply(ui::CloseReplay{});
        input_.release_mouse();
        break;
      case ui::Action::quit:
        quit();
        break;
      default:
        break;  // driving actions, which DriverInput handles
    }
  }

  void show_help() { panel_.show_help(help_, ui::help_text(input_.bindings(), window_.input().controllers)); }

  // Commands of the Enter key: turn forces on, and start the offered lesson. After a passed lesson, offer the next one,
  // if it is a different lesson. Otherwise restart the lesson.
  ui::PanelCommands enter_commands() const {
    ui::PanelCommands commands{ui::Arm{}};
    if (session_.is_replaying()) return commands;
    const lessons::CoachView& coach = session_.coach().view();
    const bool is_over = coach.phase == lessons::LessonPhase::over;
    if (is_over && coach.result->passed && !coach.next.empty() && coach.next != coach.lesson)
      commands.push_back(ui::OfferLesson{coach.next});
    else if (is_over || coach.phase == lessons::LessonPhase::offered)
      commands.push_back(ui::BeginLesson{});
    return commands;
  }

  ui::PanelCommands draw_panel() {
    const glm::ivec2 size = panel_size();
    const float scale = wears() ? UiScale::in_headset(size.x, panel_.visible())
                                : ui_scale_.follow(window_.framebuffer().y, window_.content_scale());
    ui_.begin(
        {static_cast<float>(size.x), static_cast<float>(size.y), static_cast<float>(std::max(seconds_, 1e-4)), scale});
    session_.set_headset(wears() ? std::optional(headset_->report()) : std::nullopt);
    ui::PanelInput input = session_.panel_input();
    input.controls = controls_.view(session_.runtime().gate(), !input.is_automatic_hand);
    health_ = input.health;
    const ui::PanelCommands commands = panel_.draw(input);
    ui_.end();
    help_ = panel_.shows_help();
    const double bound = session_.runtime().config().preset.haptics.ghost_offset;
    for (const ui::PanelCommand& command : commands) {
      if (std::holds_alternative<ui::ResetView>(command)) look_.recentre();
      const auto* seat = std::get_if<ui::HeadsetCommand>(&command);
      if (seat && wears()) headset_->apply(*seat, bound);
      if (const auto* driven = std::get_if<ui::DriveCommand>(&command)) drive(*driven);
      if (const auto* controls = std::get_if<ui::ControlsCommand>(&command))
        report(controls_.apply(*controls, session_.runtime().gate()));
    }
    panel_has_keys_ = panel_.has_keyboard();
    keep_view();
    return commands;
  }

  void show() {
    if (wears()) {
      fresh_view_ = session_.take_new_model() || fresh_view_;
      if (fresh_view_) fresh_view_ = !headset_->set_model(session_.stage().model());
      if (!wears()) return;  // set_model() may have lost the headset
      headset_->draw(session_.stage().scene(), free_region(panel_, panel_size()), card_region(panel_, panel_size()),
                     look_.pose());
      return;
    }
    if (!view_) return;  // the headset or the GPU was lost
    try {
      if (session_.take_new_model() || fresh_view_) view_->set_model(session_.stage().model());
      fresh_view_ = false;
      if (view_->begin())
        view_->draw(session_.stage().scene(), look_.pose(), look_.field(), free_region(panel_, panel_size()));
    } catch (const engine::GpuLost& lost) {
      lose_view(lost);
    }
  }

  TrainSetup setup_;
  engine::Window window_;
  const engine::Instance driver_{engine::GpuConfig{}};  // keeps the Vulkan driver loaded between views
  engine::UiContext ui_;
  UiScale ui_scale_;
  ui::Panel panel_;
  std::unique_ptr<LearnerHeadset> headset_;  // null if no headset was requested
  std::unique_ptr<cabin::CabinView> view_;   // null while the headset is open
  Session session_;
  std::optional<LearnerHeadset::Pointer> pointer_;  // where the hand points on the panel
  PointingHand pointing_;
  SharedInput shared_;
  ui::DriverInput& input_;
  ControlsAssistant controls_;
  CabinCamera look_;
  ui::PanelView kept_view_;
  LessonLines lines_;
  Clock::time_point last_frame_;
  double seconds_ = 1.0 / 60.0;                    // [s] duration of this frame
  bool panel_has_keys_ = false;                    // a key press goes to the panel
  std::optional<Clock::time_point> signalled_at_;  // when a signal to end was first noticed during a frame
  bool help_ = false;
  bool quit_ = false;
  bool fresh_view_ = true;
  Clock::time_point next_view_{}, view_quiet_until_{}, next_labels_{}, reply_until_{}, quit_until_{};
  ui::DeviceAtHand labelled_ = ui::DeviceAtHand::keyboard;
  std::optional<runtime::LoopHealth> health_;  // health of the loop in the newest frame
  std::string printed_message_;
  std::vector<engine::Controller> controllers_;  // plugged in, without the stick that is the lever
  std::vector<std::string> reported_;            // sentences about them that were printed
  FrameThread frame_thread_;                     // last, so that it ends first
};

// True if the lesson or the replay has ended.
bool is_done(const Session& session) {
  return session.coach().view().phase == lessons::LessonPhase::over || session.is_replay_over();
}

int run_trainer(TrainSetup setup) {
  const base::StopSignals signals;
  setup.choice.watch = std::make_shared<runtime::ControlsWatch>();
  WindowTrainer trainer(setup);
  try {
    while (!trainer.done()) trainer.frame();
  } catch (...) {
    (void)trainer.finish();
    throw;
  }
  return trainer.finish();
}

}  // namespace

int train_in_window(const TrainSetup& setup) {
  const int code = run_trainer(setup);
  // A headset's runtime that hangs still has its thread, so the program ends without the destructors that would wait for
  // it or take away what it uses.
  if (engine::HeadsetThread::wait_for_ended(kHeadsetEnds)) return code;
  std::_Exit(std::fflush(stdout) == 0 ? code : 1);
}

int train_offscreen(const TrainSetup& setup, const OffscreenSetup& offscreen) {
  const base::StopSignals signals;
  Session session(setup.choice);
  if (!session.message().empty()) base::print_message("{}", session.message());
  const CabinCamera look(setup.choice.camera, setup.choice.drive);
  engine::UiContext ui;
  ui::Panel panel;
  if (setup.panel_view) panel.set_view(*setup.panel_view);
  panel.set_visible(setup.panel);
  if (!setup.replay.empty()) session.open_replay(setup.replay, setup.shift, setup.from);
  cabin::CabinView view(setup.view, nullptr, &ui);
  base::make_folder(offscreen.folder);
  const double seconds = 1.0 / kOffscreenRate;
  const glm::ivec2 eye = cabin::eye_size(setup.view, {setup.view.width, setup.view.height});
  LessonLines lines;
  const auto draw = [&] {
    ui.begin({static_cast<float>(eye.x), static_cast<float>(eye.y), static_cast<float>(seconds),
              UiScale().follow(eye.y, 1.0f)});
    session.apply(panel.draw(session.panel_input()));
    ui.end();
  };
  const auto wants_more = [&] { return session.time() < offscreen.seconds && !is_done(session); };
  while (wants_more() && !base::StopSignals::requested()) {
    session.advance(seconds);
    print_events(session.events(), !session.runtime().device().measures_hand_force, session.runtime().gate());
    print_lines(lines.new_lines(session.coach().view()), session.lever_time());
    draw();
    session.update_cabin();
  }
  const bool is_cut = wants_more();
  for (int i = 0; i < kSettling; ++i) draw();
  print_unsaved(session.save_and_stop());
  print_lines(lines.new_lines(session.coach().view()), session.lever_time());
  view.set_model(session.stage().model());  // loaded only now, because only the last frame is rendered
  view.begin();
  view.draw(session.stage().scene(), look.pose(), look.field(), free_region(panel, eye));
  const std::filesystem::path picture = offscreen.folder / "train.png";
  engine::write_png(picture, view.picture());
  base::print_out("{}\n", picture.string());
  if (is_cut) base::print_message("stopped after {:.1f} of {:g} s", session.time(), offscreen.seconds);
  return is_cut ? 1 : 0;
}

}  // namespace gearshift::session
