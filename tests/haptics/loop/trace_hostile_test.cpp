// Tests that every kind of invalid trace file is refused in one sentence.
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/loop/block_codec.h"
#include "haptics/loop/trace_csv.h"
#include "haptics/loop/trace_reader.h"
#include "tests/haptics/loop/trace_bench.h"

namespace gearshift::test {
namespace {

constexpr std::size_t kFrame = 20, kPreamble = 12;  // [bytes] sizes as documented, not taken from the code
constexpr std::size_t kSampleBytes = 392;           // [bytes] per cycle
constexpr std::size_t kCycles = 600;                // two full blocks of 256 cycles and a partial block

// The CRC-32, computed bit by bit from its definition.
std::uint32_t slow_crc(const unsigned char* bytes, std::size_t size) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc % 2 != 0 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

std::uint32_t get(const Bytes& file, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, file.data() + at, 4);
  return value;
}
void put(Bytes& file, std::size_t at, std::uint32_t value) {
  std::memcpy(file.data() + at, &value, 4);
}

// Returns the offsets of the frames (header, three data blocks, end block) and of the end of the file.
std::vector<std::size_t> borders(const Bytes& file) {
  std::vector<std::size_t> at{kPreamble};
  while (at.back() < file.size()) at.push_back(at.back() + kFrame + get(file, at.back() + 4));
  return at;
}

void seal_frame(Bytes& file, std::size_t at) {
  put(file, at + 16, slow_crc(&file[at], 16));
}
void seal_payload(Bytes& file, std::size_t at) {
  put(file, at + 12, slow_crc(&file[at + kFrame], get(file, at + 4)));
  seal_frame(file, at);
}

Bytes slice(const Bytes& file, std::size_t from, std::size_t to) {
  return {file.begin() + static_cast<std::ptrdiff_t>(from), file.begin() + static_cast<std::ptrdiff_t>(to)};
}
void append(Bytes& to, const Bytes& more) {
  to.insert(to.end(), more.begin(), more.end());
}

// Replaces the payload of the data block at `at`, sets its number of samples, and corrects the checksums.
void put_payload(Bytes& file, std::size_t at, const Bytes& payload, std::uint32_t samples) {
  const std::size_t end = at + kFrame + get(file, at + 4);
  Bytes with = slice(file, 0, at + kFrame);
  append(with, payload);
  append(with, slice(file, end, file.size()));
  file = with;
  put(file, at + 4, static_cast<std::uint32_t>(payload.size()));
  put(file, at + 8, samples);
  seal_payload(file, at);
}

Bytes payload_of(const Bytes& file, std::size_t at) {
  return slice(file, at + kFrame, at + kFrame + get(file, at + 4));
}

// A zstd frame that declares `size` bytes of content, but repeats a zero byte for more than all samples of a block
// (RFC 8878: magic, descriptor with a size of 4 bytes in a single segment, size, two blocks of one repeated byte).
Bytes with_content_size(std::uint32_t size) {
  Bytes frame{0x28, 0xB5, 0x2F, 0xFD, 0xA0, 0, 0, 0, 0};
  put(frame, 5, size);
  for (const unsigned is_last : {0u, 1u}) {
    const std::uint32_t header = is_last | 1u << 1 | 65'536u << 3;
    for (const int shift : {0, 8, 16}) frame.push_back(static_cast<unsigned char>(header >> shift));
    frame.push_back(0);
  }
  return frame;
}

// Changes the samples of a block and corrects the checksums, as an attacker who knows the code could.
void forge(Bytes& file, std::size_t at, const std::function<void(std::byte* samples)>& change) {
  const Bytes payload = payload_of(file, at);
  haptics::BlockCodec codec;
  std::vector<std::byte> samples, coded;
  REQUIRE(codec.decode(std::as_bytes(std::span(payload)), get(file, at + 8), samples));
  change(samples.data());
  codec.encode(samples, coded);
  Bytes again(coded.size());
  std::memcpy(again.data(), coded.data(), coded.size());
  put_payload(file, at, again, get(file, at + 8));
}

// Returns the error message of reading the whole file; empty if there is none.
std::string refusal(const std::filesystem::path& file) {
  try {
    read_trace(file);
  } catch (const haptics::FileError& error) {
    return error.what();
  }
  return {};
}

struct Hostile {
  const char* what;
  std::function<void(Bytes& file, const std::vector<std::size_t>& at)> change;
  const char* sentence;  // expected part of the message
};

using B = Bytes;
using At = const std::vector<std::size_t>;

const std::vector<Hostile> hostile_traces = {
    {"empty", [](B& f, At&) { f.clear(); }, "is empty"},
    {"a text file", [](B& f, At&) { f = {'n', 'a', 'm', 'e', ' ', '=', ' ', '"', 'x', '"', '\n', '\n', '\n'}; },
     "is not a gearshift trace"},
    {"another magic", [](B& f, At&) { f[1] ^= 1; }, "is not a gearshift trace"},
    {"line ends rewritten", [](B& f, At&) { f.erase(f.begin() + 6); }, "is not a gearshift trace"},
    {"cut inside the magic", [](B& f, At&) { f.resize(5); }, "is not a gearshift trace"},
    {"a newer format", [](B& f, At&) { put(f, 8, 9); },
     "recorded by a newer gearshift (format 9), but this version reads only format 8"},
    {"a far newer format", [](B& f, At&) { put(f, 8, 0xFFFFFFFF); }, "recorded by a newer gearshift"},
    {"an older format", [](B& f, At&) { put(f, 8, 7); },
     "recorded by an older gearshift (format 7), but this version reads only format 8; replay the trace with that "
     "version"},
    {"cut after the version", [](B& f, At& at) { f.resize(at[0]); }, "is incomplete; it ends inside its header"},
    {"cut inside the header's frame", [](B& f, At& at) { f.resize(at[0] + 7); },
     "is incomplete; it ends inside its header"},
    {"cut inside the header", [](B& f, At& at) { f.resize(at[1] - 1); }, "is incomplete; it ends inside its header"},
    {"cut after the header", [](B& f, At& at) { f.resize(at[1]); },
     "is incomplete, because it has no end block; 0 intact cycles"},
    {"cut after a block", [](B& f, At& at) { f.resize(at[2]); },
     "is incomplete, because it has no end block; 256 intact cycles"},
    {"cut inside a block", [](B& f, At& at) { f.resize(at[3] - 1); },
     "is incomplete, because it has no end block; 256 intact"},
    {"cut before the end block", [](B& f, At& at) { f.resize(at[4]); }, "it has no end block; 600 intact cycles"},
    {"cut inside the end block", [](B& f, At& at) { f.resize(at[5] - 1); }, "it has no end block; 600 intact cycles"},
    {"header byte flipped", [](B& f, At& at) { f[at[0] + kFrame + 20] ^= 4; }, "the checksum of its header"},
    {"header frame flipped", [](B& f, At& at) { f[at[0] + 4] ^= 1; }, "is damaged; its header cannot be found"},
    {"data byte flipped", [](B& f, At& at) { f[at[2] + kFrame + 999] ^= 128; },
     "is damaged; the checksum of the block"},
    {"data frame flipped", [](B& f, At& at) { f[at[2] + 5] ^= 1; }, "is damaged; a block is missing at byte"},
    {"end byte flipped", [](B& f, At& at) { f[at[4] + kFrame] ^= 1; }, "is damaged; its end block is not valid"},
    {"end frame flipped", [](B& f, At& at) { f[at[4] + 13] ^= 1; }, "is damaged; a block is missing at byte"},
    {"a block that claims 4 GB", [](B& f, At& at) { put(f, at[1] + 4, 0xFFFFFFF0), seal_frame(f, at[1]); },
     "is damaged; a block is missing at byte"},
    {"a header that claims 4 GB", [](B& f, At& at) { put(f, at[0] + 4, 0xFFFFFFFF), seal_frame(f, at[0]); },
     "is damaged; its header cannot be found"},
    {"a text that claims 4 GB", [](B& f, At& at) { put(f, at[0] + kFrame, 0xFFFFFFFF), seal_payload(f, at[0]); },
     "is damaged; its header is not valid"},
    {"a block of no known kind", [](B& f, At& at) { put(f, at[2], 0x21212121), seal_frame(f, at[2]); },
     "is damaged; a block is missing at byte"},
    {"a block without samples", [](B& f, At& at) { put(f, at[3] + 8, 0), seal_frame(f, at[3]); },
     "is damaged; a block is missing at byte"},
    {"a block of more samples than any has", [](B& f, At& at) { put(f, at[1] + 8, 257), seal_frame(f, at[1]); },
     "is damaged; a block is missing at byte"},
    {"a block that claims four thousand million samples",
     [](B& f, At& at) { put(f, at[1] + 8, 0xFFFFFFFF), seal_frame(f, at[1]); },
     "is damaged; a block is missing at byte"},
    {"an end with samples", [](B& f, At& at) { put(f, at[4] + 8, 1), seal_frame(f, at[4]); },
     "is damaged; a block is missing at byte"},
    {"a block larger than any can be",
     [](B& f, At& at) { put(f, at[1] + 4, 257 * kSampleBytes + 65), seal_frame(f, at[1]); },
     "is damaged; a block is missing at byte"},
    {"a block of fewer samples than it claims, and a matching end block",
     [](B& f, At& at) {
       put(f, at[3] + 8, 89), seal_frame(f, at[3]);
       f[at[4] + kFrame] ^= 600 ^ 601, seal_payload(f, at[4]);
     },
     "does not contain the 89 cycles that it declares"},
    {"a block of more samples than it claims",
     [](B& f, At& at) {
       put(f, at[1] + 8, 255), seal_frame(f, at[1]);
       put(f, at[3] + 8, 89), seal_frame(f, at[3]);
     },
     "does not contain the 255 cycles that it declares"},
    {"a coded block that ends early",
     [](B& f, At& at) {
       Bytes less = payload_of(f, at[2]);
       less.pop_back();
       put_payload(f, at[2], less, 256);
     },
     "does not contain the 256 cycles that it declares"},
    {"a coded block with bytes behind its end",
     [](B& f, At& at) {
       Bytes more = payload_of(f, at[2]);
       more.push_back(0);
       put_payload(f, at[2], more, 256);
     },
     "does not contain the 256 cycles that it declares"},
    {"a coded block that declares 4 GB",
     [](B& f, At& at) { put_payload(f, at[1], with_content_size(0xFFFFFFFF), 256); },
     "does not contain the 256 cycles that it declares"},
    {"a coded block that declares one byte more than the samples",
     [](B& f, At& at) { put_payload(f, at[1], with_content_size(256 * kSampleBytes + 1), 256); },
     "does not contain the 256 cycles that it declares"},
    {"a coded block that declares the right size, but expands beyond all samples",
     [](B& f, At& at) { put_payload(f, at[1], with_content_size(256 * kSampleBytes), 256); },
     "does not contain the 256 cycles that it declares"},
    {"a coded block of two frames",
     [](B& f, At& at) {
       Bytes twice = payload_of(f, at[3]);
       append(twice, Bytes(twice));
       put_payload(f, at[3], twice, 88);
     },
     "does not contain the 88 cycles that it declares"},
    {"a coded block with no frame", [](B& f, At& at) { put_payload(f, at[1], Bytes(100'000, 0), 256); },
     "does not contain the 256 cycles that it declares"},
    {"a coded block whose frame has another magic",
     [](B& f, At& at) {
       Bytes other = payload_of(f, at[1]);
       other[0] ^= 1;
       put_payload(f, at[1], other, 256);
     },
     "does not contain the 256 cycles that it declares"},
    {"a coded block that is empty", [](B& f, At& at) { put_payload(f, at[1], {}, 256); },
     "does not contain the 256 cycles that it declares"},
    {"a second header",
     [](B& f, At& at) {
       Bytes twice = slice(f, 0, at[1]);
       append(twice, slice(f, at[0], f.size()));
       f = twice;
     },
     "is damaged; a block is missing at byte"},
    {"no header",
     [](B& f, At& at) {
       Bytes none = slice(f, 0, at[0]);
       append(none, slice(f, at[1], f.size()));
       f = none;
     },
     "is damaged; its header cannot be found"},
    {"a block left out",
     [](B& f, At& at) {
       Bytes less = slice(f, 0, at[2]);
       append(less, slice(f, at[3], f.size()));
       f = less;
     },
     "is damaged; it contains 344 cycles, but its end block says 600"},
    {"two blocks exchanged",
     [](B& f, At& at) {
       Bytes turned = slice(f, 0, at[1]);
       append(turned, slice(f, at[2], at[3]));
       append(turned, slice(f, at[1], at[2]));
       append(turned, slice(f, at[3], f.size()));
       f = turned;
     },
     "is damaged; cycle 0 follows cycle 511"},
    {"bytes after the end", [](B& f, At&) { f.push_back(0); }, "is damaged; the file continues after the end block"},
    {"two traces in one file", [](B& f, At&) { append(f, Bytes(f)); }, "the file continues after the end block"},
    {"a command that does not exist",
     [](B& f, At& at) { forge(f, at[1], [](std::byte* samples) { samples[185] = std::byte{77}; }); },
     "is damaged; cycle 0 contains an invalid value"},
    {"fewer deadlines skipped than none",
     [](B& f, At& at) {
       const std::int64_t skipped = -3;
       forge(f, at[1], [&](std::byte* samples) { std::memcpy(samples + kSampleBytes + 8, &skipped, sizeof skipped); });
     },
     "is damaged; cycle 1 skipped -3 deadlines"},
    {"an output forged, its block sealed again",
     [](B& f, At& at) { forge(f, at[1], [](std::byte* samples) { samples[221] ^= std::byte{1}; }); },
     "is damaged; its parameters and outputs do not match"},
    {"the hash forged", [](B& f, At& at) { f[at[4] + kFrame + 9] ^= 1, seal_payload(f, at[4]); },
     "is damaged; its parameters and outputs do not match"},
    {"marked torn by the recorder", [](B& f, At& at) { f[at[4] + kFrame + 16] = 1, seal_payload(f, at[4]); },
     "is incomplete, because the recorder could not keep up; 600 intact cycles can be exported with --torn --csv FILE"},
};

}  // namespace

TEST_CASE("hostile traces: each is refused in one sentence that says what is wrong") {
  const TempFolder folder;
  const Bytes good = file_bytes(put_trace(folder / "good.trace", kCycles));
  REQUIRE(borders(good).size() == 6);
  REQUIRE(refusal(folder / "good.trace").empty());

  for (const Hostile& hostile : hostile_traces) {
    CAPTURE(hostile.what);
    Bytes bytes = good;
    hostile.change(bytes, borders(good));
    put_file(folder / "bad.trace", bytes);
    const std::string message = refusal(folder / "bad.trace");
    CAPTURE(message);
    CHECK(message.find((folder / "bad.trace").string() + ": ") == 0);
    CHECK(message.find(hostile.sentence) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("hostile traces: a path that is not a regular file is refused without reading it") {
  const TempFolder folder;
  CHECK(refusal(folder.path()).find("this is a folder, not a trace") != std::string::npos);
  CHECK(refusal(folder / "none.trace").find("there is no such file") != std::string::npos);
  CHECK(refusal("/dev/zero").find("is not a regular file") != std::string::npos);
}

TEST_CASE("hostile traces: a trace without cycles is refused") {
  const TempFolder folder;
  CHECK(refusal(put_trace(folder / "t.trace", 0)).find("contains no cycles") != std::string::npos);
}

TEST_CASE("hostile traces: flipping any one byte anywhere is noticed") {
  const TempFolder folder;
  Bytes bytes = file_bytes(put_trace(folder / "t.trace", 3));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    CAPTURE(at);
    bytes[at] ^= 0x10;
    put_file(folder / "t.trace", bytes);
    CHECK_THROWS_AS(read_trace(folder / "t.trace"), haptics::FileError);
    bytes[at] ^= 0x10;
  }
}

TEST_CASE("hostile traces: truncating the file anywhere is noticed, and only complete cycles are returned") {
  const TempFolder folder;
  const Bytes bytes = file_bytes(put_trace(folder / "t.trace", 3));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    put_file(folder / "t.trace", slice(bytes, 0, size));
    CHECK_THROWS_AS(read_trace(folder / "t.trace"), haptics::FileError);
  }
}

TEST_CASE("a torn trace returns its intact cycles on request, and is reported as torn") {
  const TempFolder folder;
  const Bytes good = file_bytes(put_trace(folder / "t.trace", kCycles));
  const auto at = borders(good);
  const auto salvaged = [&](const Bytes& bytes) {
    put_file(folder / "t.trace", bytes);
    haptics::TraceReader reader(folder / "t.trace", haptics::TornTrace::salvage);
    std::size_t cycles = 0;
    for (haptics::TraceSample sample; reader.next(sample); ++cycles) REQUIRE(sample.out.cycle == cycles);
    CHECK(reader.torn());
    return cycles;
  };
  CHECK(salvaged(slice(good, 0, at[1])) == 0);
  CHECK(salvaged(slice(good, 0, at[2])) == 256);
  CHECK(salvaged(slice(good, 0, at[4] - 1)) == 512);
  CHECK(salvaged(slice(good, 0, at[5] - 1)) == 600);
  Bytes damaged = good;
  damaged[at[2] + kFrame + 5] ^= 1;
  CHECK(salvaged(damaged) == 256);
  damaged = good;
  damaged[at[3] + 1] ^= 1;
  CHECK(salvaged(damaged) == 512);
}

TEST_CASE("salvaging stops before an invalid coded block") {
  const TempFolder folder;
  Bytes lying = file_bytes(put_trace(folder / "t.trace", kCycles));
  put_payload(lying, borders(lying)[2], with_content_size(256 * kSampleBytes), 256);
  put_file(folder / "t.trace", lying);
  haptics::TraceReader reader(folder / "t.trace", haptics::TornTrace::salvage);
  std::size_t cycles = 0;
  for (haptics::TraceSample sample; reader.next(sample);) ++cycles;
  CHECK(cycles == 256);
  CHECK(reader.torn());
}

TEST_CASE("a complete trace is not called torn in salvage mode") {
  const TempFolder folder;
  haptics::TraceReader reader(put_trace(folder / "t.trace", kCycles), haptics::TornTrace::salvage);
  for (haptics::TraceSample sample; reader.next(sample);) continue;
  CHECK_FALSE(reader.torn());
}

}  // namespace gearshift::test
