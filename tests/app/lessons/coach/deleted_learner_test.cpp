// After a learner was deleted, a program that is still running writes nothing about that learner until a user selects
// her again.
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>
#include <thread>

#include <doctest/doctest.h>

#include "haptics/files/printable.h"
#include "tests/app/lessons/coach/coach_bench.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

constexpr const char* kDeletedMessage =
    "Another program deleted Ada, so this session is no longer saved. Choose or enter a learner to continue.";

std::string erase(const std::filesystem::path& file, const std::string& name) {
  History other(file);
  return other.erase_learner(other.find_learner(name).value().id, [](const auto&) {});
}

std::vector<std::string> names_in(const std::filesystem::path& file) {
  std::vector<std::string> names;
  for (const LearnerRow& row : History(file).learners()) names.push_back(row.name);
  return names;
}

using Names = std::vector<std::string>;

// A program with Ada as the selected learner. The history contains one run of hers.
struct Deleting {
  TempFolder folder;
  CoachBench bench{folder / "history.db"};
  const std::filesystem::path& file = bench.config.history;
  Coach coach{bench.config};

  Deleting() {
    coach.set_help(false);
    bench.trial(coach, "one");
  }

  void check_forgotten() {
    CHECK(coach.take_problem() == std::string(kDeletedMessage));
    CHECK(coach.view().learner_deleted);
    CHECK_FALSE(coach.view().is_saving);
    CHECK(names_in(file).empty());
    bench.trial(coach, "one");
    coach.set_next("two");
    coach.add_comment(coach.view().runs[0].id, "Bo", "Calmer.");
    coach.edit_comment(coach.view().runs[0].id, coach.view().runs[0].comments[0].id, "Much calmer.");
    CHECK(coach.view().run == 0);
    CHECK(coach.flush().empty());
    CHECK_FALSE(coach.take_problem().has_value());  // reported only once
    CHECK(names_in(file).empty());
    CHECK(History(file).runs(1).empty());
  }
};

}  // namespace

TEST_CASE("a learner deleted during a lesson: one message, the lesson continues, nothing more is written") {
  Deleting here;
  here.coach.offer(here.bench.config.lessons[0]);
  here.bench.begin(here.coach, "/a/drive.trace");
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  here.coach.add(std::span(drive).first(500));
  CHECK(here.coach.view().run > 0);
  CHECK(erase(here.file, "Ada").empty());
  here.coach.add(std::span(drive).subspan(500));
  CHECK(here.coach.view().result->passed);
  CHECK(here.coach.view().run == 0);
  // Only the run that has just ended is shown. It belongs to no learner.
  CHECK(here.coach.view().runs.size() == 1);
  CHECK(here.coach.take_unreferenced_recordings() == std::vector<std::string>{"/a/drive.trace"});
  here.check_forgotten();
}

TEST_CASE("deleted between lessons, during an offer, or before an instructor's comment: nothing more is written") {
  for (int action = 0; action < 4; ++action) {
    CAPTURE(action);
    Deleting here;
    CHECK(erase(here.file, "Ada").empty());
    if (action == 0) here.bench.trial(here.coach, "one");
    if (action == 1) here.coach.offer(here.bench.config.lessons[1]);
    if (action == 2) here.coach.set_next("two");
    if (action == 3) here.coach.add_comment(here.coach.view().runs.at(0).id, "Bo", "Calmer.");
    here.check_forgotten();
  }
}

TEST_CASE("writes that are pending when the learner is deleted are dropped") {
  Deleting here;
  sqlite3* holder = nullptr;
  REQUIRE(sqlite3_open(here.file.c_str(), &holder) == SQLITE_OK);
  REQUIRE(sqlite3_exec(holder, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr) == SQLITE_OK);
  here.bench.trial(here.coach, "one");
  here.bench.trial(here.coach, "one");
  here.coach.set_next("two");
  here.coach.add_comment(here.coach.view().runs[0].id, "Bo", "Calmer.");
  CHECK(here.coach.take_problem().has_value());
  sqlite3_close(holder);
  CHECK(erase(here.file, "Ada").empty());
  CHECK(here.coach.flush() == kDeletedMessage);
  here.check_forgotten();
}

TEST_CASE("a new learner with her name is a different learner; selecting the name again starts a new record") {
  Deleting here;
  CHECK(erase(here.file, "Ada").empty());
  const std::int64_t other = History(here.file).find_or_add_learner("Ada");
  here.bench.trial(here.coach, "one");
  CHECK(here.coach.take_problem() == std::string(kDeletedMessage));
  CHECK(History(here.file).runs(other).empty());
  here.coach.set_learner("Ada");
  CHECK_FALSE(here.coach.view().learner_deleted);
  CHECK(here.coach.view().runs.empty());
  CHECK(here.bench.trial(here.coach, "one").passed);
  CHECK(here.coach.view().run > 0);
  CHECK(History(here.file).runs(other).size() == 1);
  CHECK_FALSE(here.coach.take_problem().has_value());
}

TEST_CASE("deleting a learner who is not selected is not reported; when selected again, she is new") {
  Deleting here;
  here.coach.set_learner("Bob");
  here.bench.trial(here.coach, "one");
  CHECK(erase(here.file, "Ada").empty());
  here.bench.trial(here.coach, "one");
  CHECK_FALSE(here.coach.take_problem().has_value());
  CHECK(names_in(here.file) == Names{"Bob"});
  here.coach.set_learner("Ada");
  CHECK(names_in(here.file) == Names{"Bob"});  // without Ada, who is added again only with her next run
  CHECK(here.coach.view().runs.empty());
  here.bench.trial(here.coach, "one");
  CHECK(names_in(here.file) == Names{"Ada", "Bob"});
  CHECK_FALSE(here.coach.take_problem().has_value());
}

// Invariant: whenever the deletion happens, the learner stays deleted, and the running program is notified.
TEST_CASE("a learner deleted at a random time while she drives is never created again: 40 times") {
  std::mt19937 chance(3);
  int recreated = 0, unnotified = 0;
  for (int round = 0; round < 40; ++round) {
    const TempFolder folder;
    const CoachBench bench(folder / "history.db");
    int ready[2], go_on[2];
    REQUIRE(pipe(ready) == 0);
    REQUIRE(pipe(go_on) == 0);
    const pid_t child = fork();
    if (child == 0) {
      close(go_on[1]);
      bool is_notified = false;
      {
        Coach coach(bench.config);
        coach.set_help(false);
        bench.trial(coach, "one");
        (void)!write(ready[1], "r", 1);
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(120);
        const std::vector<DriveSample> drive = bench_drive(Drive::good);
        for (int trial = 0; trial < 2 || std::chrono::steady_clock::now() < end; ++trial) {
          coach.offer(bench.config.lessons[0]);
          bench.begin(coach);
          for (std::size_t at = 0; at < drive.size(); at += 250)
            coach.add(std::span(drive).subspan(at, std::min<std::size_t>(250, drive.size() - at)));
          coach.set_next(trial % 2 == 0 ? "two" : "");
        }
        char c = 0;
        (void)!read(go_on[0], &c, 1);  // returns when the parent process has deleted the learner
        bench.trial(coach, "one");
        coach.set_next("two");
        (void)coach.flush();
        is_notified = coach.view().learner_deleted;
      }
      _exit(is_notified ? 0 : 1);
    }
    char c = 0;
    REQUIRE(read(ready[0], &c, 1) == 1);
    std::this_thread::sleep_for(std::chrono::microseconds(chance() % 100'000));
    (void)erase(bench.config.history, "Ada");
    for (const int end : {go_on[0], go_on[1], ready[0], ready[1]}) close(end);
    int status = -1;
    waitpid(child, &status, 0);
    unnotified += status == 0 ? 0 : 1;
    recreated += names_in(bench.config.history).empty() ? 0 : 1;
  }
  CHECK(recreated == 0);
  CHECK(unnotified == 0);
}
