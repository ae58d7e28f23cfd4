#include "app/lessons/history/history_state.h"
#include "app/lessons/history/sql_binding.h"
#include "app/lessons/history/user_text.h"

namespace gearshift::lessons {

// Inserts a row of this file. Binds the row's number at `index`, and returns it.
std::int64_t History::State::insert_numbered(SQLite::Statement& insert, int index, const char* kind) {
  SQLite::Statement count = query("UPDATE last_number SET number = number + 1 WHERE kind = ? RETURNING number");
  count.bind(1, kind);
  count.executeStep();
  const std::int64_t number = count.getColumn(0).getInt64();
  count.reset();
  insert.bind(index, number);
  insert.exec();
  return number;
}

void History::State::insert_shift(std::int64_t run, const ShiftRecord& shift) {
  SQLite::Statement insert = query("INSERT OR REPLACE INTO shift (" + column_names<ShiftRecord>() + ", run) VALUES (" +
                                   placeholders<ShiftRecord>(1) + ")");
  insert.bind(bind_record(insert, 1, shift), run);
  insert.exec();
}

void History::State::replace_errors(std::int64_t run, const LessonResult& result) {
  SQLite::Statement deletion = query("DELETE FROM driving_error WHERE run = ?");
  deletion.bind(1, run);
  deletion.exec();
  SQLite::Statement insert = query("INSERT INTO driving_error (" + column_names<DrivingError>() +
                                   ", run, number) VALUES (" + placeholders<DrivingError>(2) + ")");
  for (std::size_t i = 0; i < result.errors.size(); ++i) {
    const int next = bind_record(insert, 1, result.errors[i]);
    insert.bind(next, run);
    insert.bind(next + 1, static_cast<std::int64_t>(i));
    insert.exec();
    insert.reset();
  }
}

std::int64_t History::find_or_add_learner(std::string_view name) {
  return state_->write([&] {
    const std::optional<LearnerRow> known = state_->find_learner(name);
    if (known && known->name == stored_name(name)) return known->id;
    const std::string stored = checked_learner_name(name);
    if (known) return known->id;
    SQLite::Statement insert = state_->query("INSERT INTO learner (name, made_at, id) VALUES (?, ?, ?)");
    insert.bind(1, stored);
    insert.bind(2, state_->date());
    return state_->insert_numbered(insert, 3, "learner");
  });
}

bool History::rename_learner(std::int64_t learner, std::string_view name) {
  const std::string stored = checked_learner_name(name);
  return state_->write([&] {
    const std::optional<LearnerRow> known = state_->find_learner(stored);
    if (known && known->id != learner) return false;
    SQLite::Statement update = state_->query("UPDATE learner SET name = ? WHERE id = ?");
    update.bind(1, stored);
    update.bind(2, learner);
    if (update.exec() == 0) state_->fail_as_deleted();
    return true;
  });
}

void History::set_next_lesson(std::int64_t learner, std::string_view lesson) {
  state_->write([&] {
    SQLite::Statement update = state_->query("UPDATE learner SET next_lesson = ? WHERE id = ?");
    update.bind(1, std::string(lesson));
    update.bind(2, learner);
    if (update.exec() == 0) state_->fail_as_deleted();
  });
}

std::int64_t History::begin_session(std::int64_t learner, std::string_view program) {
  return state_->write([&] {
    SQLite::Statement insert =
        state_->query("INSERT INTO session (learner, begun_at, program, id) VALUES (?, ?, ?, ?)");
    insert.bind(1, learner);
    insert.bind(2, state_->date());
    insert.bind(3, std::string(program));
    return state_->insert_numbered(insert, 4, "session");
  });
}

std::int64_t History::begin_run(std::int64_t session, const LessonResult& result, std::string_view recording) {
  LessonResult start;
  start.lesson = result.lesson;
  start.task = result.task;
  start.mode = result.mode;
  start.guided = result.guided;
  start.begin = result.begin;
  const std::int64_t run = state_->write([&] {
    SQLite::Statement insert =
        state_->query("INSERT INTO lesson_run (" + column_names<LessonResult>() +
                      ", session, begun_at, recording, id) VALUES (" + placeholders<LessonResult>(4) + ")");
    const int next = bind_record(insert, 1, start);
    insert.bind(next, session);
    insert.bind(next + 1, state_->date());
    insert.bind(next + 2, state_->relative_recording(std::string(recording)));
    return state_->insert_numbered(insert, next + 3, "lesson_run");
  });
  // Empties the log if nobody reads, so that the run's result finds room in it even if the disk fills up meanwhile.
  state_->database->tryExec("PRAGMA wal_checkpoint(PASSIVE)");
  return run;
}

void History::add_shift(std::int64_t run, const ShiftRecord& shift) {
  state_->write([&] { state_->insert_shift(run, shift); });
}

void History::end_run(std::int64_t run, const LessonResult& result) {
  state_->write([&] {
    SQLite::Statement update =
        state_->query("UPDATE lesson_run SET " + column_names<LessonResult>(" = ?") + " WHERE id = ?");
    update.bind(bind_record(update, 1, result), run);
    if (update.exec() == 0) state_->fail_as_deleted();
    for (const ShiftRecord& shift : result.shifts) state_->insert_shift(run, shift);
    state_->replace_errors(run, result);
  });
}

void History::clear_recording(std::int64_t run) {
  state_->write([&] {
    SQLite::Statement update = state_->query("UPDATE lesson_run SET recording = '' WHERE id = ?");
    update.bind(1, run);
    if (update.exec() == 0) state_->fail_as_deleted();
  });
}

std::int64_t History::add_comment(std::int64_t run, std::string_view author, std::string_view text) {
  const std::string by = checked_text(UserText::name, "an instructor's name", author);
  const std::string stored = checked_text(UserText::comment, "a comment", text);
  return state_->write([&] {
    SQLite::Statement insert =
        state_->query("INSERT INTO comment (run, made_at, author, text, id) VALUES (?, ?, ?, ?, ?)");
    insert.bind(1, run);
    insert.bind(2, state_->date());
    insert.bind(3, by);
    insert.bind(4, stored);
    return state_->insert_numbered(insert, 5, "comment");
  });
}

bool History::edit_comment(std::int64_t comment, std::string_view text) {
  const std::string stored = checked_text(UserText::comment, "a comment", text);
  return state_->write([&] {
    SQLite::Statement update = state_->query("UPDATE comment SET text = ?, edited_at = ? WHERE id = ?");
    update.bind(1, stored);
    update.bind(2, state_->date());
    update.bind(3, comment);
    return update.exec() > 0;
  });
}

bool History::delete_comment(std::int64_t comment) {
  return state_->write([&] {
    SQLite::Statement deletion = state_->query("DELETE FROM comment WHERE id = ?");
    deletion.bind(1, comment);
    return deletion.exec() > 0;
  });
}

}  // namespace gearshift::lessons
