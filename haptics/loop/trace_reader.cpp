#include "haptics/loop/trace_reader.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "haptics/files/file_error.h"

namespace gearshift::haptics {
namespace {

std::string at_byte(std::uint64_t at) {
  return "at byte " + std::to_string(at);
}

}  // namespace

TraceReader::TraceReader(const std::filesystem::path& file, TornTrace torn) : name_(file.string()), policy_(torn) {
  open(file);
  begin();
}

TraceReader::TraceReader(std::string bytes, const std::string& name, TornTrace torn)
    : name_(name), size_(bytes.size()), policy_(torn) {
  stream_ = std::make_unique<std::istringstream>(std::move(bytes), std::ios::binary);
  begin();
}

void TraceReader::begin() {
  check_preamble();
  read_header();
  check_scanned();
}

void TraceReader::fail(const std::string& reason) const {
  throw FileError(name_, 0, reason);
}

// Throws FileError. When salvaging, marks the trace as torn and returns false instead.
bool TraceReader::stop_or_fail(const std::string& reason) {
  if (policy_ == TornTrace::refuse) fail(reason);
  torn_ = true;
  return false;
}

void TraceReader::open(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::none) fail("cannot be read (" + error.message() + ")");
  if (!std::filesystem::exists(status)) fail("there is no such file");
  if (std::filesystem::is_directory(status)) fail("this is a folder, not a trace");
  if (!std::filesystem::is_regular_file(status)) fail("this is not a regular file");
  errno = 0;
  stream_ = std::make_unique<std::ifstream>(file, std::ios::binary);
  if (!*stream_) fail(std::string("cannot be read (") + std::strerror(errno) + ")");
  size_ = std::filesystem::file_size(file, error);
  if (error) fail("cannot be read (" + error.message() + ")");
}

void TraceReader::read(std::uint64_t at, std::span<std::byte> to) {
  stream_->seekg(static_cast<std::streamoff>(at));
  stream_->read(reinterpret_cast<char*>(to.data()), static_cast<std::streamsize>(to.size()));
  if (!*stream_) fail("the file cannot be read " + at_byte(at));
}

void TraceReader::check_preamble() {
  if (size_ == 0) fail("the file is empty");
  if (size_ < kPreambleBytes) fail("this is not a gearshift trace");
  std::array<std::byte, kPreambleBytes> bytes;
  read(0, bytes);
  if (std::memcmp(bytes.data(), kTraceMagic.data(), kTraceMagic.size()) != 0) fail("this is not a gearshift trace");
  std::uint32_t version = 0;
  FieldReader(std::span(bytes).subspan(kTraceMagic.size())).take(version);
  const auto refuse = [&](const std::string& age) {
    fail("the trace was recorded by " + age + " gearshift (format " + std::to_string(version) +
         "), but this version reads only format " + std::to_string(kTraceVersion) +
         "; replay the trace with that version");
  };
  if (version > kTraceVersion) refuse("a newer");
  if (version < kTraceVersion) refuse("an older");
}

// The header must be intact even when salvaging: without it the cycles cannot be interpreted.
void TraceReader::read_header() {
  if (size_ < kPreambleBytes + kFrameBytes) fail("the trace is incomplete; it ends inside its header");
  std::array<std::byte, kFrameBytes> bytes;
  read(kPreambleBytes, bytes);
  const std::optional<BlockFrame> frame = decode_frame(bytes);
  if (!frame || frame->kind != BlockKind::header) fail("the trace is damaged; its header cannot be found");
  const Block block{kPreambleBytes + kFrameBytes, *frame};
  if (block.at + frame->size > size_) fail("the trace is incomplete; it ends inside its header");

  const std::vector<std::byte> payload = read_payload(block);
  if (crc32(payload) != frame->payload_crc) fail("the trace is damaged; the checksum of its header does not match");
  std::optional<TraceHeader> header = decode_header(payload);
  if (!header) fail("the trace is damaged; its header is not valid");
  header_ = std::move(*header);
  hash_ = begin_hash(header_);
  scan_blocks(block.at + frame->size);
}

void TraceReader::scan_blocks(std::uint64_t at) {
  torn_ = true;  // stays true until the end block is found
  while (size_ - at >= kFrameBytes)
    if (!scan_block(at)) return;
}

// Moves `at` past the block. Returns false if no further block can be found.
bool TraceReader::scan_block(std::uint64_t& at) {
  std::array<std::byte, kFrameBytes> bytes;
  read(at, bytes);
  const std::optional<BlockFrame> frame = decode_frame(bytes);
  if (!frame || frame->kind == BlockKind::header)
    return stop_or_fail("the trace is damaged; a block is missing " + at_byte(at));
  const Block block{at + kFrameBytes, *frame};
  if (frame->size > size_ - block.at) return false;  // cut short
  at = block.at + frame->size;
  if (frame->kind == BlockKind::data) {
    blocks_.push_back(block);
    cycles_ += frame->samples;
    return true;
  }
  const std::vector<std::byte> payload = read_payload(block);
  const std::optional<TraceEnd> end = decode_end(payload);
  if (crc32(payload) != frame->payload_crc || !end)
    return stop_or_fail("the trace is damaged; its end block is not valid");
  end_ = *end;
  torn_ = end_.torn;
  if (at != size_) return stop_or_fail("the trace is damaged; the file continues after the end block");
  return false;
}

void TraceReader::check_scanned() {
  if (policy_ == TornTrace::salvage) return;
  const std::string intact = std::to_string(cycles_) + " intact cycles can be exported with --torn --csv FILE";
  if (end_.torn) fail("the trace is incomplete, because the recorder could not keep up; " + intact);
  if (torn_) fail("the trace is incomplete, because it has no end block; " + intact);
  if (cycles_ != end_.cycles)
    fail("the trace is damaged; it contains " + std::to_string(cycles_) + " cycles, but its end block says " +
         std::to_string(end_.cycles));
  if (cycles_ == 0) fail("the trace contains no cycles");
}

std::vector<std::byte> TraceReader::read_payload(const Block& block) {
  std::vector<std::byte> payload(block.frame.size);  // safe, because decode_frame() limits the size
  read(block.at, payload);
  return payload;
}

bool TraceReader::load_block() {
  if (next_block_ == blocks_.size()) return false;
  const Block& block = blocks_[next_block_++];
  payload_.resize(block.frame.size);
  used_ = 0;
  read(block.at, payload_);
  const bool intact = crc32(payload_) == block.frame.payload_crc;
  if (intact && codec_.decode(payload_, block.frame.samples, samples_)) return true;
  samples_.clear();
  next_block_ = blocks_.size();
  const std::string where = "the block " + at_byte(block.at);
  if (!intact) return stop_or_fail("the trace is damaged; the checksum of " + where + " does not match");
  return stop_or_fail("the trace is damaged; " + where + " does not contain the " +
                      std::to_string(block.frame.samples) + " cycles that it declares");
}

bool TraceReader::next(TraceSample& sample) {
  if (used_ == samples_.size() && !load_block()) {
    check_end();
    return false;
  }
  const auto bytes = std::span(samples_).subspan(used_).first<kSampleBytes>();
  used_ += kSampleBytes;
  FieldReader reader(bytes);
  reader.take(sample);
  if (!reader.ok()) fail("the trace is damaged; cycle " + std::to_string(cycles_read_) + " contains an invalid value");
  check_cycle(sample);
  last_cycle_ = sample.out.cycle;
  ++cycles_read_;
  hash_.add(outputs_of(bytes));
  return true;
}

void TraceReader::check_cycle(const TraceSample& sample) const {
  const auto damaged = [&](const std::string& how) {
    fail("the trace is damaged; cycle " + std::to_string(sample.out.cycle) + how);
  };
  if (cycles_read_ > 0 && sample.out.cycle != last_cycle_ + 1) damaged(" follows cycle " + std::to_string(last_cycle_));
  if (sample.skipped < 0) damaged(" skipped " + std::to_string(sample.skipped) + " deadlines");
}

void TraceReader::check_end() const {
  if (torn_ || hash() == end_.hash) return;
  fail("the trace is damaged; its parameters and outputs do not match its end block");
}

}  // namespace gearshift::haptics
