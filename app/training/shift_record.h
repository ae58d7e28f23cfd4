// One shift, measured: what facts of scoring and coaching stand on.
//
// A shift begins when the clutch pedal passes its bite point downwards or the lever leaves the gear's rest, whichever is
// first, and ends when gear and clutch are in again (or the driver gives up: 2 s without a gear, the clutch up).
#pragma once

#include <cstdint>
#include <vector>

#include "haptics/gate/gate.h"

namespace gearshift {

// What a shift consists of, in the order that is taught.
enum class ShiftStep : std::uint8_t { throttle_off, clutch_down, neutral, gear, clutch_up, throttle_on };

struct ShiftRecord {
  std::int64_t number = 0;  // in its lesson run, from 0
  double begin = 0.0;       // [s] on the loop's clock
  double end = 0.0;         // [s]
  int from = kNeutralGear;
  int to = kNeutralGear;  // what was engaged at the end
  bool guided = false;    // a guidance force was on, or still fading: never graded

  // Time
  double clutch_time = 0.0;  // [s] pedal past the bite point on its way down until past it on its way up
  double lever_time = 0.0;   // [s] gear left until gear engaged
  double torque_gap = 0.0;   // [s] with less than 5 % of the drive torque before the shift

  // Engine and clutch
  double engine_speed = 0.0;     // [rad/s] at its begin
  double slip_energy = 0.0;      // [J]
  double slip_power_peak = 0.0;  // [W]
  double rev_error = 0.0;        // [rad/s] engine less shaft at the first clutch torque after the gear was in
  double flare = 0.0;            // [rad/s] rise of the engine's speed while the clutch was down
  double clutch_lead = 0.0;      // [s] gear left after the clutch was down; negative: before
  double clutch_lag = 0.0;       // [s] clutch up after the gear was in; negative: before, though it was pressed again

  // Comfort
  double jerk_peak = 0.0;       // [m/s^3] of the acceleration after a 15 Hz second-order low-pass
  double vibration_dose = 0.0;  // [m/s^1.75] VDV, ISO 2631-1: fourth-power dose of the acceleration, unweighted

  // Lever
  double force_peak = 0.0;       // [N] of the hand
  double impulse = 0.0;          // [N s] integral of the hand's force
  double wall_work = 0.0;        // [J] integral of wall force times penetration speed, pushing in
  double path_length = 0.0;      // [m] of the lever
  double path_efficiency = 1.0;  // [1] path length over the shortest way through the gate, >= 1
  double overshoot = 0.0;        // [m] the lever's deepest place beyond the drawn lever
  int wrong_columns = 0;         // mouths entered off the way, but those of gears that were in
  double block_time = 0.0;       // [s] pushed against a blocking synchroniser
  double grind_time = 0.0;       // [s]
  double grind_energy = 0.0;     // [J]
  bool missed = false;           // gave up, or came back to the gear it left

  std::vector<ShiftStep> steps;  // as they happened
  int steps_out_of_place = 0;    // edit distance to the nearest of the orders that are taught
};

}  // namespace gearshift
