// The lever and car in force: which runtime runs, whether it has forces, and who holds lever and pedals.
//
// Another gate, car, hand or preset needs another runtime. prepare() makes or checks it while the old one keeps
// running; hand_over() then replaces the old one. Only one runtime at a time may use a real stick.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/lessons/assessment/lesson.h"
#include "app/runtime/runtime.h"
#include "app/session/resolve_choice.h"
#include "app/session/session_choice.h"

namespace gearshift::session {

// Ignition and hand brake at the start of a lesson. The caller must set the user's switches to these values.
struct CarSwitches {
  bool ignition = true;
  double hand_brake = 0.0;  // [1] 0: released, 1: fully applied
  double brake = 0.0;       // [1] the instructor holds the foot brake there until the user presses it
};

// The first limit that the device imposes on a tuning, as a sentence; empty: none
std::string first_limit(const haptics::AdmittedTuning& admitted);

// A lesson's additions to the driver's controls: the slope of its road, and help for hand and feet.
struct LessonControls {
  double slope = 0.0;     // [rad]
  double guidance = 0.0;  // [1] 0 to 1
  int guided_gear = haptics::kNeutralGear;
  double pedal_help = 0.0;  // [1] 0 to 1
};

class LeverInForce {
 public:
  explicit LeverInForce(const SessionChoice& choice) : choice_(choice) { controls_.ignition = true; }

  // A lever that is ready to replace the one in force.
  struct Next {
    SessionChoice choice;  // with the names of the car and gate in use, which are never empty
    std::string gate_text;
    runtime::RuntimeConfig config;
    std::unique_ptr<runtime::Runtime> runtime;  // null for a stick, which the old runtime still uses
    haptics::Gate gate;
    std::optional<CarSwitches> switches;  // not empty if the lever is for a lesson
  };
  // Throws FileError, std::invalid_argument or std::runtime_error with a one-sentence message; nothing then changes.
  // `lesson`: null if the lever is for free driving.
  Next prepare(const SessionChoice& choice, const lessons::Lesson* lesson) const;
  // Replaces the lever in force. The new one has forces as runtime::kForceRules says. `chosen`: the user's choice from
  // then on; null: unchanged, as for a lesson. If a stick's new lever cannot be made, the old one is made again, without
  // forces, and this throws.
  void hand_over(Next next, const SessionChoice* chosen = nullptr);

  // Switches forces on. Returns false if this is refused, because the stick is not plugged in.
  bool arm();
  void disarm();
  void stop();
  // Begins a frame: ends the stick's forces if it was unplugged, and sends the controls. Returns the stick's messages,
  // separated by "; "; may be empty.
  std::string begin_frame(const LessonControls& lesson);

  // The user's hand at once, controls and pedal keys from the next send_controls() on. Each pedal is as far down as in
  // `controls` or as `keys` move it in the car's time, whichever is further down.
  void set_driver(const haptics::HandTarget& hand, const haptics::DriverControls& controls,
                  const haptics::PedalKeys& keys = {});
  bool are_pedal_keys_held() const { return keys_ != haptics::PedalKeys{}; }  // by the user
  // The instructor holds clutch and brake after a lesson, until release_car() or the next lever.
  void hold_car() { is_car_held_ = true; }
  void release_car() { is_car_held_ = false; }
  bool is_car_held() const { return is_car_held_; }
  // Passes the controls to the runtime: the user's, or the instructor's, on the lesson's road.
  void send_controls(const LessonControls& lesson);

  bool exists() const { return runtime_ != nullptr; }
  runtime::Runtime& runtime() { return *runtime_; }
  const runtime::Runtime& runtime() const { return *runtime_; }
  const SessionChoice& choice() const { return choice_; }                                // the user's
  const SessionChoice& running() const { return running_; }                              // in use; names car and gate
  void set_preset(const std::string& name) { choice_.preset = running_.preset = name; }  // saved under this name
  void set_learner(const std::string& name) { choice_.learner = name; }
  bool is_stick_connected() const { return is_stick_connected_; }
  std::string describe_limit() const;  // first limit of the tuning, as a sentence; may be empty

  // True once after gate, car, hand or device changed.
  bool take_new_runtime() { return std::exchange(is_new_, false); }
  // Not empty once after a lesson began.
  std::optional<CarSwitches> take_switches() { return std::exchange(switches_, std::nullopt); }

 private:
  void hand_over_pedals(runtime::RuntimeConfig& config) const;
  bool wants_forces_after_hand_over();
  void check_lever_gear(const lessons::Lesson& lesson, const haptics::Gate& gate) const;
  std::unique_ptr<runtime::Runtime> replace_runtime(const runtime::RuntimeConfig& config);
  std::unique_ptr<runtime::Runtime> old_runtime(runtime::RuntimeConfig config) const;

  SessionChoice choice_, running_;
  std::unique_ptr<runtime::Runtime> runtime_;
  haptics::DriverControls controls_;  // the user's, without the pedals that keys press
  haptics::PedalKeys keys_;           // the user's
  std::optional<CarSwitches> switches_;
  bool is_car_held_ = false;
  double start_brake_ = 0.0;         // [1] foot brake that the instructor still holds at the start of a lesson
  bool has_just_armed_ = false;      // the user switched forces on in this frame; see ForceCause::new_lever_of_armed
  bool is_stick_connected_ = false;  // the stick was connected in the previous frame
  bool is_new_ = false;
};

}  // namespace gearshift::session
