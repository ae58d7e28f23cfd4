// Erasing a learner removes every byte of her data from the file. If erasing fails (readers, full disk, killed
// program), the failure is reported and the user can finish it later.
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

#include "app/lessons/history/history.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/full_disk.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

const std::string kSecret = "Zymurgic quincunx";

struct Erasing {
  TempFolder folder;
  std::filesystem::path file = folder / "history.db";
  std::int64_t zeb = 0;

  Erasing() {
    History history(file);
    zeb = history.find_or_add_learner("Zebediah");
    const std::int64_t run = history.begin_run(history.begin_session(zeb, "1.0"), some_result(0), "a.trace");
    history.add_comment(run, "Bo", kSecret);
    history.find_or_add_learner("Bob");
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

TEST_CASE("while a second program reads, erased data stays in the log: this is reported, and completed later") {
  const Erasing erasing;
  sqlite3* reader = nullptr;
  sqlite3_stmt* statement = nullptr;
  REQUIRE(sqlite3_open(erasing.file.c_str(), &reader) == SQLITE_OK);
  {
    History history(erasing.file);
    history.set_lock_timeout(std::chrono::milliseconds(20));
    history.find_or_add_learner("Cy");  // this row stays in the write-ahead log
    REQUIRE(sqlite3_exec(reader, "BEGIN", nullptr, nullptr, nullptr) == SQLITE_OK);
    REQUIRE(sqlite3_prepare_v2(reader, "SELECT name FROM learner", -1, &statement, nullptr) == SQLITE_OK);
    REQUIRE(sqlite3_step(statement) == SQLITE_ROW);
    std::vector<std::string> removed;
    const std::string left = history.erase_learner(erasing.zeb, [&](const auto& recordings) { removed = recordings; });
    CHECK(is_one_sentence(left));
    CHECK(left.find("another program") != std::string::npos);
    CHECK(removed == std::vector<std::string>{"a.trace"});
    CHECK(erasing.holds_secret());  // Zebediah's data is still in the write-ahead log
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

TEST_CASE("on a full disk either nothing is erased, or erased data stays in the file; both are reported") {
  const Erasing erasing;
  {
    History history(erasing.file);
    disk_is_full = true;
    CHECK_THROWS_WITH_AS((void)history.erase_learner(erasing.zeb, [](const auto&) {}),
                         doctest::Contains("the disk is full, so only the recordings were deleted"), HistoryFull);
    disk_is_full = false;
    REQUIRE(history.find_learner("Zebediah").has_value());  // the learner must remain, so that she can be erased later
    // Adds 4 MB of data for a different learner.
    const std::int64_t session = history.begin_session(history.find_or_add_learner("Bob"), "1.0");
    LessonResult long_reason;
    long_reason.why = std::string(1'000'000, 'x');
    for (int i = 0; i < 4; ++i) history.end_run(history.begin_run(session, long_reason, ""), long_reason);
  }
  // The file size limit of 2 MB leaves room for the transaction, but not for the copy of the file that VACUUM makes.
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    History other(erasing.file);
    const rlimit small{2'000'000, 2'000'000};
    setrlimit(RLIMIT_FSIZE, &small);
    bool has_removed = false;
    const std::string left = other.erase_learner(erasing.zeb, [&](const auto& names) { has_removed = !names.empty(); });
    const bool is_erased = !other.find_learner("Zebediah").has_value();
    _exit(has_removed && is_erased && is_one_sentence(left) && other.erasure_is_pending() ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(status == 0);
  History history(erasing.file);
  CHECK(history.erasure_is_pending());
  CHECK(history.finish_erasure().empty());
  CHECK_FALSE(erasing.holds_secret());
}

TEST_CASE(
    "if the program is killed after deleting recordings and before deleting rows, the learner can be erased later") {
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
