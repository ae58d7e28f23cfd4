// Tests that deleting a learner removes the learner's rows, recordings and every byte of the name. Data of other
// learners stays, as do files that are not recordings.
#include "app/lessons/report/delete_learner.h"

#include <sqlite3.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

#include "app/lessons/report/learner_history.h"
#include "haptics/loop/trace_format.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string trace_bytes() {
  return std::string(kTraceMagic.begin(), kTraceMagic.end()) + "anything";
}

std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void drive(History& history, const std::string& name, const std::vector<std::string>& recordings) {
  const std::int64_t session = history.begin_session(history.find_or_add_learner(name), "1.0");
  for (const std::string& recording : recordings) {
    const std::int64_t run = history.begin_run(session, some_result(0), recording);
    history.end_run(run, some_result(2));
    history.add_comment(run, "Bo", "Remarkable Xylophone");
  }
}

}  // namespace

TEST_CASE("rows, comments and recordings are deleted and listed; other learners keep theirs") {
  const TempFolder folder;
  const std::string own = (folder / "own.trace").string(), shared = (folder / "shared.trace").string(),
                    letter = (folder / "letter.txt").string(), away = (folder / "away.trace").string();
  write(own, trace_bytes());
  write(shared, trace_bytes());
  write(folder / "near.trace", trace_bytes());
  write(letter, "Dear Ada");
  std::filesystem::create_symlink(letter, folder / "link.trace");
  {
    History history(folder / "history.db");
    drive(history, "Zebediah", {own, shared, letter, away, "near.trace", "link.trace", ""});
    drive(history, "Bob", {shared});
    const DeletionReport report = delete_learner(history, *history.find_learner("Zebediah"));
    CHECK(report.sessions == 1);
    CHECK(report.runs == 7);
    CHECK(report.shifts == 14);
    CHECK(report.errors == 28);
    CHECK(report.comments == 7);
    CHECK(report.remaining_data.empty());
    CHECK(report.recordings.size() == 2);  // own.trace and near.trace
    CHECK(report.missing == std::vector<std::string>{away});
    REQUIRE(report.not_deleted.size() == 2);
    CHECK_FALSE(history.find_learner("Zebediah").has_value());
    CHECK(read_learner(history, *history.find_learner("Bob")).runs.size() == 1);
  }
  CHECK_FALSE(std::filesystem::exists(own));
  CHECK_FALSE(std::filesystem::exists(folder / "near.trace"));
  CHECK(std::filesystem::exists(shared));
  CHECK(file_bytes(letter) == "Dear Ada");
  CHECK(std::filesystem::is_symlink(folder / "link.trace"));
  CHECK(file_bytes(folder / "history.db").find("Zebediah") == std::string::npos);
}

TEST_CASE(
    "if deleted rows cannot be removed from the file's bytes, this is reported, and recordings are still deleted") {
  const TempFolder folder;
  write(folder / "own.trace", trace_bytes());
  History history(folder / "history.db");
  drive(history, "Zebediah", {"own.trace"});
  history.set_lock_timeout(std::chrono::milliseconds(10));
  sqlite3* reader = nullptr;
  REQUIRE(sqlite3_open((folder / "history.db").c_str(), &reader) == SQLITE_OK);
  REQUIRE(sqlite3_exec(reader, "BEGIN; SELECT count(*) FROM learner", nullptr, nullptr, nullptr) == SQLITE_OK);
  const DeletionReport report = delete_learner(history, *history.find_learner("Zebediah"));
  CHECK(report.recordings.size() == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "own.trace"));
  CHECK(report.remaining_data.find("another program is reading the file") != std::string::npos);
  sqlite3_close(reader);
  CHECK(history.finish_erasure().empty());
}

TEST_CASE("a learner is read back with runs and comments") {
  const TempFolder folder;
  History history(folder / "history.db");
  drive(history, "Ada", {"a", "b"});
  const LearnerHistory all = read_learner(history, *history.find_learner("Ada"));
  CHECK(all.learner.name == "Ada");
  REQUIRE(all.runs.size() == 2);
  CHECK(all.runs[1].recording == "b");
  REQUIRE(all.runs[1].comments.size() == 1);
  CHECK(all.runs[1].comments[0].text == "Remarkable Xylophone");
}

TEST_CASE("deleting a learner from a copied history deletes the copy's recordings only") {
  const TempFolder folder;
  const auto one = folder / "one", copy = folder / "copy";
  std::filesystem::create_directories(one / "recordings");
  write(one / "recordings/a.trace", trace_bytes());
  {
    History history(one / "history.db");
    drive(history, "Ada", {(one / "recordings/a.trace").string()});
  }
  std::filesystem::copy(one, copy, std::filesystem::copy_options::recursive);
  {
    History history(copy / "history.db");
    const DeletionReport report = delete_learner(history, *history.find_learner("Ada"));
    CHECK(report.recordings == std::vector<std::string>{(copy / "recordings/a.trace").string()});
  }
  CHECK_FALSE(std::filesystem::exists(copy / "recordings/a.trace"));
  CHECK(std::filesystem::exists(one / "recordings/a.trace"));
}

TEST_CASE("recordings can be deleted first, even with a read-only history; the rows can be deleted later") {
  const TempFolder folder;
  write(folder / "own.trace", trace_bytes());
  write(folder / "shared.trace", trace_bytes());
  {
    History history(folder / "history.db");
    drive(history, "Ada", {"own.trace", "shared.trace"});
    drive(history, "Bob", {"shared.trace"});
  }
  History copy(folder / "history.db", system_seconds, kHistoryLockTimeout, HistoryUse::read);
  CHECK(remove_recordings(copy, *copy.find_learner("Ada")).recordings.size() == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "own.trace"));
  CHECK(std::filesystem::exists(folder / "shared.trace"));
  History history(folder / "history.db");
  const DeletionReport report = delete_learner(history, *history.find_learner("Ada"));
  CHECK(report.runs == 2);
  CHECK(report.missing.size() == 1);
}
