// One person at the lever: the running lever with its car, the lessons, the cabin and its sound. What the panel asks for is
// done here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cabin_sound/cabin_sound.h"
#include "app/coach/coach.h"
#include "app/input/key_feet.h"
#include "app/panel/panel.h"
#include "app/replay/opening_drive.h"
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
  ~Session();  // the lever ends first

  // A frame, in this order. Nothing here throws: a refusal becomes message(). Keys move pedals on the car's clock from
  // here to the next lead(); each is as deep as the deeper of keys and controls.
  void lead(const HandTarget& hand, const DriverControls& controls, const FootKeys& keys = {});
  void obey(const PanelRequests& requests);
  void advance(double seconds);  // lever (on the virtual clock), events, lesson, replay
  void place();                  // cabin and sound

  void set_foot_pace(const FootPace& pace) { feet_->set_pace(pace); }

  // Looks at a recorded drive: at one of its shifts, or at all of it from then on [s]. Throws FileError,
  // std::invalid_argument or std::runtime_error with one sentence.
  void look_at(const std::filesystem::path& recording, std::optional<std::size_t> shift = std::nullopt,
               double from = 0.0);

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
  // Before the session ends: a lesson that is driven counts as left, the history has what it takes, and recordings that it
  // will not name are gone. Returns what could not be kept, one sentence; empty: all is.
  std::string settle();
  bool end_recording();  // false where it failed; what came of it is in message()
  void set_ears(const EyePose& ears) { ears_ = ears; }
  void set_frame_ms(double ms) { frame_ms_ = ms; }
  void tell(const std::string& news) { message_ = news; }
  // Of a headset; none: nobody wears one.
  void set_headset(std::optional<HeadsetReport> report) { panel_.headset = std::move(report); }
  // How far the seen lever is from the felt one already, before it is clamped: so much less may the clamp take. [m]
  void set_seen_offset(double offset) { seen_offset_ = offset; }
  void set_pointer(const std::optional<Beam>& beam) { pointer_ = beam; }  // of a hand that points, in the cabin
  void set_keys(std::vector<KeyHint> keys) { panel_.keys = std::move(keys); }
  void set_mouse_leads(bool leads) { panel_.mouse_leads = leads; }
  bool replays() const { return player_.has_value(); }
  bool replay_is_over() const { return player_ && !player_->plays(); }
  bool replays_shift() const { return player_ && player_->shift(); }

 private:
  // session_stick.cpp: the lever that a person holds
  bool arm();
  void follow_stick();
  Gate check_stick(TrainerConfig config) const;
  std::unique_ptr<Trainer> hand_over(const TrainerConfig& config);
  void check_gear_of(const Lesson& lesson, const Gate& gate) const;

  // session.cpp: the lever that runs, its cabin, a frame
  void change_to(const SessionChoice& choice, const Lesson* lesson = nullptr,
                 std::string_view what = "it begins again");  // what: leaves a lesson that is driven
  void change_by(const PanelRequests& requests);
  std::string limit_words() const;
  void close_what_ran(std::string_view what);
  void take_over(std::unique_ptr<Trainer> trainer, const Lesson* lesson);
  PersonFeet feet(int lever) const;
  bool keeps_forces();
  void show(const Gate& gate, const std::string& text, const YokeGeometry& yoke, Cabin cabin);
  const Gate& shown_gate() const;
  void sound_car(const CarSpec& car);
  void take_events();
  void take_cycles();
  void look();
  void tell_sound();
  void save_preset(const std::string& name);

  // session_lessons.cpp
  void obey_instructor(const LessonRequests& requests);
  void offer_first(const SessionChoice& choice);
  void offer(const Lesson& lesson);
  void change_comment(const LessonRequests::CommentChange& change);
  void change_learner(const std::string& name);
  void leave_lesson();
  void tell_left(std::string_view what);
  void begin_lesson();
  std::filesystem::path record_lesson(const Lesson& lesson);  // empty where it cannot be
  void follow_lesson(std::span<const DriveSample> cycles);
  void hold();
  void look_whether_lost();
  DriverControls led() const;
  bool remove_unnamed();

  // session_replay.cpp
  void obey_viewer(const ReplayRequests& requests);
  void open_last();
  void open(const std::filesystem::path& recording, std::optional<double> near);  // [s] where a shift begins
  void end_opening();
  void show_opened();
  void give_up_opening();
  void look_at(Player player);
  void show_replay(double seconds);
  void end_replay();
  void check_free_to_look() const;

  // session_recordings.cpp
  std::filesystem::path recordings_folder() const;
  void toggle_recording();
  void start_recording(const std::string& name);
  void end_lesson_recording();
  void tell_recording_problem();

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
  std::unique_ptr<OpeningDrive> opening_;                        // while one is read
  std::optional<double> opening_near_;                           // [s] the shift that is looked for in it
  std::optional<Player> player_;                                 // while it replays
  std::shared_ptr<KeyFeet> feet_ = std::make_shared<KeyFeet>();  // a person's; the lever's thread moves them
  int lever_ = 0;                                                // of all so far the one that has the feet
  DriverControls controls_;                                      // a person's, but for these
  DriverControls driven_;                                        // in the newest cycle
  double slope_ = 0.0;                                           // [rad] of the lesson's road
  bool held_ = false;  // after a lesson the teacher holds the car: until the next, none, or another car, gate or hand
  std::size_t faults_ = 0;  // of the trial that is driven, so far
  bool is_lost_ = false;    // it cannot be passed any more
  std::optional<CarSwitches> switches_;
  EyePose ears_;
  double seen_offset_ = 0.0;  // [m]
  std::optional<Beam> pointer_;
  HapticSnapshot shown_;
  VehicleState car_;                     // that is shown
  std::vector<HapticSnapshot> history_;  // of what is shown, in this frame
  std::vector<HapticEvent> events_;
  PanelInput panel_;
  std::filesystem::path last_recording_;
  std::set<std::string> lesson_recordings_;  // files that lessons made by themselves
  std::string message_;
  std::string why_silent_;       // in the frame before
  bool wants_forces_ = true;     // the last of arm, release and stop
  bool armed_now_ = false;       // by a person, in this frame
  bool stick_is_there_ = false;  // in the frame before
  bool records_lesson_ = false;  // the recording that runs
  bool is_torn_ = false;         // of a lesson, and the last one
  std::int64_t start_ns_ = 0;    // [ns] of this session, on the lever's clock
  std::int64_t newest_ns_ = 0;   // [ns] of its newest snapshot, on the same
  double time_ = 0.0;            // [s]
  double frame_ms_ = 0.0;        // [ms]
  std::uint64_t run_ = 0;        // PanelInput::run
  bool new_model_ = true;
  bool new_trainer_ = true;
};

}  // namespace gearshift
