// Gone is gone, and where it cannot be, that is said and can be done later: readers, full disks, killed programs.
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>

#include "app/history/history.h"
#include "tests/app/history/some_result.h"
#include "tests/support/full_disk.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

const std::string kSecret = "Zymurgic quincunx";

struct Erasing {
  TempFolder folder;
  std::filesystem::path file = folder / "history.db";
  std::int64_t zeb = 0;

  Erasing() {
    History history(file);
    zeb = history.learner("Zebediah");
    const std::int64_t run = history.begin_run(history.begin_session(zeb, "1.0"), some_result(0), "a.trace");
    history.add_comment(run, "Bo", kSecret);
    history.learner("Bob");
  }

  bool holds_secret() const {
    bool anywhere = false;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      anywhere |= bytes.find(kSecret) != std::string::npos || bytes.find("Zebediah") != std::string::npos;
    }
    return anywhere;
  }
};

bool is_one_sentence(const std::string& text) {
  return !text.empty() && text.find('\n') == std::string::npos;
}

}  // namespace

TEST_CASE("while another program reads, what was erased is not out of the log: that is said, and done later") {
  const Erasing erasing;
  sqlite3* reader = nullptr;
  sqlite3_stmt* statement = nullptr;
  REQUIRE(sqlite3_open(erasing.file.c_str(), &reader) == SQLITE_OK);
  {
    History history(erasing.file);
    history.set_patience(std::chrono::milliseconds(20));
    history.learner("Cy");  // something that the log holds
    REQUIRE(sqlite3_exec(reader, "BEGIN", nullptr, nullptr, nullptr) == SQLITE_OK);
    REQUIRE(sqlite3_prepare_v2(reader, "SELECT name FROM learner", -1, &statement, nullptr) == SQLITE_OK);
    REQUIRE(sqlite3_step(statement) == SQLITE_ROW);
    std::vector<std::string> removed;
    const std::string left = history.erase_learner(erasing.zeb, [&](const auto& recordings) { removed = recordings; });
    CHECK(is_one_sentence(left));
    CHECK(left.find("another program") != std::string::npos);
    CHECK(removed == std::vector<std::string>{"a.trace"});
    CHECK(erasing.holds_secret());  // or else nothing would have to be said
    CHECK_FALSE(history.find_learner("Zebediah").has_value());
    CHECK(history.erasure_is_pending());
    CHECK(is_one_sentence(history.finish_erasure()));
  }
  sqlite3_finalize(statement);
  REQUIRE(sqlite3_exec(reader, "COMMIT", nullptr, nullptr, nullptr) == SQLITE_OK);
  History again(erasing.file);
  CHECK(again.erasure_is_pending());
  CHECK(again.finish_erasure().empty());
  CHECK_FALSE(again.erasure_is_pending());
  CHECK_FALSE(erasing.holds_secret());
  sqlite3_close(reader);
}

TEST_CASE("on a disk that is full the learner stays, or all but the room goes, and that is said") {
  const Erasing erasing;
  {
    History history(erasing.file);
    disk_is_full = true;
    CHECK_THROWS_WITH_AS((void)history.erase_learner(erasing.zeb, [](const auto&) {}),
                         doctest::Contains("the disk is full: the recordings are gone, all else stays"), HistoryFull);
    disk_is_full = false;
    REQUIRE(history.find_learner("Zebediah").has_value());  // to be erased again
    // Another learner's 4 MB.
    const std::int64_t session = history.begin_session(history.learner("Bob"), "1.0");
    for (int i = 0; i < 4; ++i) history.add_settings(session, std::string(1'000'000, 'x'));
  }
  // Room for the transaction, but not for the file written anew: no file can be longer than 2 MB.
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    History other(erasing.file);
    const rlimit small{2'000'000, 2'000'000};
    setrlimit(RLIMIT_FSIZE, &small);
    bool has_removed = false;
    const std::string left = other.erase_learner(erasing.zeb, [&](const auto& names) { has_removed = !names.empty(); });
    const bool is_gone = !other.find_learner("Zebediah").has_value();
    _exit(has_removed && is_gone && is_one_sentence(left) && other.erasure_is_pending() ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(status == 0);
  History history(erasing.file);
  CHECK(history.erasure_is_pending());
  CHECK(history.finish_erasure().empty());
  CHECK_FALSE(erasing.holds_secret());
}

TEST_CASE("killed between the recordings and the rows, the learner is there to be erased") {
  const Erasing erasing;
  const pid_t child = fork();
  if (child == 0) {
    History history(erasing.file);
    (void)history.erase_learner(erasing.zeb, [](const auto&) { _exit(0); });
    _exit(1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  REQUIRE(status == 0);
  History history(erasing.file);
  CHECK(history.find_learner("Zebediah").has_value());
  CHECK(history.erase_learner(erasing.zeb, [](const auto& recordings) { CHECK(recordings.size() == 1); }).empty());
  CHECK_FALSE(erasing.holds_secret());
}
