#include "app/history/history.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "app/history/schema.h"
#include "app/training/shift_fields.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

constexpr int kPatience = 3000;            // [ms] for another program that writes
constexpr int kNap = 10;                   // [ms]
constexpr std::size_t kLongestName = 100;  // [bytes]

constexpr const char* kDeleted = "what this belongs to was deleted by another program";

std::string reason_of(const SQLite::Exception& problem) {
  switch (problem.getErrorCode()) {
    case SQLITE_NOTADB:
      return "it is no history of this program; it is left as it is";
    case SQLITE_CORRUPT:
      return "it is damaged; it is left as it is";
    case SQLITE_FULL:
      return "the disk is full";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "it may not be written";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program holds it";
    case SQLITE_CANTOPEN:
      return "it cannot be opened";
    case SQLITE_CONSTRAINT:
      return kDeleted;
    case SQLITE_IOERR:
      return "the disk does not answer";
    default:
      return problem.what();
  }
}

// "?, ?, ?"
std::string marks(std::size_t count) {
  std::string text = "?";
  for (std::size_t i = 1; i < count; ++i) text += ", ?";
  return text;
}

std::string figure_names() {
  std::string names;
  const ShiftRecord none;
  each_figure(none, [&](const char* name, const auto&) { names += std::string(", ") + name; });
  return names;
}

std::string steps_text(const std::vector<ShiftStep>& steps) {
  std::string text;
  for (const ShiftStep step : steps) text += static_cast<char>('0' + static_cast<int>(step));
  return text;
}

std::vector<ShiftStep> steps_of(const std::string& text) {
  std::vector<ShiftStep> steps;
  for (const char c : text) {
    if (c >= '0' && c <= '5') steps.push_back(static_cast<ShiftStep>(c - '0'));
  }
  return steps;
}

template <class Enum>
Enum within(int value, Enum last) {
  return static_cast<Enum>(std::clamp(value, 0, static_cast<int>(last)));
}

}  // namespace

struct History::State {
  State(const std::filesystem::path& path, Clock clock) : file(path), now(std::move(clock)) {}

  void open();
  int admitted_version();
  void bring_up_to_date();
  void keep_log();
  void insert_shift(std::int64_t run, const ShiftRecord& shift);
  void replace_faults(std::int64_t run, const LessonResult& result);
  std::vector<ShiftRecord> shifts(std::int64_t run);
  void read_faults(std::int64_t run, LessonResult& result);

  std::string date() const { return date_text(now()); }
  SQLite::Statement query(const std::string& text) { return {*database, text}; }

  // One sentence whatever goes wrong; `work` is one transaction, seen whole or not at all.
  template <class Work>
  auto write(const Work& work) {
    return said([&] {
      SQLite::Transaction transaction(*database, SQLite::TransactionBehavior::IMMEDIATE);
      if constexpr (std::is_void_v<decltype(work())>) {
        work();
        transaction.commit();
      } else {
        auto result = work();
        transaction.commit();
        return result;
      }
    });
  }
  template <class Work>
  auto said(const Work& work) -> decltype(work()) {
    try {
      return work();
    } catch (const SQLite::Exception& problem) {
      throw HistoryError(fmt::format("{}: the history cannot be used: {}", file.string(), reason_of(problem)));
    }
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw HistoryError(fmt::format("{}: the history cannot be used: {}", file.string(), why));
  }

  std::filesystem::path file;
  Clock now;
  std::unique_ptr<SQLite::Database> database;
};

void History::State::open() {
  std::error_code problem;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), problem);
  if (problem) refuse(fmt::format("its folder cannot be made: {}", problem.message()));
  const bool has_log = std::filesystem::exists(file.string() + "-wal", problem);
  said([&] {
    database =
        std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kPatience);
    // What is refused is left to the byte: the log of a killed program is not worked in.
    if (has_log) sqlite3_db_config(database->getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    const int version = admitted_version();
    if (version != kSchemaVersion) bring_up_to_date();
    keep_log();
    sqlite3_db_config(database->getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 0, nullptr);
    database->exec("PRAGMA foreign_keys = ON");
    database->exec("PRAGMA secure_delete = ON");
  });
}

// One look at the file, whatever another program does to it meanwhile: that may be making it.
int History::State::admitted_version() {
  SQLite::Transaction look(*database);
  const int application = database->execAndGet("PRAGMA application_id").getInt();
  const int version = database->execAndGet("PRAGMA user_version").getInt();
  const bool is_empty = database->execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
  if (!is_empty && application != kApplicationId) refuse("it is no history of this program; it is left as it is");
  if (version > kSchemaVersion) refuse("a newer program made it; it is left as it is");
  if (database->execAndGet("PRAGMA quick_check(1)").getString() != "ok") refuse("it is damaged; it is left as it is");
  return version;
}

void History::State::bring_up_to_date() {
  SQLite::Transaction transaction(*database, SQLite::TransactionBehavior::IMMEDIATE);
  // Another program may have been faster.
  for (int from = database->execAndGet("PRAGMA user_version").getInt(); from < kSchemaVersion; ++from) {
    database->exec(kMigrations[static_cast<std::size_t>(from)]);
    database->exec(fmt::format("PRAGMA user_version = {}", from + 1));
  }
  database->exec(fmt::format("PRAGMA application_id = {}", kApplicationId));
  transaction.commit();
}

// Writing ahead needs the file alone for a moment, and SQLite does not wait for it by itself.
void History::State::keep_log() {
  for (int waited = 0;; waited += kNap) {
    try {
      database->exec("PRAGMA journal_mode = WAL");
      break;
    } catch (const SQLite::Exception& problem) {
      if (problem.getErrorCode() != SQLITE_BUSY || waited >= kPatience) throw;
      sqlite3_sleep(kNap);
    }
  }
  database->exec("PRAGMA synchronous = NORMAL");  // a killed process loses nothing; a dead machine the last seconds
}

void History::State::insert_shift(std::int64_t run, const ShiftRecord& shift) {
  static const std::string names = figure_names();
  static const std::size_t figures = static_cast<std::size_t>(std::count(names.begin(), names.end(), ','));
  SQLite::Statement insert =
      query("INSERT OR REPLACE INTO shift (run, number, from_gear, to_gear, guided, missed, steps" + names +
            ") VALUES (" + marks(7 + figures) + ")");
  insert.bind(1, run);
  insert.bind(2, shift.number);
  insert.bind(3, shift.from);
  insert.bind(4, shift.to);
  insert.bind(5, shift.guided ? 1 : 0);
  insert.bind(6, shift.missed ? 1 : 0);
  insert.bind(7, steps_text(shift.steps));
  int place = 8;
  each_figure(shift, [&](const char*, const auto& value) { insert.bind(place++, value); });
  insert.exec();
}

void History::State::replace_faults(std::int64_t run, const LessonResult& result) {
  SQLite::Statement forget = query("DELETE FROM fault WHERE run = ?");
  forget.bind(1, run);
  forget.exec();
  std::map<std::size_t, double> points;
  for (const Deduction& deduction : result.deductions) points[deduction.fault] += deduction.points;
  SQLite::Statement insert = query("INSERT INTO fault VALUES (" + marks(10) + ")");
  for (std::size_t i = 0; i < result.faults.size(); ++i) {
    const DriveFault& fault = result.faults[i];
    insert.bind(1, run);
    insert.bind(2, static_cast<std::int64_t>(i));
    insert.bind(3, std::string(fault_key(fault.kind)));
    insert.bind(4, static_cast<int>(fault.severity));
    insert.bind(5, fault.time);
    insert.bind(6, fault.value);
    insert.bind(7, fault.shift);
    insert.bind(8, points.count(i) != 0 ? points.at(i) : 0.0);
    insert.bind(9, fault.step);
    insert.bind(10, fault.wanted);
    insert.exec();
    insert.reset();
  }
}

std::vector<ShiftRecord> History::State::shifts(std::int64_t run) {
  SQLite::Statement rows = query("SELECT number, from_gear, to_gear, guided, missed, steps" + figure_names() +
                                 " FROM shift WHERE run = ? ORDER BY number");
  rows.bind(1, run);
  std::vector<ShiftRecord> shifts;
  while (rows.executeStep()) {
    ShiftRecord shift;
    shift.number = rows.getColumn(0).getInt64();
    shift.from = rows.getColumn(1).getInt();
    shift.to = rows.getColumn(2).getInt();
    shift.guided = rows.getColumn(3).getInt() != 0;
    shift.missed = rows.getColumn(4).getInt() != 0;
    shift.steps = steps_of(rows.getColumn(5).getString());
    int place = 6;
    each_figure(shift, [&](const char*, auto& value) {
      value = static_cast<std::remove_reference_t<decltype(value)>>(rows.getColumn(place++).getDouble());
    });
    shifts.push_back(std::move(shift));
  }
  return shifts;
}

void History::State::read_faults(std::int64_t run, LessonResult& result) {
  SQLite::Statement rows = query(
      "SELECT kind, severity, time_s, value, shift, points, step, wanted_s FROM fault WHERE run = ? ORDER BY number");
  rows.bind(1, run);
  while (rows.executeStep()) {
    const std::optional<FaultKind> kind = fault_of(rows.getColumn(0).getString());
    if (!kind) continue;  // of another program's version
    const double points = rows.getColumn(5).getDouble();
    if (points != 0.0) result.deductions.push_back({result.faults.size(), points});
    result.faults.push_back({*kind, within(rows.getColumn(1).getInt(), Severity::very_severe),
                             rows.getColumn(2).getDouble(), rows.getColumn(3).getDouble(), rows.getColumn(4).getInt64(),
                             rows.getColumn(6).getString(), rows.getColumn(7).getDouble()});
  }
}

void check_learner_name(std::string_view name) {
  if (name.empty() || name.size() > kLongestName)
    throw std::invalid_argument(fmt::format("a learner's name has 1 to {} bytes", kLongestName));
  if (!is_printable(name)) throw std::invalid_argument("a learner's name has no control characters");
}

History::History(const std::filesystem::path& file, Clock now) : state_(std::make_unique<State>(file, std::move(now))) {
  state_->open();
}

History::~History() = default;

const std::filesystem::path& History::file() const noexcept {
  return state_->file;
}

std::int64_t History::learner(std::string_view name) {
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

std::vector<LearnerRow> History::learners() {
  return state_->said([&] {
    std::vector<LearnerRow> all;
    SQLite::Statement rows = state_->query("SELECT id, name, made_at, next_lesson FROM learner ORDER BY name");
    while (rows.executeStep()) {
      all.push_back({rows.getColumn(0).getInt64(), rows.getColumn(1).getString(), rows.getColumn(2).getString(),
                     rows.getColumn(3).getString()});
    }
    return all;
  });
}

std::optional<LearnerRow> History::find_learner(std::string_view name) {
  for (LearnerRow& row : learners()) {
    if (row.name == name) return std::move(row);
  }
  return std::nullopt;
}

void History::set_next_lesson(std::int64_t learner, std::string_view lesson) {
  state_->write([&] {
    SQLite::Statement update = state_->query("UPDATE learner SET next_lesson = ? WHERE id = ?");
    update.bind(1, std::string(lesson));
    update.bind(2, learner);
    update.exec();
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
        "INSERT INTO lesson_run (session, begun_at, recording, lesson, task, mode, ended, guided, whole, "
        "begin_s, duration_s, grade, passed, why, slip_energy_j, engine_work_j) VALUES (" +
        marks(16) + ")");
    insert.bind(1, session);
    insert.bind(2, state_->date());
    insert.bind(3, std::string(recording));
    insert.bind(4, result.lesson);
    insert.bind(5, result.task);
    insert.bind(6, static_cast<int>(result.mode));
    insert.bind(7, static_cast<int>(LessonEnd::running));
    insert.bind(8, result.guided ? 1 : 0);
    insert.bind(9, 1);
    insert.bind(10, result.begin);
    for (const int place : {11, 12, 13, 15, 16}) insert.bind(place, 0);
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
        "UPDATE lesson_run SET ended = ?, guided = ?, whole = ?, begin_s = ?, duration_s = ?, grade = ?, "
        "passed = ?, why = ?, slip_energy_j = ?, engine_work_j = ? WHERE id = ?");
    update.bind(1, static_cast<int>(result.end));
    update.bind(2, result.guided ? 1 : 0);
    update.bind(3, result.whole ? 1 : 0);
    update.bind(4, result.begin);
    update.bind(5, result.duration);
    update.bind(6, result.grade);
    update.bind(7, result.passed ? 1 : 0);
    update.bind(8, result.why);
    update.bind(9, result.slip_energy);
    update.bind(10, result.fuel);
    update.bind(11, run);
    if (update.exec() == 0) state_->refuse(kDeleted);
    for (const ShiftRecord& shift : result.shifts) state_->insert_shift(run, shift);
    state_->replace_faults(run, result);
  });
}

void History::add_comment(std::int64_t run, std::string_view author, std::string_view text) {
  state_->write([&] {
    SQLite::Statement insert = state_->query("INSERT INTO comment (run, made_at, author, text) VALUES (?, ?, ?, ?)");
    insert.bind(1, run);
    insert.bind(2, state_->date());
    insert.bind(3, std::string(author));
    insert.bind(4, std::string(text));
    insert.exec();
  });
}

std::vector<RunRow> History::runs(std::int64_t learner) {
  return state_->said([&] {
    // One snapshot of the file, whatever another program writes meanwhile.
    SQLite::Transaction snapshot(*state_->database);
    SQLite::Statement rows = state_->query(
        "SELECT r.id, session, r.begun_at, recording, lesson, task, mode, ended, guided, whole, begin_s, duration_s, "
        "grade, passed, why, slip_energy_j, engine_work_j FROM lesson_run r JOIN session s ON s.id = r.session "
        "WHERE s.learner = ? ORDER BY r.id");
    rows.bind(1, learner);
    std::vector<RunRow> runs;
    while (rows.executeStep()) {
      RunRow run{rows.getColumn(0).getInt64(),
                 rows.getColumn(1).getInt64(),
                 rows.getColumn(2).getString(),
                 rows.getColumn(3).getString(),
                 {}};
      LessonResult& result = run.result;
      result.lesson = rows.getColumn(4).getString();
      result.task = rows.getColumn(5).getString();
      result.mode = within(rows.getColumn(6).getInt(), LessonMode::by_yourself);
      result.end = within(rows.getColumn(7).getInt(), LessonEnd::left);
      result.guided = rows.getColumn(8).getInt() != 0;
      result.whole = rows.getColumn(9).getInt() != 0;
      result.begin = rows.getColumn(10).getDouble();
      result.duration = rows.getColumn(11).getDouble();
      result.grade = rows.getColumn(12).getDouble();
      result.passed = rows.getColumn(13).getInt() != 0;
      result.why = rows.getColumn(14).getString();
      result.slip_energy = rows.getColumn(15).getDouble();
      result.fuel = rows.getColumn(16).getDouble();
      result.shifts = state_->shifts(run.id);
      state_->read_faults(run.id, result);
      runs.push_back(std::move(run));
    }
    return runs;
  });
}

std::vector<CommentRow> History::comments(std::int64_t run) {
  return state_->said([&] {
    std::vector<CommentRow> all;
    SQLite::Statement rows = state_->query("SELECT made_at, author, text FROM comment WHERE run = ? ORDER BY id");
    rows.bind(1, run);
    while (rows.executeStep()) {
      all.push_back({rows.getColumn(0).getString(), rows.getColumn(1).getString(), rows.getColumn(2).getString()});
    }
    return all;
  });
}

std::vector<std::string> History::settings(std::int64_t session) {
  return state_->said([&] {
    std::vector<std::string> all;
    SQLite::Statement rows = state_->query("SELECT text FROM settings WHERE session = ? ORDER BY id");
    rows.bind(1, session);
    while (rows.executeStep()) all.push_back(rows.getColumn(0).getString());
    return all;
  });
}

std::int64_t History::changes() {
  return state_->said([&] { return state_->database->execAndGet("PRAGMA data_version").getInt64(); });
}

std::vector<std::string> History::erase_learner(std::int64_t learner) {
  std::vector<std::string> recordings = state_->write([&] {
    std::vector<std::string> of_learner;
    SQLite::Statement rows = state_->query(
        "SELECT DISTINCT recording FROM lesson_run WHERE recording != '' AND session IN (SELECT id FROM session WHERE "
        "learner = ?1) AND recording NOT IN (SELECT recording FROM lesson_run WHERE session NOT IN (SELECT id FROM "
        "session WHERE learner = ?1))");
    rows.bind(1, learner);
    while (rows.executeStep()) of_learner.push_back(rows.getColumn(0).getString());
    SQLite::Statement forget = state_->query("DELETE FROM learner WHERE id = ?");
    forget.bind(1, learner);
    forget.exec();
    return of_learner;
  });
  state_->said([&] {
    state_->database->exec("VACUUM");  // what was deleted is overwritten already; its pages go, too
    state_->database->exec("PRAGMA wal_checkpoint(TRUNCATE)");
  });
  return recordings;
}

}  // namespace gearshift
