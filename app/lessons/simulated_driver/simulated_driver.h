// A simulated driver: perceives what a real driver perceives, and moves hand and feet as a real driver can.
//
// The lesson is the driver's only instruction: each step's condition defines what to do (lesson_intent.h). No code is
// specific to one lesson.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/simulated_driver/driver_skill.h"
#include "app/lessons/simulated_driver/foot.h"
#include "app/lessons/simulated_driver/lesson_intent.h"
#include "app/lessons/simulated_driver/stroke_hand.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/device/gaussian_noise.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

class SimulatedDriver {
 public:
  // `car` and `gate` must outlive the driver. `period`: time between two calls of act() [s], > 0.
  SimulatedDriver(const Lesson& lesson, const vehicle::CarSpec& car, const haptics::Gate& gate,
                  const DriverSkill& skill, const DeliberateErrors& errors, std::uint64_t seed, double period);

  // Call before the first act(): feet and key start from these positions.
  void take_over(const haptics::DriverControls& controls) noexcept;

  // Call once per cycle with the sample of the previous cycle and the number of the current step. Returns the action
  // for the next cycle; its guidance is not set. Allocates memory.
  vehicle::DriverAction act(const vehicle::DriveSample& now, std::size_t step);

  // True if the driver made no progress for so long that a learner would ask for help.
  bool has_given_up() const noexcept { return has_given_up_; }

 private:
  enum class Detour { none, wrong_gear, blocked, missed, back };  // deliberate deviation from the planned shift

  struct Shift {
    int gear = haptics::kNeutralGear;
    Detour detour = Detour::none;
    bool between_gears = false;
    bool is_down = false;                // between forward gears, to a lower one
    int then = haptics::kNeutralGear;    // gear after neutral when double-clutching; kNeutralGear: none
    bool is_revving_in_neutral = false;  // double-clutching: the clutch is up in neutral
    bool has_revved = false;             // double-clutching: the throttle holds the revs of the lower gear
    bool uses_clutch = true;
    bool clutch_early = false;
    bool releases_early = false;  // the clutch is coming up too early
    bool in_hand = false;         // the hand has started to move
    double lift_at = 0.0;         // [s] when the throttle is released
    double flares_until = 0.0;    // [s] until this time the throttle stays pressed, as a deliberate error
    double press_at = 0.0;        // [s] when the clutch is pressed
    double hand_lead = 0.0;       // [s] time from clutch at bite point to the start of the hand's movement
  };

  struct Feet {
    Foot throttle, brake, clutch, hand_brake;
  };

  void notice(std::size_t step, double time);
  const LessonIntent& intent() const noexcept { return intents_[current_step_]; }
  double reading_time_of(std::size_t step) const noexcept;
  std::optional<double> speed_to_shift(std::size_t step) const noexcept;
  std::optional<double> revs_to_shift(std::size_t step, double vehicle::EngineSpec::*advice) const noexcept;
  double launch_target() const noexcept;
  bool mark_done(ErrorKind kind) noexcept;
  bool is_due(ErrorKind kind) const noexcept;
  double noise(double spread) noexcept { return spread * random_.next(); }
  double shaft_speed_in(const vehicle::DriveSample& now, int gear) const noexcept;

  bool is_foot_free(double time) noexcept;
  bool handle_restart(const vehicle::DriveSample& now);
  std::optional<int> wanted_gear(const vehicle::DriveSample& now) const;
  bool should_spin_shaft(const vehicle::DriveSample& now) const noexcept;
  bool should_shift_late(const vehicle::DriveSample& now) const noexcept;
  bool should_shift_early(const vehicle::DriveSample& now) const noexcept;
  void begin_shift(const vehicle::DriveSample& now, int gear);
  Detour detour_for(const vehicle::DriveSample& now, int gear) noexcept;
  int wrong_gear_for(int gear, int from) const noexcept;
  void follow_shift(const vehicle::DriveSample& now);
  void rev_in_neutral(const vehicle::DriveSample& now);
  void shift_feet(const vehicle::DriveSample& now);
  void shift_hand(const vehicle::DriveSample& now);
  void reach(const vehicle::DriveSample& now, int gear);
  std::vector<haptics::HandStroke> strokes_to(glm::dvec2 from, int old_gear, int gear) const;
  std::vector<haptics::HandStroke> strokes_into_mouth(glm::dvec2 from, int old_gear, int gear) const;
  void draw_back(const vehicle::DriveSample& now);
  bool waits_for_shaft(const vehicle::DriveSample& now) const noexcept;
  bool has_arrived(const vehicle::DriveSample& now) const noexcept;
  void end_shift(const vehicle::DriveSample& now);
  void rest_hand(const vehicle::DriveSample& now);

  void drive(const vehicle::DriveSample& now);
  void set_brakes(const vehicle::DriveSample& now);
  void drive_on(const vehicle::DriveSample& now);
  void creep(const vehicle::DriveSample& now);
  void hold_on_the_clutch(const vehicle::DriveSample& now);
  bool is_held() const noexcept;
  bool is_pulled_downhill(int gear) const noexcept;
  void slow_down(const vehicle::DriveSample& now);
  void stop(const vehicle::DriveSample& now);
  void release(const vehicle::DriveSample& now);
  void release_rolling(const vehicle::DriveSample& now, double gear_speed);
  bool match_revs(const vehicle::DriveSample& now, double speed);
  void launch(const vehicle::DriveSample& now);
  bool has_pending_error(const vehicle::DriveSample& now) const noexcept;
  bool spoil_launch(const vehicle::DriveSample& now);
  void hold_revs(double speed);
  bool feels_bite(const vehicle::DriveSample& now) const noexcept;
  void press_clutch();

  bool make_over_rev(const vehicle::DriveSample& now);
  bool make_coasting(const vehicle::DriveSample& now);
  std::optional<int> early_reverse_gear(const vehicle::DriveSample& now) const;
  std::optional<int> early_downshift_gear(const vehicle::DriveSample& now) const;
  bool make_lugging(const vehicle::DriveSample& now);
  int lugging_gear(const vehicle::DriveSample& now) const noexcept;
  bool should_stall_by_brake(const vehicle::DriveSample& now) const noexcept;
  bool make_brake_stall(const vehicle::DriveSample& now);

  Lesson lesson_;
  const vehicle::CarSpec& car_;
  double bite_;  // [1] pedal position at which the driver expects the bite point
  const haptics::Gate& gate_;
  DriverSkill skill_;
  DeliberateErrors errors_;
  std::vector<LessonIntent> intents_;
  haptics::GaussianNoise random_;
  double period_;
  Feet feet_;
  StrokeHand hand_;
  std::array<bool, kErrorKindCount> done_errors_{};  // errors made only once that are already made

  std::size_t current_step_ = 0, noticed_step_ = 0;
  double noticed_at_ = -1.0;       // [s]
  double reaction_ = 0.0;          // [s] reaction time for the last step that was noticed
  double on_throttle_at_ = -10.0;  // [s] time when the right foot was last on the throttle
  double progress_at_ = 0.0;
  bool has_given_up_ = false;
  bool ignition_ = false, starter_ = false;
  bool has_run_ = false, was_running_ = false;  // engine ran before; engine ran in the last cycle

  bool shifting_ = false;
  Shift shift_;
  double pause_until_ = 0.0;     // [s] no shift starts before this time
  double gear_in_at_ = -10.0;    // [s]
  double release_at_ = 0.0;      // [s] the clutch stays down until this time
  double clutch_down_at_ = 0.0;  // [s] when the clutch passed its bite point downwards
  bool clutch_is_down_ = false;
  double release_rate_ = 1.0;     // [1/s] rate of the current clutch release
  double abrupt_rate_ = 1.0;      // [1/s] rate of a clutch release with a deliberate jerk
  double rev_bias_ = 1.0;         // [1] intended engine speed divided by the correct one
  double launch_speed_ = 0.0;     // [rad/s] intended engine speed of the current launch
  double brake_effort_ = 1.0;     // [1] brake pedal position for a call to stop
  double blip_since_ = -1.0;      // [s]
  double perceived_speed_ = 0.0;  // [rad/s] engine speed as heard
  double matched_since_ = 0.0;    // [s]
  bool are_revs_matched_ = false;
  bool launching_ = false;
  bool is_rescuing_ = false;  // pressing the clutch to save the engine from stalling
  int lug_gear_ = haptics::kNeutralGear;
  double lug_time_ = 0.0;       // [s]
  double lug_since_ = 0.0;      // [s]
  double rolls_since_ = 0.0;    // [s]
  double slow_since_ = 0.0;     // [s] when the engine first sounded so slow that the clutch must be pressed
  double coasts_until_ = 0.0;   // [s] end of deliberate coasting; 0: not started
  bool is_lingering_ = false;   // deliberately staying too long in a gear
  bool over_rev_late_ = false;  // true: the over_rev error is made by a late shift; false: with the clutch down
};

}  // namespace gearshift::lessons
