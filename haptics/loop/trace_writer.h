// Writes a trace file, under its final name from the start. If the program is killed, the file has no end block, is
// recognised as torn, and still has all its intact cycles.
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

namespace gearshift::haptics {

class TraceWriter {
 public:
  // Replaces an existing file. Throws FileError if it cannot be created or its header cannot be written.
  TraceWriter(const std::filesystem::path& file, const TraceHeader& header);

  // Adds one cycle; normally allocates nothing. After a write error, problem() says what failed, and all later cycles
  // are ignored.
  void add(const TraceSample& sample) noexcept;

  // Writes the end block and closes the file. A file without an end block counts as torn. torn: cycles were lost, so
  // the file is marked as torn although it has an end block.
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

}  // namespace gearshift::haptics
