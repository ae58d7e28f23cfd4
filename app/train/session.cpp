#include "app/train/session.h"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/limited_words.h"
#include "app/output_folder.h"
#include "app/program_name.h"
#include "app/train/preset_shelf.h"
#include "app/train/recording_file.h"
#include "app/trainer/history.h"
#include "app/trainer/user_folder.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/preset_writer.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostHistory = 200;  // [snapshots] a frame

Preset chosen_preset(const SessionChoice& choice) {
  Preset preset = read_preset(preset_file(choice.preset).string());
  if (choice.hand.empty() || choice.hand == kTouringHand) return preset;
  const std::optional<HandImpedance> hand = hand_from_text(choice.hand);
  if (!hand || hand->stiffness < kLeastLeadingStiffness)
    throw std::invalid_argument(
        fmt::format("hand {}: must be light, grip, arm, \"{}\" or M,B,K in kg, N s/m and N/m, with at least {:g} N/m",
                    choice.hand, kTouringHand, kLeastLeadingStiffness));
  preset.lever.hand = *hand;
  return preset;
}

// By itself the hand is too quick for the car to move off: it rolls already.
RollingCar car_for(const SessionChoice& choice) {
  RollingCarConfig config;
  if (choice.hand == kTouringHand) config.start_speed = 30.0 / kKmhPerMps;
  return RollingCar(config);
}

std::string first_limit(const AdmittedTuning& admitted) {
  return admitted.limited.empty() ? std::string{} : limited_words(admitted.limited.front());
}

}  // namespace

Session::Session(const SessionChoice& choice)
    : choice_(choice),
      cabin_(cabin_seen_from(choice.camera)),
      car_(car_for(choice)),
      sound_(choice.sound),
      cabin_sound_(sound_, CabinSoundConfig{}) {
  controls_.ignition = true;
  if (choice.clock == TrainerClock::real_time)
    start_ns_ = std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  change_to(choice);
  if (!sound_.why_silent().empty()) message_ = sound_.why_silent();
  panel_.gates = shipped_names("gates");
  panel_.presets = preset_names();
  panel_.hands = {"light", "grip", "arm", std::string(kTouringHand)};
  panel_.device_name = kSimulatedDevice;
}

TrainerConfig Session::trainer_config(const SessionChoice& choice) const {
  TrainerConfig config;
  config.preset = chosen_preset(choice);
  if (choice.haptics) config.preset.haptics = *choice.haptics;
  config.layout = read_gate_layout(find_asset("gates", choice.gate));
  config.hand = choice.hand == kTouringHand ? HandKind::touring : HandKind::led;
  config.clock = choice.clock;
  config.seed = choice.seed;
  config.program = program_name();
  return config;
}

std::unique_ptr<Stage> Session::make_stage(const Trainer& trainer, Cabin cabin) const {
  return std::make_unique<Stage>(stage_config(trainer.gate(), trainer.config().preset.lever.yoke, cabin),
                                 assets_folder() / "models");
}

// Its plate is cut for the gate, and its lever turns as the device's does.
bool Session::fits_stage(const SessionChoice& choice, const YokeGeometry& yoke) const {
  if (!stage_ || choice.gate != choice_.gate) return false;
  const YokeGeometry& now = trainer_->config().preset.lever.yoke;
  return yoke.radius == now.radius && yoke.theta_limit == now.theta_limit && yoke.phi_limit == now.phi_limit;
}

// What a person or a fault has taken, only a person gives back.
bool Session::keeps_forces() {
  if (!trainer_) return true;
  const GuardState guard = trainer_->snapshot().guard;
  return wants_forces_ && guard != GuardState::released && guard != GuardState::damped;
}

// All of it or nothing: what runs goes on until the new one stands.
void Session::change_to(const SessionChoice& choice) {
  const TrainerConfig config = trainer_config(choice);
  auto trainer = std::make_unique<Trainer>(config);
  if (!fits_stage(choice, config.preset.lever.yoke)) {
    stage_ = make_stage(*trainer, cabin_);
    new_model_ = true;
  }
  message_.clear();
  const bool armed = keeps_forces();
  if (trainer_ && trainer_->recording()) end_recording();
  player_.reset();
  trainer_ = std::move(trainer);
  new_trainer_ = true;
  ++run_;
  trainer_->set_controls(controls_);
  if (armed) trainer_->arm();
  feet_.reset();
  if (choice.hand == kTouringHand) feet_.emplace(trainer_->gate());
  if (choice.clock == TrainerClock::virtual_time) start_ns_ = -std::llround(1e9 * time_);
  choice_ = choice;
  const std::string limit = first_limit(trainer_->admitted());
  if (!limit.empty()) message_ += (message_.empty() ? "" : "; ") + limit;
}

void Session::look_from(std::string_view camera) {
  const Cabin cabin = cabin_seen_from(camera);
  if (cabin == cabin_) return;
  try {
    stage_ = make_stage(*trainer_, cabin);
    cabin_ = cabin;
    new_model_ = true;
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

void Session::lead(const HandTarget& hand, const DriverControls& controls) {
  trainer_->set_hand(hand);
  controls_ = controls;
}

void Session::obey(const PanelRequests& requests) {
  try {
    if (requests.stop) trainer_->stop();
    if (requests.disarm) trainer_->disarm();
    if (requests.arm) trainer_->arm();
    if (requests.stop || requests.disarm || requests.arm) wants_forces_ = requests.arm;
    if (requests.tuning) message_ = first_limit(trainer_->change_tuning(*requests.tuning));
    if (requests.record && recording()) {
      end_recording();
    } else if (requests.record) {
      start_recording();
    }
    if (requests.replay) start_replay();
    if (requests.save_preset) save_preset(*requests.save_preset);
    change_by(requests);
    if (requests.compare) {
      panel_.compared.reset();
      panel_.compared = read_preset(preset_file(*requests.compare).string());
    }
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

// What was tuned stays, unless a preset was asked for.
void Session::change_by(const PanelRequests& requests) {
  if (!requests.gate && !requests.preset && !requests.hand && !requests.restart) return;
  SessionChoice wanted = choice_;
  wanted.haptics = trainer_->config().preset.haptics;
  if (requests.gate) wanted.gate = *requests.gate;
  if (requests.hand) wanted.hand = *requests.hand;
  if (requests.restart) wanted.haptics = *requests.restart;
  if (requests.preset) {
    wanted.preset = *requests.preset;
    wanted.haptics.reset();
  }
  change_to(wanted);
}

DriverControls Session::driven() const {
  return feet_ ? deeper(feet_->at(trainer_->time(), car_.state()), controls_) : controls_;
}

void Session::advance(double seconds) {
  time_ += seconds;
  trainer_->set_controls(driven());
  if (choice_.clock == TrainerClock::virtual_time) trainer_->advance(seconds);
  if (const std::optional<std::string> problem = trainer_->take_recording_problem()) {
    (void)trainer_->stop_recording();
    message_ = *problem;
  }
  events_ = trainer_->take_events();
  for (HapticEvent& event : events_) event.time_ns -= start_ns_;
  history_ = trainer_->take_history(kMostHistory);
  shown_ = trainer_->snapshot();  // last: no older than the history
  const DriverControls controls = player_ ? replay(seconds) : driven();
  car_.step(controls, shown_.gear, seconds);
}

// What is shown is of the trace then, but for the guard: its state is that of the lever that runs.
DriverControls Session::replay(double seconds) {
  try {
    if (player_->advance(seconds)) {
      const GuardState guard = shown_.guard;
      const GuardFault fault = shown_.fault;
      shown_ = player_->snapshot();
      shown_.guard = guard;
      shown_.fault = fault;
      history_ = thinned(player_->passed(), kMostHistory);
      return player_->controls();
    }
    message_ = "replay done";
  } catch (const FileError& damaged) {
    message_ = damaged.what();
  }
  player_.reset();
  ++run_;
  return driven();
}

void Session::place() {
  stage_->place({shown_, car_.state(), time_});
  const glm::vec3 knob = stage_->knob();
  if (!player_)
    for (const HapticEvent& event : events_) cabin_sound_.hear(event, knob);
  cabin_sound_.update(shown_, car_.state(), ears_, knob, time_);
}

bool Session::take_new_trainer() {
  return std::exchange(new_trainer_, false);
}

bool Session::take_new_model() {
  return std::exchange(new_model_, false);
}

void Session::start_recording() {
  const fs::path folder = user_data_folder() / "recordings";
  make_folder(folder);
  const fs::path file = free_trace(folder, drive_name());
  trainer_->start_recording(file);
  last_recording_ = file;
  message_ = fmt::format("recording to {}", file.string());
}

bool Session::end_recording() {
  const std::optional<std::string> problem = trainer_->stop_recording();
  message_ = problem ? *problem : fmt::format("recorded: {}", last_recording_.string());
  return !problem;
}

void Session::start_replay() {
  if (recording() && !end_recording()) return;
  if (last_recording_.empty()) throw std::runtime_error("nothing has been recorded yet");
  player_.emplace(last_recording_);
  const TraceHeader& header = player_->header();
  const bool same_lever = header.device.yoke_radius == trainer_->device().yoke_radius &&
                          header.device.workspace == trainer_->device().workspace;
  if (header.gate_text != trainer_->config().layout.text || !same_lever) {
    player_.reset();
    throw std::runtime_error(fmt::format("{}: recorded in another gate or with another lever ({}): choose that first",
                                         last_recording_.string(), header.gate_file));
  }
  ++run_;
  message_ = fmt::format("replaying {}", last_recording_.string());
}

void Session::save_preset(const std::string& name) {
  const fs::path file = own_preset_file(name);
  Preset preset = trainer_->config().preset;
  preset.name = name;
  write_preset(preset, file);
  choice_.preset = name;
  panel_.presets = preset_names();
  message_ = fmt::format("saved as {}", file.string());
}

const PanelInput& Session::panel_input() {
  panel_.gate = &trainer_->gate();
  panel_.device = &trainer_->device();
  panel_.haptics = trainer_->config().preset.haptics;
  panel_.admitted = trainer_->admitted();
  panel_.now = shown_;
  panel_.run = run_;
  panel_.history = history_;
  panel_.events = player_ ? std::vector<HapticEvent>{} : events_;
  panel_.health = trainer_->health();
  panel_.car = car_.state();
  panel_.gate_name = choice_.gate;
  panel_.preset_name = choice_.preset;
  panel_.hand_name = choice_.hand.empty() ? "preset's" : choice_.hand;
  panel_.recording = trainer_->recording();
  panel_.message = message_;
  panel_.frame_ms = frame_ms_;
  return panel_;
}

}  // namespace gearshift
