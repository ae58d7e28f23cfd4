// Reading a history needs no write access. Tested with read-only files and folders, and write-ahead logs of other
// programs.
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

#include "app/lessons/history/history.h"
#include "haptics/files/printable.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

namespace fs = std::filesystem;

History read_only(const fs::path& file) {
  return History(file, system_seconds, kHistoryLockTimeout, HistoryUse::read);
}

// A read-only folder that contains a history. The destructor makes the folder writable, so that it can be removed.
struct ReadOnlyFolder {
  TempFolder folder;
  fs::path place = folder / "sealed", file = place / "history.db";

  explicit ReadOnlyFolder(const std::function<void(const fs::path&)>& make) {
    fs::permissions(folder.path(), fs::perms(0755));
    fs::create_directory(place);
    make(file);
    for (const auto& entry : fs::directory_iterator(place)) fs::permissions(entry.path(), fs::perms(0444));
    fs::permissions(place, fs::perms(0555));
  }
  ~ReadOnlyFolder() { fs::permissions(place, fs::perms(0755)); }
  ReadOnlyFolder(const ReadOnlyFolder&) = delete;
  ReadOnlyFolder& operator=(const ReadOnlyFolder&) = delete;

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
  const std::int64_t session = history.begin_session(history.find_or_add_learner("Ada"), "1.0");
  const std::int64_t run = history.begin_run(session, some_result(0), "");
  history.end_run(run, some_result(3));
  history.add_comment(run, "Bo", "Calmer.");
}

// Runs `work` in a child process without root's rights, because root can always write. Returns the message that `work`
// returned, or the text of the HistoryError that it threw.
std::string without_permission(const std::function<std::string()>& work) {
  int message_pipe[2];
  REQUIRE(pipe(message_pipe) == 0);
  const pid_t child = fork();
  if (child == 0) {
    std::string message = "cannot become nobody";
    if (geteuid() != 0 || setuid(65534) == 0) {
      try {
        message = work();
      } catch (const HistoryError& problem) {
        message = problem.what();
      }
    }
    (void)!write(message_pipe[1], message.data(), message.size());
    _exit(0);
  }
  close(message_pipe[1]);
  std::string message;
  for (char c = 0; read(message_pipe[0], &c, 1) == 1;) message += c;
  close(message_pipe[0]);
  waitpid(child, nullptr, 0);
  return message;
}

std::string check_readable(History&& history) {
  const auto ada = history.find_learner("Ada");
  if (!ada) return "nobody";
  const std::vector<RunRow> runs = history.runs(ada->id);
  if (runs.size() != 1 || runs[0].result.shifts.size() != 3) return "other runs";
  const std::vector<CommentRow> comments = comments_of(history, runs[0].id);
  return comments.size() == 1 && comments[0].text == "Calmer." ? "" : "other comments";
}

}  // namespace

TEST_CASE("a read-only history in a read-only folder is read completely and stays unchanged") {
  const ReadOnlyFolder sealed(write_one);
  const auto before = sealed.bytes();
  REQUIRE(before.size() == 1);
  CHECK(without_permission([&] { return check_readable(read_only(sealed.file)); }) == "");
  // A history that was opened for reading is not written, even if the file permits writing.
  CHECK(check_readable(read_only(sealed.file)) == "");
  CHECK(sealed.bytes() == before);
}

// Invariant: opening a read-only history creates no log file, because that file would be read-only for other programs
// too.
TEST_CASE("a read-only history in a writable folder can be read, and written again later") {
  const TempFolder folder;
  const fs::path place = folder / "open", file = place / "history.db";
  fs::permissions(folder.path(), fs::perms(0755));
  fs::create_directory(place);
  write_one(file);
  fs::permissions(place, fs::perms(0777));
  fs::permissions(file, fs::perms(0444));
  const auto write = [&] {
    History(file).find_or_add_learner("Bob");
    return std::string();
  };
  const std::string message = without_permission(write);
  CHECK(message == file.string() + ": the history cannot be used because you have no permission to write to the file");
  CHECK(without_permission([&] { return check_readable(read_only(file)); }) == "");
  CHECK(std::distance(fs::directory_iterator(place), {}) == 1);
  fs::permissions(file, fs::perms(0666));
  CHECK(without_permission(write) == "");

  // An older program may have left this read-only file behind. The error message must name the file.
  std::ofstream(place / "history.db-shm") << "";
  fs::permissions(place / "history.db-shm", fs::perms(0444));
  CHECK(
      without_permission(write) ==
      file.string() +
          ": the history cannot be used because you have no permission to write to history.db-shm in the same folder");
}

TEST_CASE("a file name with a special meaning in a URI is used as an ordinary name") {
  const TempFolder folder;
  fs::permissions(folder.path(), fs::perms(0755));
  for (const char* name : {"a?b#c", "100%41", "mode=memory", "sp ace"}) {
    CAPTURE(name);
    const fs::path place = folder / name;
    fs::create_directory(place);
    write_one(place / "history.db");
    fs::permissions(place / "history.db", fs::perms(0444));
    fs::permissions(place, fs::perms(0555));
    CHECK(without_permission([&] { return check_readable(read_only(place / "history.db")); }) == "");
    fs::permissions(place, fs::perms(0755));
  }
}

// If a program was killed before a checkpoint, its last data is only in the write-ahead log.
TEST_CASE("a log with its index is read; a log without its index is reported") {
  const auto killed = [](const fs::path& file) {
    const pid_t child = fork();
    if (child == 0) {
      static History history(file);
      const std::int64_t session = history.begin_session(history.find_or_add_learner("Ada"), "1.0");
      const std::int64_t run = history.begin_run(session, some_result(0), "");
      history.end_run(run, some_result(3));
      history.add_comment(run, "Bo", "Calmer.");
      _exit(0);
    }
    waitpid(child, nullptr, 0);
  };
  const ReadOnlyFolder with_index(killed);
  const auto before = with_index.bytes();
  REQUIRE(before.size() == 3);
  CHECK(without_permission([&] { return check_readable(read_only(with_index.file)); }) == "");
  CHECK(with_index.bytes() == before);

  const ReadOnlyFolder without([&](const fs::path& file) {
    killed(file);
    fs::remove(file.string() + "-shm");
  });
  const std::string message = without_permission([&] { return check_readable(read_only(without.file)); });
  CHECK(message.find(without.file.string() + ": the history cannot be used because the file has a write-ahead log") ==
        0);
  CHECK(is_printable(message));
}

TEST_CASE("a history opened for reading rejects writes and locks out no other program") {
  const TempFolder folder;
  const auto file = folder / "history.db";
  write_one(file);
  History copy = read_only(file), writer(file);
  CHECK_THROWS_WITH_AS(copy.find_or_add_learner("Bob"), doctest::Contains("the file is read-only"), HistoryError);
  CHECK(writer.erase_learner(writer.find_learner("Ada")->id, [](const auto&) {}).empty());
  CHECK(check_readable(std::move(copy)) == "");  // the reader still gets the state before the deletion
  CHECK(read_only(file).learners().empty());
}

TEST_CASE("a history can be read on a full disk") {
  const TempFolder folder;
  write_one(folder / "history.db");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit none{0, 0};  // [bytes] limit of the file size; no file can grow
    setrlimit(RLIMIT_FSIZE, &none);
    std::string message;
    try {
      message = check_readable(read_only(folder / "history.db"));
    } catch (const HistoryError& problem) {
      message = problem.what();
    }
    _exit(message.empty() ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(status == 0);
}

TEST_CASE("an unreadable file is rejected in one sentence, and no file is created") {
  const TempFolder folder;
  fs::permissions(folder.path(), fs::perms(0755));
  const auto refused = [](const fs::path& file) {
    const std::string message = without_permission([&] { return check_readable(read_only(file)); });
    CAPTURE(message);
    return message.find(file.string() + ": the history cannot be used because ") == 0 && is_printable(message);
  };
  CHECK(refused(folder / "none.db"));
  CHECK(refused(folder.path()));
  CHECK_THROWS_WITH_AS((void)read_only(folder.path()), doctest::Contains("this is a folder"), HistoryError);
  std::ofstream(folder / "letter.db") << "Dear Ada" << std::string(4096, ' ');
  CHECK(refused(folder / "letter.db"));
  write_one(folder / "secret.db");
  fs::permissions(folder / "secret.db", fs::perms(0));
  CHECK(refused(folder / "secret.db"));
  CHECK_FALSE(fs::exists(folder / "none.db"));
}
