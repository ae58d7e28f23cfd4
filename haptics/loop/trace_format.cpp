#include "haptics/loop/trace_format.h"

#include "haptics/loop/block_codec.h"

namespace gearshift::haptics {
namespace {

constexpr std::uint32_t kMaxHeaderBytes = 4u << 20;  // upper bound; a header's gate layout has only a few kilobytes

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
  const std::size_t before = bytes.size();
  bytes.resize(before + encoded_size<T>());
  FieldWriter(bytes.data() + before).put(value);
}

void append_text(std::vector<std::byte>& bytes, const std::string& text) {
  append(bytes, static_cast<std::uint32_t>(text.size()));
  const auto view = std::as_bytes(std::span(text));
  bytes.insert(bytes.end(), view.begin(), view.end());
}

bool is_plausible(const BlockFrame& frame) noexcept {
  if (frame.kind != BlockKind::data && frame.samples != 0) return false;
  switch (frame.kind) {
    case BlockKind::header:
      return frame.size <= kMaxHeaderBytes;
    case BlockKind::data:
      return frame.size <= kMaxCodedBytes && frame.samples > 0 && frame.samples <= kSamplesPerBlock;
    case BlockKind::end:
      return frame.size == kEndBytes;
  }
  return false;
}

}  // namespace

EncodedSample encode_sample(const TraceSample& sample) noexcept {
  EncodedSample bytes;
  FieldWriter(bytes.data()).put(sample);
  return bytes;
}

std::span<const std::byte> outputs_of(std::span<const std::byte, kSampleBytes> sample) noexcept {
  return sample.last<kOutputBytes>();
}

std::vector<std::byte> encode_header(const TraceHeader& header) {
  std::vector<std::byte> bytes;
  append_text(bytes, header.program);
  append(bytes, header.config);
  append(bytes, header.device);
  append_text(bytes, header.gate_file);
  append_text(bytes, header.gate_text);
  append_text(bytes, header.load);
  append(bytes, header.armed);
  return bytes;
}

std::optional<TraceHeader> decode_header(std::span<const std::byte> payload) {
  TraceHeader header;
  FieldReader reader(payload);
  if (!reader.read_text(header.program)) return std::nullopt;
  reader.take(header.config);
  reader.take(header.device);
  if (!reader.read_text(header.gate_file)) return std::nullopt;
  if (!reader.read_text(header.gate_text)) return std::nullopt;
  if (!reader.read_text(header.load)) return std::nullopt;
  reader.take(header.armed);
  if (!reader.ok() || !reader.at_end()) return std::nullopt;
  return header;
}

std::array<std::byte, kEndBytes> encode_end(const TraceEnd& end) noexcept {
  std::array<std::byte, kEndBytes> bytes;
  FieldWriter writer(bytes.data());
  writer.put(end.cycles);
  writer.put(end.hash);
  writer.put(end.torn);
  return bytes;
}

std::optional<TraceEnd> decode_end(std::span<const std::byte> payload) noexcept {
  TraceEnd end;
  FieldReader reader(payload);
  reader.take(end.cycles);
  reader.take(end.hash);
  reader.take(end.torn);
  if (!reader.ok() || !reader.at_end()) return std::nullopt;
  return end;
}

// The program's version and the layout's file name are left out: they do not affect the result.
RunHash begin_hash(const TraceHeader& header) {
  TraceHeader parameters = header;
  parameters.program.clear();
  parameters.gate_file.clear();
  RunHash hash;
  hash.add(encode_header(parameters));
  return hash;
}

std::array<std::byte, kFrameBytes> encode_frame(BlockKind kind, std::span<const std::byte> payload,
                                                std::size_t samples) noexcept {
  std::array<std::byte, kFrameBytes> bytes;
  FieldWriter writer(bytes.data());
  writer.put(static_cast<std::uint32_t>(kind));
  writer.put(static_cast<std::uint32_t>(payload.size()));
  writer.put(static_cast<std::uint32_t>(samples));
  writer.put(crc32(payload));
  const std::uint32_t crc = crc32(std::span(bytes).first<kFrameBytes - sizeof(std::uint32_t)>());
  writer.put(crc);
  return bytes;
}

std::optional<BlockFrame> decode_frame(std::span<const std::byte, kFrameBytes> bytes) noexcept {
  BlockFrame frame;
  std::uint32_t kind = 0, crc = 0;
  FieldReader reader(bytes);
  reader.take(kind);
  reader.take(frame.size);
  reader.take(frame.samples);
  reader.take(frame.payload_crc);
  reader.take(crc);
  frame.kind = static_cast<BlockKind>(kind);
  if (crc != crc32(bytes.first<kFrameBytes - sizeof crc>())) return std::nullopt;
  if (!is_plausible(frame)) return std::nullopt;
  return frame;
}

}  // namespace gearshift::haptics
