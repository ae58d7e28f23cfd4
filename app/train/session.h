// One person at the lever: the running lever, the car, the cabin and its sound. What the panel asks for is done here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cabin_sound/cabin_sound.h"
#include "app/panel/panel.h"
#include "app/stage/stage.h"
#include "app/train/trace_player.h"
#include "app/trainer/trainer.h"
#include "app/vehicle/rolling_car.h"

namespace gearshift {

inline constexpr std::string_view kTouringHand = "by itself";  // the hand that needs nobody
inline constexpr std::string_view kSimulatedDevice = "simulated";

// What can be chosen, by name.
struct SessionChoice {
  std::string gate = "paper";      // shipped, or a file
  std::string preset = "default";  // shipped, the user's own, or a file
  std::string hand;                // light, grip, arm, M,B,K or kTouringHand; empty: the preset's, or a grip
  TrainerClock clock = TrainerClock::real_time;
  SoundOutput sound = SoundOutput::card;
  std::uint64_t seed = 1;               // of the hand that needs nobody
  std::optional<HapticConfig> haptics;  // in place of the preset's
};

class Session {
 public:
  // Throws FileError, GltfError, std::invalid_argument or std::runtime_error with one sentence.
  explicit Session(const SessionChoice& choice);
  ~Session();

  // A frame, in this order. Nothing here throws: a refusal becomes message().
  void lead(const HandTarget& hand, const DriverControls& controls);
  void obey(const PanelRequests& requests);
  void advance(double seconds);  // lever (on the virtual clock), events, car
  void place();                  // cabin and sound

  const Stage& stage() const { return *stage_; }
  bool take_new_model();    // once true after the stage was made anew
  bool take_new_trainer();  // once true after gate, hand or device have changed
  const PanelInput& panel_input();
  Trainer& trainer() { return *trainer_; }
  const HapticSnapshot& shown() const { return shown_; }              // what the cabin shows: now, or the replay
  const std::vector<HapticEvent>& events() const { return events_; }  // of this frame
  const VehicleState& car() const { return car_.state(); }
  SoundWorld& sound() { return sound_; }
  double time() const { return time_; }  // [s] since the start
  void set_message(std::string message) { message_ = std::move(message); }
  void toggle_recording();
  void set_ears(const EyePose& ears) { ears_ = ears; }
  void set_frame_ms(double ms) { frame_ms_ = ms; }

 private:
  TrainerConfig trainer_config(const SessionChoice& choice) const;
  void change_to(const SessionChoice& choice);
  void save_preset(const std::string& name);
  void start_replay();

  SessionChoice choice_;
  std::unique_ptr<Trainer> trainer_;
  std::unique_ptr<Stage> stage_;
  RollingCar car_;
  SoundWorld sound_;
  CabinSound cabin_sound_;
  std::optional<TracePlayer> player_;
  DriverControls controls_;
  EyePose ears_;
  HapticSnapshot shown_;
  std::vector<HapticEvent> events_;
  PanelInput panel_;
  std::filesystem::path last_recording_;
  std::string message_;
  double time_ = 0.0;      // [s]
  double frame_ms_ = 0.0;  // [ms]
  bool new_model_ = true;
  bool new_trainer_ = true;
};

}  // namespace gearshift
