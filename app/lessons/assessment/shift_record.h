// Measurements of one shift, used for grading and feedback.
//
// A shift begins when the clutch pedal passes its bite point downwards or the lever leaves the gear's rest position,
// whichever is first. The shift ends when gear and clutch are engaged again, or when the driver gives up: the clutch
// has been up for 2 s without a gear.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/record_field.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// The steps of a shift, in the order that the lessons teach.
enum class ShiftStep : std::uint8_t { throttle_off, clutch_down, neutral, gear, clutch_up, throttle_on };
inline constexpr std::string_view kShiftStepNames[] = {"throttle_off", "clutch_down", "neutral",
                                                       "gear",         "clutch_up",   "throttle_on"};
constexpr std::string_view to_string(ShiftStep step) noexcept {
  return kShiftStepNames[static_cast<std::size_t>(step)];
}
inline std::string format_steps(const std::vector<ShiftStep>& steps) {  // "throttle_off clutch_down neutral"
  std::string text;
  for (const ShiftStep step : steps) {
    if (!text.empty()) text += ' ';
    text += to_string(step);
  }
  return text;
}

struct ShiftRecord {
  std::int64_t number = 0;  // number of the shift in its lesson run, from 0
  double begin = 0.0;       // [s] on the haptic loop's clock
  double end = 0.0;         // [s]
  int from = haptics::kNeutralGear;
  int to = haptics::kNeutralGear;  // gear engaged at the end
  bool guided = false;             // a guidance force was active or still fading, so the shift is not graded

  // Time
  double clutch_time = 0.0;  // [s] time with the pedal pressed beyond the bite point
  double lever_time = 0.0;   // [s] time from leaving one gear to engaging the next
  double clutch_lead = 0.0;  // [s] time from clutch down to gear left; negative: gear left first
  // [s] time from gear engaged to clutch up; negative: clutch up first, even if it was pressed again later
  double clutch_lag = 0.0;
  double torque_gap = 0.0;  // [s] time with less than 5 % of the drive torque from before the shift

  // Engine and clutch
  double engine_speed = 0.0;  // [rad/s] engine speed at the beginning of the shift
  double slip_energy = 0.0;   // [J]
  // [rad/s] engine speed minus shaft speed when the clutch first transmits torque after the gear was engaged
  double rev_error = 0.0;
  double flare = 0.0;  // [rad/s] rise of engine speed while the clutch was down

  // Comfort
  double jerk_peak = 0.0;  // [m/s^3] largest jerk, from the acceleration after a 15 Hz second-order low-pass

  // Lever
  double force_peak = 0.0;       // [N] largest hand force
  double impulse = 0.0;          // [N s] integral of the hand's force over time
  double path_length = 0.0;      // [m] distance travelled by the lever
  double path_efficiency = 1.0;  // [1] path length divided by the shortest path through the gate, >= 1
  int wrong_columns = 0;         // number of slots entered off the path, except slots of gears that were engaged
  double block_time = 0.0;       // [s] time spent pushing against a blocking synchroniser
  double grind_time = 0.0;       // [s]
  double grind_energy = 0.0;     // [J]
  bool missed = false;           // the driver gave up, or returned to the same gear

  std::vector<ShiftStep> steps;  // in the order in which they happened
  int steps_out_of_place = 0;    // edit distance to the nearest order that the lessons teach
};

constexpr void each_field(FieldsOf<ShiftRecord> auto&& record, auto&& visit) {
  visit(RecordField{"shift"}, record.number);
  visit(RecordField{"from_gear", "", 0, true}, record.from);
  visit(RecordField{"to_gear", "", 0, true}, record.to);
  visit(RecordField{"guided"}, record.guided);
  visit(RecordField{"missed"}, record.missed);
  visit(RecordField{"steps"}, record.steps);
  visit(RecordField{"begin_s"}, record.begin);
  visit(RecordField{"end_s"}, record.end);
  visit(RecordField{"clutch_time_s"}, record.clutch_time);
  visit(RecordField{"lever_time_s"}, record.lever_time);
  visit(RecordField{"clutch_lead_s", "Clutch down before lever [s]", 2}, record.clutch_lead);
  visit(RecordField{"clutch_lag_s", "Clutch up after gear [s]", 2}, record.clutch_lag);
  visit(RecordField{"torque_gap_s", "No drive [s]", 2}, record.torque_gap);
  visit(RecordField{"engine_speed_rad_per_s"}, record.engine_speed);
  visit(RecordField{"slip_energy_j", "Clutch heat [J]"}, record.slip_energy);
  visit(RecordField{"rev_error_rad_per_s"}, record.rev_error);
  visit(RecordField{"flare_rad_per_s"}, record.flare);
  visit(RecordField{"jerk_peak_m_per_s3", "Jerk [m/s³]", 1}, record.jerk_peak);
  visit(RecordField{"force_peak_n", "Push [N]", 1}, record.force_peak);
  visit(RecordField{"impulse_n_s", "Impulse [N s]", 1}, record.impulse);
  visit(RecordField{"path_length_m"}, record.path_length);
  visit(RecordField{"path_efficiency", "Path / shortest", 2}, record.path_efficiency);
  visit(RecordField{"wrong_columns"}, record.wrong_columns);
  visit(RecordField{"block_time_s"}, record.block_time);
  visit(RecordField{"grind_time_s"}, record.grind_time);
  visit(RecordField{"grind_energy_j"}, record.grind_energy);
  visit(RecordField{"steps_out_of_place"}, record.steps_out_of_place);
}

}  // namespace gearshift::lessons
