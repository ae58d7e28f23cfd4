// A history that is read needs no write: files and folders that nobody may write, logs of others, older versions.
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/history/history.h"
#include "app/history/schema.h"
#include "haptics/files/printable.h"
#include "tests/app/history/some_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

namespace fs = std::filesystem;

History read_only(const fs::path& file) {
  return History(file, system_seconds, kHistoryPatience, HistoryUse::read);
}

// A folder with a history in it that nobody may write; it can be removed again.
struct Sealed {
  TempFolder folder;
  fs::path place = folder / "sealed", file = place / "history.db";

  explicit Sealed(const std::function<void(const fs::path&)>& make) {
    fs::permissions(folder.path(), fs::perms(0755));
    fs::create_directory(place);
    make(file);
    for (const auto& entry : fs::directory_iterator(place)) fs::permissions(entry.path(), fs::perms(0444));
    fs::permissions(place, fs::perms(0555));
  }
  ~Sealed() { fs::permissions(place, fs::perms(0755)); }
  Sealed(const Sealed&) = delete;
  Sealed& operator=(const Sealed&) = delete;

  std::map<std::string, std::string> bytes() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(place)) {
      std::ifstream in(entry.path(), std::ios::binary);
      all[entry.path().filename()] = {std::istreambuf_iterator<char>(in), {}};
    }
    return all;
  }
};

void write_one(const fs::path& file) {
  History history(file);
  const std::int64_t session = history.begin_session(history.learner("Ada"), "1.0");
  const std::int64_t run = history.begin_run(session, some_result(0), "");
  history.end_run(run, some_result(3));
  history.add_comment(run, "Bo", "Calmer.");
}

// In another program, as a user without the right to write, which root never is. Empty: it went well.
std::string as_nobody(const std::function<std::string()>& work) {
  int told[2];
  REQUIRE(pipe(told) == 0);
  const pid_t child = fork();
  if (child == 0) {
    std::string said = "cannot become nobody";
    if (geteuid() != 0 || setuid(65534) == 0) {
      try {
        said = work();
      } catch (const HistoryError& problem) {
        said = problem.what();
      }
    }
    (void)!write(told[1], said.data(), said.size());
    _exit(0);
  }
  close(told[1]);
  std::string said;
  for (char c = 0; read(told[0], &c, 1) == 1;) said += c;
  close(told[0]);
  waitpid(child, nullptr, 0);
  return said;
}

std::string what_is_wrong_with(History&& history) {
  const auto ada = history.find_learner("Ada");
  if (!ada) return "nobody";
  const std::vector<RunRow> runs = history.runs(ada->id);
  if (runs.size() != 1 || runs[0].result.shifts.size() != 3) return "other runs";
  const std::vector<CommentRow> comments = history.comments(runs[0].id);
  return comments.size() == 1 && comments[0].text == "Calmer." ? "" : "other comments";
}

}  // namespace

TEST_CASE("a history that nobody may write, in a folder that nobody may write, is read whole, and stays as it is") {
  const Sealed sealed(write_one);
  const auto before = sealed.bytes();
  REQUIRE(before.size() == 1);
  CHECK(as_nobody([&] { return what_is_wrong_with(read_only(sealed.file)); }) == "");
  CHECK(what_is_wrong_with(read_only(sealed.file)) == "");  // who may write does not, either
  CHECK(sealed.bytes() == before);
}

// Law: what may not be written gets no log beside it, which nobody else could write either.
TEST_CASE("a history that may not be written, in a folder that may: read or refused, it can be written again later") {
  const TempFolder folder;
  const fs::path place = folder / "open", file = place / "history.db";
  fs::permissions(folder.path(), fs::perms(0755));
  fs::create_directory(place);
  write_one(file);
  fs::permissions(place, fs::perms(0777));
  fs::permissions(file, fs::perms(0444));
  const auto write = [&] {
    History(file).learner("Bob");
    return std::string();
  };
  const std::string said = as_nobody(write);
  CHECK(said == file.string() + ": the history cannot be used: it may not be written");
  CHECK(as_nobody([&] { return what_is_wrong_with(read_only(file)); }) == "");
  CHECK(std::distance(fs::directory_iterator(place), {}) == 1);
  fs::permissions(file, fs::perms(0666));
  CHECK(as_nobody(write) == "");

  // What an older program left there: named.
  std::ofstream(place / "history.db-shm") << "";
  fs::permissions(place / "history.db-shm", fs::perms(0444));
  CHECK(as_nobody(write) ==
        file.string() + ": the history cannot be used: history.db-shm beside it may not be written");
}

TEST_CASE("names that mean something in an address are names") {
  const TempFolder folder;
  fs::permissions(folder.path(), fs::perms(0755));
  for (const char* name : {"a?b#c", "100%41", "mode=memory", "sp ace"}) {
    CAPTURE(name);
    const fs::path place = folder / name;
    fs::create_directory(place);
    write_one(place / "history.db");
    fs::permissions(place / "history.db", fs::perms(0444));
    fs::permissions(place, fs::perms(0555));
    CHECK(as_nobody([&] { return what_is_wrong_with(read_only(place / "history.db")); }) == "");
    fs::permissions(place, fs::perms(0755));
  }
}

// What a killed program had written and not yet taken over stands in the log alone.
TEST_CASE("with a log beside it and its index both are read; with a log alone that is said") {
  const auto killed = [](const fs::path& file) {
    const pid_t child = fork();
    if (child == 0) {
      static History history(file);
      const std::int64_t session = history.begin_session(history.learner("Ada"), "1.0");
      const std::int64_t run = history.begin_run(session, some_result(0), "");
      history.end_run(run, some_result(3));
      history.add_comment(run, "Bo", "Calmer.");
      _exit(0);
    }
    waitpid(child, nullptr, 0);
  };
  const Sealed with_index(killed);
  const auto before = with_index.bytes();
  REQUIRE(before.size() == 3);
  CHECK(as_nobody([&] { return what_is_wrong_with(read_only(with_index.file)); }) == "");
  CHECK(with_index.bytes() == before);

  const Sealed without([&](const fs::path& file) {
    killed(file);
    fs::remove(file.string() + "-shm");
  });
  const std::string said = as_nobody([&] { return what_is_wrong_with(read_only(without.file)); });
  CHECK(said.find(without.file.string() + ": the history cannot be used: it has a log beside it") == 0);
  CHECK(is_printable(said));
}

TEST_CASE("an older history is read as if it were brought up to date, and is not") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  sqlite3* old = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &old) == SQLITE_OK);
  const std::string text = kMigrations[0] +
                           "PRAGMA user_version = 1; PRAGMA application_id = " + std::to_string(kApplicationId) +
                           ";INSERT INTO learner VALUES (3, 'Ada', '2026-01-02T03:04:05Z', 'reverse');";
  REQUIRE(sqlite3_exec(old, text.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(old);
  const auto bytes = [&] {
    std::ifstream in(file, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string before = bytes();
  History history = read_only(file);
  REQUIRE(history.find_learner("Ada").has_value());
  CHECK(history.runs(3).empty());
  CHECK(bytes() == before);
}

TEST_CASE("what was opened to be read takes nothing, and nobody waits for it") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  write_one(file);
  History copy = read_only(file), writer(file);
  CHECK_THROWS_WITH_AS(copy.learner("Bob"), doctest::Contains("may not be written"), HistoryError);
  CHECK(writer.erase_learner(writer.find_learner("Ada")->id, [](const auto&) {}).empty());
  CHECK(what_is_wrong_with(std::move(copy)) == "");  // as it was
  CHECK(read_only(file).learners().empty());
}

TEST_CASE("on a disk that is full it is read all the same") {
  const TempFolder folder;
  write_one(folder / "history.db");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit none{0, 0};  // no file can grow
    setrlimit(RLIMIT_FSIZE, &none);
    std::string said;
    try {
      said = what_is_wrong_with(read_only(folder / "history.db"));
    } catch (const HistoryError& problem) {
      said = problem.what();
    }
    _exit(said.empty() ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(status == 0);
}

TEST_CASE("what cannot be read is refused in one sentence, and nothing is made") {
  const TempFolder folder;
  fs::permissions(folder.path(), fs::perms(0755));
  const auto refused = [](const fs::path& file) {
    const std::string said = as_nobody([&] { return what_is_wrong_with(read_only(file)); });
    CAPTURE(said);
    return said.find(file.string() + ": the history cannot be used: ") == 0 && is_printable(said);
  };
  CHECK(refused(folder / "none.db"));
  CHECK(refused(folder.path()));
  CHECK_THROWS_WITH_AS((void)read_only(folder.path()), doctest::Contains("it is a folder"), HistoryError);
  std::ofstream(folder / "letter.db") << "Dear Ada" << std::string(4096, ' ');
  CHECK(refused(folder / "letter.db"));
  write_one(folder / "secret.db");
  fs::permissions(folder / "secret.db", fs::perms(0));
  CHECK(refused(folder / "secret.db"));
  CHECK_FALSE(fs::exists(folder / "none.db"));
}
