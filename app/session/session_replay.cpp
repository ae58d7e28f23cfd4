// The session's replays: a recorded drive is displayed instead of the live lever.
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/session/plot_samples.h"
#include "app/session/session.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::session {

namespace fs = std::filesystem;

void Session::open_last_recording() {
  check_can_replay();
  if (recording() && !end_recording()) return;
  if (last_recording_.empty()) throw std::runtime_error("nothing has been recorded yet. Press \"Record\" first.");
  open_recording(last_recording_, std::nullopt);
}

// Starts to read the recording in the background. On the virtual clock, waits until the recording has been read,
// because no user is waiting for the next frame.
void Session::open_recording(const fs::path& recording, std::optional<double> near) {
  check_can_replay();
  opening_ = std::make_unique<lessons::DriveLoader>(recording);
  opening_near_ = near;
  message_ = fmt::format("opening {}", recording.string());
  if (running_.clock == runtime::RuntimeClock::virtual_time) show_opened();
}

void Session::finish_opening() {
  if (!opening_ || !opening_->is_over()) return;
  try {
    show_opened();
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

void Session::show_opened() {
  const std::unique_ptr<lessons::DriveLoader> opened = std::exchange(opening_, nullptr);
  lessons::Player player = opened->take();
  if (opening_near_) player.select_nearest_shift(*opening_near_);
  start_replay(std::move(player));
}

void Session::apply_replay_requests(const ui::ReplayRequests& requests) {
  if (requests.open) open_recording(requests.open->recording, requests.open->begin);
  if (requests.close && opening_) return cancel_opening();
  if (!player_) return;
  if (requests.shift) player_->select_shift(requests.shift);
  if (requests.whole_drive) player_->select_shift(std::nullopt);
  if (requests.seek) player_->seek(*requests.seek);
  if (requests.pace) player_->set_pace(*requests.pace);
  if (requests.play) player_->play(*requests.play);
  if (requests.close) end_replay();
}

void Session::cancel_opening() {
  opening_.reset();
  message_.clear();
}

void Session::check_can_replay() const {
  if (coach_.view().phase == lessons::LessonPhase::driving)
    throw std::runtime_error("You cannot open a recording during a lesson. Leave the lesson first.");
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
  player_ = std::move(player);
}

void Session::end_replay() {
  player_.reset();
  ++run_;
  message_.clear();
  const runtime::RuntimeConfig& config = runtime_->config();
  if (stage_gate_ != config.layout.text) rebuild_stage(runtime_->gate(), config.layout.text, stage_yoke_, cabin_);
}

// Displays the state from the trace, except for the guard, whose live state must stay visible.
void Session::show_replay(double seconds) {
  if (player_->has_jumped()) ++run_;
  (void)player_->advance(seconds);
  const haptics::GuardState guard = shown_.guard;
  const haptics::GuardFault fault = shown_.fault;
  shown_ = player_->now().lever;
  shown_.guard = guard;
  shown_.fault = fault;
  car_ = player_->now().car;
  history_ = plot_samples(player_->passed());
}

}  // namespace gearshift::session
