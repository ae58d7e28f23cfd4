// Opening the history in difficult cases: many processes create it at once, a killed program left files behind, or the
// files have invalid content.
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/history/history.h"
#include "app/lessons/history/schema.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/history_version_1.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

std::string all_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Runs `work` in a child process that exits without closing anything. Its exit status is 0 if `work` threw nothing.
template <class Work>
pid_t in_another_program(const Work& work) {
  const pid_t child = fork();
  if (child != 0) return child;
  try {
    work();
    _exit(0);
  } catch (const std::exception& problem) {
    (void)!write(2, problem.what(), std::string(problem.what()).size());
    _exit(1);
  }
}

bool exits_cleanly(pid_t program) {
  int status = -1;
  waitpid(program, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

TEST_CASE("many programs create one file at the same time, and all of them can use it") {
  constexpr int kPrograms = 8;
  for (int round = 0; round < 20; ++round) {
    const TempFolder folder;
    int start[2];
    REQUIRE(pipe(start) == 0);
    std::vector<pid_t> programs;
    for (int i = 0; i < kPrograms; ++i) {
      programs.push_back(in_another_program([&] {
        close(start[1]);
        char c = 0;
        (void)!read(start[0], &c, 1);  // returns when the parent closes the pipe
        History history(folder / "history.db");
        history.find_or_add_learner(std::to_string(i));
      }));
    }
    close(start[0]);
    close(start[1]);
    int well = 0;
    for (const pid_t program : programs) well += exits_cleanly(program) ? 1 : 0;
    CHECK(well == kPrograms);
    CHECK(History(folder / "history.db").learners().size() == kPrograms);
  }
}

TEST_CASE("a file of a newer version, left with its log by a killed program, is rejected and does not change") {
  const TempFolder folder;
  const auto file = folder / "history.db", log = folder / "history.db-wal";
  REQUIRE(exits_cleanly(in_another_program([&] {
    auto* left_open = new History(file);
    left_open->find_or_add_learner("Ada");
    _exit(0);  // exits with the database still open
  })));
  sqlite3* newer = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &newer) == SQLITE_OK);
  sqlite3_db_config(newer, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  const std::string set_version = "PRAGMA user_version = " + std::to_string(kSchemaVersion + 1);
  REQUIRE(sqlite3_exec(newer, set_version.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(newer);
  const std::string before = all_bytes(file), logged = all_bytes(log);
  REQUIRE(!logged.empty());
  CHECK_THROWS_WITH_AS(History{file}, doctest::Contains("the file was written by a newer version of gearshift"),
                       HistoryError);
  CHECK(all_bytes(file) == before);
  CHECK(all_bytes(log) == logged);
}

TEST_CASE("a file of version 1 is upgraded: its runs keep their verdict, which counts as by the old rule") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  const std::int64_t ada = write_one_run(file, 2);
  sqlite3* old = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &old) == SQLITE_OK);
  REQUIRE(sqlite3_exec(old, kToHistoryVersion1, nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(old);
  for (const HistoryUse use : {HistoryUse::read, HistoryUse::write}) {
    History history(file, system_seconds, kHistoryLockTimeout, use);
    const std::vector<RunRow> runs = history.runs(ada);
    REQUIRE(runs.size() == 1);
    const LessonResult& result = runs[0].result;
    CHECK(result.grading == Grading::old_rule);
    CHECK(result.passed);
    CHECK(result.grade == 7.5);
    CHECK(result.shifts.size() == 2);
    CHECK_FALSE(result.score);
    CHECK_FALSE(result.figures.jerk_peak);
    CHECK(result.car.empty());
    CHECK(result.lever_help == (result.guided ? 1.0 : 0.0));
    CHECK(result.pedal_help == 0.0);
  }
  History history(file);
  const std::int64_t run = history.begin_run(history.begin_session(ada, "1.0"), some_result(0), "");
  history.end_run(run, some_result(1));
  const LessonResult result = history.runs(ada)[1].result;
  CHECK(result.grading == Grading::norm);
  CHECK(result.score == 0.75);
  CHECK(result.figures.impulse == 4.5);
  CHECK(result.car == "hatchback");
  CHECK(result.path_length == 0.25);
  CHECK(result.lever_help == 0.5);
  CHECK(result.pedal_help == 0.125);
  CHECK_FALSE(result.figures.clutch_lag_error);
}

// Invariant: data is written only to the file that was opened, and only while the file's version is unchanged.
TEST_CASE(
    "a file upgraded by a newer program, or removed, while it is open: rejected in one sentence, and not written") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  History history(file);
  const std::int64_t ada = history.find_or_add_learner("Ada");
  const auto set_version = [&](int version) {
    sqlite3* other = nullptr;
    REQUIRE(sqlite3_open(file.c_str(), &other) == SQLITE_OK);
    const std::string text = "PRAGMA user_version = " + std::to_string(version);
    REQUIRE(sqlite3_exec(other, text.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(other);
  };
  set_version(kSchemaVersion + 1);
  CHECK_THROWS_WITH_AS(history.find_or_add_learner("Bob"),
                       doctest::Contains("a newer version of gearshift has upgraded the file"), HistoryError);
  CHECK_THROWS_AS(history.begin_session(ada, "1.0"), HistoryError);
  set_version(kSchemaVersion);
  history.find_or_add_learner("Bob");
  CHECK(history.learners().size() == 2);

  std::filesystem::rename(file, folder / "elsewhere.db");
  CHECK_THROWS_WITH_AS(history.find_or_add_learner("Cy"), doctest::Contains("the file was removed"), HistoryError);
  CHECK_FALSE(std::filesystem::exists(file));
  std::ofstream(file) << "another one";
  CHECK_THROWS_WITH_AS(history.find_or_add_learner("Cy"), doctest::Contains("the file was removed or replaced"),
                       HistoryError);
  std::filesystem::rename(folder / "elsewhere.db", file);
  history.find_or_add_learner("Cy");
  CHECK(history.learners().size() == 3);
}

TEST_CASE("dates come from the given clock") {
  const TempFolder folder;
  std::int64_t now = 0;
  History history(folder / "history.db", [&] { return now; });
  const std::int64_t ada = history.find_or_add_learner("Ada");
  now = 1'000'000'000;  // Unix time of 2001-09-09 01:46:40 UTC
  history.begin_run(history.begin_session(ada, "1.0"), some_result(0), "");
  CHECK(history.learners().at(0).made_at == "1970-01-01T00:00:00Z");
  CHECK(history.runs(ada).at(0).begun_at == "2001-09-09T01:46:40Z");
  CHECK(parse_utc("2001-09-09T01:46:40Z") == now);
  for (const char* none : {"", "2001-09-09", "2001-09-09T01:46:40", "2001-13-09T01:46:40Z", "2001-02-30T01:46:40Z"})
    CHECK_FALSE(parse_utc(none).has_value());
}

TEST_CASE("changes() counts the writes of other programs, and not its own") {
  const TempFolder folder;
  History one(folder / "history.db"), other(folder / "history.db");
  const std::int64_t before = one.changes();
  one.find_or_add_learner("Ada");
  CHECK(one.changes() == before);
  other.find_or_add_learner("Bob");
  CHECK(one.changes() != before);
}

TEST_CASE("data of a learner who was erased in the meantime is rejected, and is not stored for anyone else") {
  const TempFolder folder;
  History driven(folder / "history.db"), instructor(folder / "history.db");
  const std::int64_t bob = driven.find_or_add_learner("Bob"), ada = driven.find_or_add_learner("Ada");
  const std::int64_t session = driven.begin_session(ada, "1.0");
  const std::int64_t run = driven.begin_run(session, some_result(0), "");
  CHECK(instructor.erase_learner(ada, [](const auto&) {}).empty());
  const std::int64_t other = instructor.begin_run(instructor.begin_session(bob, "1.0"), some_result(0), "");
  CHECK_THROWS_WITH_AS(driven.add_shift(run, some_shift(0)), doctest::Contains("deleted by another program"),
                       HistoryError);
  for (const LessonResult& result : {some_result(2), some_result(0), LessonResult{}})
    CHECK_THROWS_WITH_AS(driven.end_run(run, result), doctest::Contains("deleted by another program"), HistoryError);
  CHECK_THROWS_AS(driven.begin_run(session, some_result(0), ""), HistoryError);
  REQUIRE(instructor.runs(bob).size() == 1);
  CHECK(instructor.runs(bob)[0].id == other);
  CHECK(instructor.runs(bob)[0].result.shifts.empty());
  CHECK(instructor.runs(bob)[0].result.end == LessonEnd::running);
}

// Invariant: only a file that this program made, with a version that it knows, is used as a history. Any other file
// stays unchanged, byte for byte.
TEST_CASE("a file of an unknown version or of a different program, empty or not, is rejected and not changed") {
  const TempFolder folder;
  const auto good = folder / "good.db", file = folder / "history.db";
  History(good).find_or_add_learner("Ada");
  const std::string intact = all_bytes(good);
  const auto refused = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      History history(file);
      return false;
    } catch (const HistoryError& problem) {
      const std::string message = problem.what();
      CAPTURE(message);
      CHECK(message.find("nothing was changed") != std::string::npos);
      CHECK(message.find('\n') == std::string::npos);
      return all_bytes(file) == bytes;
    }
  };
  // Bytes 60 to 63 hold the schema version, which SQLite calls user version (sqlite.org/fileformat2.html, section 1.3).
  const auto with_version = [](std::string bytes, std::int32_t version) {
    for (std::size_t i = 0; i < 4; ++i)
      bytes[60 + i] = static_cast<char>(static_cast<std::uint32_t>(version) >> (24 - 8 * i));
    return bytes;
  };
  for (const std::int32_t version : {-2'000'000'000, -65, -1, 0, kSchemaVersion + 1, 2'000'000'000})
    CHECK(refused(with_version(intact, version)));
  CHECK_FALSE(refused(with_version(intact, kSchemaVersion)));
  for (const char* name : {"history.db-wal", "history.db-shm"}) std::filesystem::remove(folder / name);

  const auto empty = [&](const std::string& mark) {
    const auto database_file = folder / "empty.db";
    std::filesystem::remove(database_file);
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(database_file.c_str(), &database) == SQLITE_OK);
    REQUIRE(sqlite3_exec(database, mark.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(database);
    return all_bytes(database_file);
  };
  CHECK(refused(empty("PRAGMA application_id = 1")));
  CHECK(refused(empty("PRAGMA application_id = 0x47534849")));  // "GSHI", the old id
  CHECK(refused(empty("PRAGMA user_version = 2")));
  CHECK(refused(empty("PRAGMA user_version = -2")));
  CHECK_FALSE(refused(""));  // an empty file is accepted
}

TEST_CASE("a file name with a special meaning in SQLite is used as an ordinary name") {
  const TempFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  for (const char* name : {":memory:", "file:x?mode=memory", "plain.db"}) {
    History(name).find_or_add_learner("Ada");
    CHECK(std::filesystem::is_regular_file(folder / name));
    CHECK(History(name).find_learner("Ada").has_value());
  }
  std::filesystem::current_path(before);
}

TEST_CASE("opening a file that a second program has locked waits until the timeout, and no longer") {
  const TempFolder folder;
  History history(folder / "history.db");
  sqlite3* other = nullptr;
  REQUIRE(sqlite3_open((folder / "history.db").c_str(), &other) == SQLITE_OK);
  REQUIRE(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr) == SQLITE_OK);
  for (const int lock_timeout : {0, 50}) {
    history.set_lock_timeout(std::chrono::milliseconds(lock_timeout));
    const auto begin = std::chrono::steady_clock::now();
    CHECK_THROWS_AS(history.find_or_add_learner("Ada"), HistoryBusy);
    const auto waited = std::chrono::steady_clock::now() - begin;
    CHECK(waited >= std::chrono::milliseconds(lock_timeout / 2));
    CHECK(waited < std::chrono::milliseconds(lock_timeout + 500));
  }
  sqlite3_close(other);
  CHECK(history.find_or_add_learner("Ada") > 0);
}
