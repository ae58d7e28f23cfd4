// Tests writing the page and the tables to a disk that fills up.
#include "app/lessons/report/report_files.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/temp_folder.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

TEST_CASE("without room for the third file, two are complete, and the message names them") {
  const TempFolder folder;
  const std::vector<ReportFile> files{{"index.html", std::string(500, 'a')},
                                      {"runs.csv", std::string(900, 'b')},
                                      {"shifts.csv", std::string(20'000, 'c')},
                                      {"errors.csv", "d"}};
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{2000, 2000};  // [bytes] size limit for any file
    setrlimit(RLIMIT_FSIZE, &small);
    int files_written = 0;
    try {
      write_report_files(folder.path(), files, [&](const auto&) { ++files_written; });
    } catch (const std::runtime_error& problem) {
      const std::string wanted =
          (folder / "shifts.csv").string() +
          ": cannot be written (File too large); written: index.html, runs.csv; not written: shifts.csv, errors.csv";
      _exit(files_written == 2 && problem.what() == wanted ? 0 : 2);
    }
    _exit(1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(WEXITSTATUS(status) == 0);
  std::vector<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) there.push_back(entry.path().filename());
  std::sort(there.begin(), there.end());
  CHECK(there == std::vector<std::string>{"index.html", "runs.csv"});
  CHECK(std::filesystem::file_size(folder / "runs.csv") == 900);
}
