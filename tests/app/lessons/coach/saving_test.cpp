// The coach writes runs into the history. Without a history, lessons continue.
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include <doctest/doctest.h>

#include "app/lessons/history/schema.h"
#include "tests/app/lessons/coach/coach_bench.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/full_disk.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<RunRow> runs_in(const std::filesystem::path& file, const std::string& learner = "Ada") {
  History history(file);
  const auto row = history.find_learner(learner);
  return row ? history.runs(row->id) : std::vector<RunRow>{};
}

bool is_one_sentence(const std::optional<std::string>& problem) {
  return problem && !problem->empty() && problem->find('\n') == std::string::npos;
}

// The bytes of a history file that contains one run and was closed cleanly.
std::string good_history(const std::filesystem::path& file) {
  const CoachBench bench(file);
  {
    Coach coach(bench.config);
    bench.trial(coach, "one");
  }
  return bytes_of(file);
}

// Drives two trials and checks their results. The second trial is passed.
void check_lesson_continues(CoachBench& bench, Coach& coach) {
  CHECK(bench.trial(coach, "one").end == LessonEnd::done);
  coach.set_help(false);
  CHECK(bench.trial(coach, "one").passed);
  CHECK(coach.view().lessons[0].passed);
  CHECK(coach.view().next == "two");
  CHECK(coach.view().runs.size() == 2);
}

}  // namespace

TEST_CASE("a trial is saved as a run with its recording and shifts") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  {
    Coach coach(bench.config);
    CHECK(coach.view().is_saving);
    CHECK(runs_in(bench.config.history).empty());
    coach.offer(bench.config.lessons[0]);
    for (int trial = 0; trial < 3; ++trial) {
      bench.begin(coach, "/a/drive.trace");
      coach.add(bench_drive(Drive::good, coach.guidance()));
    }
    CHECK_FALSE(coach.take_problem().has_value());
  }
  const std::vector<RunRow> runs = runs_in(bench.config.history);
  REQUIRE(runs.size() == 3);
  CHECK(runs[0].recording == "/a/drive.trace");
  CHECK(runs[0].begun_at == format_utc(kSomeDay));
  CHECK(runs[0].result.begin == doctest::Approx(99.0));  // [s] on the recording's clock
  CHECK(runs[0].result.shifts.size() == 1);
  CHECK(runs[2].session == runs[0].session);
}

TEST_CASE("a coach destroyed during a lesson saves it as left; a killed program keeps the shifts that were finished") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  {
    Coach coach(bench.config);
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach);
    coach.add(std::span(drive).first(500));
  }
  REQUIRE(runs_in(bench.config.history).size() == 1);
  CHECK(runs_in(bench.config.history)[0].result.end == LessonEnd::left);
  const pid_t child = fork();
  if (child == 0) {
    Lesson longer = bench.config.lessons[0];
    longer.steps.push_back({"Stop.", "", {}, kNeutralGear, 8.0});
    longer.steps.back().until.speed_below = 1.0;
    Coach coach(bench.config);
    coach.offer(longer);
    bench.begin(coach);
    coach.add(drive);
    _exit(coach.view().phase == LessonPhase::driving ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  REQUIRE(status == 0);
  const std::vector<RunRow> runs = runs_in(bench.config.history);
  REQUIRE(runs.size() == 2);
  CHECK(runs[1].result.end == LessonEnd::running);
  CHECK(runs[1].result.shifts.size() == 1);
}

TEST_CASE(
    "if the learner changes during a lesson, the trial counts as left, and the lesson is offered to the new learner") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  bench.trial(coach, "one");
  bench.begin(coach);
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  coach.add(std::span(drive).first(500));
  coach.set_learner("Ada");  // Ada is already selected
  CHECK(coach.view().phase == LessonPhase::driving);
  coach.set_learner("Bob");
  CHECK(coach.view().phase == LessonPhase::offered);
  CHECK(coach.view().learner == "Bob");
  CHECK(coach.view().runs.empty());
  coach.add(std::span(drive).subspan(500));
  bench.trial(coach, "one");
  CHECK(coach.view().learners == std::vector<std::string>{"Ada", "Bob"});
  coach.set_learner("");
  bench.trial(coach, "one");
  CHECK(coach.view().runs.size() == 1);
  coach.set_learner("Ada");
  CHECK(coach.view().runs.size() == 2);
  CHECK(coach.view().runs[0].result.end == LessonEnd::left);

  const std::vector<RunRow> ada = runs_in(bench.config.history, "Ada"), bob = runs_in(bench.config.history, "Bob");
  CHECK(ada.size() == 2);
  REQUIRE(bob.size() == 1);
  CHECK(bob[0].session != ada[0].session);
  CHECK(History(bench.config.history).learners().size() == 2);  // an empty name adds no learner
}

TEST_CASE("the lesson set by the instructor takes precedence over the suggestion until a run of it was passed") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  Coach instructor(bench.config);  // a second program
  instructor.set_next("two");
  coach.offer(bench.config.lessons[0]);
  CHECK(coach.view().next == "two");
  CHECK(coach.view().next_by_instructor);
  const auto wanted = [&] { return History(bench.config.history).find_learner("Ada")->next_lesson; };

  coach.set_help(false);
  bench.trial(coach, "one");
  CHECK(wanted() == "two");  // only a passed run of "two" removes this choice, but the run was of "one"
  coach.offer(bench.config.lessons[1]);
  bench.begin(coach);
  coach.add(bench_drive(Drive::good, 0.5));
  CHECK(coach.view().result->guided);
  CHECK(wanted() == "two");  // a guided run is not graded, so it does not remove the choice
  bench.begin(coach);
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  coach.add(std::span(drive).first(500));
  coach.leave();
  CHECK(wanted() == "two");  // an unfinished run does not remove the choice
  Lesson strict = bench.config.lessons[1];
  strict.pass_grade = 10.0;
  coach.offer(strict);
  bench.begin(coach);
  coach.add(bench_drive(Drive::pushed));
  CHECK(coach.view().phase == LessonPhase::over);
  CHECK_FALSE(coach.view().result->passed);
  CHECK(wanted() == "two");  // a failed run does not remove the choice
  CHECK(coach.view().next == "two");
  bench.trial(coach, "two");
  CHECK(coach.view().result->passed);
  CHECK(wanted().empty());
  CHECK_FALSE(coach.view().next_by_instructor);

  coach.set_next("two");
  coach.offer(bench.config.lessons[1]);
  bench.begin(coach);
  instructor.set_next("one");  // a run of "two" is in progress
  coach.add(bench_drive(Drive::good));
  CHECK(wanted() == "one");
  CHECK(coach.view().next == "one");
  coach.set_next("");
  CHECK(wanted().empty());
}

TEST_CASE("a comment belongs to its run and can be edited and deleted, with and without a history") {
  const TempFolder folder;
  for (const std::filesystem::path& file : {folder / "history.db", std::filesystem::path()}) {
    const CoachBench bench(file);
    Coach coach(bench.config);
    bench.trial(coach, "one");
    bench.trial(coach, "one");
    coach.add_comment(coach.view().runs[1].id, "Bo", "Calmer.");
    REQUIRE(coach.view().runs.size() == 2);
    CHECK(coach.view().runs[0].comments.empty());
    REQUIRE(coach.view().runs[1].comments.size() == 1);
    CHECK(coach.view().runs[1].comments[0].text == "Calmer.");

    const std::int64_t run = coach.view().runs[1].id, calmer = coach.view().runs[1].comments[0].id;
    coach.add_comment(run, "Di", "Fine.");
    coach.edit_comment(run, calmer, "Much calmer.");
    REQUIRE(coach.view().runs[1].comments.size() == 2);
    CHECK(coach.view().runs[1].comments[0].text == "Much calmer.");
    CHECK(coach.view().runs[1].comments[0].author == "Bo");
    coach.delete_comment(run, calmer);
    REQUIRE(coach.view().runs[1].comments.size() == 1);
    CHECK(coach.view().runs[1].comments[0].text == "Fine.");
    CHECK_THROWS_AS(coach.edit_comment(run, calmer, "Again."), std::invalid_argument);
    CHECK_THROWS_AS(coach.delete_comment(coach.view().runs[0].id, coach.view().runs[1].comments[0].id),
                    std::invalid_argument);
    CHECK_THROWS_AS(coach.add_comment(run, "Bo", "\t"), std::invalid_argument);
    CHECK_THROWS_AS(coach.add_comment(run, "B\to", "Calmer."), std::invalid_argument);
    CHECK_THROWS_AS(coach.edit_comment(run, coach.view().runs[1].comments[0].id, ""), std::invalid_argument);
    CHECK_FALSE(coach.take_problem().has_value());
    if (file.empty()) continue;
    History history(file);
    REQUIRE(comments_of(history, run).size() == 1);
    CHECK(comments_of(history, run)[0].text == "Fine.");
  }
}

TEST_CASE(
    "with two coaches on one file all runs are saved, and each coach sees those of the other with its next lesson") {
  const TempFolder folder;
  const CoachBench bench(folder / "history.db");
  Coach one(bench.config), other(bench.config);
  one.offer(bench.config.lessons[0]);
  other.offer(bench.config.lessons[0]);
  bench.begin(one);
  bench.begin(other);
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  for (std::size_t at = 0; at < drive.size(); at += 100) {
    const std::size_t lot = std::min<std::size_t>(100, drive.size() - at);
    one.add(std::span(drive).subspan(at, lot));
    other.add(std::span(drive).subspan(at, lot));
  }
  CHECK_FALSE(one.take_problem().has_value());
  CHECK_FALSE(other.take_problem().has_value());
  CHECK(runs_in(bench.config.history).size() == 2);
  one.offer(bench.config.lessons[0]);
  other.offer(bench.config.lessons[0]);
  CHECK(one.view().runs.size() == 2);
  CHECK(other.view().runs.size() == 2);
  CHECK(one.view().guidance == other.view().guidance);
}

TEST_CASE("damaged, foreign, newer or unreachable history: one message, the lesson continues, the file is unchanged") {
  const TempFolder folder;
  const std::string intact = good_history(folder / "good.db");
  REQUIRE(intact.size() > 20000);
  std::string newer = intact, foreign = intact, torn = intact;
  newer[63] = kSchemaVersion + 1;  // last byte of the schema version (sqlite.org/fileformat2.html, section 1.3)
  foreign[71] ^= 1;
  std::fill(torn.begin() + 8192, torn.begin() + 12288, 'x');
  const std::string damaged = intact.substr(0, intact.size() / 2);
  for (const std::string& bytes : {newer, foreign, torn, damaged, std::string(5000, ' ')}) {
    const auto file = folder / "history.db";
    std::ofstream(file, std::ios::binary) << bytes;
    CoachBench bench(file);
    {
      Coach coach(bench.config);
      CHECK_FALSE(coach.view().is_saving);
      CHECK(is_one_sentence(coach.take_problem()));
      check_lesson_continues(bench, coach);
      CHECK_FALSE(coach.take_problem().has_value());
    }
    CHECK(bytes_of(file) == bytes);
    for (const char* log_file : {"history.db-wal", "history.db-shm"})
      CHECK_FALSE(std::filesystem::exists(folder / log_file));
  }
  std::ofstream(folder / "plain") << "no folder";
  CoachBench bench(folder / "plain/history.db");
  Coach coach(bench.config);
  CHECK(is_one_sentence(coach.take_problem()));
  check_lesson_continues(bench, coach);
  CHECK_FALSE(coach.take_problem().has_value());
}

// The test runs in a process without root's rights, because root can always write.
TEST_CASE("a read-only history is reported once and stays unchanged") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  const std::string intact = good_history(file);
  std::filesystem::permissions(file, std::filesystem::perms(0444));
  std::filesystem::permissions(folder / "", std::filesystem::perms(0555));
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && setuid(65534) != 0) _exit(2);
    CoachBench bench(file);
    Coach coach(bench.config);
    const std::optional<std::string> first = coach.take_problem();
    bench.trial(coach, "one");
    const std::optional<std::string> second = coach.take_problem();
    coach.set_help(false);
    if (!bench.trial(coach, "one").passed || coach.view().is_saving) _exit(3);
    if (first.has_value() == second.has_value() || coach.take_problem()) _exit(4);
    _exit(0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(WEXITSTATUS(status) == 0);
  std::filesystem::permissions(folder / "", std::filesystem::perms(0755));
  CHECK(bytes_of(file) == intact);
}

TEST_CASE("a full disk is reported once; the lesson counts, and is saved when there is room again") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  std::optional<Coach> coach(std::in_place, bench.config);
  coach->set_help(false);
  bench.trial(*coach, "one");
  coach->offer(bench.config.lessons[0]);
  bench.begin(*coach);
  const std::vector<DriveSample> drive = bench_drive(Drive::good);
  coach->add(std::span(drive).first(500));
  disk_is_full = true;
  coach->add(std::span(drive).subspan(500));
  CHECK(coach->take_problem() == bench.config.history.string() +
                                     ": the disk is full, so nothing more can be saved; earlier results are kept; new "
                                     "results are kept in memory until "
                                     "there is space");
  CHECK_FALSE(coach->view().is_saving);
  CHECK(coach->view().result->passed);
  CHECK(coach->view().runs.size() == 2);
  CHECK(coach->view().lessons[0].trials == 2);
  CHECK(bench.trial(*coach, "one").passed);
  CHECK_FALSE(coach->take_problem().has_value());
  CHECK(coach->view().lessons[0].trials == 3);

  CHECK(coach->view().runs[0].id < 0);  // a temporary number, because this run is not in the history

  // The disk is full when the shift ends, and has room again before the lesson ends.
  disk_is_full = false;
  Lesson longer = bench.config.lessons[0];
  longer.steps.push_back(longer.steps.back());
  longer.steps.back().until.held = 0.5;
  const auto cut = std::find_if(drive.begin(), drive.end(), [](const DriveSample& s) { return s.time() > 101.0; });
  coach->offer(longer);
  bench.begin(*coach);
  coach->add(std::span(drive).first(500));
  CHECK(coach->view().is_saving);
  disk_is_full = true;
  coach->add(std::span(drive.begin() + 500, cut));
  REQUIRE(coach->view().result->shifts.size() == 1);
  CHECK(coach->view().phase == LessonPhase::driving);
  CHECK(is_one_sentence(coach->take_problem()));  // the problem is reported again, because saving had worked in between
  CHECK(coach->view().run == 0);
  disk_is_full = false;
  coach->add(std::span(cut, drive.end()));
  CHECK(coach->view().phase == LessonPhase::over);
  CHECK(coach->view().is_saving);
  CHECK(coach->view().run > 0);
  CHECK_FALSE(coach->take_problem().has_value());
  CHECK(coach->view().lessons[0].trials == 4);
  for (const RunRow& row : coach->view().runs) CHECK(row.id > 0);
  coach.reset();
  const std::vector<RunRow> runs = runs_in(bench.config.history);
  REQUIRE(runs.size() == 4);
  for (const RunRow& run : runs) {
    CHECK(run.result.end == LessonEnd::done);
    CHECK(run.result.passed);
    CHECK(run.result.shifts.size() == 1);
  }
}

// Invariant: lost data is reported even after a message that promised a retry. If the data is saved later, the report
// is withdrawn.
TEST_CASE("a flush fails on a full disk, then there is room again: the loss is reported, then withdrawn") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  bench.trial(coach, "one");
  CHECK_FALSE(coach.needs_room());
  disk_is_full = true;
  bench.trial(coach, "one");
  CHECK(coach.take_problem().value_or("").find("results are kept in memory until there is space") != std::string::npos);
  const std::string lost = coach.flush();
  CHECK(lost.find("the disk is full") != std::string::npos);
  CHECK(lost.find("; not saved: 1 run") != std::string::npos);
  CHECK(coach.needs_room());
  disk_is_full = false;
  CHECK(coach.flush().empty());
  CHECK_FALSE(coach.take_problem().has_value());
  CHECK_FALSE(coach.needs_room());
  CHECK(runs_in(bench.config.history).size() == 2);
  disk_is_full = true;
  bench.trial(coach, "one");
  disk_is_full = false;
  CHECK(coach.flush().empty());  // flush() also saves data whose problem was not reported yet
  CHECK(runs_in(bench.config.history).size() == 3);
}

TEST_CASE("no run refers to a lost recording: lost before its first cycle, while it is driven, or after its end") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  {
    Coach coach(bench.config);
    const std::vector<DriveSample> drive = bench_drive(Drive::good);
    for (const std::size_t driven : {std::size_t{0}, std::size_t{500}, drive.size()}) {
      coach.offer(bench.config.lessons[0]);
      bench.begin(coach, "/a/lost.trace");
      coach.add(std::span(drive).first(driven));
      coach.clear_recording();
      coach.add(std::span(drive).subspan(driven));
      CHECK(coach.view().runs[0].recording.empty());
    }
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach, "/a/kept.trace");
    coach.add(drive);
    disk_is_full = true;
    coach.clear_recording();
    CHECK(runs_in(bench.config.history).back().recording == "/a/kept.trace");
    disk_is_full = false;
  }
  const std::vector<RunRow> runs = runs_in(bench.config.history);
  REQUIRE(runs.size() == 4);
  for (const RunRow& run : runs) CHECK(run.recording.empty());
}

TEST_CASE("recordings inside the history's folder are stored with relative paths and found there") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  const std::string recording = (folder / "recordings/a.trace").string();
  {
    Coach coach(bench.config);
    coach.offer(bench.config.lessons[0]);
    bench.begin(coach, recording);
    coach.add(bench_drive(Drive::good));
    CHECK(coach.view().runs[0].recording == recording);
  }
  CHECK(runs_in(bench.config.history)[0].recording == "recordings/a.trace");
  Coach again(bench.config);
  CHECK(again.view().runs[0].recording == recording);
}

TEST_CASE("a history file that is removed while lessons are driven is reported, together with the losses") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  Coach coach(bench.config);
  bench.trial(coach, "one");
  std::filesystem::remove(bench.config.history);
  bench.trial(coach, "one");
  CHECK(coach.take_problem().value_or("").find("the file was removed") != std::string::npos);
  CHECK_FALSE(coach.view().is_saving);
  CHECK(coach.flush().find("not saved: 1 run") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(bench.config.history));
}
