// The last full run of each family on one machine, saved in the user's data folder.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "app/lab/bench/bench_run.h"

namespace gearshift::lab {

// folder: the user's data folder.
std::filesystem::path last_run_file(const std::filesystem::path& folder, const Machine& machine);

struct LastFigure {
  double value = 0.0;
  std::optional<Quartiles> spread;
};

struct LastFamily {
  std::string date, program, contention;                   // of the last run; contention: text of format_contention()
  std::map<std::string, LastFigure, std::less<>> figures;  // key: the row's name
};
using LastRun = std::map<std::string, LastFamily, std::less<>>;  // by family

// Empty if the file does not exist. A file that cannot be read or parsed is reported in one sentence and renamed to
// FILE.unreadable (or FILE.unreadable2 and so on), so that this run can be saved.
LastRun read_last_run(const std::filesystem::path& file, const std::function<void(const std::string&)>& report);

// Empty for a row that was not measured now or is missing in the last run.
std::optional<SinceLast> since_last(const LastRun& last, const BenchRow& row);
void compare(BenchRun& run, const LastRun& last);  // all rows, and the costs of the methods among them

// Replaces the families of this run in the file and keeps the others. Throws FileError.
void save_run(const std::filesystem::path& file, LastRun last, const BenchRun& run);

}  // namespace gearshift::lab
