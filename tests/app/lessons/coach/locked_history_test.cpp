// Another program has locked the history, or the history is slow to open. No frame waits long for it, and no run is
// lost.
#include <sqlite3.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

#include <doctest/doctest.h>

#include "tests/app/lessons/coach/coach_bench.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Time limit for one frame: 50 ms for the lock timeout and 350 ms for delays on a busy machine.
constexpr milliseconds kFrame{400};

// Acts as a second program that holds the history's write lock.
class LockHolder {
 public:
  explicit LockHolder(const std::filesystem::path& file) {
    REQUIRE(sqlite3_open(file.c_str(), &database_) == SQLITE_OK);
    REQUIRE(sqlite3_exec(database_, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr) == SQLITE_OK);
  }
  ~LockHolder() { sqlite3_close(database_); }
  LockHolder(const LockHolder&) = delete;
  LockHolder& operator=(const LockHolder&) = delete;

 private:
  sqlite3* database_ = nullptr;
};

void by_hand(const std::filesystem::path& file, const char* text) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, text, nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
}

template <class Work>
void in_a_frame(const Work& work) {
  const auto begin = steady_clock::now();
  work();
  CHECK(steady_clock::now() - begin < kFrame);
}

// Runs frames without new cycles for `time`, which is long enough for the coach to retry.
void frames(Coach& coach, milliseconds time = milliseconds(1000)) {
  for (const auto end = steady_clock::now() + time; steady_clock::now() < end;) {
    in_a_frame([&] { coach.add({}); });
    std::this_thread::sleep_for(milliseconds(16));
  }
}

std::vector<RunRow> runs_of_ada(const std::filesystem::path& file) {
  History history(file);
  const auto row = history.find_learner("Ada");
  return row ? history.runs(row->id) : std::vector<RunRow>{};
}

}  // namespace

TEST_CASE("while the history is locked no frame waits for it, and afterwards everything is saved in order") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  {
    Coach coach(bench.config);
    coach.set_help(false);
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach, "/a/first.trace");
    const std::vector<DriveSample> drive = bench_drive(Drive::good);
    coach.add(std::span(drive).first(500));
    const std::int64_t first = coach.view().run;
    CHECK(first > 0);
    {
      const LockHolder holder(bench.config.history);
      bench.now += 100;
      for (std::size_t at = 500; at < drive.size(); at += 50) {
        const std::size_t lot = std::min<std::size_t>(50, drive.size() - at);
        in_a_frame([&] { coach.add(std::span(drive).subspan(at, lot)); });
      }
      CHECK(coach.view().phase == LessonPhase::over);
      CHECK(coach.view().run == 0);
      const std::optional<std::string> problem = coach.take_problem();
      REQUIRE(problem.has_value());
      CHECK(problem->find("another program has locked the file") != std::string::npos);
      CHECK(problem->find('\n') == std::string::npos);

      bench.now += 100;
      in_a_frame([&] { coach.offer(bench.config.lessons[1]); });
      in_a_frame([&] { bench.begin(coach, "/a/second.trace"); });
      in_a_frame([&] { coach.add(bench_drive(Drive::pushed)); });
      CHECK(coach.view().runs.size() == 2);
      const std::int64_t second = coach.view().runs[0].id;
      CHECK(second < 0);
      bench.now += 100;
      in_a_frame([&] { coach.add_comment(first, "Bo", "Calmer."); });
      in_a_frame([&] { coach.add_comment(second, "Bo", "Too much."); });
      in_a_frame([&] { coach.set_next("one"); });
      CHECK(coach.view().next == "one");
      frames(coach);
      CHECK_FALSE(coach.take_problem().has_value());  // reported only once
      CHECK(coach.view().is_saving);                  // the results are pending, not lost
    }
    frames(coach);
    CHECK(coach.view().run > first);
    CHECK(coach.view().runs[0].id == coach.view().run);
    REQUIRE(coach.view().runs[0].comments.size() == 1);
    CHECK(coach.view().runs[0].comments[0].text == "Too much.");
    CHECK_FALSE(coach.take_problem().has_value());
  }
  const std::vector<RunRow> runs = runs_of_ada(bench.config.history);
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].result.end == LessonEnd::done);
  CHECK(runs[0].result.lesson == "one");
  CHECK(runs[0].result.passed);
  CHECK(runs[0].recording == "/a/first.trace");
  CHECK(runs[1].result.lesson == "two");
  CHECK(runs[1].result.shifts.size() == 1);
  CHECK(runs[1].result.errors.size() == 1);
  CHECK(runs[1].recording == "/a/second.trace");
  CHECK(runs[1].session == runs[0].session);
  CHECK(runs[0].begun_at == format_utc(kSomeDay));
  CHECK(runs[1].begun_at == format_utc(kSomeDay + 200));  // the date of the drive, not the date of saving
  for (const RunRow& run : runs) {
    REQUIRE(run.comments.size() == 1);
    CHECK(run.comments[0].at == format_utc(kSomeDay + 300));
  }
  CHECK(History(bench.config.history).find_learner("Ada")->next_lesson == "one");
}

TEST_CASE("a run driven while the history was locked is saved afterwards, for the learner who drove it") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  {
    Coach coach(bench.config);
    coach.set_help(false);
    bench.trial(coach, "one");
    {
      const LockHolder holder(bench.config.history);
      bench.trial(coach, "one");
      coach.set_learner("Bob");
      bench.trial(coach, "one");
    }
    CHECK(coach.take_unreferenced_recordings().empty());  // the pending runs have no recordings
    coach.set_learner("Ada");
    frames(coach);
    CHECK(coach.view().runs.size() == 2);
    for (const RunRow& row : coach.view().runs) CHECK(row.id > 0);
  }
  CHECK(runs_of_ada(bench.config.history).size() == 2);
  History history(bench.config.history);
  CHECK(history.runs(history.find_learner("Bob")->id).size() == 1);
}

TEST_CASE("on exit the coach waits a few seconds for a locked history") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  auto holder = std::make_optional<LockHolder>(folder / "before.db");
  std::thread other;
  {
    Coach coach(bench.config);
    coach.set_help(false);
    bench.trial(coach, "one");
    holder.emplace(bench.config.history);
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach);
    const std::vector<DriveSample> drive = bench_drive(Drive::good);
    coach.add(std::span(drive).first(500));
    other = std::thread([&] {
      std::this_thread::sleep_for(milliseconds(700));
      holder.reset();
    });
  }
  other.join();
  const std::vector<RunRow> runs = runs_of_ada(bench.config.history);
  REQUIRE(runs.size() == 2);
  CHECK(runs[1].result.end == LessonEnd::left);
}

TEST_CASE("comments that were edited or deleted while the history was locked are saved in their final state") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  std::int64_t run = 0;
  {
    Coach coach(bench.config);
    bench.trial(coach, "one");
    run = coach.view().run;
    for (const char* text : {"one", "two", "three"}) coach.add_comment(run, "Bo", text);
    const auto number = [&](std::size_t i) { return coach.view().runs[0].comments.at(i).id; };
    const LockHolder holder(bench.config.history);
    in_a_frame([&] { coach.edit_comment(run, number(0), "One."); });
    in_a_frame([&] { coach.delete_comment(run, number(1)); });
    in_a_frame([&] { coach.add_comment(run, "Di", "four"); });
    in_a_frame([&] { coach.add_comment(run, "Di", "five"); });
    in_a_frame([&] { coach.edit_comment(run, number(2), "Four."); });
    in_a_frame([&] { coach.delete_comment(run, number(3)); });
    in_a_frame([&] { coach.edit_comment(run, number(0), "One!"); });
    REQUIRE(coach.view().runs[0].comments.size() == 3);
    CHECK(coach.view().runs[0].comments[0].text == "One!");
    CHECK(coach.view().runs[0].comments[2].text == "Four.");
  }
  History history(bench.config.history);
  const std::vector<CommentRow> comments = comments_of(history, run);
  REQUIRE(comments.size() == 3);
  CHECK(comments[0].text == "One!");
  CHECK(comments[0].edited_at == format_utc(kSomeDay));
  CHECK(comments[1].text == "three");
  CHECK(comments[2].text == "Four.");
}

// Invariant: a flush waits at most 3 s in total, however much data is pending. The test allows 1 s more for delays on a
// busy machine.
TEST_CASE("a failed flush reports the losses once, after a bounded time, and the destructor does not wait again") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  std::optional<Coach> coach(std::in_place, bench.config);
  coach->set_help(false);
  bench.trial(*coach, "one");
  CHECK(coach->flush().empty());
  const LockHolder holder(bench.config.history);
  bench.trial(*coach, "one");
  coach->add_comment(coach->view().runs[1].id, "Bo", "Calmer.");
  coach->offer(bench.config.lessons[0]);
  bench.begin(*coach);
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  coach->add(std::span(drive).first(500));
  (void)coach->take_problem();
  const auto begin = steady_clock::now();
  const std::string message = coach->flush();
  const auto waited = steady_clock::now() - begin;
  CHECK(coach->view().phase == LessonPhase::over);  // flush() ended the running lesson, which counts as left
  CHECK(waited > milliseconds(2000));
  CHECK(waited < milliseconds(4000));
  CHECK(message ==
        bench.config.history.string() +
            ": the history cannot be used because another program has locked the file; not saved: 2 runs, 1 comment");
  CHECK(coach->take_problem() == message);
  const auto again = steady_clock::now();
  coach.reset();
  CHECK(steady_clock::now() - again < milliseconds(1000));
  CHECK(runs_of_ada(bench.config.history).size() == 1);
}

TEST_CASE("a flush saves pending data and reports what cannot be saved") {
  const TempFolder folder;
  std::ofstream(folder / "place") << "no folder";
  const CoachBench bench(folder / "place/history.db");
  Coach coach(bench.config);
  bench.trial(coach, "one");
  coach.set_next("two");
  const std::string message = coach.flush();
  CHECK(message.find(bench.config.history.string()) == 0);
  CHECK(message.find("; not saved: 1 run, 1 choice of the next lesson") != std::string::npos);
  std::filesystem::remove(folder / "place");
  (void)coach.take_problem();
  CHECK(coach.flush().empty());
  CHECK(runs_of_ada(bench.config.history).size() == 1);
}

TEST_CASE("recordings of runs that are missing from the history are listed once") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  {
    Coach coach(bench.config);
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach, "/a/known.trace");
    const std::vector<DriveSample> drive = bench_drive(Drive::good);
    coach.add(std::span(drive).first(500));
    const LockHolder holder(bench.config.history);
    bench.begin(coach, "/a/unknown.trace");
    coach.add(drive);
    CHECK(coach.take_unreferenced_recordings() == std::vector<std::string>{"/a/unknown.trace"});
    CHECK(coach.take_unreferenced_recordings().empty());
  }
  const std::vector<RunRow> runs = runs_of_ada(bench.config.history);
  REQUIRE(runs.size() == 2);  // the lock was released first, so the coach's destructor saved both runs
  CHECK(runs[0].recording == "/a/known.trace");
  CHECK(runs[1].recording.empty());
}

TEST_CASE("a history that could not be opened is opened with the next lesson, and then gets the runs driven before") {
  const TempFolder folder;
  std::ofstream(folder / "place") << "no folder";
  const CoachBench bench(folder / "place/history.db");
  Coach coach(bench.config);
  coach.set_help(false);
  CHECK(coach.take_problem().has_value());
  bench.trial(coach, "one");
  CHECK_FALSE(coach.take_problem().has_value());
  CHECK_FALSE(coach.view().is_saving);
  std::filesystem::remove(folder / "place");
  bench.trial(coach, "one");
  CHECK(coach.view().is_saving);
  CHECK(coach.view().runs.size() == 2);
  CHECK(coach.view().run > 0);
  CHECK(runs_of_ada(bench.config.history).size() == 2);
}

// The trigger makes SQLite refuse new comments for ever, as a damaged row or a limit of SQLite may; all else can be saved.
TEST_CASE("a write that always fails is dropped and reported, and does not keep later results from the history") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  coach.set_help(false);
  bench.trial(coach, "one");
  by_hand(bench.config.history,
          "CREATE TRIGGER no BEFORE INSERT ON comment BEGIN SELECT RAISE(ABORT, 'not this comment'); END");
  coach.add_comment(coach.view().run, "Bo", "Calmer.");
  bench.trial(coach, "one");
  bench.trial(coach, "one");
  std::string problems;
  for (const auto end = steady_clock::now() + milliseconds(3000); steady_clock::now() < end;) {
    coach.add({});
    problems += coach.take_problem().value_or("");
    std::this_thread::sleep_for(milliseconds(16));
  }
  CHECK(problems.find("not this comment; a comment was dropped") != std::string::npos);
  CHECK(coach.view().is_saving);
  CHECK(runs_of_ada(bench.config.history).size() == 3);
  by_hand(bench.config.history, "DROP TRIGGER no");
  CHECK(coach.flush().empty());
  CHECK(runs_of_ada(bench.config.history)[0].comments.empty());  // dropped for good
}

TEST_CASE("while nothing at all can be written, nothing is dropped") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  coach.set_help(false);
  bench.trial(coach, "one");
  for (const char* table : {"comment", "lesson_run"})
    by_hand(bench.config.history, (std::string("CREATE TRIGGER no_") + table + " BEFORE INSERT ON " + table +
                                   " BEGIN SELECT RAISE(ABORT, 'nothing'); END")
                                      .c_str());
  coach.add_comment(coach.view().run, "Bo", "Calmer.");
  bench.trial(coach, "one");
  frames(coach, milliseconds(3000));
  CHECK(runs_of_ada(bench.config.history).size() == 1);
  (void)coach.take_problem();
  by_hand(bench.config.history, "DROP TRIGGER no_comment; DROP TRIGGER no_lesson_run");
  CHECK(coach.flush().empty());
  const std::vector<RunRow> runs = runs_of_ada(bench.config.history);
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].comments.size() == 1);
}

TEST_CASE("the comments of past runs are read together with the runs, not again whenever the view is refreshed") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  bench.trial(coach, "one");
  coach.add_comment(coach.view().run, "Bo", "Calmer.");
  by_hand(bench.config.history, "ALTER TABLE comment RENAME TO renamed");
  coach.set_next("two");
  CHECK_FALSE(coach.take_problem().has_value());
  REQUIRE(coach.view().runs[0].comments.size() == 1);
  CHECK(coach.view().runs[0].comments[0].text == "Calmer.");
}

TEST_CASE("data that cannot be reloaded keeps its last state until it can be read again") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  coach.set_help(false);
  bench.trial(coach, "one");
  bench.trial(coach, "one");
  by_hand(bench.config.history, "ALTER TABLE driving_error RENAME TO renamed");
  coach.offer(bench.config.lessons[0]);
  CHECK(coach.take_problem().has_value());
  CHECK(coach.view().runs.size() == 2);
  CHECK(coach.view().lessons[0].passed);
  by_hand(bench.config.history, "ALTER TABLE renamed RENAME TO driving_error");
  coach.offer(bench.config.lessons[0]);
  CHECK(coach.view().runs.size() == 2);
  bench.trial(coach, "one");
  CHECK(coach.view().is_saving);
  CHECK(runs_of_ada(bench.config.history).size() == 3);
}
