// A learner is chosen by any form of the name and renamed, here or by another program, and keeps every run.
#include <sqlite3.h>

#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/app/lessons/coach/coach_bench.h"
#include "tests/support/history_version_1.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

using Names = std::vector<std::string>;

// A program with Ada as the selected learner. The history contains one run of hers, and Bob.
struct Named {
  TempFolder folder;
  CoachBench bench{folder / "history.db"};
  Coach coach{bench.config};

  Named() {
    coach.set_help(false);
    bench.trial(coach, "one");
    History(bench.config.history).find_or_add_learner("Bob");
  }
  Names saved() const {
    Names names;
    for (const LearnerRow& row : History(bench.config.history).learners()) names.push_back(row.name);
    return names;
  }
  void rename_elsewhere(const std::string& before, const std::string& name) const {
    History other(bench.config.history);
    REQUIRE(other.rename_learner(other.find_learner(before).value().id, name));
  }
};

}  // namespace

TEST_CASE("any form of a name chooses the same learner") {
  Named here;
  for (const char* form : {"ADA", "\uff21da", " Ada "}) {
    here.coach.set_learner("Bob");
    here.coach.set_learner(form);
    CHECK(here.coach.view().learner == "Ada");
    CHECK(here.coach.view().runs.size() == 1);
  }
  here.coach.set_learner("Zoe\u0308");
  CHECK(here.coach.view().learner == "Zo\u00eb");
  CHECK(here.saved() == Names{"Ada", "Bob"});  // a name that has driven nothing leaves nothing
}

TEST_CASE("a renamed learner keeps all runs, and later runs are saved under the new name") {
  Named here;
  here.coach.rename_learner("Ada  Lo\u0308we");
  CHECK(here.coach.view().learner == "Ada L\u00f6we");
  CHECK(here.coach.view().learners == Names{"Ada L\u00f6we", "Bob"});
  CHECK(here.coach.view().runs.size() == 1);
  here.bench.trial(here.coach, "one");
  CHECK(here.coach.view().runs.size() == 2);
  CHECK(here.saved() == Names{"Ada L\u00f6we", "Bob"});
  for (const char* bad : {"bob", "", "A\u200bda"})
    CHECK_THROWS_AS(here.coach.rename_learner(bad), std::invalid_argument);
  here.coach.set_learner("");
  CHECK_THROWS_AS(here.coach.rename_learner("Zoe"), std::invalid_argument);
  here.coach.set_learner("Cy");  // has driven nothing yet
  here.coach.rename_learner("Cyd");
  CHECK(here.saved() == Names{"Ada L\u00f6we", "Bob"});
  here.bench.trial(here.coach, "one");
  CHECK(here.saved() == Names{"Ada L\u00f6we", "Bob", "Cyd"});
}

TEST_CASE("while the history is locked a new name waits, then it is saved; of two new names only the second") {
  Named here;
  {
    sqlite3* other = nullptr;
    REQUIRE(sqlite3_open(here.bench.config.history.c_str(), &other) == SQLITE_OK);
    REQUIRE(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr) == SQLITE_OK);
    here.coach.rename_learner("Eve");
    here.coach.rename_learner("Eva");
    CHECK(here.coach.view().learner == "Eva");
    sqlite3_close(other);
  }
  CHECK(here.coach.flush().empty());
  CHECK(here.saved() == Names{"Bob", "Eva"});
}

TEST_CASE("if another learner gets the name first, the old name stays and this is reported") {
  Named here;
  sqlite3* other = nullptr;
  REQUIRE(sqlite3_open(here.bench.config.history.c_str(), &other) == SQLITE_OK);
  REQUIRE(sqlite3_exec(other, "BEGIN IMMEDIATE; UPDATE learner SET name = 'Eve' WHERE name = 'Bob'", nullptr, nullptr,
                       nullptr) == SQLITE_OK);
  here.coach.rename_learner("eve");
  REQUIRE(sqlite3_exec(other, "COMMIT", nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(other);
  here.coach.flush();
  CHECK(here.coach.view().learner == "Ada");
  CHECK(here.coach.take_problem() == "Another learner is called eve now, so the name Ada stays.");
  CHECK(here.saved() == Names{"Ada", "Eve"});
}

TEST_CASE("a learner whom another program renames stays selected; the old name is free for someone else") {
  Named here;
  here.rename_elsewhere("Ada", "Ada Lovelace");
  here.bench.trial(here.coach, "one");
  CHECK(here.coach.view().learner == "Ada Lovelace");
  CHECK(here.coach.view().runs.size() == 2);
  here.coach.set_learner("Ada");
  CHECK(here.coach.view().runs.empty());
  here.bench.trial(here.coach, "one");
  CHECK(here.saved() == Names{"Ada", "Ada Lovelace", "Bob"});
}

TEST_CASE("learners joined in an older file are reported once") {
  const TempFolder folder;
  CoachBench bench(folder / "history.db");
  History(bench.config.history).find_or_add_learner("Ada");
  sqlite3* older = nullptr;
  REQUIRE(sqlite3_open(bench.config.history.c_str(), &older) == SQLITE_OK);
  const std::string text = std::string("INSERT INTO learner (name, made_at) VALUES ('Ada ', '');") + kToHistoryVersion1;
  REQUIRE(sqlite3_exec(older, text.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(older);
  {
    Coach coach(bench.config);
    CHECK(coach.take_problem().value_or("").ends_with("were joined, with all their runs: Ada"));
    CHECK_FALSE(coach.take_problem().has_value());
  }
  CHECK_FALSE(Coach(bench.config).take_problem().has_value());
}
