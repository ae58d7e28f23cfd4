#include "haptics/loop/trace_writer.h"

#include <cerrno>
#include <cstring>

#include "haptics/files/file_error.h"

namespace gearshift::haptics {

TraceWriter::TraceWriter(const std::filesystem::path& file, const TraceHeader& header)
    : name_(file.string()), file_(std::fopen(name_.c_str(), "wb")), hash_(begin_hash(header)) {
  if (!file_) throw FileError(name_, 0, std::string("cannot be written (") + std::strerror(errno) + ")");
  // Without buffering, a write error is reported at the block that failed. The blocks are large enough to be written
  // directly.
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  block_.resize(kSamplesPerBlock * kSampleBytes);
  codec_.encode(block_, coded_);  // reserves the memory for later blocks
  block_.clear();

  write(std::as_bytes(std::span(kTraceMagic)));
  write(std::as_bytes(std::span(&kTraceVersion, 1)));
  write_block(BlockKind::header, encode_header(header));
  if (!problem_.empty()) throw FileError(name_, 0, problem_);
}

void TraceWriter::add(const TraceSample& sample) noexcept {
  if (!file_ || !problem_.empty()) return;
  const EncodedSample bytes = encode_sample(sample);
  hash_.add(outputs_of(bytes));
  block_.insert(block_.end(), bytes.begin(), bytes.end());  // does not allocate, because the capacity was reserved
  ++cycles_;
  if (block_.size() == kSamplesPerBlock * kSampleBytes) flush();
}

void TraceWriter::finish(bool torn) noexcept {
  if (!file_) return;
  flush();
  write_block(BlockKind::end, encode_end({cycles_, hash_.value(), torn}));
  errno = 0;
  if (std::fclose(file_.release()) != 0) fail(errno);
}

void TraceWriter::flush() noexcept {
  if (block_.empty()) return;
  codec_.encode(block_, coded_);
  write_block(BlockKind::data, coded_, block_.size() / kSampleBytes);
  block_.clear();
}

void TraceWriter::write_block(BlockKind kind, std::span<const std::byte> payload, std::size_t samples) noexcept {
  write(encode_frame(kind, payload, samples));
  write(payload);
}

void TraceWriter::write(std::span<const std::byte> bytes) noexcept {
  if (!problem_.empty()) return;
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail(errno);
}

void TraceWriter::fail(int error) noexcept {
  if (!problem_.empty()) return;
  problem_ = "the recording failed after " + std::to_string(cycles_) + " cycles (" + std::strerror(error) + ")";
}

}  // namespace gearshift::haptics
