// Format of the trace file: all inputs needed to replay a drive, and all outputs.
//
//   magic 8 bytes | version u32 | header block | data blocks | end block
//   block = frame (kind, size, samples, CRC of the payload, CRC of the previous four numbers; u32 each) | payload
//
// All numbers are little-endian. The payload of a data block is coded (block_codec.h); its CRC covers the coded bytes.
// The version precedes the first block, so that a newer file is recognised whatever its blocks look like.
// Each frame has its own CRC, so that a damaged length is not mistaken for a truncated file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "haptics/loop/checksum.h"
#include "haptics/loop/field_codec.h"

namespace gearshift::haptics {

// The magic contains a line end, so that a file transfer that converts line ends damages the magic and is detected.
inline constexpr std::array<char, 8> kTraceMagic = {'\x89', 'G', 'S', 'T', 'R', 'C', '\r', '\n'};
inline constexpr std::uint32_t kTraceVersion = 8;

// Everything that a replay needs before the first cycle. For a replayable trace, start recording before the first
// cycle, and put the initial tuning into the config instead of calling HapticLoop::change_tuning().
struct TraceHeader {
  std::string program;  // name and version of the recording program
  HapticConfig config;
  DeviceSpec device;
  std::string gate_file;                            // file name, for messages
  std::string gate_text;                            // GateLayout::text: the whole file
  std::string load = NoLoad{}.replay_parameters();  // LeverLoad::replay_parameters()
  bool armed = false;                               // HapticLoop::arm() was called before the first cycle
};

// Size of an encoded sample [bytes]; the last kOutputBytes of a sample are its outputs.
inline constexpr std::size_t kSampleBytes = encoded_size<TraceSample>();
inline constexpr std::size_t kOutputBytes = encoded_size<HapticSnapshot>();
inline constexpr std::uint64_t kFieldsHash = fields_hash<TraceSample, HapticConfig, DeviceSpec>();
static_assert(kFieldsHash == 6596994105473238030u,
              "the fields of a trace have changed: raise kTraceVersion, then put the hash that g++ shows here");
inline constexpr std::size_t kSamplesPerBlock = 256;
using EncodedSample = std::array<std::byte, kSampleBytes>;
EncodedSample encode_sample(const TraceSample& sample) noexcept;
std::span<const std::byte> outputs_of(std::span<const std::byte, kSampleBytes> sample) noexcept;

std::vector<std::byte> encode_header(const TraceHeader& header);
std::optional<TraceHeader> decode_header(std::span<const std::byte> payload);  // empty if malformed

// Difference of two times from a file. The times may have any value, so the difference wraps instead of overflowing.
constexpr std::int64_t nanoseconds_between(std::int64_t from, std::int64_t to) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from));
}

struct TraceEnd {
  std::uint64_t cycles = 0;
  std::uint64_t hash = 0;  // see begin_hash
  bool torn = false;       // the recorder could not keep up; later cycles are missing
};
inline constexpr std::size_t kEndBytes = 17;
std::array<std::byte, kEndBytes> encode_end(const TraceEnd& end) noexcept;
std::optional<TraceEnd> decode_end(std::span<const std::byte> payload) noexcept;

// The hash of a run covers its parameters and the outputs of every cycle. The parameters are included so that a
// difference in a parameter's last bit is detected even if no output depends on that bit.
RunHash begin_hash(const TraceHeader& header);

enum class BlockKind : std::uint32_t {
  header = 0x44414548,  // "HEAD"
  data = 0x41544144,    // "DATA"
  end = 0x20444E45      // "END "
};

struct BlockFrame {
  BlockKind kind = BlockKind::data;
  std::uint32_t size = 0;     // [bytes] size of the payload
  std::uint32_t samples = 0;  // number of samples; only in data blocks
  std::uint32_t payload_crc = 0;
};
inline constexpr std::size_t kFrameBytes = 20;
inline constexpr std::size_t kPreambleBytes = kTraceMagic.size() + sizeof kTraceVersion;

std::array<std::byte, kFrameBytes> encode_frame(BlockKind kind, std::span<const std::byte> payload,
                                                std::size_t samples = 0) noexcept;
// Returns an empty value if the frame is damaged, of unknown kind, or has more bytes or samples than a block of that
// kind can have.
std::optional<BlockFrame> decode_frame(std::span<const std::byte, kFrameBytes> bytes) noexcept;

}  // namespace gearshift::haptics
