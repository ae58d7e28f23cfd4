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

void begin(SQLite::Statement& rows, std::int64_t run) {
  rows.reset();
  rows.bind(1, run);
}

// Reads shifts, driving errors and comments run by run, with prepared statements.
class RunParts {
 public:
  explicit RunParts(SQLite::Database& database)
      : shift_rows_(database, "SELECT " + column_names<ShiftRecord>() + " FROM shift WHERE run = ? ORDER BY shift"),
        error_rows_(database,
                    "SELECT " + column_names<DrivingError>() + " FROM driving_error WHERE run = ? ORDER BY number"),
        comment_rows_(database,
                      "SELECT made_at, author, text, id, edited_at FROM comment WHERE run = ? ORDER BY made_at, id") {}

  void read(RunRow& run) {
    for (begin(shift_rows_, run.id); shift_rows_.executeStep();) read_shift(run.result);
    for (begin(error_rows_, run.id); error_rows_.executeStep();) read_error(run.result);
    for (begin(comment_rows_, run.id); comment_rows_.executeStep();) read_comment(run.comments);
  }

 private:
  // Reads one shift. Skips rows with an impossible gear or shift number.
  void read_shift(LessonResult& result) {
    ShiftRecord shift;
    read_record(shift_rows_, 0, shift);
    if (is_gear(shift.from) && is_gear(shift.to) && is_shift_number(shift.number))
      result.shifts.push_back(std::move(shift));
  }

  // Skips an error of a kind that this version of the program does not know.
  void read_error(LessonResult& result) {
    if (!error_kind_of(error_rows_.getColumn(0).getString())) return;
    DrivingError error;
    read_record(error_rows_, 0, error);
    error.points = std::clamp(error.points, 0.0, kMaxPoints);
    if (!is_shift_number(error.shift)) error.shift = -1;
    for (std::optional<int>* gear : {&error.gear, &error.wanted_gear}) {
      if (!is_gear(gear->value_or(haptics::kNeutralGear))) gear->reset();
    }
    result.errors.push_back(std::move(error));
  }

  void read_comment(std::vector<CommentRow>& comments) {
    comments.push_back({stored_date(comment_rows_.getColumn(0).getString()), comment_rows_.getColumn(1).getString(),
                        comment_rows_.getColumn(2).getString(), comment_rows_.getColumn(3).getInt64(),
                        stored_date(comment_rows_.getColumn(4).getString())});
  }

  SQLite::Statement shift_rows_, error_rows_, comment_rows_;
};

// The columns are in the order of the SELECT in History::runs().
RunRow run_in(const SQLite::Statement& row) {
  RunRow run{row.getColumn(0).getInt64(),
             row.getColumn(1).getInt64(),
             stored_date(row.getColumn(2).getString()),
             row.getColumn(3).getString(),
             {}};
  run.kept_at = row.getColumn(read_record(row, 4, run.result)).getString();
  run.result.grade = std::clamp(run.result.grade, 0.0, kMaxPoints);
  return run;
}

}  // namespace

std::vector<LearnerRow> History::State::learners() {
  std::vector<LearnerRow> all;
  SQLite::Statement rows = query("SELECT id, name, made_at, next_lesson FROM learner ORDER BY name");
  while (rows.executeStep()) {
    all.push_back({rows.getColumn(0).getInt64(), rows.getColumn(1).getString(),
                   stored_date(rows.getColumn(2).getString()), rows.getColumn(3).getString()});
  }
  return all;
}

std::optional<LearnerRow> History::State::find_learner(std::string_view name) {
  const std::vector<LearnerRow> rows = learners();
  std::vector<std::string> names;
  for (const LearnerRow& row : rows) names.push_back(row.name);
  const std::optional<std::size_t> found = find_name(names, name);
  return found ? std::optional(rows[*found]) : std::nullopt;
}

std::vector<LearnerRow> History::learners() {
  return state_->translating_errors([&] { return state_->learners(); });
}

std::optional<LearnerRow> History::find_learner(std::string_view name) {
  return state_->translating_errors([&] { return state_->find_learner(name); });
}

std::vector<RunRow> History::runs(std::int64_t learner) {
  return state_->translating_errors([&] {
    // Reads all rows from one snapshot, even while another program is writing.
    SQLite::Transaction snapshot(*state_->database);
    SQLite::Statement rows =
        state_->query("SELECT r.id, session, r.begun_at, recording, " + column_names<LessonResult>() + ", kept_at" +
                      " FROM lesson_run r JOIN session s ON s.id = r.session "
                      "WHERE s.learner = ? ORDER BY r.begun_at, r.id");
    rows.bind(1, learner);
    RunParts parts(*state_->database);
    std::vector<RunRow> runs;
    while (rows.executeStep()) {
      RunRow run = run_in(rows);
      parts.read(run);
      runs.push_back(std::move(run));
    }
    return runs;
  });
}

}  // namespace gearshift::lessons
