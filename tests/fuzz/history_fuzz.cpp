// Fuzzes the file of the history, through reports and a lesson's record. An input changes a history of one learner: an
// odd first byte sets values of any type in any columns, an even one overwrites bytes of the pages. The history must be
// read, or be rejected in one sentence that names the file.
#include <sqlite3.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "app/lessons/history/history.h"
#include "app/lessons/report/learner_table.h"
#include "app/lessons/report/report_csv.h"
#include "app/lessons/report/report_json.h"
#include "app/lessons/report/report_page.h"
#include "tests/fuzz/fuzz_checks.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

LessonResult sample_result() {
  LessonResult result;
  result.lesson = "moving_off";
  result.task = "moving_off";
  result.end = LessonEnd::done;
  result.duration = 34.25;
  result.grade = 7.5;
  result.passed = true;
  result.grading = Grading::norm;
  result.car = "hatchback";
  result.errors = {make_driving_error(ErrorKind::stall, Severity::severe, 13.5, 36.6, -1)};
  ShiftRecord shift;
  shift.steps = {ShiftStep::clutch_down, ShiftStep::gear, ShiftStep::clutch_up};
  result.shifts = {shift};
  return result;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The bytes of a history of two runs, one of them commented on.
const std::string& intact_history() {
  static const std::string bytes = [] {
    const FuzzedFile file("history.db");
    {
      History history(file.path());
      const std::int64_t session = history.begin_session(history.find_or_add_learner("Ada"), "1.0");
      for (int i = 0; i < 2; ++i) {
        const std::int64_t run = history.begin_run(session, sample_result(), "ada.trace");
        history.end_run(run, sample_result());
        if (i == 0) history.add_comment(run, "Bo", "Calmer.");
      }
    }
    return bytes_of(file.path());
  }();
  return bytes;
}

// Takes numbers and texts from the input; zeros and empty texts after its end.
class Input {
 public:
  explicit Input(std::string_view bytes) : rest_(bytes) {}
  bool is_empty() const { return rest_.empty(); }
  std::uint32_t number(int bytes) {
    std::uint32_t value = 0;
    for (const char c : text(static_cast<std::size_t>(bytes))) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  }
  std::string_view text(std::size_t size) {
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(taken.size());
    return taken;
  }

 private:
  std::string_view rest_;
};

void overwrite_bytes(const std::filesystem::path& file, Input& input) {
  std::string bytes = intact_history();
  while (!input.is_empty()) {
    const std::size_t at = input.number(3) % bytes.size();
    const std::string_view text = input.text(1 + input.number(1) % 16);
    bytes.replace(at, std::min(text.size(), bytes.size() - at), text.substr(0, bytes.size() - at));
  }
  std::ofstream(file, std::ios::binary) << bytes;
}

struct Column {
  std::string table, name;
};

std::vector<Column> columns_of(sqlite3* database) {
  std::vector<Column> columns;
  const auto add = [](void* to, int, char** values, char**) {
    static_cast<std::vector<Column>*>(to)->push_back({values[0], values[1]});
    return 0;
  };
  sqlite3_exec(database,
               "SELECT t.name, c.name FROM sqlite_master t, pragma_table_info(t.name) c WHERE t.type = 'table'", add,
               &columns, nullptr);
  return columns;
}

void bind_value(sqlite3_stmt* statement, Input& input) {
  static constexpr double kNumbers[] = {-1.0, 0.5, 1e9, 1e300, -1e300, 9.3e18};
  const std::uint32_t kind = input.number(1);
  switch (kind % 5) {
    case 0:
      sqlite3_bind_null(statement, 1);
      break;
    case 1:
      sqlite3_bind_int64(statement, 1, static_cast<std::int32_t>(input.number(4)));
      break;
    case 2:
      sqlite3_bind_double(statement, 1, kNumbers[kind / 5 % std::size(kNumbers)]);
      break;
    default: {
      const std::string_view text = input.text(input.number(1) % 40);
      const auto size = static_cast<int>(text.size());
      if (kind % 5 == 3)
        sqlite3_bind_text(statement, 1, text.data(), size, SQLITE_TRANSIENT);
      else
        sqlite3_bind_blob(statement, 1, text.data(), size, SQLITE_TRANSIENT);
    }
  }
}

// Values that the schema itself rejects are left out.
void set_values(const std::filesystem::path& file, Input& input) {
  std::ofstream(file, std::ios::binary) << intact_history();
  sqlite3* database = nullptr;
  sqlite3_open(file.c_str(), &database);
  sqlite3_exec(database, "PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY; BEGIN", nullptr, nullptr, nullptr);
  static const std::vector<Column> kColumns = columns_of(database);
  check_invariant(!kColumns.empty(), "a history has columns");
  while (!input.is_empty()) {
    const Column& column = kColumns[input.number(1) % kColumns.size()];
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database, ("UPDATE \"" + column.table + "\" SET \"" + column.name + "\" = ?").c_str(), -1,
                       &statement, nullptr);
    bind_value(statement, input);
    sqlite3_step(statement);
    sqlite3_finalize(statement);
  }
  sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr);
  sqlite3_close(database);
}

void check_reports(History& history) {
  std::vector<LearnerHistory> all;
  for (const LearnerRow& learner : history.learners()) {
    const LearnerHistory& each = all.emplace_back(read_learner(history, learner));
    check_invariant(!report_page(each, show_shifts(each, history.file().parent_path()), {}).empty(), "a page is made");
    for (const auto& table : {runs_csv, shifts_csv, errors_csv})
      check_invariant(!table(each, {}).empty(), "a table has a head");
    check_invariant(!history_json(each, {}).dump().empty() && !run_table(each).empty(), "a learner is told");
  }
  check_invariant(!class_page(all, {}).empty() && !standings_csv(all, {}, {}).empty(), "a class page is made");
}

void record_lesson(History& history) {
  const std::int64_t session = history.begin_session(history.find_or_add_learner("Ada"), "1.0");
  const std::int64_t run = history.begin_run(session, sample_result(), "");
  history.end_run(run, sample_result());
}

template <class Work>
bool is_accepted(const std::filesystem::path& file, HistoryUse use, const Work& work) {
  try {
    History history(file, system_seconds, std::chrono::milliseconds(0), use);
    work(history);
    return true;
  } catch (const HistoryError& refusal) {  // the only exception allowed
    check_sentence(refusal, file.string());
    return false;
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const TempFolder folder;
  const std::filesystem::path file = folder / "history.db";
  Input input(text_of(data + 1, size - 1));
  if (data[0] % 2 == 0)
    overwrite_bytes(file, input);
  else
    set_values(file, input);
  if (is_accepted(file, HistoryUse::read, check_reports)) ++accepted_inputs;
  is_accepted(file, HistoryUse::write, record_lesson);
  return 0;
}
