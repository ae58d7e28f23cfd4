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
// Learners whose names look equal are joined by version 2, too (History::State::join_equal_learners).
inline constexpr std::array<const char*, 1> kUpgrades{
    "ALTER TABLE driving_error ADD COLUMN speed_unit INTEGER NOT NULL DEFAULT 0;",
};
inline constexpr int kSchemaVersion = 1 + static_cast<int>(std::tuple_size_v<decltype(kUpgrades)>);

}  // namespace gearshift::lessons
