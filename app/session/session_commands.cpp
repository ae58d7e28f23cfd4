// Executes the user's commands from the panel.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/lessons/history/user_text.h"
#include "app/session/preset_store.h"
#include "app/session/resolve_choice.h"
#include "app/session/session.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/preset.h"

namespace gearshift::session {
namespace {

namespace fs = std::filesystem;

bool same_geometry(const haptics::YokeGeometry& a, const haptics::YokeGeometry& b) {
  return a.radius == b.radius && a.theta_limit == b.theta_limit && a.phi_limit == b.phi_limit;
}

}  // namespace

// One handler per command. A command without a handler does not compile.
struct Session::Handlers {
  Session& session;

  void operator()(const ui::Stop&) const {}  // executed by apply()
  void operator()(const ui::Arm&) const { session.arm(); }
  void operator()(const ui::Disarm&) const { session.lever_.disarm(); }
  void operator()(const ui::ToggleRecording&) const { session.toggle_recording(); }
  void operator()(const ui::ReplayLastRecording&) const { session.open_last_recording(); }

  void operator()(const ui::ChangeTuning& asked) const {
    session.message_ = first_limit(session.lever_.runtime().change_tuning(asked.tuning));
  }
  void operator()(const ui::Restart& asked) const {
    SessionChoice wanted = session.current_choice();
    wanted.haptics = asked.config;
    session.change_choice(wanted, "the settings changed");
  }
  void operator()(const ui::ChooseGate& asked) const {
    session.change_choice(with_gate(session.current_choice(), asked.name), "the gate changed");
  }
  void operator()(const ui::ChooseCar& asked) const {
    SessionChoice wanted = session.current_choice();
    wanted.car = asked.name;
    wanted.gate = wanted.car == kNoCar ? session.lever_.running().gate : std::string{};
    session.change_choice(wanted, "the car changed");
  }
  void operator()(const ui::ChoosePreset& asked) const {
    SessionChoice wanted = session.current_choice();
    wanted.preset = asked.name;
    wanted.haptics.reset();
    session.change_choice(wanted, "the preset changed");
  }
  void operator()(const ui::ChooseHand& asked) const {
    SessionChoice wanted = session.current_choice();
    wanted.hand = asked.name;
    session.change_choice(wanted, "the hand changed");
  }
  void operator()(const ui::SavePreset& asked) const { session.save_preset(asked.name); }
  void operator()(const ui::ComparePreset& asked) const {
    session.panel_.compared.reset();
    session.panel_.compared = haptics::read_preset(preset_file(asked.name).string());
  }

  void operator()(const ui::OfferLesson& asked) const {
    session.director_.offer(asked.key);
    session.recorder_.keep_incomplete();
  }
  void operator()(const ui::BeginLesson&) const {
    if (coach().lesson() != nullptr) session.begin_lesson();
  }
  void operator()(const ui::LeaveLesson&) const {
    if (session.director_.leave()) session.lever_.hold_car();
  }
  void operator()(const ui::DismissLesson&) const {
    session.director_.dismiss();
    session.lever_.release_car();
  }
  void operator()(const ui::SetMode& asked) const { coach().set_mode(asked.mode); }
  void operator()(const ui::SetHelp& asked) const { coach().set_help(asked.on); }
  void operator()(const ui::ChooseLearner& asked) const { session.change_learner(asked.name); }
  void operator()(const ui::RenameLearner& asked) const { session.rename_learner(asked.name); }
  void operator()(const ui::ChooseNextLesson& asked) const { coach().set_next(asked.key); }
  void operator()(const ui::AddComment& asked) const { coach().add_comment(asked.run, asked.author, asked.text); }
  void operator()(const ui::EditComment& asked) const { coach().edit_comment(asked.run, asked.comment, asked.text); }
  void operator()(const ui::DeleteComment& asked) const { coach().delete_comment(asked.run, asked.comment); }

  void operator()(const ui::OpenShift& asked) const { session.open_recording(asked.recording, asked.begin); }
  void operator()(const ui::ShowShift& asked) const {
    if (player()) player()->select_shift(asked.index);
  }
  void operator()(const ui::ShowWholeDrive&) const {
    if (player()) player()->select_shift(std::nullopt);
  }
  void operator()(const ui::SeekReplay& asked) const {
    if (player()) player()->seek(asked.time);
  }
  void operator()(const ui::PlayReplay& asked) const {
    if (player()) player()->play(asked.on);
  }
  void operator()(const ui::SetPace& asked) const {
    if (player()) player()->set_pace(asked.pace);
  }
  void operator()(const ui::CloseReplay&) const { session.close_replay(); }

  // Executed by the window, which owns camera, headset and the driver's input.
  void operator()(const ui::ResetView&) const {}
  void operator()(const ui::HeadsetCommand&) const {}
  void operator()(const ui::ControlsCommand&) const {}
  void operator()(const ui::DriveCommand&) const {}

  lessons::Coach& coach() const { return session.director_.coach(); }
  lessons::Player* player() const { return session.viewer_.player(); }  // null if nothing is replayed
};

void Session::apply(const ui::PanelCommands& commands) {
  std::string rejected;  // reported last, because the commands that follow may set another message
  const auto is_stop = [](const ui::PanelCommand& command) { return std::holds_alternative<ui::Stop>(command); };
  const auto after_stop = std::find_if(commands.rbegin(), commands.rend(), is_stop).base();
  if (after_stop != commands.begin()) lever_.stop();  // at once, as others may take long
  for (auto command = commands.begin(); command != commands.end(); ++command) {
    if (command < after_stop && std::holds_alternative<ui::Arm>(*command)) continue;
    try {
      std::visit(Handlers{*this}, *command);
    } catch (const std::exception& refused) {
      rejected += (rejected.empty() ? "" : "; ") + std::string(refused.what());
    }
  }
  if (!director_.is_driving()) end_lesson_recording();
  if (!rejected.empty()) message_ = rejected;
}

void Session::arm() {
  const std::shared_ptr<runtime::StickLever>& stick = lever_.choice().stick;
  if (!lever_.arm())
    throw std::runtime_error(fmt::format("{} is not plugged in. Plug it in, then turn forces on.", stick->name()));
  if (stick) message_.clear();  // the message asked the user to turn forces on
}

// The user's choice with the configuration in use, so that tuned parameters stay unchanged.
SessionChoice Session::current_choice() const {
  SessionChoice choice = lever_.choice();
  if (choice.car.empty()) choice.car = kDefaultCar;
  choice.haptics = lever_.runtime().config().preset.haptics;
  return choice;
}

void Session::change_choice(const SessionChoice& wanted, std::string_view reason) {
  switch_to(wanted, nullptr, reason, &wanted);
  // Only with the automatic hand, because another program may have renamed the learner.
  if (director_.view().learner.empty() != learner_of(wanted).empty()) director_.coach().set_learner(learner_of(wanted));
}

void Session::switch_to(const SessionChoice& choice, const lessons::Lesson* lesson, std::string_view reason,
                        const SessionChoice* chosen) {
  LeverInForce::Next next = lever_.prepare(choice, lesson);
  const haptics::YokeGeometry& yoke = next.config.preset.lever.yoke;
  if (!stage_ || stage_gate_ != next.gate_text || !same_geometry(stage_yoke_, yoke))
    rebuild_stage(next.gate, next.gate_text, yoke, cabin_);
  message_.clear();
  close_current(reason);
  try {
    lever_.hand_over(std::move(next), chosen);
  } catch (...) {
    if (lever_.exists()) show_lever_in_force();
    throw;
  }
  ++run_;
  const runtime::RuntimeConfig& config = lever_.runtime().config();
  if (config.car) configure_sound(*config.car);
  director_.coach().set_speed_unit(config.car ? config.car->speed_unit : vehicle::SpeedUnit::km_per_h);
  if (config.clock == runtime::RuntimeClock::virtual_time) start_ns_ = -std::llround(1e9 * time_);
  director_.set_road(lesson);
  lever_.send_controls(director_.controls());
  add_message(lever_.describe_limit());
}

void Session::add_message(const std::string& message) {
  if (!message.empty()) message_ += (message_.empty() ? "" : "; ") + message;
}

// Ends a running lesson early, ends recordings and ends a replay.
void Session::close_current(std::string_view reason) {
  const bool drives = director_.is_driving();
  if (drives) (void)director_.leave();
  end_lesson_recording();
  if (recording()) end_recording();
  if (drives) report_early_end(reason);
  viewer_.cancel();
  viewer_.close();
}

void Session::save_preset(const std::string& name) {
  const fs::path file = user_preset_file(name);
  haptics::Preset preset = lever_.runtime().config().preset;
  preset.name = name;
  haptics::write_preset(preset, file);
  lever_.set_preset(name);
  panel_.presets = preset_names();
  message_ = fmt::format("preset saved as {}", file.string());
}

void Session::toggle_recording() {
  if (director_.is_driving())
    throw std::runtime_error(
        "You cannot start or end a recording during a lesson. Lessons are recorded automatically once you enter a "
        "name.");
  if (recording()) {
    end_recording();
    return;
  }
  recorder_.start(lever_.runtime(), "drive");
  message_ = fmt::format("recording to {}", recorder_.last().string());
}

bool Session::end_recording() {
  const std::optional<std::string> problem = recorder_.end(lever_.runtime());
  message_ = problem ? *problem : fmt::format("recorded: {}", recorder_.last().string());
  return !problem;
}

void Session::end_lesson_recording() {
  if (!lever_.exists()) return;
  if (const std::optional<std::string> problem = recorder_.end_lesson(lever_.runtime())) message_ = *problem;
}

// Selects the learner. If the name is invalid, throws before anything changes.
void Session::change_learner(const std::string& name) {
  const bool is_automatic = lever_.choice().hand == kAutomaticHand;
  const std::string stored = is_automatic && !name.empty() ? lessons::checked_learner_name(name) : std::string();
  const bool has_ended_lesson = director_.set_learner(is_automatic ? std::string() : name);
  lever_.set_learner(is_automatic ? stored : director_.view().learner);
  message_.clear();
  if (is_automatic) message_ = "the simulated driver is driving, so nothing is saved";
  if (!has_ended_lesson) return;
  lever_.hold_car();
  report_early_end("the learner changed");
}

void Session::rename_learner(const std::string& name) {
  director_.coach().rename_learner(name);
  lever_.set_learner(director_.view().learner);
}

// Puts the report about the lesson's end in front of the current message, which may be about a recording or a limit.
void Session::report_early_end(std::string_view reason) {
  message_ = fmt::format("the lesson ended early because {}{}{}", reason, message_.empty() ? "" : "; ", message_);
}

// Switches to the lesson's setup, then starts the trial.
void Session::begin_lesson() {
  const lessons::Lesson lesson = *director_.coach().lesson();
  if (director_.view().phase == lessons::LessonPhase::over) {
    director_.coach().offer(lesson);
    recorder_.keep_incomplete();
  }
  SessionChoice wanted = with_lesson(lever_.choice(), lesson);
  if (lever_.exists()) wanted.haptics = lever_.runtime().config().preset.haptics;
  const std::string replaced = describe_replaced_gate(lever_.choice(), wanted, lesson);
  switch_to(wanted, &lesson);
  add_message(replaced);
  const bool is_saved = director_.view().is_saving && !director_.view().learner.empty();
  director_.begin(lever_, is_saved ? record_lesson(lesson.key) : fs::path());
  lever_.send_controls(director_.controls());
}

// If the recording cannot be started, the lesson is driven without one, and the path is empty. A recording that starts
// by itself needs no message.
fs::path Session::record_lesson(const std::string& lesson) {
  try {
    return recorder_.start_lesson(lever_.runtime(), lesson);
  } catch (const std::exception& refused) {
    message_ = refused.what();
    return {};
  }
}

// After a lesson the instructor holds the car.
void Session::end_lesson() {
  lever_.hold_car();
  end_lesson_recording();
}

std::string Session::save_and_stop() {
  end_lesson_recording();
  return director_.save_all(recorder_);
}

void Session::open_last_recording() {
  check_can_replay();
  if (recording() && !end_recording()) return;
  if (recorder_.last().empty()) throw std::runtime_error("nothing has been recorded yet. Press \"Record\" first.");
  open_recording(recorder_.last(), std::nullopt);
}

// On the virtual clock, waits until the recording has been read, because no user is waiting for the next frame.
void Session::open_recording(const fs::path& recording, std::optional<double> near) {
  check_can_replay();
  viewer_.open(recording, near);
  message_ = fmt::format("opening {}", recording.string());
  if (lever_.running().clock == runtime::RuntimeClock::virtual_time) show_opened();
}

void Session::check_can_replay() const {
  if (director_.is_driving())
    throw std::runtime_error("You cannot open a recording during a lesson. Leave the lesson first.");
}

void Session::show_opened() {
  start_replay(viewer_.take());
}

void Session::open_replay(const fs::path& recording, std::optional<std::size_t> shift, double from) {
  check_can_replay();
  lessons::Player player(recording);
  player.start_at(from);
  if (shift) player.select_shift(shift);
  start_replay(std::move(player));
}

// Shows the recording in a cabin with the recording's gate and the running preset's lever. A drive recorded with a
// simulated lever needs a preset with the same lever; one recorded with a stick fits any preset.
void Session::start_replay(lessons::Player player) {
  const haptics::TraceHeader& header = player.drive().header();
  const bool same_lever = header.device.yoke_radius == stage_yoke_.radius &&
                          header.device.workspace == haptics::workspace_half_extent(stage_yoke_);
  if (header.device.simulated && !same_lever)
    throw std::runtime_error(fmt::format("{} was recorded with a different lever; choose the matching preset first",
                                         player.file().string()));
  if (header.gate_text != stage_gate_) rebuild_stage(player.drive().gate(), header.gate_text, stage_yoke_, cabin_);
  message_ = fmt::format("replaying {}", player.file().string());
  viewer_.show(std::move(player));
}

// Returns to the live lever. If a recording is loading, cancels only that.
void Session::close_replay() {
  if (viewer_.is_opening()) {
    viewer_.cancel();
    message_.clear();
    return;
  }
  if (viewer_.player() == nullptr) return;
  viewer_.close();
  ++run_;
  message_.clear();
  show_lever_in_force();
}

// Rebuilds the stage if it shows another gate or yoke than the lever in force has.
void Session::show_lever_in_force() {
  const runtime::RuntimeConfig& config = lever_.runtime().config();
  const haptics::YokeGeometry& yoke = config.preset.lever.yoke;
  if (stage_gate_ != config.layout.text || !same_geometry(stage_yoke_, yoke))
    rebuild_stage(lever_.runtime().gate(), config.layout.text, yoke, cabin_);
}

}  // namespace gearshift::session
