// A session's replays: a recorded drive in the place of the lever that runs.
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/train/seen_history.h"
#include "app/train/session.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift {

namespace fs = std::filesystem;

void Session::open_last() {
  check_free_to_look();
  if (recording() && !end_recording()) return;
  if (last_recording_.empty()) throw std::runtime_error("nothing has been recorded yet");
  open(last_recording_, std::nullopt);
}

// Read while the lever goes on; on the virtual clock nobody waits for a frame.
void Session::open(const fs::path& recording, std::optional<double> near) {
  check_free_to_look();
  opening_ = std::make_unique<OpeningDrive>(recording);
  opening_near_ = near;
  message_ = fmt::format("opening {}", recording.string());
  if (running_.clock == TrainerClock::virtual_time) show_opened();
}

void Session::end_opening() {
  if (!opening_ || !opening_->is_over()) return;
  try {
    show_opened();
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

void Session::show_opened() {
  const std::unique_ptr<OpeningDrive> opened = std::exchange(opening_, nullptr);
  Player player = opened->take();
  if (opening_near_) player.look_near(*opening_near_);
  look_at(std::move(player));
}

void Session::obey_viewer(const ReplayRequests& requests) {
  if (requests.open) open(requests.open->recording, requests.open->begin);
  if (requests.close && opening_) return give_up_opening();
  if (!player_) return;
  if (requests.shift) player_->look_at(requests.shift);
  if (requests.whole) player_->look_at(std::nullopt);
  if (requests.seek) player_->seek(*requests.seek);
  if (requests.pace) player_->set_pace(*requests.pace);
  if (requests.play) player_->play(*requests.play);
  if (requests.close) end_replay();
}

void Session::give_up_opening() {
  opening_.reset();
  message_.clear();
}

void Session::check_free_to_look() const {
  if (coach_.view().phase == LessonPhase::driving)
    throw std::runtime_error("a lesson is being driven: leave it before looking at a recording");
}

void Session::look_at(const fs::path& recording, std::optional<std::size_t> shift, double from) {
  check_free_to_look();
  Player player(recording);
  player.begin_at(from);
  if (shift) player.look_at(shift);
  look_at(std::move(player));
}

// In the cabin of its own gate. The preset's lever is drawn; a stick's way fits any.
void Session::look_at(Player player) {
  const TraceHeader& header = player.drive().header();
  const bool same_lever =
      header.device.yoke_radius == stage_yoke_.radius && header.device.workspace == workspace_half_extent(stage_yoke_);
  if (header.device.simulated && !same_lever)
    throw std::runtime_error(
        fmt::format("{}: recorded with another lever: choose its preset first", player.file().string()));
  if (header.gate_text != stage_gate_) show(player.drive().gate(), header.gate_text, stage_yoke_, cabin_);
  message_ = fmt::format("replaying {}", player.file().string());
  player_ = std::move(player);
}

void Session::end_replay() {
  player_.reset();
  ++run_;
  message_.clear();
  const TrainerConfig& config = trainer_->config();
  if (stage_gate_ != config.layout.text) show(trainer_->gate(), config.layout.text, stage_yoke_, cabin_);
}

// What is shown is of the trace then, but for the guard: its state is that of the lever that runs.
void Session::show_replay(double seconds) {
  if (player_->jumped()) ++run_;
  (void)player_->advance(seconds);
  const GuardState guard = shown_.guard;
  const GuardFault fault = shown_.fault;
  shown_ = player_->now().lever;
  shown_.guard = guard;
  shown_.fault = fault;
  car_ = player_->now().car;
  history_ = seen_history(player_->passed());
}

}  // namespace gearshift
