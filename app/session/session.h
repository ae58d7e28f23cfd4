// A session: lever and car in force, lessons, replays and recordings, with the cabin and its sound. Executes what the
// user asks for in the panel.
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

#include "app/cabin/sound/cabin_sound.h"
#include "app/cabin/stage/stage.h"
#include "app/cabin/view/cabin_kind.h"
#include "app/lessons/school/server_link.h"
#include "app/session/drive_recorder.h"
#include "app/session/lesson_director.h"
#include "app/session/lever_in_force.h"
#include "app/session/replay_viewer.h"
#include "app/session/session_choice.h"
#include "app/ui/panel/panel.h"

namespace gearshift::session {

class Session {
 public:
  // Throws FileError, GltfError, std::invalid_argument or std::runtime_error with a one-sentence message.
  explicit Session(const SessionChoice& choice);

  // A frame is advance(), with the hand and controls last set by lever().set_driver(), and update_cabin(); apply() may be
  // called at any time. They do not throw: if a command is rejected, message() says why.
  LeverInForce& lever() { return lever_; }
  // Executes the commands in this order, except that STOP comes first and cancels any arming before it. A rejected
  // command does not stop those after it.
  void apply(const ui::PanelCommands& commands);
  void apply(const ui::PanelCommand& command) { apply(ui::PanelCommands{command}); }
  void advance(double seconds);  // advances lesson, replay and a loop on the virtual clock; reads events
  // Places the cabin's parts and plays the sounds of the frame. `pointer`: the beam of the pointing hand, in cabin
  // coordinates; empty: no beam
  void update_cabin(const engine::EyePose& ears = {}, const std::optional<cabin::Beam>& pointer = {});

  // Replays a recorded drive: the shift with the index `shift` or, if `shift` is empty, the whole drive. `from` [s]:
  // start time in the recording. Throws FileError, std::invalid_argument or std::runtime_error with a one-sentence
  // message.
  void open_replay(const std::filesystem::path& recording, std::optional<std::size_t> shift = std::nullopt,
                   double from = 0.0);

  const cabin::Stage& stage() const { return *stage_; }
  void set_camera(std::string_view camera);  // see cabin_for_camera()
  bool take_new_model();                     // true once after the stage was rebuilt
  ui::PanelInput panel_input() const;        // valid until the next call of a function that is not const
  runtime::Runtime& runtime() { return lever_.runtime(); }
  const lessons::Coach& coach() const { return director_.coach(); }
  const haptics::HapticSnapshot& shown() const { return shown_; }  // lever shown in the cabin, live or replayed
  const vehicle::VehicleState& car() const { return car_; }        // car shown in the cabin, live or replayed
  const std::vector<haptics::HapticEvent>& events() const {
    return events_;
  }  // events of the running loop in this frame; times [ns] since the start of the session
  engine::SoundWorld& sound() { return sound_; }
  double time() const { return time_; }  // [s] sum of all frame times since the session start
  // [s] time of the running loop's newest snapshot, from the start of the session
  double lever_time() const { return 1e-9 * static_cast<double>(newest_ns_ - start_ns_); }
  const std::string& message() const { return message_; }  // last message, e.g. a rejection; one sentence
  bool recording() const { return lever_.exists() && lever_.runtime().is_recording(); }
  // Call before the session ends. Ends a running lesson early, saves pending results and deletes recordings that the
  // history does not reference. Returns a sentence that says what could not be saved; empty if everything was saved.
  std::string save_and_stop();
  bool end_recording();  // returns false if the recording failed; message() describes the result
  void set_frame_ms(double ms) { frame_ms_ = ms; }
  void set_message(const std::string& message) { message_ = message; }
  // `report`: the state of the headset; empty if no headset is open.
  void set_headset(std::optional<cabin::HeadsetReport> report) { panel_.headset = std::move(report); }
  // `offset` [m]: distance between displayed and felt lever due to the seat calibration. The displayed lever is also
  // limited to the gate, which adds to this distance. If the sum exceeds `ghost_offset`, the lever is flagged as past
  // the wall (kFlagGhost).
  void set_visual_offset(double offset) { visual_offset_ = offset; }
  void set_keys(std::vector<ui::KeyHint> keys) { panel_.keys = std::move(keys); }
  void set_mouse_leads(bool leads) { panel_.mouse_moves_lever = leads; }
  const std::vector<ui::KeyHint>& keys() const { return panel_.keys; }
  void set_reply(std::string reply) { panel_.reply = std::move(reply); }  // see PanelInput::reply
  void set_held_throttle(double held) { panel_.held_throttle = held; }    // [1] by the keys
  bool is_replaying() const { return viewer_.player() != nullptr; }
  bool is_replay_over() const { return is_replaying() && !viewer_.player()->is_playing(); }
  bool is_replaying_shift() const { return viewer_.shift() != nullptr; }

 private:
  // Data for the panel that no other member holds.
  struct PanelData {
    std::vector<std::string> gates, presets, cars, hands;
    std::string device_name;
    std::optional<haptics::Preset> compared;
    std::optional<cabin::HeadsetReport> headset;
    std::vector<ui::KeyHint> keys;
    bool mouse_moves_lever = false;
    std::string reply;
    double held_throttle = 0.0;
  };

  // Defined in session.cpp.
  void rebuild_stage(const haptics::Gate& gate, const std::string& text, const haptics::YokeGeometry& yoke,
                     cabin::Cabin cabin);
  std::span<const haptics::HapticEvent> live_events() const;
  const haptics::Gate& displayed_gate() const;
  void find_way();
  void configure_sound(const vehicle::CarSpec& car);
  void follow(runtime::RuntimeFrame frame);
  void report_sound();
  void finish_opening();
  void show_replay(double seconds);

  // Defined in session_commands.cpp.
  struct Handlers;
  void arm();
  SessionChoice current_choice() const;
  void change_choice(const SessionChoice& wanted, std::string_view reason);
  void offer_in_its_gate(const SessionChoice& choice, const lessons::Lesson& lesson);
  void add_message(const std::string& message);  // after the present one
  // Replaces the lever. `reason`: reported if this ends a lesson. `chosen`: see LeverInForce::hand_over(). If the new
  // lever is rejected, the old one keeps running unchanged; if a stick's new lever fails although it was accepted, the
  // old one runs again, without forces.
  void switch_to(const SessionChoice& choice, const lessons::Lesson* lesson = nullptr,
                 std::string_view reason = "the loop was restarted", const SessionChoice* chosen = nullptr);
  void show_lever_in_force();
  void close_current(std::string_view reason);
  void toggle_recording();
  void end_lesson_recording();
  void save_preset(const std::string& name);
  void change_learner(const std::string& name);
  void rename_learner(const std::string& name);
  void begin_lesson();
  std::filesystem::path record_lesson(const std::string& lesson);
  void end_lesson();
  void report_early_end(std::string_view reason);
  void open_last_recording();
  void open_recording(const std::filesystem::path& recording, std::optional<double> near);
  void check_can_replay() const;
  void show_opened();
  void start_replay(lessons::Player player);
  void close_replay();

  LessonDirector director_;
  ReplayViewer viewer_;
  DriveRecorder recorder_;

  cabin::Cabin cabin_;
  std::unique_ptr<cabin::Stage> stage_;
  std::string stage_gate_;            // text of the gate file for which the stage was built
  haptics::YokeGeometry stage_yoke_;  // yoke for which the stage was built
  engine::SoundWorld sound_;
  cabin::CabinSound cabin_sound_;
  double visual_offset_ = 0.0;  // [m] see set_visual_offset()

  haptics::DriverControls newest_controls_;
  haptics::HapticSnapshot shown_;
  vehicle::VehicleState car_;                     // displayed state of the car
  std::vector<haptics::HapticSnapshot> history_;  // lever samples of this frame for the plots
  std::vector<haptics::HapticEvent> events_;
  std::vector<glm::dvec2> way_;  // [m] from the lever to the gear that the lesson wants; empty: none
  PanelData panel_;
  std::string message_;
  std::string why_silent_;      // sound_.silence_reason() in the previous frame
  std::int64_t start_ns_ = 0;   // [ns] start of this session, on the loop's clock
  std::int64_t newest_ns_ = 0;  // [ns] time of the newest snapshot, on the loop's clock
  double time_ = 0.0;           // [s] see time()
  std::optional<lessons::ServerLink> server_link_;
  double frame_ms_ = 0.0;  // [ms] length of the last frame
  std::uint64_t run_ = 0;  // see PanelInput::run
  bool new_model_ = true;
  LeverInForce lever_;  // last, so that its motors stop first: other destructors may take long, as without a sound card
};

}  // namespace gearshift::session
