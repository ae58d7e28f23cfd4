// Saves the finished cases of a campaign, one per line, in a file that may be truncated at any moment.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "app/lab/campaign/campaign_run.h"

namespace gearshift::lab {

inline constexpr int kMaxThreads = 256;  // maximum number of threads of a campaign

class CaseFile {
 public:
  // Reads the existing lines, drops an incomplete last line and appends after it. of: identifies the campaign in one
  // line (seed, gates, program). Throws std::runtime_error with one sentence if the file belongs to a different
  // campaign, is invalid (names line, column, value and range; a case number cannot exceed the number of lines by more
  // than the threads), is being written by another program, or cannot be read or written; the file is then unchanged.
  CaseFile(const std::filesystem::path& file, const std::string& of);

  const std::map<std::uint64_t, CaseOutcome>& cases() const noexcept { return cases_; }
  void add(const CaseOutcome& outcome);  // Throws std::runtime_error

 private:
  std::size_t read_cases(std::string_view text, std::size_t begin);

  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  std::string name_, why_;  // why_: reason of the first failed write, after which no more lines are written
  std::map<std::uint64_t, CaseOutcome> cases_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace gearshift::lab
