#include "app/lessons/history/schema.h"

#include <fmt/format.h>

#include "app/lessons/assessment/lesson_result.h"
#include "app/lessons/history/sql_binding.h"

namespace gearshift::lessons {
namespace {

// `last_number` counts the rows of this file; rows of other seats have numbers of their own (exchange.h). `unsent` lists
// the rows that the server does not have yet, and the deleted learners and comments (`gone`). A row that changes again
// gets a new number, by which a sender sees that it has not sent the newest state. Shifts and driving errors are sent
// with their run. `server` and `server_learner` hold what the server said.
constexpr const char* kExchangeTables = R"sql(
CREATE TABLE last_number (kind TEXT PRIMARY KEY, number INTEGER NOT NULL);
INSERT INTO last_number VALUES ('learner', 0), ('session', 0), ('lesson_run', 0), ('comment', 0);
CREATE TABLE unsent (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  kind TEXT NOT NULL,
  row INTEGER NOT NULL,
  gone INTEGER NOT NULL DEFAULT 0,
  UNIQUE (kind, row) ON CONFLICT REPLACE);
CREATE TABLE server (
  token TEXT NOT NULL, school TEXT NOT NULL, seat INTEGER NOT NULL,
  sends INTEGER NOT NULL, mark TEXT NOT NULL, next_mark TEXT NOT NULL);
CREATE TABLE server_learner (
  learner INTEGER PRIMARY KEY REFERENCES learner ON DELETE CASCADE,
  on_server INTEGER NOT NULL,
  version INTEGER NOT NULL);
)sql";

struct Trigger {
  const char *event, *table;  // "INSERT", "shift"
  const char* kind;           // in `unsent`
  const char* row;            // "NEW.run"
  bool gone = false;
};
constexpr Trigger kTriggers[] = {
    {"INSERT", "learner", "learner", "NEW.id"},       {"UPDATE", "learner", "learner", "NEW.id"},
    {"DELETE", "learner", "learner", "OLD.id", true}, {"INSERT", "session", "session", "NEW.id"},
    {"INSERT", "lesson_run", "lesson_run", "NEW.id"}, {"UPDATE", "lesson_run", "lesson_run", "NEW.id"},
    {"INSERT", "shift", "lesson_run", "NEW.run"},     {"INSERT", "driving_error", "lesson_run", "NEW.run"},
    {"INSERT", "comment", "comment", "NEW.id"},       {"UPDATE", "comment", "comment", "NEW.id"},
    {"DELETE", "comment", "comment", "OLD.id", true},
};

std::string triggers() {
  std::string text;
  for (const Trigger& t : kTriggers)
    text += fmt::format(
        "CREATE TRIGGER {1}_{0} AFTER {0} ON {1} BEGIN "
        "INSERT INTO unsent (kind, row, gone) VALUES ('{2}', {3}, {4}); END;\n",
        t.event, t.table, t.kind, t.row, t.gone ? 1 : 0);
  return text;
}

}  // namespace

// Row numbers are never reused (AUTOINCREMENT and last_number). Otherwise a program that is still recording a run of an
// erased learner could write into the rows of a later learner.
std::string learner_tables(const SqlDialect& dialect) {
  return fmt::format(
      R"sql(
CREATE TABLE learner (
  id {key},
  name TEXT NOT NULL UNIQUE,
  made_at TEXT NOT NULL,
  next_lesson TEXT NOT NULL DEFAULT '');
CREATE TABLE session (
  id {key},
  learner {integer} NOT NULL REFERENCES learner ON DELETE CASCADE,
  begun_at TEXT NOT NULL,
  program TEXT NOT NULL);
CREATE TABLE lesson_run (
  id {key},
  session {integer} NOT NULL REFERENCES session ON DELETE CASCADE,
  begun_at TEXT NOT NULL,
  recording TEXT NOT NULL,
{run},
  kept_at TEXT NOT NULL DEFAULT '');
CREATE TABLE shift (
  run {integer} NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
{shift},
  PRIMARY KEY (run, shift));
CREATE TABLE driving_error (
  run {integer} NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
  number {integer} NOT NULL,
{error},
  PRIMARY KEY (run, number));
CREATE TABLE comment (
  id {key},
  run {integer} NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
  made_at TEXT NOT NULL,
  author TEXT NOT NULL,
  text TEXT NOT NULL,
  edited_at TEXT NOT NULL DEFAULT '');
CREATE INDEX session_of_learner ON session (learner);
CREATE INDEX run_of_session ON lesson_run (session);
)sql",
      fmt::arg("key", dialect.key), fmt::arg("integer", dialect.integer),
      fmt::arg("run", column_definitions<LessonResult>(dialect)),
      fmt::arg("shift", column_definitions<ShiftRecord>(dialect)),
      fmt::arg("error", column_definitions<DrivingError>(dialect)));
}

// A row in pending_erasure means that erased data may still be in the log or in free pages.
std::string schema() {
  return learner_tables(kSqlite) + "CREATE TABLE pending_erasure (since TEXT NOT NULL);" + kExchangeTables + triggers();
}

std::array<std::string, kSchemaVersion - 1> upgrades() {
  return {// Version 2: figures of a run, how it was graded (0: by the old rule), and the car's unit of speed.
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
          // Version 3: car and gate, help by limb. Until then only the lever gave help, with a strength that was not
          // stored.
          "ALTER TABLE lesson_run ADD COLUMN car TEXT NOT NULL DEFAULT '';"
          "ALTER TABLE lesson_run ADD COLUMN path_length_m REAL NOT NULL DEFAULT 0;"
          "ALTER TABLE lesson_run ADD COLUMN lever_help REAL NOT NULL DEFAULT 0;"
          "ALTER TABLE lesson_run ADD COLUMN pedal_help REAL NOT NULL DEFAULT 0;"
          "UPDATE lesson_run SET lever_help = 1 WHERE guided;",
          // Version 4: exchange with other seats. No row has been sent yet.
          std::string("ALTER TABLE lesson_run ADD COLUMN kept_at TEXT NOT NULL DEFAULT '';") + kExchangeTables +
              "UPDATE last_number SET number = coalesce((SELECT seq FROM sqlite_sequence WHERE name = kind), 0);"
              "INSERT INTO unsent (kind, row) SELECT 'learner', id FROM learner;"
              "INSERT INTO unsent (kind, row) SELECT 'session', id FROM session;"
              "INSERT INTO unsent (kind, row) SELECT 'lesson_run', id FROM lesson_run;"
              "INSERT INTO unsent (kind, row) SELECT 'comment', id FROM comment;" +
              triggers(),
          // Version 5: steadiness of the feet.
          "ALTER TABLE lesson_run ADD COLUMN pedal_corrections_per_s REAL;"};
}

}  // namespace gearshift::lessons
