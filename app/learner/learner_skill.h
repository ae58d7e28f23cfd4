// How well a simulated learner does it, and what is wrong with how he does it.
#pragma once

#include <array>
#include <cstddef>

#include "app/training/drive_fault.h"

namespace gearshift {

// A practised driver. [engineering value]s: reaction of 0.2 s to what is expected, a foot good to half a percent.
struct LearnerSkill {
  double reaction = 0.20;        // [s] from what is seen to the first movement
  double timing_spread = 0.020;  // [s] standard deviation of when hand and foot begin
  double aim_noise = 0.001;      // [m] standard deviation of where a stroke ends, each axis
  double pedal_noise = 0.004;    // [1] standard deviation of a pedal that is held in between
  double rev_spread = 0.03;      // [1] relative, of the engine speed that is meant
  double release_spread = 0.08;  // [1] relative, of how fast the clutch comes up, and of how hard the brake is pressed
  double pace = 0.35;            // [m/s] mean speed of a stroke of the lever
  double haste = 1.0;            // [1] how much faster than it should the clutch comes up, on the whole
  double hearing = 0.08;         // [s] by which the engine's sound is late in what the feet do
  double foot_change = 0.20;     // [s] of the right foot, from the throttle to the brake
  double brake_effort = 1.0;     // [1] of the brake, where it should be all of it at once
  double gas = 1.0;              // [1] of the engine speed that a launch needs, that is meant
  double reading = 0.0;          // [s] to read what a step says, before the reaction to it
  double bite_fall = 0.18;       // [1] by which the engine falls at the bite point until the left foot waits for it
  bool operator==(const LearnerSkill&) const = default;
};

// Between a practised driver (error 0) and one who begins (error 1). error: [1] 0 to 1.
LearnerSkill skill_of(double error) noexcept;

// How much of each fault the learner does on purpose; 0: none, 1: so that nobody would overlook it.
//
// What has a time or a strength is done at every occasion and grows with the amount; what is done or not (a wrong slot,
// a stall) is done once, at the first occasion, from 0.5 on.
//
//   stall              lets the clutch up without throttle, or brakes with the clutch up
//   over_rev           shifts too late, throttle open; where no low gear is driven: howls with the clutch down
//   lugging            a gear too high, throttle open
//   clutch_dump        high revs, then the foot off the pedal
//   clutch_early       clutch past its bite point while the ring still turns
//   clutch_late        pulls the lever 0.35 s (times the amount) before pressing the pedal
//   no_clutch          leaves the pedal alone
//   riding_clutch      the foot stays on the pedal
//   riding_lever       the hand stays on the knob and leans, 6 N
//   throttle_in_shift  lifts the throttle 0.6 s too late
//   rev_mismatch       no blip where one is asked for
//   grind              does not wait before reverse (a forward gear grinds in a worn box alone)
//   blocked            pushes feebly to first at speed
//   missed_shift       draws back before the gear is in and gives up for a while
//   wrong_gear, wrong_column   a wrong gear, a wrong slot's mouth, first
//   over_push          impatient with the synchroniser and the end stop: 55 N and 35 N more
//   step_order         throttle 0.6 s before the clutch comes up
//   rollback           lets the hand brake off before the bite point
//   jerk               clutch up abruptly at high revs
//   early_shift, late_shift    outside the lesson's band, or far from the speed that a step says
//   too_slow           4 s with the clutch down
//   wrong_direction    shifts before the car stands
//   slow_step          begins a step that has a time once 1.5 times that has gone
//   coasting           rolls on for 5.5 s with the clutch open
//   clutch_burn        twice the throttle that a launch needs
//   early_downshift    the lower gear at once, instead of slowing down for it first
struct LearnerFaults {
  std::array<double, kFaultKinds> amount{};  // [1] >= 0
  double of(FaultKind kind) const noexcept { return amount[static_cast<std::size_t>(kind)]; }
};
LearnerFaults only(FaultKind kind, double amount = 1.0) noexcept;

}  // namespace gearshift
