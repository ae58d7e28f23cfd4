// The trace file: everything that is needed to run a recorded drive again, and all of what came out.
//
//   magic 8 bytes | version u32 | header block | data blocks | end block
//   block = frame (kind, size, samples, CRC of the payload, CRC of these four: u32 each) | payload
//
// All numbers little-endian. The payload of a data block is coded (block_codec.h), and its CRC is of what is stored.
// The version stands before the first block: a newer file is recognised whatever its blocks look like.
// Each frame has its own CRC: a damaged length is told from a file cut short.
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

namespace gearshift {

// Not text, and spoilt by a transfer that rewrites line ends.
inline constexpr std::array<char, 8> kTraceMagic = {'\x89', 'G', 'S', 'T', 'R', 'C', '\r', '\n'};
inline constexpr std::uint32_t kTraceVersion = 7;

// What must be known before the first cycle. The run must start with it: no tuning is written to the channels
// before the first cycle (put it into the config), and the recording starts before the first cycle.
struct TraceHeader {
  std::string program;  // that recorded: its name and version
  HapticConfig config;
  DeviceSpec device;
  std::string gate_file;                   // its name, for messages
  std::string gate_text;                   // GateLayout::text: the whole file
  std::string world = NullWorld{}.name();  // LeverWorld::name()
  bool armed = false;                      // HapticLoop::arm() was called before the first cycle
};

// Samples encoded one after another; the last bytes of each are its outputs.
inline constexpr std::size_t kSampleBytes = encoded_size<TraceSample>();
inline constexpr std::size_t kOutputBytes = encoded_size<HapticSnapshot>();
inline constexpr std::size_t kSamplesPerBlock = 256;
using EncodedSample = std::array<std::byte, kSampleBytes>;
EncodedSample encode_sample(const TraceSample& sample) noexcept;
std::span<const std::byte> outputs_of(std::span<const std::byte, kSampleBytes> sample) noexcept;

std::vector<std::byte> encode_header(const TraceHeader& header);
std::optional<TraceHeader> decode_header(std::span<const std::byte> payload);  // nothing when malformed

// Of two times that a file claims: any two, without overflow.
constexpr std::int64_t nanoseconds_between(std::int64_t from, std::int64_t to) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from));
}

struct TraceEnd {
  std::uint64_t cycles = 0;
  std::uint64_t hash = 0;  // see begin_hash
  bool torn = false;       // the recorder could not keep up: cycles are missing after these
};
inline constexpr std::size_t kEndBytes = 17;
std::array<std::byte, kEndBytes> encode_end(const TraceEnd& end) noexcept;
std::optional<TraceEnd> decode_end(std::span<const std::byte> payload) noexcept;

// The hash of a run begins with its parameters and goes on with the outputs of every cycle. So a parameter
// that differs in its last bit is found even where it is only ever compared with something (a threshold) and
// no output happens to depend on that bit.
RunHash begin_hash(const TraceHeader& header);

enum class BlockKind : std::uint32_t {
  header = 0x44414548,  // "HEAD"
  data = 0x41544144,    // "DATA"
  end = 0x20444E45      // "END "
};

struct BlockFrame {
  BlockKind kind = BlockKind::data;
  std::uint32_t size = 0;     // [bytes] of the payload
  std::uint32_t samples = 0;  // that are coded in it: of data alone
  std::uint32_t payload_crc = 0;
};
inline constexpr std::size_t kFrameBytes = 20;
inline constexpr std::size_t kPreambleBytes = kTraceMagic.size() + sizeof kTraceVersion;

std::array<std::byte, kFrameBytes> encode_frame(BlockKind kind, std::span<const std::byte> payload,
                                                std::size_t samples = 0) noexcept;
// Nothing when damaged, of unknown kind, or with more bytes or samples than any block of that kind has.
std::optional<BlockFrame> decode_frame(std::span<const std::byte, kFrameBytes> bytes) noexcept;

}  // namespace gearshift
