#include "app/lessons/history/schema.h"

#include "app/lessons/assessment/lesson_result.h"
#include "app/lessons/history/sql_binding.h"

namespace gearshift::lessons {

// Row numbers are never reused (AUTOINCREMENT). Otherwise a program that is still recording a run of an erased learner
// could write into the rows of a later learner. A row in pending_erasure means that erased data may still be in the log
// or in free pages.
std::string schema() {
  return R"sql(
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
CREATE TABLE lesson_run (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  session INTEGER NOT NULL REFERENCES session ON DELETE CASCADE,
  begun_at TEXT NOT NULL,
  recording TEXT NOT NULL,
)sql" + column_definitions<LessonResult>() +
         R"sql();
CREATE TABLE shift (
  run INTEGER NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
)sql" + column_definitions<ShiftRecord>() +
         R"sql(,
  PRIMARY KEY (run, shift));
CREATE TABLE driving_error (
  run INTEGER NOT NULL REFERENCES lesson_run ON DELETE CASCADE,
  number INTEGER NOT NULL,
)sql" + column_definitions<DrivingError>() +
         R"sql(,
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
}

}  // namespace gearshift::lessons
