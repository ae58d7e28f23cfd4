// What a campaign has done so far, one line a case, in a file that may be cut short at any moment.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "tests/bench/campaign/campaign_run.h"

namespace gearshift {

inline constexpr int kMostThreads = 256;  // that drive a campaign

class CaseFile {
 public:
  // Reads what is there, drops a line that was not finished, and goes on behind it. of: the campaign, in one line: its
  // seed, its gates, the program. Throws std::runtime_error in one sentence where the file is of another campaign, is not
  // one (line, column, value, range; a case is never further ahead of the lines than threads can be), is being written by another program, or cannot be read or written: then nothing of
  // it is touched.
  CaseFile(const std::filesystem::path& file, const std::string& of);

  const std::map<std::uint64_t, CaseOutcome>& cases() const noexcept { return cases_; }
  void add(const CaseOutcome& outcome);  // Throws std::runtime_error

 private:
  std::size_t read_cases(std::string_view text, std::size_t begin);

  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  std::string name_, why_;  // it is not written any more
  std::map<std::uint64_t, CaseOutcome> cases_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace gearshift
