// Writes a trace file, under its final name from the start: a killed program then leaves a file that lacks
// its end block, is recognised as torn, and lies where one looks for it, with all its intact cycles.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "haptics/loop/block_codec.h"
#include "haptics/loop/trace_format.h"

namespace gearshift {

class TraceWriter {
 public:
  // Replaces a file of that name. Throws FileError when it cannot be created or its header not be written.
  TraceWriter(const std::filesystem::path& file, const TraceHeader& header);

  // A failure to write is kept in problem(); everything after it is ignored. No allocation in health.
  void add(const TraceSample& sample) noexcept;

  // Writes the end block and closes. Without it the file stays torn. torn: say so in the end block, too.
  void finish(bool torn = false) noexcept;

  const std::string& problem() const noexcept { return problem_; }  // empty, or one sentence
  std::uint64_t cycles() const noexcept { return cycles_; }
  std::uint64_t hash() const noexcept { return hash_.value(); }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  void flush() noexcept;
  void write(std::span<const std::byte> bytes) noexcept;
  void write_block(BlockKind kind, std::span<const std::byte> payload, std::size_t samples = 0) noexcept;
  void fail(int error) noexcept;

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  BlockCodec codec_;
  std::vector<std::byte> block_;  // samples not yet written
  std::vector<std::byte> coded_;
  std::uint64_t cycles_ = 0;
  RunHash hash_;
  std::string problem_;
};

}  // namespace gearshift
