#include <algorithm>
#include <map>

#include "app/lessons/assessment/shift_fields.h"
#include "app/lessons/history/history_state.h"
#include "app/lessons/history/sql_binding.h"
#include "app/lessons/history/user_text.h"

namespace gearshift::lessons {

void History::State::insert_shift(std::int64_t run, const ShiftRecord& shift) {
  static const std::string names = figure_names();
  static const std::size_t figures = static_cast<std::size_t>(std::count(names.begin(), names.end(), ','));
  SQLite::Statement insert =
      query("INSERT OR REPLACE INTO shift (run, number, from_gear, to_gear, guided, missed, steps" + names +
            ") VALUES (" + placeholders(7 + figures) + ")");
  insert.bind(1, run);
  insert.bind(2, shift.number);
  insert.bind(3, shift.from);
  insert.bind(4, shift.to);
  insert.bind(5, shift.guided ? 1 : 0);
  insert.bind(6, shift.missed ? 1 : 0);
  insert.bind(7, format_steps(shift.steps));
  int index = 8;
  each_figure(shift, [&](const char*, const auto& value) { bind_figure(insert, index++, value); });
  insert.exec();
}

void History::State::replace_errors(std::int64_t run, const LessonResult& result) {
  SQLite::Statement deletion = query("DELETE FROM driving_error WHERE run = ?");
  deletion.bind(1, run);
  deletion.exec();
  std::map<std::size_t, double> points;
  for (const Deduction& deduction : result.deductions) points[deduction.error] += deduction.points;
  SQLite::Statement insert = query("INSERT INTO driving_error VALUES (" + placeholders(10) + ")");
  for (std::size_t i = 0; i < result.errors.size(); ++i) {
    const DrivingError& error = result.errors[i];
    insert.bind(1, run);
    insert.bind(2, static_cast<std::int64_t>(i));
    insert.bind(3, std::string(to_string(error.kind)));
    insert.bind(4, static_cast<int>(error.severity));
    bind_figure(insert, 5, error.time);
    bind_figure(insert, 6, error.value);
    insert.bind(7, error.shift);
    bind_figure(insert, 8, points.count(i) != 0 ? points.at(i) : 0.0);
    insert.bind(9, error.step);
    bind_figure(insert, 10, error.wanted);
    insert.exec();
    insert.reset();
  }
}

std::int64_t History::find_or_add_learner(std::string_view name) {
  check_learner_name(name);
  return state_->write([&] {
    SQLite::Statement insert = state_->query("INSERT OR IGNORE INTO learner (name, made_at) VALUES (?, ?)");
    insert.bind(1, std::string(name));
    insert.bind(2, state_->date());
    insert.exec();
    SQLite::Statement find = state_->query("SELECT id FROM learner WHERE name = ?");
    find.bind(1, std::string(name));
    find.executeStep();
    return find.getColumn(0).getInt64();
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
    SQLite::Statement insert = state_->query("INSERT INTO session (learner, begun_at, program) VALUES (?, ?, ?)");
    insert.bind(1, learner);
    insert.bind(2, state_->date());
    insert.bind(3, std::string(program));
    insert.exec();
    return static_cast<std::int64_t>(state_->database->getLastInsertRowid());
  });
}

void History::add_settings(std::int64_t session, std::string_view text) {
  state_->write([&] {
    SQLite::Statement insert = state_->query("INSERT INTO settings (session, set_at, text) VALUES (?, ?, ?)");
    insert.bind(1, session);
    insert.bind(2, state_->date());
    insert.bind(3, std::string(text));
    insert.exec();
  });
}

std::int64_t History::begin_run(std::int64_t session, const LessonResult& result, std::string_view recording) {
  return state_->write([&] {
    SQLite::Statement insert = state_->query(
        "INSERT INTO lesson_run (session, begun_at, recording, lesson, task, mode, ended, guided, complete, "
        "begin_s, duration_s, grade, passed, why, slip_energy_j, engine_work_j) VALUES (" +
        placeholders(16) + ")");
    insert.bind(1, session);
    insert.bind(2, state_->date());
    insert.bind(3, state_->relative_recording(std::string(recording)));
    insert.bind(4, result.lesson);
    insert.bind(5, result.task);
    insert.bind(6, static_cast<int>(result.mode));
    insert.bind(7, static_cast<int>(LessonEnd::running));
    insert.bind(8, result.guided ? 1 : 0);
    insert.bind(9, 1);
    bind_figure(insert, 10, result.begin);
    for (const int index : {11, 12, 13, 15, 16}) insert.bind(index, 0);
    insert.bind(14, "");
    insert.exec();
    return static_cast<std::int64_t>(state_->database->getLastInsertRowid());
  });
}

void History::add_shift(std::int64_t run, const ShiftRecord& shift) {
  state_->write([&] { state_->insert_shift(run, shift); });
}

void History::end_run(std::int64_t run, const LessonResult& result) {
  state_->write([&] {
    SQLite::Statement update = state_->query(
        "UPDATE lesson_run SET ended = ?, guided = ?, complete = ?, begin_s = ?, duration_s = ?, grade = ?, "
        "passed = ?, why = ?, slip_energy_j = ?, engine_work_j = ? WHERE id = ?");
    update.bind(1, static_cast<int>(result.end));
    update.bind(2, result.guided ? 1 : 0);
    update.bind(3, result.is_complete ? 1 : 0);
    bind_figure(update, 4, result.begin);
    bind_figure(update, 5, result.duration);
    bind_figure(update, 6, result.grade);
    update.bind(7, result.passed ? 1 : 0);
    update.bind(8, result.why);
    bind_figure(update, 9, result.slip_energy);
    bind_figure(update, 10, result.fuel);
    update.bind(11, run);
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
  check_user_text(UserText::name, "an instructor's name", author);
  check_user_text(UserText::comment, "a comment", text);
  return state_->write([&] {
    SQLite::Statement insert = state_->query("INSERT INTO comment (run, made_at, author, text) VALUES (?, ?, ?, ?)");
    insert.bind(1, run);
    insert.bind(2, state_->date());
    insert.bind(3, std::string(author));
    insert.bind(4, std::string(text));
    insert.exec();
    return static_cast<std::int64_t>(state_->database->getLastInsertRowid());
  });
}

bool History::edit_comment(std::int64_t comment, std::string_view text) {
  check_user_text(UserText::comment, "a comment", text);
  return state_->write([&] {
    SQLite::Statement update = state_->query("UPDATE comment SET text = ?, edited_at = ? WHERE id = ?");
    update.bind(1, std::string(text));
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
