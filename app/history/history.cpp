#include "app/history/history.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "app/history/schema.h"
#include "app/training/shift_fields.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kNap{10};
constexpr std::size_t kLongestName = 100;  // [bytes]
constexpr double kLargest = 1e9;           // [1] of any figure, in its unit; fits an int [engineering value]
constexpr double kMostPoints = 10.0;

constexpr const char* kDeleted = "what this belongs to was deleted by another program";
constexpr const char* kForeign = "it is no history of this program; it is left as it is";

// Of a row that is not there (any more) to hang on; other broken rules are this program's own mistakes.
bool is_gone(const SQLite::Exception& problem) noexcept {
  return problem.getExtendedErrorCode() == SQLITE_CONSTRAINT_FOREIGNKEY;
}

bool is_busy(const SQLite::Exception& problem) noexcept {
  return problem.getErrorCode() == SQLITE_BUSY || problem.getErrorCode() == SQLITE_LOCKED;
}

std::string reason_of(const SQLite::Exception& problem) {
  if (is_gone(problem)) return kDeleted;
  switch (problem.getErrorCode()) {
    case SQLITE_NOTADB:
      return kForeign;
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

// What a figure can be, whoever wrote it: what is not finite is 0, as what was never measured.
double figure(double value) noexcept {
  return std::isfinite(value) ? std::clamp(value, -kLargest, kLargest) : 0.0;
}

void bind_figure(SQLite::Statement& statement, int place, double value) {
  statement.bind(place, figure(value));
}

double figure_in(const SQLite::Statement& row, int place) {
  return figure(row.getColumn(place).getDouble());
}

bool flag_in(const SQLite::Statement& row, int place) {
  return row.getColumn(place).getInt64() != 0;
}

template <class Enum>
Enum choice_in(const SQLite::Statement& row, int place, Enum last) {
  const std::int64_t value = row.getColumn(place).getInt64();
  return static_cast<Enum>(std::clamp<std::int64_t>(value, 0, static_cast<std::int64_t>(last)));
}

bool is_gear(std::int64_t gear) noexcept {
  return gear >= kReverseGear && gear <= kMaxGear;
}

}  // namespace

struct History::State {
  State(const std::filesystem::path& path, Clock clock, milliseconds a_patience)
      : file(path), now(std::move(clock)), patience(a_patience) {}

  void open();
  int admitted_version();
  int version_in_file();
  void bring_up_to_date();
  void keep_log();
  void insert_shift(std::int64_t run, const ShiftRecord& shift);
  void replace_faults(std::int64_t run, const LessonResult& result);
  std::string empty_log();
  [[nodiscard]] std::string try_to(const std::function<std::string()>& work);

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
      const std::string sentence = unusable(reason_of(problem));
      if (is_busy(problem)) throw HistoryBusy(sentence);
      if (is_gone(problem)) throw HistoryGone(sentence);
      throw HistoryError(sentence);
    }
  }
  std::string unusable(const std::string& why) const {
    return fmt::format("{}: the history cannot be used: {}", file.string(), why);
  }
  [[noreturn]] void refuse(const std::string& why) const { throw HistoryError(unusable(why)); }

  std::filesystem::path file;
  Clock now;
  milliseconds patience;
  std::unique_ptr<SQLite::Database> database;
};

namespace {

// Shifts and faults of one run after another.
class RunParts {
 public:
  explicit RunParts(SQLite::Database& database)
      : shifts_(database, "SELECT number, from_gear, to_gear, guided, missed, steps" + figure_names() +
                              " FROM shift WHERE run = ? ORDER BY number"),
        faults_(database,
                "SELECT kind, severity, time_s, value, shift, points, step, wanted_s FROM fault WHERE run = ? ORDER BY "
                "number") {}

  void read(std::int64_t run, LessonResult& result) {
    for (begin(shifts_, run); shifts_.executeStep();) read_shift(result);
    for (begin(faults_, run); faults_.executeStep();) read_fault(result);
  }

 private:
  static void begin(SQLite::Statement& rows, std::int64_t run) {
    rows.reset();
    rows.bind(1, run);
  }

  // One between gears that no box has is left out.
  void read_shift(LessonResult& result) {
    const std::int64_t from = shifts_.getColumn(1).getInt64(), to = shifts_.getColumn(2).getInt64();
    if (!is_gear(from) || !is_gear(to)) return;
    ShiftRecord shift;
    shift.number = shifts_.getColumn(0).getInt64();
    shift.from = static_cast<int>(from);
    shift.to = static_cast<int>(to);
    shift.guided = flag_in(shifts_, 3);
    shift.missed = flag_in(shifts_, 4);
    shift.steps = steps_of(shifts_.getColumn(5).getString());
    int place = 6;
    each_figure(shift, [&](const char*, auto& value) {
      value = static_cast<std::remove_reference_t<decltype(value)>>(figure_in(shifts_, place++));
    });
    result.shifts.push_back(std::move(shift));
  }

  void read_fault(LessonResult& result) {
    const std::optional<FaultKind> kind = fault_of(faults_.getColumn(0).getString());
    if (!kind) return;  // of another program's version
    const double points = std::clamp(figure_in(faults_, 5), 0.0, kMostPoints);
    if (points > 0.0) result.deductions.push_back({result.faults.size(), points});
    result.faults.push_back({*kind, choice_in(faults_, 1, Severity::very_severe), figure_in(faults_, 2),
                             figure_in(faults_, 3), faults_.getColumn(4).getInt64(), faults_.getColumn(6).getString(),
                             figure_in(faults_, 7)});
  }

  SQLite::Statement shifts_, faults_;
};

// In the order of the SELECT in History::runs().
RunRow run_in(const SQLite::Statement& row) {
  RunRow run{row.getColumn(0).getInt64(),
             row.getColumn(1).getInt64(),
             row.getColumn(2).getString(),
             row.getColumn(3).getString(),
             {}};
  LessonResult& result = run.result;
  result.lesson = row.getColumn(4).getString();
  result.task = row.getColumn(5).getString();
  result.mode = choice_in(row, 6, LessonMode::by_yourself);
  result.end = choice_in(row, 7, LessonEnd::left);
  result.guided = flag_in(row, 8);
  result.whole = flag_in(row, 9);
  result.begin = figure_in(row, 10);
  result.duration = figure_in(row, 11);
  result.grade = std::clamp(figure_in(row, 12), 0.0, kMostPoints);
  result.passed = flag_in(row, 13);
  result.why = row.getColumn(14).getString();
  result.slip_energy = figure_in(row, 15);
  result.fuel = figure_in(row, 16);
  return run;
}

}  // namespace

void History::State::open() {
  std::error_code problem;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), problem);
  if (problem) refuse(fmt::format("its folder cannot be made: {}", problem.message()));
  // Absolute: "file:x" and ":memory:" are names of files, too.
  const std::string place = std::filesystem::absolute(file, problem).string();
  if (problem) refuse(fmt::format("it cannot be found: {}", problem.message()));
  const bool has_log = std::filesystem::exists(place + "-wal", problem);
  said([&] {
    database = std::make_unique<SQLite::Database>(place, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                                                  static_cast<int>(patience.count()));
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
  const int version = version_in_file();
  if (database->execAndGet("PRAGMA quick_check(1)").getString() != "ok") refuse("it is damaged; it is left as it is");
  return version;
}

// 0: nothing is in it yet, nobody's name either. Refuses what is another program's.
int History::State::version_in_file() {
  const int application = database->execAndGet("PRAGMA application_id").getInt();
  const int version = database->execAndGet("PRAGMA user_version").getInt();
  const bool is_empty = database->execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
  const bool is_ours = application == kApplicationId;
  if (is_ours && version > kSchemaVersion) refuse("a newer program made it; it is left as it is");
  const bool is_new = is_empty && version == 0 && (is_ours || application == 0);
  if (!is_new && (is_empty || !is_ours || version < 1)) refuse(kForeign);
  return version;
}

void History::State::bring_up_to_date() {
  SQLite::Transaction transaction(*database, SQLite::TransactionBehavior::IMMEDIATE);
  // Another program may have been faster.
  for (int from = version_in_file(); from < kSchemaVersion; ++from) {
    database->exec(kMigrations[static_cast<std::size_t>(from)]);
    database->exec(fmt::format("PRAGMA user_version = {}", from + 1));
  }
  database->exec(fmt::format("PRAGMA application_id = {}", kApplicationId));
  transaction.commit();
}

// Writing ahead needs the file alone for a moment, and SQLite does not wait for it by itself.
void History::State::keep_log() {
  for (milliseconds waited{0};; waited += kNap) {
    try {
      database->exec("PRAGMA journal_mode = WAL");
      break;
    } catch (const SQLite::Exception& problem) {
      if (!is_busy(problem) || waited >= patience) throw;
      sqlite3_sleep(static_cast<int>(kNap.count()));
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
  each_figure(shift, [&](const char*, const auto& value) { bind_figure(insert, place++, value); });
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
    bind_figure(insert, 5, fault.time);
    bind_figure(insert, 6, fault.value);
    insert.bind(7, fault.shift);
    bind_figure(insert, 8, points.count(i) != 0 ? points.at(i) : 0.0);
    insert.bind(9, fault.step);
    bind_figure(insert, 10, fault.wanted);
    insert.exec();
    insert.reset();
  }
}

void check_learner_name(std::string_view name) {
  if (name.empty() || name.size() > kLongestName)
    throw std::invalid_argument(fmt::format("a learner's name has 1 to {} bytes", kLongestName));
  if (!is_printable(name)) throw std::invalid_argument("a learner's name has no control characters");
}

History::History(const std::filesystem::path& file, Clock now, milliseconds patience)
    : state_(std::make_unique<State>(file, std::move(now), patience)) {
  state_->open();
}

History::~History() = default;

void History::set_patience(milliseconds patience) {
  sqlite3_busy_timeout(state_->database->getHandle(), static_cast<int>(patience.count()));
}

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
    bind_figure(insert, 10, result.begin);
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
    bind_figure(update, 4, result.begin);
    bind_figure(update, 5, result.duration);
    bind_figure(update, 6, result.grade);
    update.bind(7, result.passed ? 1 : 0);
    update.bind(8, result.why);
    bind_figure(update, 9, result.slip_energy);
    bind_figure(update, 10, result.fuel);
    update.bind(11, run);
    if (update.exec() == 0) throw HistoryGone(state_->unusable(kDeleted));
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
    RunParts parts(*state_->database);
    std::vector<RunRow> runs;
    while (rows.executeStep()) {
      RunRow run = run_in(rows);
      parts.read(run.id, run.result);
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

std::string History::erase_learner(std::int64_t learner, const RecordingRemover& remove) {
  state_->write([&] {
    std::vector<std::string> recordings;
    SQLite::Statement rows = state_->query(
        "SELECT DISTINCT recording FROM lesson_run WHERE recording != '' AND session IN (SELECT id FROM session WHERE "
        "learner = ?1) AND recording NOT IN (SELECT recording FROM lesson_run WHERE session NOT IN (SELECT id FROM "
        "session WHERE learner = ?1))");
    rows.bind(1, learner);
    while (rows.executeStep()) recordings.push_back(rows.getColumn(0).getString());
    SQLite::Statement forget = state_->query("DELETE FROM learner WHERE id = ?");
    forget.bind(1, learner);
    forget.exec();
    SQLite::Statement mark = state_->query("INSERT INTO pending_erasure VALUES (?)");
    mark.bind(1, state_->date());
    mark.exec();
    remove(recordings);
  });
  return finish_erasure();
}

bool History::erasure_is_pending() {
  return state_->said(
      [&] { return state_->database->execAndGet("SELECT count(*) FROM pending_erasure").getInt64() > 0; });
}

// The deleted rows are overwritten already, in new pages of the log. The old ones go with it; VACUUM gives room back.
std::string History::finish_erasure() {
  const auto exec = [&](const char* text) {
    return state_->try_to([&] {
      state_->database->exec(text);
      return std::string();
    });
  };
  std::string left = exec("VACUUM");
  const std::string log = state_->try_to([&] { return state_->empty_log(); });
  if (left.empty()) left = log;
  if (left.empty()) left = exec("DELETE FROM pending_erasure");
  if (left.empty()) return {};
  return fmt::format("{}: what was deleted is not yet out of the file for good: {}; delete again when that is over",
                     file().string(), left);
}

// Returns what keeps it, or nothing: a reader is no error to SQLite.
std::string History::State::empty_log() {
  const bool is_kept = database->execAndGet("PRAGMA wal_checkpoint(TRUNCATE)").getInt() != 0;
  return is_kept ? "another program reads it" : "";
}

// Returns what went wrong, or what the work says.
std::string History::State::try_to(const std::function<std::string()>& work) {
  try {
    return work();
  } catch (const SQLite::Exception& problem) {
    return reason_of(problem);
  }
}

}  // namespace gearshift
