// One person at the lever: the running lever, the car, the cabin and its sound. What the panel asks for is done here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/cabin_sound/cabin_sound.h"
#include "app/panel/panel.h"
#include "app/stage/stage.h"
#include "app/train/touring_feet.h"
#include "app/train/trace_player.h"
#include "app/trainer/trainer.h"
#include "app/vehicle/rolling_car.h"
#include "app/view/cabin_kind.h"

namespace gearshift {

inline constexpr std::string_view kTouringHand = "by itself";  // the hand that needs nobody
inline constexpr std::string_view kSimulatedDevice = "simulated";

// What can be chosen, by name.
struct SessionChoice {
  std::string gate = "paper";      // shipped, or a file
  std::string preset = "default";  // shipped, the user's own, or a file
  std::string hand;                // light, grip, arm, M,B,K or kTouringHand; empty: the preset's, or a grip
  std::string camera = "driver";   // the cabin is laid open for what is looked at
  TrainerClock clock = TrainerClock::real_time;
  SoundOutput sound = SoundOutput::card;
  std::uint64_t seed = 1;               // of the hand that needs nobody
  std::optional<HapticConfig> haptics;  // in place of the preset's
};

class Session {
 public:
  // Throws FileError, GltfError, std::invalid_argument or std::runtime_error with one sentence.
  explicit Session(const SessionChoice& choice);

  // A frame, in this order. Nothing here throws: a refusal becomes message().
  void lead(const HandTarget& hand, const DriverControls& controls);
  void obey(const PanelRequests& requests);
  void advance(double seconds);  // lever (on the virtual clock), events, car
  void place();                  // cabin and sound

  const Stage& stage() const { return *stage_; }
  void look_from(std::string_view camera);  // see cabin_seen_from()
  bool take_new_model();                    // once true after the stage was made anew
  bool take_new_trainer();                  // once true after gate, hand or device have changed
  const PanelInput& panel_input();
  Trainer& trainer() { return *trainer_; }
  const HapticSnapshot& shown() const { return shown_; }  // what the cabin shows: now, or the replay
  const std::vector<HapticEvent>& events() const {
    return events_;
  }  // of the running lever, in this frame; [ns] since the start
  const VehicleState& car() const { return car_.state(); }
  SoundWorld& sound() { return sound_; }
  double time() const { return time_; }                    // [s] since the start
  const std::string& message() const { return message_; }  // the last refusal or news, one sentence
  bool recording() const { return trainer_->recording(); }
  bool end_recording();  // false where it failed; what came of it is in message()
  void set_ears(const EyePose& ears) { ears_ = ears; }
  void set_frame_ms(double ms) { frame_ms_ = ms; }

 private:
  TrainerConfig trainer_config(const SessionChoice& choice) const;
  std::unique_ptr<Stage> make_stage(const Trainer& trainer, Cabin cabin) const;
  bool fits_stage(const SessionChoice& choice, const YokeGeometry& yoke) const;
  void change_to(const SessionChoice& choice);
  void change_by(const PanelRequests& requests);
  void start_recording();
  void start_replay();
  bool keeps_forces();
  DriverControls driven() const;
  DriverControls replay(double seconds);
  void save_preset(const std::string& name);

  SessionChoice choice_;
  Cabin cabin_;
  std::unique_ptr<Trainer> trainer_;
  std::unique_ptr<Stage> stage_;
  RollingCar car_;
  SoundWorld sound_;
  CabinSound cabin_sound_;
  std::optional<TracePlayer> player_;  // while it replays
  std::optional<TouringFeet> feet_;    // of the hand that needs nobody
  DriverControls controls_;            // a person's
  EyePose ears_;
  HapticSnapshot shown_;
  std::vector<HapticSnapshot> history_;  // of what is shown, in this frame
  std::vector<HapticEvent> events_;
  PanelInput panel_;
  std::filesystem::path last_recording_;
  std::string message_;
  bool wants_forces_ = true;   // the last of arm, release and stop
  std::int64_t start_ns_ = 0;  // [ns] of this session, on the lever's clock
  double time_ = 0.0;          // [s]
  double frame_ms_ = 0.0;      // [ms]
  std::uint64_t run_ = 0;      // PanelInput::run
  bool new_model_ = true;
  bool new_trainer_ = true;
};

}  // namespace gearshift
