// Someone who drives a lesson: sees what a driver sees, and moves hand and feet as a person can.
//
// It works from the lesson alone: each step's condition says what to do (lesson_intent.h). There is no code per lesson.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "app/learner/foot.h"
#include "app/learner/learner_hand.h"
#include "app/learner/learner_skill.h"
#include "app/learner/lesson_intent.h"
#include "app/training/drive_sample.h"
#include "app/training/lesson.h"
#include "app/vehicle/car_spec.h"
#include "haptics/device/gaussian_noise.h"
#include "haptics/gate/gate.h"

namespace gearshift {

class SimulatedLearner {
 public:
  // car and gate must outlive the learner. period: of the calls to act() [s], > 0. Seeded.
  SimulatedLearner(const Lesson& lesson, const CarSpec& car, const Gate& gate, const LearnerSkill& skill,
                   const LearnerFaults& faults, std::uint64_t seed, double period);

  // Before the first act(): feet and key are where these are, not at rest.
  void take_over(const DriverControls& controls) noexcept;

  // Once a cycle: the cycle that was and the step that the lesson is at, to what is done in the next, without the
  // teacher's guidance. Allocates.
  DriverAction act(const DriveSample& now, std::size_t step);

  // Nothing goes on any more: a person would ask for help.
  bool gives_up() const noexcept { return gives_up_; }

 private:
  enum class Errand { none, wrong_gear, blocked, missed, back };  // what is done instead of the shift that was meant

  struct Shift {
    int gear = kNeutralGear;
    Errand errand = Errand::none;
    bool between_gears = false;
    bool uses_clutch = true;
    bool clutch_early = false;
    bool comes_up = false;      // the clutch, too early
    bool in_hand = false;       // the hand is on its way
    double lift_at = 0.0;       // [s] the throttle
    double flares_until = 0.0;  // [s] it is pressed instead
    double press_at = 0.0;      // [s] the clutch
    double hand_lead = 0.0;     // [s] after the clutch has passed its bite point
  };

  struct Feet {
    Foot throttle, brake, clutch, hand_brake;
  };

  void notice(std::size_t step, double time);
  const LessonIntent& intent() const noexcept { return intents_[known_]; }
  double reading_of(std::size_t step) const noexcept;
  std::optional<double> speed_to_shift(std::size_t step) const noexcept;
  double launch_target() const noexcept;
  bool once(FaultKind kind) noexcept;
  bool is_due(FaultKind kind) const noexcept;
  double noise(double spread) noexcept { return spread * chance_.next(); }
  double asked(const DriveSample& now, int gear) const noexcept;

  bool foot_is_free(double time) noexcept;
  bool restarts(const DriveSample& now);
  std::optional<int> wanted_gear(const DriveSample& now) const;
  bool spins_shaft(const DriveSample& now) const noexcept;
  bool shifts_late(const DriveSample& now) const noexcept;
  bool shifts_early(const DriveSample& now) const noexcept;
  void begin_shift(const DriveSample& now, int gear);
  Errand errand_for(const DriveSample& now, int gear) noexcept;
  int wrong_gear_for(int gear, int from) const noexcept;
  void follow_shift(const DriveSample& now);
  void shift_feet(const DriveSample& now);
  void shift_hand(const DriveSample& now);
  void reach(const DriveSample& now, int gear);
  std::vector<HandStroke> strokes_to(glm::dvec2 from, int old_gear, int gear) const;
  std::vector<HandStroke> strokes_into_mouth(glm::dvec2 from, int old_gear, int gear) const;
  void draw_back(const DriveSample& now);
  bool waits_for_shaft(const DriveSample& now) const noexcept;
  bool is_behind_detent(const DriveSample& now) const noexcept;
  bool has_arrived(const DriveSample& now) const noexcept;
  void end_shift(const DriveSample& now);
  void rest_hand(const DriveSample& now);

  void drive(const DriveSample& now);
  void set_brakes(const DriveSample& now);
  void go_on(const DriveSample& now);
  void creep(const DriveSample& now);
  void slow_down(const DriveSample& now);
  void stand(const DriveSample& now);
  void release(const DriveSample& now);
  void release_rolling(const DriveSample& now, double turns);
  bool revs_fit(const DriveSample& now, double speed);
  void launch(const DriveSample& now);
  bool means_ill(const DriveSample& now) const noexcept;
  bool spoils_launch(const DriveSample& now);
  void hold_revs(double speed);
  bool feels_bite(const DriveSample& now) const noexcept;
  void press_clutch();

  bool over_revs(const DriveSample& now);
  bool coasts(const DriveSample& now);
  std::optional<int> reverse_too_soon(const DriveSample& now) const;
  std::optional<int> too_low_a_gear(const DriveSample& now) const;
  bool lugs(const DriveSample& now);
  int lugging_gear(const DriveSample& now) const noexcept;
  bool brakes_to_stall(const DriveSample& now) const noexcept;
  bool stalls_by_brake(const DriveSample& now);

  Lesson lesson_;  // as it is driven in this car
  const CarSpec& car_;
  const Gate& gate_;
  LearnerSkill skill_;
  LearnerFaults faults_;
  std::vector<LessonIntent> intents_;
  GaussianNoise chance_;
  double period_;
  Feet feet_;
  LearnerHand hand_;
  std::array<bool, kFaultKinds> done_{};  // deeds that are done once

  std::size_t known_ = 0, seen_ = 0;
  double seen_at_ = -1.0;          // [s]
  double reaction_ = 0.0;          // [s] to the step that was seen last
  double on_throttle_at_ = -10.0;  // [s] the right foot
  double progress_at_ = 0.0;
  bool gives_up_ = false;
  bool ignition_ = false, starter_ = false;
  bool has_run_ = false, ran_ = false;  // the engine, ever and in the cycle before

  bool shifting_ = false;
  Shift shift_;
  double pause_until_ = 0.0;     // [s] nothing is begun before
  double gear_in_at_ = -10.0;    // [s]
  double release_at_ = 0.0;      // [s] the clutch comes up, not before
  double clutch_down_at_ = 0.0;  // [s] it passed its bite point downwards
  bool clutch_is_down_ = false;
  double release_rate_ = 1.0;  // [1/s] of this release
  double abrupt_ = 1.0;        // [1/s] the same, where it shall jerk
  double ear_ = 1.0;           // [1] engine speed that is meant, over the right one
  double launch_speed_ = 0.0;  // [rad/s] that this launch is meant with
  double brake_effort_ = 1.0;  // [1] of the brake, at a call
  double blip_since_ = -1.0;   // [s]
  double heard_ = 0.0;         // [rad/s] of the engine
  double fit_since_ = 0.0;     // [s]
  bool revs_fit_ = false;
  bool launching_ = false;
  bool saves_ = false;  // the engine, from dying
  int lug_gear_ = kNeutralGear;
  double lugged_ = 0.0;         // [s]
  double lug_since_ = 0.0;      // [s]
  double rolls_since_ = 0.0;    // [s]
  double slow_since_ = 0.0;     // [s] the engine is heard to fall to where the clutch must go down
  double coasts_until_ = 0.0;   // [s] 0: not yet
  bool lingers_ = false;        // in a gear that is to be left
  bool over_rev_late_ = false;  // the lesson drives a low gear out: shifted too late; else howls
};

}  // namespace gearshift
