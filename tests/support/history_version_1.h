// SQL that turns an empty or filled history of version 3 into one of version 1.
#pragma once

namespace gearshift::test {

inline constexpr const char* kToHistoryVersion1 =
    "ALTER TABLE driving_error DROP COLUMN speed_unit;"
    "ALTER TABLE lesson_run DROP COLUMN jerk_peak_m_per_s3;"
    "ALTER TABLE lesson_run DROP COLUMN rev_error_rad_per_s;"
    "ALTER TABLE lesson_run DROP COLUMN clutch_lead_error_s;"
    "ALTER TABLE lesson_run DROP COLUMN clutch_lag_error_s;"
    "ALTER TABLE lesson_run DROP COLUMN path_efficiency;"
    "ALTER TABLE lesson_run DROP COLUMN impulse_n_s;"
    "ALTER TABLE lesson_run DROP COLUMN graded_by;"
    "ALTER TABLE lesson_run DROP COLUMN score;"
    "ALTER TABLE lesson_run DROP COLUMN car;"
    "ALTER TABLE lesson_run DROP COLUMN path_length_m;"
    "ALTER TABLE lesson_run DROP COLUMN lever_help;"
    "ALTER TABLE lesson_run DROP COLUMN pedal_help;"
    "PRAGMA user_version = 1;";

}  // namespace gearshift::test
