// Skill of a simulated driver, and the errors that the driver makes on purpose.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/lessons/assessment/driving_error.h"

namespace gearshift::lessons {

// The default values describe a practised driver. Engineering values.
struct DriverSkill {
  double reaction = 0.20;            // [s] from seeing an event to the first movement
  double timing_spread = 0.020;      // [s] standard deviation of the start of hand and foot movements
  double aim_noise = 0.001;          // [m] standard deviation of a stroke's end point, per axis
  double pedal_noise = 0.004;        // [1] standard deviation of the position of a pedal that is held
  double rev_spread = 0.03;          // [1] relative standard deviation of the intended engine speed
  double release_spread = 0.08;      // [1] relative standard deviation of clutch release speed and braking force
  double pace = 0.35;                // [m/s] mean speed of a lever stroke
  double release_haste = 1.0;        // [1] clutch release speed divided by the correct speed
  double hearing_delay = 0.08;       // [s] delay from engine sound to foot movement
  double foot_change = 0.20;         // [s] time to move the right foot from throttle to brake
  double brake_effort = 1.0;         // [1] brake pedal in an emergency stop, where 1 is needed
  double launch_speed_factor = 1.0;  // [1] intended engine speed at a launch divided by the correct speed
  double reading_time = 0.0;         // [s] time to read a prompt, before the reaction
  double max_bite_drop = 0.18;       // [1] relative drop of engine speed at which the left foot pauses the release
  double throttle_factor = 1.0;      // [1] throttle while accelerating and cruising, divided by the usual one
  double bite_error = 0.0;       // [1] pedal position at which the driver expects the bite point, minus the true one
  bool blips = false;            // matches the revs in every downshift, not only where the lesson asks for it
  bool double_clutches = false;  // in downshifts, lets the clutch up in neutral to match the revs
  bool operator==(const DriverSkill&) const = default;
};

// Relative standard deviations of the styles of equally skilled drivers [1]. Each value is multiplied by exp(N(0, s)).
// Engineering values; no measurements were found.
struct StyleSpread {
  double pace = 0.15;      // of the hand
  double reaction = 0.20;  // also the time to move the right foot to the brake
  double haste = 0.15;     // of clutch releases
  double gas = 0.08;       // engine speed at a launch, and throttle
  double hearing = 0.25;
  double bite_error = 0.01;  // [1] standard deviation of DriverSkill::bite_error
};

// Returns `skill` in the style of one driver. The same seed gives the same style.
DriverSkill in_style(const DriverSkill& skill, std::uint64_t seed, const StyleSpread& spread = {});

// Interpolates between a practised driver (`error` = 0) and a beginner (`error` = 1). `error` [1] is clamped to 0 to 1.
DriverSkill skill_of(double error) noexcept;

// How strongly the simulated driver makes each kind of error on purpose. 0: not at all. 1: so clearly that every
// observer would notice the error.
//
// Errors with a duration or a strength are made at every opportunity and grow with `amount`. All-or-nothing errors (a
// wrong slot, a stall) are made once, at the first opportunity, if `amount` is at least 0.5.
//
//   stall              releases the clutch without throttle, or brakes with the clutch up
//   over_rev           shifts too late with an open throttle; without a low gear: revs up with the clutch down
//   lugging            drives in too high a gear with an open throttle
//   clutch_dump        takes the foot off the pedal at high revs
//   clutch_early       lets the clutch up past its bite point before the gear is in
//   clutch_late        moves the lever 0.35 s (times the amount) before pressing the pedal
//   no_clutch          does not use the pedal
//   riding_clutch      rests the foot on the pedal
//   riding_lever       rests the hand on the knob, pushing with 6 N (times the amount)
//   throttle_in_shift  keeps the throttle pressed for 0.6 s (times the amount) of the shift
//   rev_mismatch       does not blip where a blip is needed
//   grind              does not wait before reverse (a forward gear grinds only in a worn gearbox)
//   blocked            pushes weakly towards first gear at speed
//   missed_shift       pulls the lever back before the gear is engaged, then pauses
//   wrong_gear, wrong_column   enters a wrong gear, or the mouth of a wrong slot, first
//   over_push          pushes on synchroniser and end stop with 60 N, plus 35 N times the amount
//   step_order         presses the throttle 0.6 s (times the amount) before the clutch comes up
//   rollback           releases the handbrake before the bite point
//   jerk               releases the clutch abruptly at high revs
//   early_shift, late_shift    shifts outside the lesson's band, or far from the speed that a step asks for
//   too_slow           keeps the clutch down for 4 s (times the amount)
//   wrong_direction    shifts before the car has stopped
//   slow_step          starts a timed step only after 1.5 times its allowed time (times the amount)
//   coasting           rolls for 5.5 s (times the amount) with the clutch open
//   clutch_burn        launches at much too high an engine speed
//   early_downshift    shifts into the lower gear at once instead of slowing down first
struct DeliberateErrors {
  std::array<double, kErrorKindCount> amount{};  // [1] >= 0
  double of(ErrorKind kind) const noexcept { return amount[static_cast<std::size_t>(kind)]; }
};
DeliberateErrors deliberate_error(ErrorKind kind, double amount = 1.0) noexcept;

}  // namespace gearshift::lessons
