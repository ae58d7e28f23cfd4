// A history that another program holds, or that comes late: no frame waits for it, and nothing is lost.
#include <sqlite3.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

#include <doctest/doctest.h>

#include "tests/app/coach/coach_bench.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Of a frame; the patience is 50 ms, and a machine that has much to do gets the rest.
constexpr milliseconds kFrame{400};

// Another program in the middle of a transaction that writes.
class Holder {
 public:
  explicit Holder(const std::filesystem::path& file) {
    REQUIRE(sqlite3_open(file.c_str(), &database_) == SQLITE_OK);
    REQUIRE(sqlite3_exec(database_, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr) == SQLITE_OK);
  }
  ~Holder() { sqlite3_close(database_); }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

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

// Frames without a cycle, for as long as it takes a coach to try again.
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

TEST_CASE("while another program holds the history no frame waits for it, and then all of it is there, in order") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  {
    Coach coach(bench.config);
    coach.want_help(false);
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach, "gate = paper", "/a/first.trace");
    const std::vector<DriveSample> drive = bench_drive(Drive::good);
    coach.add(std::span(drive).first(500));
    const std::int64_t first = coach.view().run;
    CHECK(first > 0);
    {
      const Holder holder(bench.config.history);
      bench.now += 100;
      for (std::size_t at = 500; at < drive.size(); at += 50) {
        const std::size_t lot = std::min<std::size_t>(50, drive.size() - at);
        in_a_frame([&] { coach.add(std::span(drive).subspan(at, lot)); });
      }
      CHECK(coach.view().phase == LessonPhase::over);
      CHECK(coach.view().run == 0);
      const std::optional<std::string> told = coach.take_problem();
      REQUIRE(told.has_value());
      CHECK(told->find("another program holds it") != std::string::npos);
      CHECK(told->find('\n') == std::string::npos);

      bench.now += 100;
      in_a_frame([&] { coach.offer(bench.config.lessons[1]); });
      in_a_frame([&] { bench.begin(coach, "gate = dog_leg", "/a/second.trace"); });
      in_a_frame([&] { coach.add(bench_drive(Drive::pushed)); });
      CHECK(coach.view().runs.size() == 2);
      const std::int64_t second = coach.view().runs[0].id;
      CHECK(second < 0);
      bench.now += 100;
      in_a_frame([&] { coach.comment(first, "Bo", "Calmer."); });
      in_a_frame([&] { coach.comment(second, "Bo", "Too much."); });
      in_a_frame([&] { coach.set_next("one"); });
      CHECK(coach.view().next == "one");
      frames(coach);
      CHECK_FALSE(coach.take_problem().has_value());  // once
      CHECK(coach.view().remembers);                  // it does: what it has waits
    }
    frames(coach);
    CHECK(coach.view().run > first);
    CHECK(coach.view().runs[0].id == coach.view().run);
    REQUIRE(coach.view().comments[0].size() == 1);
    CHECK(coach.view().comments[0][0].text == "Too much.");
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
  CHECK(runs[1].result.faults.size() == 1);
  CHECK(runs[1].recording == "/a/second.trace");
  CHECK(runs[1].session == runs[0].session);
  CHECK(runs[0].begun_at == date_text(kSomeDay));
  CHECK(runs[1].begun_at == date_text(kSomeDay + 200));  // when it was driven
  History history(bench.config.history);
  CHECK(history.settings(runs[0].session) == std::vector<std::string>{"gate = paper", "gate = dog_leg"});
  for (const RunRow& run : runs) {
    REQUIRE(history.comments(run.id).size() == 1);
    CHECK(history.comments(run.id)[0].at == date_text(kSomeDay + 300));
  }
  CHECK(history.find_learner("Ada")->next_lesson == "one");
}

TEST_CASE("a run of which the history knew nothing while it was driven is in it afterwards, for whoever drove it") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  {
    Coach coach(bench.config);
    coach.want_help(false);
    bench.trial(coach, "one");
    {
      const Holder holder(bench.config.history);
      bench.trial(coach, "one");
      coach.set_learner("Bob");
      bench.trial(coach, "one");
    }
    CHECK(coach.forget_recordings().empty());  // they have none
    coach.set_learner("Ada");
    frames(coach);
    CHECK(coach.view().runs.size() == 2);
    for (const RunRow& row : coach.view().runs) CHECK(row.id > 0);
  }
  CHECK(runs_of_ada(bench.config.history).size() == 2);
  History history(bench.config.history);
  CHECK(history.runs(history.find_learner("Bob")->id).size() == 1);
}

TEST_CASE("who goes while the history is held waits some seconds for it") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  auto holder = std::make_optional<Holder>(folder / "before.db");
  std::thread other;
  {
    Coach coach(bench.config);
    coach.want_help(false);
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

TEST_CASE("comments that were said otherwise or taken back while the history was held are so in it, too") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  std::int64_t run = 0;
  {
    Coach coach(bench.config);
    bench.trial(coach, "one");
    run = coach.view().run;
    for (const char* text : {"one", "two", "three"}) coach.comment(run, "Bo", text);
    const auto number = [&](std::size_t i) { return coach.view().comments[0].at(i).id; };
    const Holder holder(bench.config.history);
    in_a_frame([&] { coach.edit_comment(run, number(0), "One."); });
    in_a_frame([&] { coach.delete_comment(run, number(1)); });
    in_a_frame([&] { coach.comment(run, "Di", "four"); });
    in_a_frame([&] { coach.comment(run, "Di", "five"); });
    in_a_frame([&] { coach.edit_comment(run, number(2), "Four."); });
    in_a_frame([&] { coach.delete_comment(run, number(3)); });
    in_a_frame([&] { coach.edit_comment(run, number(0), "One!"); });
    REQUIRE(coach.view().comments[0].size() == 3);
    CHECK(coach.view().comments[0][0].text == "One!");
    CHECK(coach.view().comments[0][2].text == "Four.");
  }
  const std::vector<CommentRow> comments = History(bench.config.history).comments(run);
  REQUIRE(comments.size() == 3);
  CHECK(comments[0].text == "One!");
  CHECK(comments[0].edited_at == date_text(kSomeDay));
  CHECK(comments[1].text == "three");
  CHECK(comments[2].text == "Four.");
}

// Law: 3 s in all, however much waits.
TEST_CASE("who settles in vain is told what is lost, once, after a bounded time; who goes does not wait again") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  std::optional<Coach> coach(std::in_place, bench.config);
  coach->want_help(false);
  bench.trial(*coach, "one");
  CHECK(coach->settle().empty());
  const Holder holder(bench.config.history);
  bench.trial(*coach, "one");
  coach->comment(coach->view().runs[1].id, "Bo", "Calmer.");
  coach->offer(bench.config.lessons[0]);
  bench.begin(*coach);
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  coach->add(std::span(drive).first(500));
  (void)coach->take_problem();
  const auto begin = steady_clock::now();
  const std::string said = coach->settle();
  const auto waited = steady_clock::now() - begin;
  CHECK(coach->view().phase == LessonPhase::over);  // it was left
  CHECK(waited > milliseconds(2000));
  CHECK(waited < milliseconds(4000));
  CHECK(said ==
        bench.config.history.string() +
            ": the history cannot be used: another program holds it; lost with this program: 2 runs, 1 comment");
  CHECK(coach->take_problem() == said);
  const auto again = steady_clock::now();
  coach.reset();
  CHECK(steady_clock::now() - again < milliseconds(1000));
  CHECK(runs_of_ada(bench.config.history).size() == 1);
}

TEST_CASE("settling takes what had no place before, and says what has none") {
  const TempFolder folder;
  std::ofstream(folder / "place") << "no folder";
  const CoachBench bench(folder / "place/history.db");
  Coach coach(bench.config);
  bench.trial(coach, "one");
  coach.set_next("two");
  const std::string said = coach.settle();
  CHECK(said.find(bench.config.history.string()) == 0);
  CHECK(said.find("; lost with this program: 1 run, 1 choice of the next lesson") != std::string::npos);
  std::filesystem::remove(folder / "place");
  (void)coach.take_problem();
  CHECK(coach.settle().empty());
  CHECK(runs_of_ada(bench.config.history).size() == 1);
}

TEST_CASE("recordings of runs that the history knows nothing of are named once, and never by it") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  {
    Coach coach(bench.config);
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach, "", "/a/known.trace");
    const std::vector<DriveSample> drive = bench_drive(Drive::good);
    coach.add(std::span(drive).first(500));
    const Holder holder(bench.config.history);
    bench.begin(coach, "", "/a/unknown.trace");
    coach.add(drive);
    CHECK(coach.forget_recordings() == std::vector<std::string>{"/a/unknown.trace"});
    CHECK(coach.forget_recordings().empty());
  }
  const std::vector<RunRow> runs = runs_of_ada(bench.config.history);
  REQUIRE(runs.size() == 2);  // the holder went first
  CHECK(runs[0].recording == "/a/known.trace");
  CHECK(runs[1].recording.empty());
}

TEST_CASE(
    "a history that could not be opened is tried again with the next lesson, and gets what was driven meanwhile") {
  const TempFolder folder;
  std::ofstream(folder / "place") << "no folder";
  const CoachBench bench(folder / "place/history.db");
  Coach coach(bench.config);
  coach.want_help(false);
  CHECK(coach.take_problem().has_value());
  bench.trial(coach, "one");
  CHECK_FALSE(coach.take_problem().has_value());
  CHECK_FALSE(coach.view().remembers);
  std::filesystem::remove(folder / "place");
  bench.trial(coach, "one");
  CHECK(coach.view().remembers);
  CHECK(coach.view().runs.size() == 2);
  CHECK(coach.view().run > 0);
  CHECK(runs_of_ada(bench.config.history).size() == 2);
}

TEST_CASE("what cannot be read anew stays as it was read, until it can be") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  coach.want_help(false);
  bench.trial(coach, "one");
  bench.trial(coach, "one");
  by_hand(bench.config.history, "ALTER TABLE fault RENAME TO faults");
  coach.offer(bench.config.lessons[0]);
  CHECK(coach.take_problem().has_value());
  CHECK(coach.view().runs.size() == 2);
  CHECK(coach.view().lessons[0].passed);
  by_hand(bench.config.history, "ALTER TABLE faults RENAME TO fault");
  coach.offer(bench.config.lessons[0]);
  CHECK(coach.view().runs.size() == 2);
  bench.trial(coach, "one");
  CHECK(coach.view().remembers);
  CHECK(runs_of_ada(bench.config.history).size() == 3);
}
