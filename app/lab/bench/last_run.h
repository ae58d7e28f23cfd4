// The latest full run of each family of rows on one machine, saved in the user's data folder.
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
  std::string date, program, contention;                   // data of the last run; contention: format_contention()
  std::map<std::string, LastFigure, std::less<>> figures;  // key: the row's name
};
using LastRun = std::map<std::string, LastFamily, std::less<>>;  // by family

// Returns an empty LastRun if the file does not exist. If the file cannot be read or parsed, reports the problem in one
// sentence and renames the file to FILE.unreadable (or FILE.unreadable2 and so on), so that the current run can be
// saved.
LastRun read_last_run(const std::filesystem::path& file, const std::function<void(const std::string&)>& report);

// Empty if the row was not measured in this run or is missing from `last`.
std::optional<SinceLast> since_last(const LastRun& last, const BenchRow& row);
void compare(BenchRun& run, const LastRun& last);  // compares all rows and the costs of their methods

// Replaces the row families that this run contains and keeps all others in the file. Throws FileError.
void save_run(const std::filesystem::path& file, LastRun last, const BenchRun& run);

}  // namespace gearshift::lab
