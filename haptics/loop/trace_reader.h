// Reads a trace file block by block and validates everything in it. Memory holds one block, and a 24-byte entry for
// every block (0.1 byte per cycle).
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "haptics/loop/block_codec.h"
#include "haptics/loop/trace_format.h"

namespace gearshift::haptics {

enum class TornTrace {
  refuse,  // reject an incomplete file
  salvage  // read the intact cycles of an incomplete file, up to the first damaged or missing block
};

class TraceReader {
 public:
  // Throws FileError with one sentence if the file is missing, a directory, empty, not a trace, of another format,
  // damaged or torn. The constructor checks the frames of all blocks; next() checks the payloads.
  explicit TraceReader(const std::filesystem::path& file, TornTrace torn = TornTrace::refuse);
  // Reads a trace from memory; name: of the file, for errors.
  TraceReader(std::string bytes, const std::string& name, TornTrace torn = TornTrace::refuse);

  const TraceHeader& header() const noexcept { return header_; }
  std::uint64_t cycles() const noexcept { return cycles_; }  // number of cycles in all complete data blocks
  bool torn() const noexcept { return torn_; }               // the file is incomplete; true only when salvaging

  // Reads the next cycle; returns false after the last cycle. Throws FileError if a block is damaged, a cycle holds an
  // invalid value or does not follow the previous one, or the hash differs from the one in the end block.
  bool next(TraceSample& sample);

  // Hash of the parameters and the outputs read so far.
  std::uint64_t hash() const noexcept { return hash_.value(); }

 private:
  struct Block {
    std::uint64_t at = 0;  // [bytes] file offset of the payload
    BlockFrame frame;
  };

  [[noreturn]] void fail(const std::string& reason) const;
  void begin();
  void open(const std::filesystem::path& file);
  void check_preamble();
  void read_header();
  void scan_blocks(std::uint64_t at);
  bool scan_block(std::uint64_t& at);
  void check_scanned();
  bool load_block();
  bool stop_or_fail(const std::string& reason);
  void check_cycle(const TraceSample& sample) const;
  void check_end() const;
  void read(std::uint64_t at, std::span<std::byte> to);
  std::vector<std::byte> read_payload(const Block& block);

  std::string name_;
  std::unique_ptr<std::istream> stream_;
  std::uint64_t size_ = 0;  // [bytes] size of the file
  TornTrace policy_;
  TraceHeader header_;
  std::vector<Block> blocks_;  // data blocks
  TraceEnd end_;
  bool torn_ = false;
  std::uint64_t cycles_ = 0;

  std::size_t next_block_ = 0;
  std::vector<std::byte> payload_;
  BlockCodec codec_;
  std::vector<std::byte> samples_;
  std::size_t used_ = 0;  // [bytes] of samples_
  std::uint64_t cycles_read_ = 0;
  std::uint64_t last_cycle_ = 0;
  RunHash hash_;
};

}  // namespace gearshift::haptics
