// The tables of the history, and the migrations that bring an older file up to date.
#pragma once

#include <array>
#include <string>
#include <tuple>

namespace gearshift::lessons {

inline constexpr int kApplicationId = 0x47534849;  // "GSHI", stored in the file header

// Columns of a lesson run, except its number.
inline constexpr const char* kRunColumns = R"sql(
  session INTEGER NOT NULL REFERENCES session ON DELETE CASCADE,
  begun_at TEXT NOT NULL,
  recording TEXT NOT NULL,
  lesson TEXT NOT NULL,
  task TEXT NOT NULL,
  mode INTEGER NOT NULL,
  ended INTEGER NOT NULL,
  guided INTEGER NOT NULL,
  whole INTEGER NOT NULL,
  begin_s REAL NOT NULL,
  duration_s REAL NOT NULL,
  grade REAL NOT NULL,
  passed INTEGER NOT NULL,
  why TEXT NOT NULL,
  slip_energy_j REAL NOT NULL,
  engine_work_j REAL NOT NULL);
)sql";

// Script i upgrades the schema from version i to i + 1. All needed scripts run in one transaction, with foreign keys
// off, so that recreating a table does not delete dependent rows.
inline const std::array<std::string, 6> kMigrations{
    // 1
    R"sql(
CREATE TABLE learner (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  made_at TEXT NOT NULL,
  next_lesson TEXT NOT NULL DEFAULT '');
CREATE TABLE session (
  id INTEGER PRIMARY KEY,
  learner INTEGER NOT NULL REFERENCES learner ON DELETE CASCADE,
  begun_at TEXT NOT NULL,
  program TEXT NOT NULL);
CREATE TABLE settings (
  id INTEGER PRIMARY KEY,
  session INTEGER NOT NULL REFERENCES session ON DELETE CASCADE,
  set_at TEXT NOT NULL,
  text TEXT NOT NULL);
CREATE TABLE lesson_run (
  id INTEGER PRIMARY KEY,
)sql" + std::string(kRunColumns) +
        R"sql(CREATE TABLE shift (
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
CREATE TABLE fault (
  run INTEGER NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
  number INTEGER NOT NULL,
  kind TEXT NOT NULL,
  severity INTEGER NOT NULL,
  time_s REAL NOT NULL,
  value REAL NOT NULL,
  shift INTEGER NOT NULL,
  points REAL NOT NULL,
  PRIMARY KEY (run, number));
CREATE TABLE comment (
  id INTEGER PRIMARY KEY,
  run INTEGER NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
  made_at TEXT NOT NULL,
  author TEXT NOT NULL,
  text TEXT NOT NULL);
CREATE INDEX session_of_learner ON session (learner);
CREATE INDEX run_of_session ON lesson_run (session);
)sql",
    // Version 2: row numbers are never reused (AUTOINCREMENT). Otherwise a program that is still recording a run of
    // an erased learner could write into the rows of a later learner.
    R"sql(
CREATE TABLE new_learner (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  name TEXT NOT NULL UNIQUE,
  made_at TEXT NOT NULL,
  next_lesson TEXT NOT NULL DEFAULT '');
INSERT INTO new_learner SELECT id, name, made_at, next_lesson FROM learner;
DROP TABLE learner;
ALTER TABLE new_learner RENAME TO learner;
CREATE TABLE new_session (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  learner INTEGER NOT NULL REFERENCES learner ON DELETE CASCADE,
  begun_at TEXT NOT NULL,
  program TEXT NOT NULL);
INSERT INTO new_session SELECT id, learner, begun_at, program FROM session;
DROP TABLE session;
ALTER TABLE new_session RENAME TO session;
CREATE TABLE new_run (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
)sql" + std::string(kRunColumns) +
        R"sql(INSERT INTO new_run SELECT id, session, begun_at, recording, lesson, task, mode, ended, guided, whole,
  begin_s, duration_s, grade, passed, why, slip_energy_j, engine_work_j FROM lesson_run;
DROP TABLE lesson_run;
ALTER TABLE new_run RENAME TO lesson_run;
CREATE INDEX session_of_learner ON session (learner);
CREATE INDEX run_of_session ON lesson_run (session);
)sql",
    // Version 3: stores the prompt and the time limit of the step for the error slow_step.
    R"sql(
ALTER TABLE fault ADD COLUMN step TEXT NOT NULL DEFAULT '';
ALTER TABLE fault ADD COLUMN wanted_s REAL NOT NULL DEFAULT 0;
)sql",
    // Version 4: a row in pending_erasure means that erased data may still be in the log or in free pages.
    R"sql(
CREATE TABLE pending_erasure (
  since TEXT NOT NULL);
)sql",
    // Version 5: comments can be edited and deleted, so their numbers must not be reused either.
    R"sql(
CREATE TABLE new_comment (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  run INTEGER NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
  made_at TEXT NOT NULL,
  author TEXT NOT NULL,
  text TEXT NOT NULL,
  edited_at TEXT NOT NULL DEFAULT '');
INSERT INTO new_comment (id, run, made_at, author, text) SELECT id, run, made_at, author, text FROM comment;
DROP TABLE comment;
ALTER TABLE new_comment RENAME TO comment;
)sql",
    // Version 6: a recording below the history's folder is stored with its relative path (done by recording_path.cpp).
    ""};
inline constexpr int kRelativeRecordingsVersion = 6;  // first version with relative paths
inline constexpr int kSchemaVersion = static_cast<int>(std::tuple_size_v<decltype(kMigrations)>);

}  // namespace gearshift::lessons
