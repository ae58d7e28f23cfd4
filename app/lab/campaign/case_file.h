// A file with the finished cases of a campaign, one per line. The file may be truncated at any time.
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
  // Reads the existing lines, drops an incomplete last line, and opens the file for appending. `of`: one line that
  // identifies the campaign (seed, gates, program). Throws std::runtime_error with one sentence, and leaves the file
  // unchanged, if the file belongs to a different campaign, is invalid, is being written by another program, or cannot
  // be read or written. For an invalid file, the sentence names line, column, value and range. `shards`: number of shards
  // that share the cases. A case number is invalid if it exceeds the number of preceding lines, times `shards`, by
  // kMaxThreads * shards or more.
  CaseFile(const std::filesystem::path& file, const std::string& of, int shards = 1);

  const std::map<std::uint64_t, CaseOutcome>& cases() const noexcept { return cases_; }
  void add(const CaseOutcome& outcome);  // Throws std::runtime_error

 private:
  std::size_t read_cases(std::string_view text, std::size_t begin, int shards);

  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  std::string name_, why_;  // why_: reason of the first failed write; no lines are written after it
  std::map<std::uint64_t, CaseOutcome> cases_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace gearshift::lab
