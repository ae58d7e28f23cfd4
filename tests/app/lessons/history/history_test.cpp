// A second connection reads back exactly what was written. A file that is not a usable history is left unchanged.
#include "app/lessons/history/history.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "app/lessons/history/schema.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/full_disk.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

// Number of members of a struct: the largest number of initialisers that it accepts.
struct Anything {
  template <class T>
  operator T() const {
    return T();
  }
};
template <class S, class... Values>
constexpr std::size_t count_members() {
  if constexpr (requires { S{Values{}..., Anything{}}; })
    return count_members<S, Values..., Anything>();
  else
    return sizeof...(Values);
}

bool is_refused(const std::filesystem::path& file, const std::string& with) {
  try {
    History history(file);
    history.learners();
    return false;
  } catch (const HistoryError& problem) {
    const std::string message = problem.what();
    CAPTURE(message);
    CHECK(message.find(file.string()) == 0);
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.find(with) != std::string::npos);
    return true;
  }
}

// Writes enough learners, sessions and runs to fill several database pages.
void fill(const std::filesystem::path& file) {
  History history(file);
  const std::int64_t session = history.begin_session(history.find_or_add_learner("Ada"), "1.0");
  for (int i = 0; i < 10; ++i) history.end_run(history.begin_run(session, some_result(0), ""), some_result(4));
}

}  // namespace

TEST_CASE("a lesson is read back as written, with errors, shifts and comments") {
  const TempFolder folder;
  const auto file = folder / "deep/down/history.db";
  std::int64_t run = 0, session = 0;
  {
    History history(file);
    const std::int64_t ada = history.find_or_add_learner("Ada Löwe");
    CHECK(history.find_or_add_learner("Ada Löwe") == ada);
    CHECK(history.find_or_add_learner("Bob") != ada);
    session = history.begin_session(ada, "gearshift 1.0");
    run = history.begin_run(session, some_result(0), "drive.trace");
    history.add_shift(run, some_shift(0));
    history.end_run(run, some_result(7));
    history.add_comment(run, "Instructor", "Läuft.");
    history.set_next_lesson(ada, "reverse");
  }
  History history(file);
  REQUIRE(history.learners().size() == 2);
  const auto ada = history.find_learner("Ada Löwe");
  REQUIRE(ada.has_value());
  CHECK(ada->next_lesson == "reverse");
  CHECK(ada->made_at.size() == std::string("2026-01-02T03:04:05Z").size());
  CHECK_FALSE(history.find_learner("ada lowe").has_value());
  const std::vector<RunRow> runs = history.runs(ada->id);
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].id == run);
  CHECK(runs[0].session == session);
  CHECK(runs[0].recording == "drive.trace");
  check_same(runs[0].result, some_result(7));
  REQUIRE(comments_of(history, run).size() == 1);
  CHECK(comments_of(history, run)[0].author == "Instructor");
  CHECK(comments_of(history, run)[0].text == "Läuft.");
  CHECK_THROWS_AS(history.find_or_add_learner(""), std::invalid_argument);
  CHECK_THROWS_AS(history.find_or_add_learner(std::string(101, 'x')), std::invalid_argument);
}

TEST_CASE("every member of a record is a column") {
  CHECK(fields_of(ShiftRecord()).size() == count_members<ShiftRecord>());
  CHECK(fields_of(DrivingError()).size() == count_members<DrivingError>());
  // Errors and shifts have tables of their own; `had_forces` shows in `why`; `figures` has columns of its own.
  CHECK(fields_of(LessonResult()).size() + 4 == count_members<LessonResult>() + count_members<RunFigures>());
}

TEST_CASE("every kind of error is read back with its named values, and with nothing else") {
  const TempFolder folder;
  LessonResult result = some_result(0);
  result.errors.clear();
  for (int i = 0; i < kErrorKindCount; ++i)
    result.errors.push_back(make_driving_error(static_cast<ErrorKind>(i), Severity::minor, i, 3.0));
  result.errors[0].wanted_gear = 4;
  result.errors[1].target_speed = 12.5;
  result.errors[2].mistake = OrderMistake::lever_first;
  History history(folder / "history.db");
  const std::int64_t ada = history.find_or_add_learner("Ada");
  history.end_run(history.begin_run(history.begin_session(ada, "1.0"), some_result(0), ""), result);
  check_same(history.runs(ada).at(0).result, result);
}

TEST_CASE("a run that never ended is listed as running, with the shifts so far") {
  const TempFolder folder;
  std::int64_t ada = 0;
  {
    History history(folder / "history.db");
    ada = history.find_or_add_learner("Ada");
    const std::int64_t run = history.begin_run(history.begin_session(ada, "1.0"), some_result(0), "");
    for (int i = 0; i < 3; ++i) history.add_shift(run, some_shift(i));
  }
  History history(folder / "history.db");
  const std::vector<RunRow> runs = history.runs(ada);
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].result.end == LessonEnd::running);
  CHECK(runs[0].result.shifts.size() == 3);
}

// Invariant: once add_shift() has returned, the shift stays in the file, even if the process is killed afterwards.
TEST_CASE("killed at a random time, a program loses no reported shift, and the file stays intact: 50 times") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  std::mt19937 chance(1);
  for (int round = 0; round < 50; ++round) {
    int shift_pipe[2];
    REQUIRE(pipe(shift_pipe) == 0);
    const pid_t child = fork();
    if (child == 0) {
      try {
        History history(file);
        const std::int64_t session = history.begin_session(history.find_or_add_learner(std::to_string(round)), "1.0");
        const std::int64_t run = history.begin_run(session, some_result(0), "");
        for (int i = 0;; ++i) {
          history.add_shift(run, some_shift(i));
          if (write(shift_pipe[1], "s", 1) != 1) break;
        }
      } catch (...) {
      }
      _exit(1);
    }
    close(shift_pipe[1]);
    std::int64_t reported = 0;
    const auto enough = static_cast<std::int64_t>(chance() % 30);
    for (char c = 0; reported < enough && read(shift_pipe[0], &c, 1) == 1;) ++reported;
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    // The child has written one byte per reported shift. This counts the bytes that were still unread.
    for (char c = 0; read(shift_pipe[0], &c, 1) == 1;) ++reported;
    close(shift_pipe[0]);

    History history(file);
    const auto learner = history.find_learner(std::to_string(round));
    if (reported == 0 && !learner) continue;
    REQUIRE(learner.has_value());
    const std::vector<RunRow> runs = history.runs(learner->id);
    const std::size_t saved = runs.empty() ? 0 : runs[0].result.shifts.size();
    CHECK(static_cast<std::int64_t>(saved) >= reported);
    for (std::size_t i = 0; i < saved; ++i) check_same(runs[0].result.shifts[i], some_shift(static_cast<int>(i)));
  }
}

TEST_CASE("two programs write into one file at the same time, and both read everything") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  constexpr int kRuns = 40;
  std::vector<pid_t> programs;
  for (const char* name : {"Ada", "Bob"}) {
    programs.push_back(fork());
    if (programs.back() != 0) continue;
    int failed = 0;
    try {
      History history(file);
      const std::int64_t session = history.begin_session(history.find_or_add_learner(name), "1.0");
      for (int i = 0; i < kRuns; ++i) history.end_run(history.begin_run(session, some_result(0), ""), some_result(2));
    } catch (const std::exception& problem) {
      failed = 1;
      (void)!write(2, problem.what(), std::string(problem.what()).size());
    }
    _exit(failed);
  }
  for (const pid_t program : programs) {
    int status = -1;
    waitpid(program, &status, 0);
    CHECK(status == 0);
  }
  History history(file);
  for (const char* name : {"Ada", "Bob"}) CHECK(history.runs(history.find_or_add_learner(name)).size() == kRuns);
}

TEST_CASE("a damaged, foreign or newer file is rejected in one sentence and not changed") {
  const TempFolder folder;
  const auto good = folder / "good.db", file = folder / "history.db";
  fill(good);
  const std::string intact = bytes_of(good);
  REQUIRE(intact.size() > 20000);

  const auto refused = [&](const std::string& bytes, const std::string& with) {
    write_bytes(file, bytes);
    const bool is = is_refused(file, with);
    return is && bytes_of(file) == bytes;
  };
  CHECK_FALSE(refused(intact, ""));  // the undamaged file is accepted
  CHECK(refused("learner,grade\nAda,7\n" + std::string(4096, ' '), "nothing was changed"));
  std::string foreign = intact, newer = intact, old = intact;
  foreign[71] ^= 1;  // bytes 68 to 71: application ID; 60 to 63: version (sqlite.org/fileformat2.html, section 1.3)
  newer[63] = kSchemaVersion + 1;
  old.replace(68, 4, "GSHI");
  CHECK(refused(foreign, "not a gearshift history"));
  CHECK(refused(newer, "newer version of gearshift"));
  CHECK(refused(old,
                "the file was written by an old version of gearshift and can no longer be read; nothing was changed; "
                "rename or delete the file to start a new history"));
  CHECK(refused(intact.substr(0, intact.size() / 2), "damaged"));
  std::string torn = intact;
  for (std::size_t i = 8192; i < 12288; ++i) torn[i] = 'x';
  CHECK(refused(torn, "damaged"));
}

TEST_CASE("a file with random bytes changed is rejected or readable, and never crashes the program") {
  const TempFolder folder;
  const auto good = folder / "good.db", file = folder / "history.db";
  fill(good);
  const std::string intact = bytes_of(good);
  std::mt19937 chance(2);
  int refused = 0;
  for (int round = 0; round < 150; ++round) {
    std::string spoilt = intact;
    for (int i = 0; i < 20; ++i) spoilt[chance() % spoilt.size()] = static_cast<char>(chance());
    write_bytes(file, spoilt);
    try {
      History history(file);
      for (const LearnerRow& learner : history.learners()) history.runs(learner.id);
    } catch (const HistoryError&) {
      ++refused;
    }
    for (const char* log_file : {"history.db-wal", "history.db-shm"}) std::filesystem::remove(folder / log_file);
  }
  CHECK(refused > 50);
}

TEST_CASE("a folder in place of the file, or an impossible path, is rejected in one sentence") {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "history.db");
  CHECK(is_refused(folder / "history.db", "this is a folder"));
  write_bytes(folder / "plain", "");
  CHECK(is_refused(folder / "plain/history.db", "folder"));
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(is_refused(folder / "pipe", "this is not a regular file"));
}

// The test runs in a process without root's rights, because root can always write.
TEST_CASE("a read-only file is rejected in one sentence") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  fill(file);
  std::filesystem::permissions(folder / "", std::filesystem::perms(0555));
  std::filesystem::permissions(file, std::filesystem::perms(0444));
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && setuid(65534) != 0) _exit(2);
    try {
      History history(file);
      history.find_or_add_learner("Bob");
      _exit(3);
    } catch (const HistoryError& problem) {
      _exit(std::string(problem.what()).find("you have no permission to write to the file") != std::string::npos ? 0
                                                                                                                 : 4);
    }
  }
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(WEXITSTATUS(status) == 0);
  std::filesystem::permissions(folder / "", std::filesystem::perms(0755));
}

TEST_CASE("a full disk gives one message; the old data stays, and writing works when there is room again") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  History history(file);
  const std::int64_t ada = history.find_or_add_learner("Ada");
  const std::int64_t run = history.begin_run(history.begin_session(ada, "1.0"), some_result(0), "");
  history.add_shift(run, some_shift(0));
  disk_is_full = true;
  CHECK_THROWS_WITH_AS(history.add_shift(run, some_shift(1)), doctest::Contains("the disk is full"), HistoryError);
  disk_is_full = false;
  REQUIRE(history.runs(ada).size() == 1);
  CHECK(history.runs(ada)[0].result.shifts.size() == 1);
  history.add_shift(run, some_shift(2));
  CHECK(history.runs(ada)[0].result.shifts.size() == 2);
}

TEST_CASE("no byte of an erased learner stays in the file; other learners and their recordings stay") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  const std::string name = "Xanthippe of the Quokkas", why = "Zymurgic quincunx";
  std::int64_t bob = 0;
  {
    History history(file);
    const std::int64_t erased = history.find_or_add_learner(name);
    bob = history.find_or_add_learner("Bob");
    LessonResult result = some_result(30);
    result.why = why;
    for (const char* recording : {"mine.trace", "both.trace"})
      history.end_run(history.begin_run(history.begin_session(erased, "1.0"), result, recording), result);
    history.end_run(history.begin_run(history.begin_session(bob, "1.0"), some_result(1), "both.trace"), some_result(1));
  }
  const auto found = [&](const std::string& text) {
    bool anywhere = false;
    for (const auto& entry : std::filesystem::directory_iterator(folder / ""))
      anywhere |= bytes_of(entry.path()).find(text) != std::string::npos;
    return anywhere;
  };
  CHECK(found(name));
  CHECK(found(why));
  History history(file);
  std::vector<std::string> removed;
  CHECK(history.erase_learner(history.find_or_add_learner(name), [&](const auto& recordings) { removed = recordings; })
            .empty());
  CHECK(removed == std::vector<std::string>{"mine.trace"});
  CHECK_FALSE(history.erasure_is_pending());
  CHECK_FALSE(found(name));
  CHECK_FALSE(found(why));
  CHECK(history.learners().size() == 1);
  CHECK(history.runs(bob).size() == 1);
}
