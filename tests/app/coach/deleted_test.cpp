// Deleted for good is forgotten: a program that still runs writes nothing more of her, until a person chooses anew.
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
#include "tests/app/coach/coach_bench.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

constexpr const char* kTold =
    "Ada was deleted by another program: this session is not remembered any more; choose or enter a learner to go on.";

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

// Ada, with a run in the history.
struct Deleting {
  TempFolder folder;
  CoachBench bench{folder / "history.db"};
  const std::filesystem::path& file = bench.config.history;
  Coach coach{bench.config};

  Deleting() {
    coach.want_help(false);
    bench.trial(coach, "one");
  }

  void check_forgotten() {
    CHECK(coach.take_problem() == std::string(kTold));
    CHECK(coach.view().forgotten);
    CHECK_FALSE(coach.view().remembers);
    CHECK(names_in(file).empty());
    bench.trial(coach, "one");
    coach.set_next("two");
    coach.comment(coach.view().runs[0].id, "Bo", "Calmer.");
    coach.edit_comment(coach.view().runs[0].id, coach.view().comments[0][0].id, "Much calmer.");
    CHECK(coach.view().run == 0);
    CHECK(coach.settle().empty());
    CHECK_FALSE(coach.take_problem().has_value());  // once
    CHECK(names_in(file).empty());
    CHECK(History(file).runs(1).empty());
  }
};

}  // namespace

TEST_CASE("deleted in the middle of a lesson: one sentence, the lesson goes on, nothing more is written") {
  Deleting here;
  here.coach.offer(here.bench.config.lessons[0]);
  here.bench.begin(here.coach, "gate = paper", "/a/drive.trace");
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  here.coach.add(std::span(drive).first(500));
  CHECK(here.coach.view().run > 0);
  CHECK(erase(here.file, "Ada").empty());
  here.coach.add(std::span(drive).subspan(500));
  CHECK(here.coach.view().result.passed);
  CHECK(here.coach.view().run == 0);
  CHECK(here.coach.view().runs.size() == 1);  // the one that is over now, nobody's; hers of before are gone
  CHECK(here.coach.forget_recordings() == std::vector<std::string>{"/a/drive.trace"});
  here.check_forgotten();
}

TEST_CASE("deleted between two lessons, or offered another, or before an instructor's word: nothing more is written") {
  for (int deed = 0; deed < 4; ++deed) {
    CAPTURE(deed);
    Deleting here;
    CHECK(erase(here.file, "Ada").empty());
    if (deed == 0) here.bench.trial(here.coach, "one");
    if (deed == 1) here.coach.offer(here.bench.config.lessons[1]);
    if (deed == 2) here.coach.set_next("two");
    if (deed == 3) here.coach.comment(here.coach.view().runs.at(0).id, "Bo", "Calmer.");
    here.check_forgotten();
  }
}

TEST_CASE("what waited for the history when she was deleted is dropped") {
  Deleting here;
  sqlite3* holder = nullptr;
  REQUIRE(sqlite3_open(here.file.c_str(), &holder) == SQLITE_OK);
  REQUIRE(sqlite3_exec(holder, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr) == SQLITE_OK);
  here.bench.trial(here.coach, "one");
  here.bench.trial(here.coach, "one");
  here.coach.set_next("two");
  here.coach.comment(here.coach.view().runs[0].id, "Bo", "Calmer.");
  CHECK(here.coach.take_problem().has_value());
  sqlite3_close(holder);
  CHECK(erase(here.file, "Ada").empty());
  CHECK(here.coach.settle() == kTold);
  here.check_forgotten();
}

TEST_CASE("another one of her name is somebody else; who is chosen again by a person is known from then on") {
  Deleting here;
  CHECK(erase(here.file, "Ada").empty());
  const std::int64_t other = History(here.file).learner("Ada");
  here.bench.trial(here.coach, "one");
  CHECK(here.coach.take_problem() == std::string(kTold));
  CHECK(History(here.file).runs(other).empty());
  here.coach.set_learner("Ada");
  CHECK_FALSE(here.coach.view().forgotten);
  CHECK(here.coach.view().runs.empty());
  CHECK(here.bench.trial(here.coach, "one").passed);
  CHECK(here.coach.view().run > 0);
  CHECK(History(here.file).runs(other).size() == 1);
  CHECK_FALSE(here.coach.take_problem().has_value());
}

TEST_CASE("a learner who was left here and deleted meanwhile is not told of, and is new when chosen again") {
  Deleting here;
  here.coach.set_learner("Bob");
  here.bench.trial(here.coach, "one");
  CHECK(erase(here.file, "Ada").empty());
  here.bench.trial(here.coach, "one");
  CHECK_FALSE(here.coach.take_problem().has_value());
  CHECK(names_in(here.file) == Names{"Bob"});
  here.coach.set_learner("Ada");
  CHECK(names_in(here.file) == Names{"Bob"});  // with the first run
  CHECK(here.coach.view().runs.empty());
  here.bench.trial(here.coach, "one");
  CHECK(names_in(here.file) == Names{"Ada", "Bob"});
  CHECK_FALSE(here.coach.take_problem().has_value());
}

// Law: whenever the deletion falls, what is deleted stays so, and the program that drives is told.
TEST_CASE("deleted at a random moment by another program while she drives here, 40 times: she is never made anew") {
  std::mt19937 chance(3);
  int anew = 0, untold = 0;
  for (int round = 0; round < 40; ++round) {
    const TempFolder folder;
    const CoachBench bench(folder / "history.db");
    int ready[2], go_on[2];
    REQUIRE(pipe(ready) == 0);
    REQUIRE(pipe(go_on) == 0);
    const pid_t child = fork();
    if (child == 0) {
      close(go_on[1]);
      bool told = false;
      {
        Coach coach(bench.config);
        coach.want_help(false);
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
        (void)!read(go_on[0], &c, 1);  // until she is deleted
        bench.trial(coach, "one");
        coach.set_next("two");
        (void)coach.settle();
        told = coach.view().forgotten;
      }
      _exit(told ? 0 : 1);
    }
    char c = 0;
    REQUIRE(read(ready[0], &c, 1) == 1);
    std::this_thread::sleep_for(std::chrono::microseconds(chance() % 100'000));
    (void)erase(bench.config.history, "Ada");
    for (const int end : {go_on[0], go_on[1], ready[0], ready[1]}) close(end);
    int status = -1;
    waitpid(child, &status, 0);
    untold += status == 0 ? 0 : 1;
    anew += names_in(bench.config.history).empty() ? 0 : 1;
  }
  CHECK(anew == 0);
  CHECK(untold == 0);
}
