// The tables of the history, and the scripts that bring an older file up to date.
#pragma once

#include <array>
#include <string>
#include <tuple>

namespace gearshift::lessons {

// Application ids, stored in the file header.
inline constexpr int kApplicationId = 0x47534c48;     // "GSLH"
inline constexpr int kOldApplicationId = 0x47534849;  // "GSHI": written until 0.1.0, no longer read

// The tables of the newest version, as SQL.
std::string schema();

// Script i upgrades a file from version i + 1 to i + 2. All needed scripts run in one
// transaction, with foreign keys off, so that recreating a table does not delete dependent rows.
inline constexpr std::array<const char*, 2> kUpgrades{
    // Version 2: figures of a run, how it was graded (0: by the old rule), and the car's unit of speed.
    // Learners whose names look equal are joined, too (History::State::join_equal_learners).
    "ALTER TABLE lesson_run ADD COLUMN jerk_peak_m_per_s3 REAL;"
    "ALTER TABLE lesson_run ADD COLUMN rev_error_rad_per_s REAL;"
    "ALTER TABLE lesson_run ADD COLUMN clutch_lead_error_s REAL;"
    "ALTER TABLE lesson_run ADD COLUMN clutch_lag_error_s REAL;"
    "ALTER TABLE lesson_run ADD COLUMN path_efficiency REAL;"
    "ALTER TABLE lesson_run ADD COLUMN impulse_n_s REAL;"
    "ALTER TABLE lesson_run ADD COLUMN graded_by INTEGER NOT NULL DEFAULT 0;"
    "ALTER TABLE lesson_run ADD COLUMN score REAL;"
    "ALTER TABLE driving_error ADD COLUMN speed_unit INTEGER NOT NULL DEFAULT 0;",
    // Version 3: car and gate, help by limb. Until then only the lever gave help, with a strength that was not stored.
    "ALTER TABLE lesson_run ADD COLUMN car TEXT NOT NULL DEFAULT '';"
    "ALTER TABLE lesson_run ADD COLUMN path_length_m REAL NOT NULL DEFAULT 0;"
    "ALTER TABLE lesson_run ADD COLUMN lever_help REAL NOT NULL DEFAULT 0;"
    "ALTER TABLE lesson_run ADD COLUMN pedal_help REAL NOT NULL DEFAULT 0;"
    "UPDATE lesson_run SET lever_help = 1 WHERE guided;"};
inline constexpr int kSchemaVersion = 1 + static_cast<int>(std::tuple_size_v<decltype(kUpgrades)>);

}  // namespace gearshift::lessons
