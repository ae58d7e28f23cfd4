// What the user requests in the panel, and what follows from it.
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

// Describes the change that the user requests; if there are several, only the first one.
std::string_view change_reason(const ui::PanelRequests& requests) {
  if (requests.car) return "the car changed";
  if (requests.gate) return "the gate changed";
  if (requests.hand) return "the hand changed";
  return requests.preset ? "the preset changed" : "the settings changed";
}

}  // namespace

void Session::apply(const ui::PanelRequests& requests) {
  try {
    apply_lever_requests(requests);
    if (requests.record) toggle_recording();
    if (requests.replay) open_last_recording();
    if (requests.save_preset) save_preset(*requests.save_preset);
    apply_replay_requests(requests.playback);
    apply_choice(requests);
    apply_lesson_requests(requests.lesson);
    if (requests.compare) {
      panel_.compared.reset();
      panel_.compared = haptics::read_preset(preset_file(*requests.compare).string());
    }
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

void Session::apply_lever_requests(const ui::PanelRequests& requests) {
  if (requests.stop) lever_.stop();
  if (requests.disarm) lever_.disarm();
  const std::shared_ptr<runtime::StickLever>& stick = lever_.choice().stick;
  if (requests.arm && !lever_.arm())
    message_ = fmt::format("{} is not plugged in. Plug it in, then turn forces on.", stick->name());
  else if (requests.arm && stick)
    message_.clear();  // the message asked the user to turn forces on
  if (requests.tuning) message_ = first_limit(lever_.runtime().change_tuning(*requests.tuning));
}

// Applies changes of gate, car, hand, preset and configuration. Tuned parameters stay unchanged unless a preset is
// requested.
void Session::apply_choice(const ui::PanelRequests& requests) {
  if (!requests.gate && !requests.car && !requests.preset && !requests.hand && !requests.restart) return;
  SessionChoice wanted = lever_.choice();
  if (wanted.car.empty()) wanted.car = kDefaultCar;
  wanted.haptics = lever_.runtime().config().preset.haptics;
  if (requests.gate) wanted = with_gate(wanted, *requests.gate);
  if (requests.car) {
    wanted.car = *requests.car;
    wanted.gate = wanted.car == kNoCar ? lever_.running().gate : std::string{};
  }
  if (requests.hand) wanted.hand = *requests.hand;
  if (requests.restart) wanted.haptics = *requests.restart;
  if (requests.preset) {
    wanted.preset = *requests.preset;
    wanted.haptics.reset();
  }
  switch_to(wanted, nullptr, change_reason(requests));
  lever_.choice() = wanted;
  if (director_.view().learner != learner_of(wanted)) director_.coach().set_learner(learner_of(wanted));
}

void Session::switch_to(const SessionChoice& choice, const lessons::Lesson* lesson, std::string_view reason) {
  LeverInForce::Next next = lever_.prepare(choice, lesson);
  const haptics::YokeGeometry& yoke = next.config.preset.lever.yoke;
  if (!stage_ || stage_gate_ != next.gate_text || !same_geometry(stage_yoke_, yoke))
    rebuild_stage(next.gate, next.gate_text, yoke, cabin_);
  message_.clear();
  close_current(reason);
  lever_.hand_over(std::move(next));
  ++run_;
  const runtime::RuntimeConfig& config = lever_.runtime().config();
  if (config.car) configure_sound(*config.car);
  if (config.clock == runtime::RuntimeClock::virtual_time) start_ns_ = -std::llround(1e9 * time_);
  director_.set_road(lesson);
  lever_.send_controls(director_.controls());
  const std::string limit = lever_.describe_limit();
  if (!limit.empty()) message_ += (message_.empty() ? "" : "; ") + limit;
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
  lever_.choice().preset = lever_.running().preset = name;
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

void Session::apply_lesson_requests(const ui::LessonRequests& requests) {
  lessons::Coach& coach = director_.coach();
  if (requests.learner) change_learner(*requests.learner);
  if (requests.next) coach.set_next(*requests.next);
  if (const auto& change = requests.comment_change) {
    if (change->text)
      coach.edit_comment(change->run, change->comment, *change->text);
    else
      coach.delete_comment(change->run, change->comment);
  }
  if (requests.comment) coach.add_comment(requests.comment->run, requests.comment->author, requests.comment->text);
  if (requests.offer) {
    director_.offer(*requests.offer);
    recorder_.keep_incomplete();
  }
  if (requests.mode) coach.set_mode(*requests.mode);
  if (requests.help) coach.set_help(*requests.help);
  if (requests.leave && director_.leave()) lever_.hold_car();
  if (requests.dismiss_lesson) {
    director_.dismiss();
    lever_.release_car();
  }
  if (requests.begin && coach.lesson() != nullptr) begin_lesson();
  if (!director_.is_driving()) end_lesson_recording();
}

// Selects the learner. If the name is invalid, throws before anything changes.
void Session::change_learner(const std::string& name) {
  if (!name.empty()) lessons::check_learner_name(name);
  lever_.choice().learner = name;
  const bool has_ended_lesson = director_.set_learner(learner_of(lever_.choice()));
  message_.clear();
  if (lever_.choice().hand == kAutomaticHand) message_ = "the simulated driver is driving, so nothing is saved";
  if (!has_ended_lesson) return;
  lever_.hold_car();
  report_early_end("the learner changed");
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
  switch_to(wanted, &lesson);
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
  std::string unsaved = director_.coach().flush();
  end_lesson_recording();
  return director_.make_room(recorder_, std::move(unsaved));
}

void Session::apply_replay_requests(const ui::ReplayRequests& requests) {
  if (requests.open) open_recording(requests.open->recording, requests.open->begin);
  if (requests.close && viewer_.is_opening()) {
    viewer_.cancel();
    message_.clear();
    return;
  }
  lessons::Player* player = viewer_.player();
  if (player == nullptr) return;
  if (requests.shift) player->select_shift(requests.shift);
  if (requests.whole_drive) player->select_shift(std::nullopt);
  if (requests.seek) player->seek(*requests.seek);
  if (requests.pace) player->set_pace(*requests.pace);
  if (requests.play) player->play(*requests.play);
  if (requests.close) end_replay();
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

void Session::end_replay() {
  viewer_.close();
  ++run_;
  message_.clear();
  const runtime::RuntimeConfig& config = lever_.runtime().config();
  if (stage_gate_ != config.layout.text)
    rebuild_stage(lever_.runtime().gate(), config.layout.text, stage_yoke_, cabin_);
}

}  // namespace gearshift::session
