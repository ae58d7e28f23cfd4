// One person is one learner, whatever form of the name was typed: added, found, renamed and erased by any of them. A file
// of version 1, in which two forms were two learners, is joined and loses nothing.
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/history/history.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/history_version_1.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

using Names = std::vector<std::string>;

const std::string kComposed = "Zo\u00eb", kDecomposed = "Zoe\u0308";

Names names_of(History& history) {
  Names names;
  for (const LearnerRow& row : history.learners()) names.push_back(row.name);
  return names;
}

void execute(const std::filesystem::path& file, const std::string& text) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, text.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
}

// Adds a run and returns its number.
std::int64_t drive(History& history, std::int64_t learner, int shifts) {
  const std::int64_t run = history.begin_run(history.begin_session(learner, "1.0"), some_result(shifts), "");
  history.end_run(run, some_result(shifts));
  return run;
}

bool holds_bytes(const std::filesystem::path& folder, const std::string& bytes) {
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    std::ifstream in(file.path(), std::ios::binary);
    const std::string all(std::istreambuf_iterator<char>(in), {});
    if (all.find(bytes) != std::string::npos) return true;
  }
  return false;
}

// A file of version 1 with the given learners; learner i has one run with i + 1 shifts.
void write_version_1(const std::filesystem::path& file, const Names& names) {
  {
    History history(file);
    for (std::size_t i = 0; i < names.size(); ++i)
      drive(history, history.find_or_add_learner("learner " + std::to_string(i)), static_cast<int>(i) + 1);
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    execute(file, "UPDATE learner SET name = '" + names[i] + "' WHERE name = 'learner " + std::to_string(i) + "'");
  execute(file, kToHistoryVersion1);
}

}  // namespace

TEST_CASE("every form of a name is one learner: added once, found, and erased with all its bytes") {
  const TempFolder folder;
  History history(folder / "history.db");
  const std::int64_t zoe = history.find_or_add_learner(kDecomposed);
  CHECK(names_of(history) == Names{kComposed});
  for (const std::string& form :
       Names{kComposed, kDecomposed, " Zo\u00eb ", "ZO\u00cb", "zoe\u0308", "\uff3ao\u00eb"}) {
    CAPTURE(form);
    CHECK(history.find_or_add_learner(form) == zoe);
    REQUIRE(history.find_learner(form).has_value());
    CHECK(history.find_learner(form)->id == zoe);
  }
  CHECK(history.find_or_add_learner("Zoe") != zoe);
  CHECK(history.erase_learner(history.find_learner(kDecomposed)->id, [](const auto&) {}).empty());
  CHECK(names_of(history) == Names{"Zoe"});
  CHECK_FALSE(holds_bytes(folder.path(), kComposed));
}

TEST_CASE("a learner is renamed with all runs, but not to a name that means another learner") {
  const TempFolder folder;
  History history(folder / "history.db");
  const std::int64_t ada = history.find_or_add_learner("Ada"), zoe = history.find_or_add_learner(kComposed);
  drive(history, ada, 2);
  CHECK(history.rename_learner(ada, "Ada  Lo\u0308we "));
  CHECK(history.find_learner("Ada L\u00f6we")->id == ada);
  CHECK_FALSE(history.find_learner("Ada").has_value());
  CHECK(history.runs(ada).size() == 1);
  for (const std::string& taken : Names{kComposed, kDecomposed, "zo\u00eb"})
    CHECK_FALSE(history.rename_learner(ada, taken));
  CHECK(history.rename_learner(zoe, "ZO\u00cb"));  // her own name in another form
  CHECK_THROWS_AS(history.rename_learner(ada, "A\u200bda"), std::invalid_argument);
  CHECK(names_of(history) == Names{"Ada L\u00f6we", "ZO\u00cb"});
  CHECK(history.erase_learner(ada, [](const auto&) {}).empty());
  CHECK_THROWS_AS(history.rename_learner(ada, "Ada"), HistoryDeleted);
}

TEST_CASE("a comment and its author are stored composed") {
  const TempFolder folder;
  History history(folder / "history.db");
  const std::int64_t run = drive(history, history.find_or_add_learner("Ada"), 0);
  const std::int64_t comment = history.add_comment(run, kDecomposed, kDecomposed + "!");
  REQUIRE(comments_of(history, run).size() == 1);
  CHECK(comments_of(history, run)[0].author == kComposed);
  CHECK(comments_of(history, run)[0].text == kComposed + "!");
  CHECK(history.edit_comment(comment, kDecomposed + "?"));
  CHECK(comments_of(history, run)[0].text == kComposed + "?");
}

TEST_CASE("version 1: forms of one name are joined with all runs and said once; visibly different names stay") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  write_version_1(file, {kDecomposed, "Bo", kComposed, "bo", "Zoe"});
  execute(file, "UPDATE learner SET next_lesson = 'reverse' WHERE name = '" + kComposed + "'");
  {
    History read(file, system_seconds, kHistoryLockTimeout, HistoryUse::read);
    CHECK(names_of(read) == Names{"Bo", "Zoe", kComposed, "bo"});
    CHECK(read.upgrade_note().empty());
  }
  {
    History history(file);
    CHECK(history.upgrade_note() ==
          file.string() + ": learners whose names look the same were joined, with all their runs: " + kComposed);
    const std::optional<LearnerRow> zoe = history.find_learner(kComposed);
    REQUIRE(zoe.has_value());
    CHECK(zoe->next_lesson == "reverse");
    const std::vector<RunRow> runs = history.runs(zoe->id);
    REQUIRE(runs.size() == 2);
    CHECK(runs[0].result.shifts.size() == 1);
    CHECK(runs[1].result.shifts.size() == 3);
    CHECK(history.runs(history.find_learner("Zoe")->id).size() == 1);
    CHECK(history.find_learner("bo")->name == "bo");
    CHECK(history.find_learner("Bo")->name == "Bo");
    CHECK_FALSE(history.find_learner("BO").has_value());
    CHECK(history.erase_learner(zoe->id, [](const auto&) {}).empty());
  }
  CHECK_FALSE(holds_bytes(folder.path(), kComposed));
  CHECK_FALSE(holds_bytes(folder.path(), kDecomposed));
  CHECK(History(file).upgrade_note().empty());
}

TEST_CASE("several programs open a file of version 1 at once: it is joined once, and no run is lost") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  write_version_1(file, {kDecomposed, kComposed, "Bo"});
  std::vector<pid_t> programs;
  for (int i = 0; i < 6; ++i) {
    const pid_t child = fork();
    if (child != 0) {
      programs.push_back(child);
      continue;
    }
    try {
      History history(file);
      drive(history, history.find_or_add_learner(i % 2 == 0 ? kComposed : kDecomposed), 0);
      _exit(0);
    } catch (const std::exception&) {
      _exit(1);
    }
  }
  for (const pid_t program : programs) {
    int status = -1;
    waitpid(program, &status, 0);
    CHECK(status == 0);
  }
  History history(file);
  CHECK(names_of(history) == Names{"Bo", kComposed});
  CHECK(history.runs(history.find_learner(kComposed)->id).size() == 8);
}

// The upgrade and a new name are one transaction each, so a kill leaves the file as before or as after.
TEST_CASE("a program killed at any time while it joins and renames leaves every run with its learner") {
  int joined = 0;
  for (int round = 0; round < 30; ++round) {
    const TempFolder folder;
    const auto file = folder / "history.db";
    write_version_1(file, {kDecomposed, kComposed});
    const pid_t child = fork();
    if (child == 0) {
      try {
        History history(file);
        for (int i = 0;; ++i) history.rename_learner(1, "Zoe " + std::to_string(i % 7));
      } catch (const std::exception&) {
        _exit(1);
      }
    }
    usleep(static_cast<useconds_t>(700 * round));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    History history(file);
    joined += history.upgrade_note().empty() ? 1 : 0;
    REQUIRE(history.learners().size() == 1);
    CHECK(history.runs(history.learners()[0].id).size() == 2);
  }
  CHECK(joined > 3);  // kills before the upgrade, and after it
  CHECK(joined < 30);
}
