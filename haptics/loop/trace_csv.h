// A trace as a table for other programs: one line per cycle, units in the header line, any locale.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "haptics/files/part_file.h"
#include "haptics/loop/haptic_loop.h"

namespace gearshift {

std::string trace_csv_header();
// first_ns: deadline of the first cycle [ns], where time_s is 0. Both without the line's end.
std::string trace_csv_line(const TraceSample& sample, std::int64_t first_ns);

class TraceCsvFile {  // there whole or not at all
 public:
  explicit TraceCsvFile(const std::filesystem::path& file);  // throws FileError when it cannot be written
  void add(const TraceSample& sample);
  void finish();  // throws FileError when something could not be written

 private:
  std::string name_;
  PartFile part_;
  std::ofstream stream_;
  std::optional<std::int64_t> first_ns_;
};

}  // namespace gearshift
