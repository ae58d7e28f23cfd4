// One person at the lever: the running lever with its car, the lessons, the cabin and its sound. What the panel asks for is
// done here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cabin_sound/cabin_sound.h"
#include "app/coach/coach.h"
#include "app/panel/panel.h"
#include "app/replay/player.h"
#include "app/stage/stage.h"
#include "app/train/chosen.h"
#include "app/train/session_choice.h"
#include "app/trainer/trainer.h"
#include "app/view/cabin_kind.h"

namespace gearshift {

// How the car stands when a lesson begins: the person's own switches follow.
struct CarSwitches {
  bool ignition = true;
  double hand_brake = 0.0;  // [1]
};

class Session {
 public:
  // Throws FileError, GltfError, std::invalid_argument or std::runtime_error with one sentence.
  explicit Session(const SessionChoice& choice);

  // A frame, in this order. Nothing here throws: a refusal becomes message().
  void lead(const HandTarget& hand, const DriverControls& controls);
  void obey(const PanelRequests& requests);
  void advance(double seconds);  // lever (on the virtual clock), events, lesson, replay
  void place();                  // cabin and sound

  // Looks at a recorded drive, at one of its shifts or at all of it. Throws FileError, std::invalid_argument or
  // std::runtime_error with one sentence.
  void look_at(const std::filesystem::path& recording, std::optional<std::size_t> shift = std::nullopt);

  const Stage& stage() const { return *stage_; }
  void look_from(std::string_view camera);     // see cabin_seen_from()
  bool take_new_model();                       // once true after the stage was made anew
  bool take_new_trainer();                     // once true after gate, car, hand or device have changed
  std::optional<CarSwitches> take_switches();  // once after a lesson has begun
  const PanelInput& panel_input();
  Trainer& trainer() { return *trainer_; }
  const Coach& coach() const { return coach_; }
  const HapticSnapshot& shown() const { return shown_; }  // what the cabin shows: now, or the replay
  const VehicleState& car() const { return car_; }        // the same
  const std::optional<CarSpec>& car_spec() const { return trainer_->config().car; }
  const std::vector<HapticEvent>& events() const {
    return events_;
  }  // of the running lever, in this frame; [ns] since the start
  SoundWorld& sound() { return sound_; }
  double time() const { return time_; }  // [s] of frames since the start
  double lever_time() const {
    return 1e-9 * static_cast<double>(newest_ns_ - start_ns_);
  }                                                        // [s] of the lever that runs
  const std::string& message() const { return message_; }  // the last refusal or news, one sentence
  bool recording() const { return trainer_ && trainer_->recording(); }
  bool end_recording();  // false where it failed; what came of it is in message()
  void set_ears(const EyePose& ears) { ears_ = ears; }
  void set_frame_ms(double ms) { frame_ms_ = ms; }
  void set_keys(std::vector<KeyHint> keys) { panel_.keys = std::move(keys); }
  void set_mouse_leads(bool leads) { panel_.mouse_leads = leads; }
  bool replays() const { return player_.has_value(); }

 private:
  TrainerConfig trainer_config(const SessionChoice& choice, const ChosenCar& chosen, const Lesson* lesson) const;
  void show(const Gate& gate, const std::string& text, const YokeGeometry& yoke, Cabin cabin);
  const Gate& shown_gate() const;
  void change_to(const SessionChoice& choice, const Lesson* lesson = nullptr);
  void change_by(const PanelRequests& requests);
  void sound_car(const CarSpec& car);
  bool keeps_forces();
  DriverControls led() const;

  void obey_instructor(const LessonRequests& requests);
  void offer_first(const SessionChoice& choice);
  void begin_lesson();
  std::filesystem::path record_lesson(const Lesson& lesson);  // empty where it cannot be
  void follow_lesson(std::span<const DriveSample> cycles);

  void obey_viewer(const ReplayRequests& requests);
  void end_lesson_recording();
  void look_at_last();
  void end_replay();
  void show_replay(double seconds);

  void check_free_to_look() const;
  std::filesystem::path recordings_folder() const;
  void toggle_recording();
  void start_recording(const std::string& name);
  void save_preset(const std::string& name);

  SessionChoice choice_;   // a person's
  SessionChoice running_;  // the same, but for what a lesson brings; car and gate are never empty
  Cabin cabin_;
  Coach coach_;
  std::unique_ptr<Trainer> trainer_;
  std::unique_ptr<Stage> stage_;
  std::string stage_gate_;   // layout text that the stage was made for
  YokeGeometry stage_yoke_;  // the same
  SoundWorld sound_;
  CabinSound cabin_sound_;
  std::optional<Player> player_;  // while it replays
  DriverControls controls_;       // a person's
  double slope_ = 0.0;            // [rad] of the lesson's road
  bool held_ = false;             // a lesson is over: the teacher holds the car until the next, or none
  std::optional<CarSwitches> switches_;
  EyePose ears_;
  HapticSnapshot shown_;
  VehicleState car_;                     // that is shown
  std::vector<HapticSnapshot> history_;  // of what is shown, in this frame
  std::vector<HapticEvent> events_;
  PanelInput panel_;
  std::filesystem::path last_recording_;
  std::string message_;
  bool wants_forces_ = true;     // the last of arm, release and stop
  bool armed_now_ = false;       // by a person, in this frame
  bool records_lesson_ = false;  // the recording that runs
  std::int64_t start_ns_ = 0;    // [ns] of this session, on the lever's clock
  std::int64_t newest_ns_ = 0;   // [ns] of its newest snapshot, on the same
  double time_ = 0.0;            // [s]
  double frame_ms_ = 0.0;        // [ms]
  std::uint64_t run_ = 0;        // PanelInput::run
  bool new_model_ = true;
  bool new_trainer_ = true;
};

}  // namespace gearshift
