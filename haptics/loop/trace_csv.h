// Exports a trace as CSV: one line per cycle, units in the header line, independent of the locale.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "haptics/files/atomic_file.h"
#include "haptics/loop/haptic_loop.h"

namespace gearshift::haptics {

std::string trace_csv_header();
// first_ns: deadline of the first cycle [ns]; the column time_s is 0 there. Neither the header line nor the data lines
// end with a newline.
std::string trace_csv_line(const TraceSample& sample, std::int64_t first_ns);

class TraceCsvFile {  // the file appears only after finish()
 public:
  explicit TraceCsvFile(const std::filesystem::path& file);  // throws FileError if it cannot be written
  void add(const TraceSample& sample);
  void finish();  // throws FileError if something could not be written

 private:
  std::string name_;
  AtomicFile part_;
  std::ofstream stream_;
  std::optional<std::int64_t> first_ns_;
};

}  // namespace gearshift::haptics
