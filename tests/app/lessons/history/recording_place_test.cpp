// A recording's path is relative to the history's folder, so the user can move or copy history and recordings together.
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/history/history.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

namespace fs = std::filesystem;

void drive(const fs::path& file, const std::vector<std::string>& recordings) {
  History history(file);
  const std::int64_t session = history.begin_session(history.find_or_add_learner("Ada"), "1.0");
  for (const std::string& recording : recordings) history.begin_run(session, some_result(0), recording);
}

std::vector<std::string> places_in(const fs::path& file) {
  History history(file);
  std::vector<std::string> places;
  for (const RunRow& run : history.runs(history.find_learner("Ada")->id))
    places.push_back(history.recording_file(run.recording));
  return places;
}

}  // namespace

TEST_CASE("a moved or copied history refers to the recordings next to it; paths to other folders stay") {
  const TempFolder folder;
  const std::string away = (folder / "away.trace").string();
  drive(folder / "one/history.db", {(folder / "one/recordings/a.trace").string(), away, ""});
  fs::copy(folder / "one", folder / "copy", fs::copy_options::recursive);
  fs::rename(folder / "one", folder / "moved");
  for (const char* place : {"copy", "moved"}) {
    const std::string near = (folder / place / "recordings/a.trace").string();
    CHECK(places_in(folder / place / "history.db") == std::vector<std::string>{near, away, ""});
  }
}

TEST_CASE(
    "only true subfolders are relative: not a similar folder name, nor a path through the parent; links are resolved") {
  const TempFolder folder;
  fs::create_directories(folder / "real");
  fs::create_directory_symlink(folder / "real", folder / "link");
  const auto name_of = [&](const fs::path& history, const fs::path& recording) {
    fs::remove(history);
    drive(history, {recording.string()});
    History opened(history);
    return opened.runs(opened.find_learner("Ada")->id).at(0).recording;
  };
  const fs::path real = folder / "real/history.db", link = folder / "link/history.db";
  CHECK(name_of(real, folder / "real/deep/a.trace") == "deep/a.trace");
  CHECK(name_of(real, folder / "really/a.trace") == (folder / "really/a.trace").string());
  CHECK(name_of(real, folder / "real/../a.trace") == (folder / "real/../a.trace").string());
  CHECK(name_of(link, folder / "link/a.trace") == "a.trace");
  CHECK(name_of(link, folder / "real/a.trace") == "a.trace");
  CHECK(name_of(real, folder / "link/a.trace") == "a.trace");
  CHECK(name_of(real, "near.trace") == "near.trace");
}

TEST_CASE("a forgotten recording is removed from all rows; recordings to which no other row refers are listed") {
  const TempFolder folder;
  History history(folder / "history.db");
  const std::int64_t ada = history.find_or_add_learner("Ada"), bob = history.find_or_add_learner("Bob");
  const std::int64_t session = history.begin_session(ada, "1.0");
  const std::int64_t run = history.begin_run(session, some_result(0), "gone.trace");
  history.begin_run(session, some_result(0), "own.trace");
  history.begin_run(session, some_result(0), "shared.trace");
  history.begin_run(history.begin_session(bob, "1.0"), some_result(0), "shared.trace");
  history.clear_recording(run);
  CHECK(history.runs(ada)[0].recording.empty());
  CHECK(history.recordings(ada) == std::vector<std::string>{"own.trace"});
  CHECK_THROWS_AS(history.clear_recording(99), HistoryDeleted);
}
