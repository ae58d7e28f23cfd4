#include "app/train/session.h"

#include <algorithm>
#include <ctime>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/limited_words.h"
#include "app/output_folder.h"
#include "app/trainer/user_folder.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/preset_writer.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostHistory = 200;  // [snapshots] a frame

std::vector<std::string> user_presets() {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(user_presets_folder(), error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".toml") names.push_back(entry->path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// The user's own before the shipped one of that name.
fs::path preset_file(const std::string& name) {
  std::error_code error;
  const fs::path own = user_presets_folder() / (name + ".toml");
  return fs::exists(own, error) ? own : find_asset("presets", name);
}

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

std::unique_ptr<Stage> make_stage(const TrainerConfig& config, const Gate& gate) {
  StageConfig stage;
  stage.gate = gate;
  stage.gate_title = config.layout.name;
  stage.yoke = config.preset.lever.yoke;
  return std::make_unique<Stage>(stage, assets_folder() / "models");
}

std::string recording_name() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  return fmt::format("drive-{:04}{:02}{:02}-{:02}{:02}{:02}.trace", local.tm_year + 1900, local.tm_mon + 1,
                     local.tm_mday, local.tm_hour, local.tm_min, local.tm_sec);
}

std::string first_limit(const AdmittedTuning& admitted) {
  return admitted.limited.empty() ? std::string{} : limited_words(admitted.limited.front());
}

}  // namespace

Session::Session(const SessionChoice& choice)
    : choice_(choice), sound_(choice.sound), cabin_sound_(sound_, CabinSoundConfig{}) {
  controls_.ignition = true;
  change_to(choice);
  if (!sound_.why_silent().empty()) message_ = sound_.why_silent();
}

Session::~Session() = default;

TrainerConfig Session::trainer_config(const SessionChoice& choice) const {
  TrainerConfig config;
  config.preset = chosen_preset(choice);
  if (choice.haptics) config.preset.haptics = *choice.haptics;
  config.layout = read_gate_layout(find_asset("gates", choice.gate));
  config.hand = choice.hand == kTouringHand ? HandKind::touring : HandKind::led;
  config.clock = choice.clock;
  config.seed = choice.seed;
  config.program = "gearshift " GEARSHIFT_VERSION;
  return config;
}

// All of it or nothing: what runs goes on until the new one stands.
void Session::change_to(const SessionChoice& choice) {
  const TrainerConfig config = trainer_config(choice);
  auto trainer = std::make_unique<Trainer>(config);
  if (!stage_ || choice.gate != choice_.gate) {
    stage_ = make_stage(config, trainer->gate());
    new_model_ = true;
  }
  trainer_ = std::move(trainer);
  new_trainer_ = true;
  trainer_->set_controls(controls_);
  trainer_->arm();
  choice_ = choice;
  message_ = first_limit(trainer_->admitted());
}

void Session::lead(const HandTarget& hand, const DriverControls& controls) {
  trainer_->set_hand(hand);
  controls_ = controls;
  trainer_->set_controls(controls);
}

void Session::obey(const PanelRequests& requests) {
  try {
    if (requests.stop) trainer_->stop();
    if (requests.disarm) trainer_->disarm();
    if (requests.arm) trainer_->arm();
    if (requests.tuning) message_ = first_limit(trainer_->change_tuning(*requests.tuning));
    if (requests.record) toggle_recording();
    if (requests.replay) start_replay();
    if (requests.save_preset) save_preset(*requests.save_preset);
    SessionChoice wanted = choice_;
    if (requests.gate) wanted.gate = *requests.gate;
    if (requests.hand) wanted.hand = *requests.hand;
    if (requests.restart) wanted.haptics = *requests.restart;
    if (requests.preset) {
      wanted.preset = *requests.preset;
      wanted.haptics.reset();
    }
    if (requests.gate || requests.preset || requests.hand || requests.restart) change_to(wanted);
    if (requests.compare) panel_.compared = read_preset(preset_file(*requests.compare).string());
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

void Session::advance(double seconds) {
  time_ += seconds;
  if (choice_.clock == TrainerClock::virtual_time) trainer_->advance(seconds);
  events_ = trainer_->take_events();
  shown_ = trainer_->snapshot();
  DriverControls controls = controls_;
  try {
    if (player_ && player_->advance(seconds)) {
      shown_ = player_->snapshot();
      controls = player_->controls();
    } else if (player_) {
      player_.reset();
      message_ = "replay done";
    }
  } catch (const FileError& damaged) {
    player_.reset();
    message_ = damaged.what();
  }
  car_.step(controls, shown_.gear, seconds);
}

void Session::place() {
  stage_->place({shown_, car_.state(), time_});
  const glm::vec3 knob = stage_->knob();
  for (const HapticEvent& event : events_) cabin_sound_.hear(event, knob);
  cabin_sound_.update(shown_, car_.state(), ears_, knob, time_);
}

bool Session::take_new_trainer() {
  return std::exchange(new_trainer_, false);
}

bool Session::take_new_model() {
  return std::exchange(new_model_, false);
}

void Session::toggle_recording() {
  if (trainer_->recording()) {
    const std::optional<std::string> problem = trainer_->stop_recording();
    message_ = problem ? *problem : fmt::format("recorded: {}", last_recording_.string());
    return;
  }
  const fs::path folder = user_data_folder() / "recordings";
  make_folder(folder);
  last_recording_ = folder / recording_name();
  trainer_->start_recording(last_recording_);
  message_ = fmt::format("recording to {}", last_recording_.string());
}

void Session::start_replay() {
  if (trainer_->recording()) toggle_recording();
  if (last_recording_.empty()) throw std::runtime_error("nothing has been recorded yet");
  player_.emplace(last_recording_);
  message_ = fmt::format("replaying {}", last_recording_.string());
}

void Session::save_preset(const std::string& name) {
  Preset preset = trainer_->config().preset;
  preset.name = name;
  const fs::path folder = user_presets_folder();
  make_folder(folder);
  const fs::path file = folder / (name + ".toml");
  write_preset(preset, file);
  choice_.preset = name;
  message_ = fmt::format("saved as {}", file.string());
}

const PanelInput& Session::panel_input() {
  panel_.gate = &trainer_->gate();
  panel_.device = &trainer_->device();
  panel_.haptics = trainer_->config().preset.haptics;
  panel_.admitted = trainer_->admitted();
  panel_.now = shown_;
  panel_.history = trainer_->take_history(kMostHistory);
  panel_.events = events_;
  panel_.health = trainer_->health();
  panel_.car = car_.state();
  panel_.gate_name = choice_.gate;
  panel_.preset_name = choice_.preset;
  panel_.hand_name = choice_.hand.empty() ? "preset's" : choice_.hand;
  panel_.device_name = kSimulatedDevice;
  panel_.gates = shipped_names("gates");
  panel_.presets = shipped_names("presets");
  for (std::string& own : user_presets()) panel_.presets.push_back(std::move(own));
  panel_.hands = {"light", "grip", "arm", std::string(kTouringHand)};
  panel_.devices = {std::string(kSimulatedDevice)};
  panel_.recording = trainer_->recording();
  panel_.message = message_;
  panel_.frame_ms = frame_ms_;
  panel_.time = time_;
  return panel_;
}

}  // namespace gearshift
