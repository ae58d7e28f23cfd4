// Names of a shift's quantities with their units, used as database columns and CSV headers.
#pragma once

#include "app/lessons/assessment/shift_record.h"

namespace gearshift::lessons {

// Calls visit(name, field) for every double and every count of `record`, in the order of ShiftRecord. The record may be
// const.
constexpr void each_figure(auto& record, auto&& visit) {
  visit("begin_s", record.begin);
  visit("end_s", record.end);
  visit("clutch_time_s", record.clutch_time);
  visit("lever_time_s", record.lever_time);
  visit("torque_gap_s", record.torque_gap);
  visit("engine_speed_rad_per_s", record.engine_speed);
  visit("slip_energy_j", record.slip_energy);
  visit("slip_power_peak_w", record.slip_power_peak);
  visit("rev_error_rad_per_s", record.rev_error);
  visit("flare_rad_per_s", record.flare);
  visit("clutch_lead_s", record.clutch_lead);
  visit("clutch_lag_s", record.clutch_lag);
  visit("jerk_peak_m_per_s3", record.jerk_peak);
  visit("vibration_dose_m_per_s175", record.vibration_dose);
  visit("force_peak_n", record.force_peak);
  visit("impulse_n_s", record.impulse);
  visit("wall_work_j", record.wall_work);
  visit("path_length_m", record.path_length);
  visit("path_efficiency", record.path_efficiency);
  visit("overshoot_m", record.overshoot);
  visit("wrong_columns", record.wrong_columns);
  visit("block_time_s", record.block_time);
  visit("grind_time_s", record.grind_time);
  visit("grind_energy_j", record.grind_energy);
  visit("steps_out_of_place", record.steps_out_of_place);
}

}  // namespace gearshift::lessons
