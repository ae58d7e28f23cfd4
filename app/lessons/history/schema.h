// The tables of the history.
#pragma once

#include <array>
#include <tuple>

namespace gearshift::lessons {

// Application ids, stored in the file header.
inline constexpr int kApplicationId = 0x47534c48;     // "GSLH"
inline constexpr int kOldApplicationId = 0x47534849;  // "GSHI": written until 0.1.0, no longer read

// Row numbers are never reused (AUTOINCREMENT). Otherwise a program that is still recording a run of an erased learner
// could write into the rows of a later learner. A row in pending_erasure means that erased data may still be in the log
// or in free pages.
inline constexpr const char* kSchema = R"sql(
CREATE TABLE learner (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  name TEXT NOT NULL UNIQUE,
  made_at TEXT NOT NULL,
  next_lesson TEXT NOT NULL DEFAULT '');
CREATE TABLE session (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  learner INTEGER NOT NULL REFERENCES learner ON DELETE CASCADE,
  begun_at TEXT NOT NULL,
  program TEXT NOT NULL);
CREATE TABLE settings (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  session INTEGER NOT NULL REFERENCES session ON DELETE CASCADE,
  set_at TEXT NOT NULL,
  text TEXT NOT NULL);
CREATE TABLE lesson_run (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  session INTEGER NOT NULL REFERENCES session ON DELETE CASCADE,
  begun_at TEXT NOT NULL,
  recording TEXT NOT NULL,
  lesson TEXT NOT NULL,
  task TEXT NOT NULL,
  mode INTEGER NOT NULL,
  ended INTEGER NOT NULL,
  guided INTEGER NOT NULL,
  complete INTEGER NOT NULL,
  begin_s REAL NOT NULL,
  duration_s REAL NOT NULL,
  grade REAL NOT NULL,
  passed INTEGER NOT NULL,
  why TEXT NOT NULL,
  slip_energy_j REAL NOT NULL,
  engine_work_j REAL NOT NULL);
CREATE TABLE shift (
  run INTEGER NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
  number INTEGER NOT NULL,
  from_gear INTEGER NOT NULL,
  to_gear INTEGER NOT NULL,
  guided INTEGER NOT NULL,
  missed INTEGER NOT NULL,
  steps TEXT NOT NULL,
  begin_s REAL NOT NULL,
  end_s REAL NOT NULL,
  clutch_time_s REAL NOT NULL,
  lever_time_s REAL NOT NULL,
  torque_gap_s REAL NOT NULL,
  engine_speed_rad_per_s REAL NOT NULL,
  slip_energy_j REAL NOT NULL,
  slip_power_peak_w REAL NOT NULL,
  rev_error_rad_per_s REAL NOT NULL,
  flare_rad_per_s REAL NOT NULL,
  clutch_lead_s REAL NOT NULL,
  clutch_lag_s REAL NOT NULL,
  jerk_peak_m_per_s3 REAL NOT NULL,
  vibration_dose_m_per_s175 REAL NOT NULL,
  force_peak_n REAL NOT NULL,
  impulse_n_s REAL NOT NULL,
  wall_work_j REAL NOT NULL,
  path_length_m REAL NOT NULL,
  path_efficiency REAL NOT NULL,
  overshoot_m REAL NOT NULL,
  wrong_columns INTEGER NOT NULL,
  block_time_s REAL NOT NULL,
  grind_time_s REAL NOT NULL,
  grind_energy_j REAL NOT NULL,
  steps_out_of_place INTEGER NOT NULL,
  PRIMARY KEY (run, number));
CREATE TABLE driving_error (
  run INTEGER NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
  number INTEGER NOT NULL,
  kind TEXT NOT NULL,
  severity INTEGER NOT NULL,
  time_s REAL NOT NULL,
  value REAL NOT NULL,
  shift INTEGER NOT NULL,
  points REAL NOT NULL,
  step TEXT NOT NULL,
  wanted REAL NOT NULL,
  PRIMARY KEY (run, number));
CREATE TABLE comment (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  run INTEGER NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
  made_at TEXT NOT NULL,
  author TEXT NOT NULL,
  text TEXT NOT NULL,
  edited_at TEXT NOT NULL DEFAULT '');
CREATE TABLE pending_erasure (
  since TEXT NOT NULL);
CREATE INDEX session_of_learner ON session (learner);
CREATE INDEX run_of_session ON lesson_run (session);
)sql";

// Script i upgrades a file from version i + 1 to i + 2. kSchema is the newest version. All needed scripts run in one
// transaction, with foreign keys off, so that recreating a table does not delete dependent rows.
inline constexpr std::array<const char*, 0> kUpgrades{};
inline constexpr int kSchemaVersion = 1 + static_cast<int>(std::tuple_size_v<decltype(kUpgrades)>);

}  // namespace gearshift::lessons
