// SQL that turns an empty or filled history of the newest version into one of version 1.
#pragma once

namespace gearshift::test {

inline constexpr const char* kToHistoryVersion1 =
    "DROP TRIGGER learner_insert;"
    "DROP TRIGGER learner_update;"
    "DROP TRIGGER learner_delete;"
    "DROP TRIGGER session_insert;"
    "DROP TRIGGER lesson_run_insert;"
    "DROP TRIGGER lesson_run_update;"
    "DROP TRIGGER shift_insert;"
    "DROP TRIGGER driving_error_insert;"
    "DROP TRIGGER comment_insert;"
    "DROP TRIGGER comment_update;"
    "DROP TRIGGER comment_delete;"
    "DROP TABLE server_learner;"
    "DROP TABLE server;"
    "DROP TABLE unsent;"
    "DROP TABLE last_number;"
    "ALTER TABLE lesson_run DROP COLUMN kept_at;"
    "ALTER TABLE driving_error DROP COLUMN speed_unit;"
    "ALTER TABLE lesson_run DROP COLUMN jerk_peak_m_per_s3;"
    "ALTER TABLE lesson_run DROP COLUMN rev_error_rad_per_s;"
    "ALTER TABLE lesson_run DROP COLUMN clutch_lead_error_s;"
    "ALTER TABLE lesson_run DROP COLUMN clutch_lag_error_s;"
    "ALTER TABLE lesson_run DROP COLUMN path_efficiency;"
    "ALTER TABLE lesson_run DROP COLUMN impulse_n_s;"
    "ALTER TABLE lesson_run DROP COLUMN pedal_corrections_per_s;"
    "ALTER TABLE lesson_run DROP COLUMN graded_by;"
    "ALTER TABLE lesson_run DROP COLUMN score;"
    "ALTER TABLE lesson_run DROP COLUMN car;"
    "ALTER TABLE lesson_run DROP COLUMN path_length_m;"
    "ALTER TABLE lesson_run DROP COLUMN lever_help;"
    "ALTER TABLE lesson_run DROP COLUMN pedal_help;"
    "PRAGMA user_version = 1;";

}  // namespace gearshift::test
