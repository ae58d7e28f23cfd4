#include "app/lessons/assessment/shift_fields.h"
#include "app/lessons/history/history_state.h"
#include "app/lessons/history/sql_binding.h"

namespace gearshift::lessons {
namespace {

constexpr double kMaxPoints = 10.0;
constexpr std::int64_t kMaxShifts = 1'000'000;  // largest number of shifts per run; shifts are numbered from 0

bool is_shift_number(std::int64_t number) noexcept {
  return number >= 0 && number < kMaxShifts;
}

bool is_gear(std::int64_t gear) noexcept {
  return gear >= haptics::kReverseGear && gear <= haptics::kMaxGear;
}

// Reads shifts and driving errors run by run, with prepared statements.
class RunParts {
 public:
  explicit RunParts(SQLite::Database& database)
      : shift_rows_(database, "SELECT number, from_gear, to_gear, guided, missed, steps" + figure_names() +
                                  " FROM shift WHERE run = ? ORDER BY number"),
        error_rows_(database,
                    "SELECT kind, severity, time_s, value, shift, points, step, wanted FROM driving_error WHERE run = "
                    "? ORDER BY "
                    "number") {}

  void read(std::int64_t run, LessonResult& result) {
    for (begin(shift_rows_, run); shift_rows_.executeStep();) read_shift(result);
    for (begin(error_rows_, run); error_rows_.executeStep();) read_error(result);
  }

 private:
  static void begin(SQLite::Statement& rows, std::int64_t run) {
    rows.reset();
    rows.bind(1, run);
  }

  // Reads one shift. Skips rows with an impossible gear or shift number.
  void read_shift(LessonResult& result) {
    const std::int64_t from = shift_rows_.getColumn(1).getInt64(), to = shift_rows_.getColumn(2).getInt64();
    const std::int64_t number = shift_rows_.getColumn(0).getInt64();
    if (!is_gear(from) || !is_gear(to) || !is_shift_number(number)) return;
    ShiftRecord shift;
    shift.number = number;
    shift.from = static_cast<int>(from);
    shift.to = static_cast<int>(to);
    shift.guided = flag_in(shift_rows_, 3);
    shift.missed = flag_in(shift_rows_, 4);
    shift.steps = parse_steps(shift_rows_.getColumn(5).getString());
    int index = 6;
    each_figure(shift, [&](const char*, auto& value) {
      value = static_cast<std::remove_reference_t<decltype(value)>>(figure_in(shift_rows_, index++));
    });
    result.shifts.push_back(std::move(shift));
  }

  void read_error(LessonResult& result) {
    const std::optional<ErrorKind> kind = error_kind_of(error_rows_.getColumn(0).getString());
    if (!kind) return;  // this version of the program does not know the kind of this error
    const double points = std::clamp(figure_in(error_rows_, 5), 0.0, kMaxPoints);
    if (points > 0.0) result.deductions.push_back({result.errors.size(), points});
    const std::int64_t shift = error_rows_.getColumn(4).getInt64();
    result.errors.push_back({*kind, enum_in(error_rows_, 1, Severity::very_severe), figure_in(error_rows_, 2),
                             figure_in(error_rows_, 3), is_shift_number(shift) ? shift : -1,
                             error_rows_.getColumn(6).getString(), figure_in(error_rows_, 7)});
  }

  SQLite::Statement shift_rows_, error_rows_;
};

// The columns are in the order of the SELECT in History::runs().
RunRow run_in(const SQLite::Statement& row) {
  RunRow run{row.getColumn(0).getInt64(),
             row.getColumn(1).getInt64(),
             row.getColumn(2).getString(),
             row.getColumn(3).getString(),
             {}};
  LessonResult& result = run.result;
  result.lesson = row.getColumn(4).getString();
  result.task = row.getColumn(5).getString();
  result.mode = enum_in(row, 6, LessonMode::by_yourself);
  result.end = enum_in(row, 7, LessonEnd::left);
  result.guided = flag_in(row, 8);
  result.is_complete = flag_in(row, 9);
  result.begin = figure_in(row, 10);
  result.duration = figure_in(row, 11);
  result.grade = std::clamp(figure_in(row, 12), 0.0, kMaxPoints);
  result.passed = flag_in(row, 13);
  result.why = row.getColumn(14).getString();
  result.slip_energy = figure_in(row, 15);
  result.fuel = figure_in(row, 16);
  return run;
}

}  // namespace

std::vector<LearnerRow> History::learners() {
  return state_->translating_errors([&] {
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

std::vector<RunRow> History::runs(std::int64_t learner) {
  return state_->translating_errors([&] {
    // Reads all rows from one snapshot, even while another program is writing.
    SQLite::Transaction snapshot(*state_->database);
    SQLite::Statement rows = state_->query(
        "SELECT r.id, session, r.begun_at, recording, lesson, task, mode, ended, guided, complete, begin_s, "
        "duration_s, "
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
  return state_->translating_errors([&] {
    std::vector<CommentRow> all;
    SQLite::Statement rows =
        state_->query("SELECT made_at, author, text, id, edited_at FROM comment WHERE run = ? ORDER BY id");
    rows.bind(1, run);
    while (rows.executeStep()) {
      all.push_back({rows.getColumn(0).getString(), rows.getColumn(1).getString(), rows.getColumn(2).getString(),
                     rows.getColumn(3).getInt64(), rows.getColumn(4).getString()});
    }
    return all;
  });
}

std::vector<std::string> History::settings(std::int64_t session) {
  return state_->translating_errors([&] {
    std::vector<std::string> all;
    SQLite::Statement rows = state_->query("SELECT text FROM settings WHERE session = ? ORDER BY id");
    rows.bind(1, session);
    while (rows.executeStep()) all.push_back(rows.getColumn(0).getString());
    return all;
  });
}

}  // namespace gearshift::lessons
