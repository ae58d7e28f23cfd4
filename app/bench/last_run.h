// What the last full run had, of each family, on one machine: a file in the user's data folder.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "app/bench/bench_run.h"

namespace gearshift {

// folder: of the user's data.
std::filesystem::path last_run_file(const std::filesystem::path& folder, const Machine& machine);

struct LastFigure {
  double value = 0.0;
  std::optional<Quartiles> spread;
};

struct LastFamily {
  std::string date, program, taken;                        // of the run: taken by others, as taken_words() says it
  std::map<std::string, LastFigure, std::less<>> figures;  // by the row's name
};
using LastRun = std::map<std::string, LastFamily, std::less<>>;  // by family

// Empty where there is no such file. What cannot be read or makes no sense is told in one sentence and kept aside as
// FILE.unreadable, FILE.unreadable2 and so on, so that the next run has a file.
LastRun read_last_run(const std::filesystem::path& file, const std::function<void(const std::string&)>& tell);

// Nothing for a row that was not measured, or not there.
std::optional<SinceLast> since_last(const LastRun& last, const BenchRow& row);
void compare(BenchRun& run, const LastRun& last);  // every row, and what its method costs

// Families of this run take the place of the same ones in the file, the others stay. Throws FileError.
void keep_run(const std::filesystem::path& file, LastRun last, const BenchRun& run);

}  // namespace gearshift
