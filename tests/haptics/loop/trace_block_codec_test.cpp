// Tests of the block codec: any block is restored bit for bit, real drives are compressed, and decoding validates every
// byte.
#include <zstd.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/loop/block_codec.h"
#include "tests/haptics/loop/recorded_drive.h"
#include "tests/haptics/loop/trace_bench.h"

namespace gearshift::test {
namespace {

using Block = std::vector<std::byte>;

constexpr std::size_t kSample = 392;  // [bytes] per cycle

Block encoded(const std::vector<haptics::TraceSample>& samples) {
  Block bytes;
  for (const haptics::TraceSample& sample : samples) {
    const haptics::EncodedSample one = haptics::encode_sample(sample);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  return bytes;
}

Block coded(const Block& samples) {
  haptics::BlockCodec codec;
  Block out;
  codec.encode(samples, out);
  return out;
}

Block any_bytes(std::size_t size, std::mt19937_64& random) {
  Block bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

Block text(std::initializer_list<int> bytes) {
  Block out;
  for (const int byte : bytes) out.push_back(static_cast<std::byte>(byte));
  return out;
}

Block decompressed(const Block& frame) {
  Block content(256 * kSample);
  const std::size_t size = ZSTD_decompress(content.data(), content.size(), frame.data(), frame.size());
  REQUIRE_FALSE(ZSTD_isError(size));
  content.resize(size);
  return content;
}

void check_comes_back(const Block& samples) {
  haptics::BlockCodec codec;
  Block back;
  const Block small = coded(samples);
  REQUIRE(small.size() <= haptics::kMaxCodedBytes);
  REQUIRE(codec.decode(small, samples.size() / kSample, back));
  REQUIRE(back == samples);
}

}  // namespace

TEST_CASE("block codec: any bits are restored, in blocks of any size") {
  for (const std::size_t count : {1u, 2u, 3u, 17u, 255u, 256u}) {
    check_comes_back(encoded(any_samples(count, count)));
    std::mt19937_64 random(count);
    check_comes_back(any_bytes(count * kSample, random));  // random bytes, not valid samples
    check_comes_back(Block(count * kSample));
    check_comes_back(Block(count * kSample, std::byte{0xFF}));
  }
}

TEST_CASE("block codec: data with the worst pattern of zero bytes hardly grows") {
  std::mt19937_64 random(5);
  for (const unsigned in : {2u, 3u, 4u, 8u, 130u, 1000u}) {
    Block samples = any_bytes(256 * kSample, random);
    for (std::byte& byte : samples)
      if (random() % in == 0) byte = std::byte{0};
    check_comes_back(samples);
  }
}

// zstd's own decoder returns planes whose bytes were derived by hand from the format's description. `reading.sequence`
// starts at byte 16 and `commanded` at byte 298: its high bytes are at 305 and 313.
TEST_CASE("block codec: zstd stores changes by byte planes, and nothing of forces that follow from others") {
  std::vector<haptics::TraceSample> samples(3);
  for (haptics::TraceSample& sample : samples) {
    sample.reading.sequence = 0x40;
    sample.out.wall_force = {-1.5, 2.0};
    sample.out.load_force = {0.25, 0.5};
    sample.out.commanded = {-1.25, 2.5};
  }
  samples[1].reading.sequence = 0x41;
  samples[2].out.commanded.x = 1.25;  // only its sign differs from the sum
  const Block planes = decompressed(coded(encoded(samples)));
  REQUIRE(planes.size() == 3 * kSample);
  const auto plane = [&](std::ptrdiff_t at) { return Block(planes.begin() + 3 * at, planes.begin() + 3 * (at + 1)); };
  CHECK(plane(16) == text({0x40, 1, 1}));
  CHECK(plane(305) == text({0, 0, 0x80}));
  for (std::ptrdiff_t at = 298; at < 314; ++at)
    if (at != 305) CHECK(plane(at) == text({0, 0, 0}));
}

TEST_CASE("block codec: a lever at rest costs less than three bytes per cycle") {
  std::vector<haptics::TraceSample> rest(256);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    haptics::TraceSample& now = rest[i];
    now.deadline_ns = 5'000'000'000 + 1'000'000 * static_cast<std::int64_t>(i);
    now.reading.time_ns = now.out.time_ns = now.deadline_ns;
    now.reading.sequence = 77 + i;
    now.out.cycle = i;
    now.out.lever = now.reading.position = {0.0123456, -0.0345678};
  }
  CHECK(coded(encoded(rest)).size() < 3 * 256);
}

// Independent fields are random. All other fields follow from them, so only the random fields cost bytes.
TEST_CASE("block codec: fields that follow from others cost nothing") {
  std::vector<haptics::TraceSample> samples = any_samples(256);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> newtons(-50.0, 50.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    haptics::TraceSample& now = samples[i];
    haptics::HapticSnapshot& out = now.out;
    for (glm::dvec2* force : {&now.reading.hand_force, &out.wall_force, &out.feel_force, &out.load_force})
      *force = {newtons(random), newtons(random)};
    now.deadline_ns = out.time_ns = 7'000'000'000 + 1'000'000 * static_cast<std::int64_t>(i);
    now.reading.time_ns = now.deadline_ns - 40'000;
    now.reading.sequence = 5 + 2 * i;
    out.cycle = i;
    out.lever = now.reading.position;
    now.reading.actuator_force = {newtons(random), newtons(random)};
    out.commanded = out.wall_force + out.feel_force + out.load_force;
    out.f_h = now.reading.hand_force;
    out.f_a = -now.reading.actuator_force;
    out.f_j = out.f_h - out.f_a;
  }
  constexpr std::size_t kFollow = 5 * 8 + 5 * 16;  // [bytes] fields that follow: 5 scalars and 5 vectors
  constexpr std::size_t kZero = 8 + 4 + 8;         // [bytes] fields that are 0: slope, guided gear, guidance
  constexpr std::size_t kFewValues = 7;            // [bytes] one-byte fields: booleans, enumerations
  CHECK(coded(encoded(samples)).size() < samples.size() * (kSample - kFollow - kZero - kFewValues));
}

TEST_CASE("block codec: a drive with every kind of event is compressed to less than a quarter") {
  const TempFolder folder;
  RecordedDrive drive;
  REQUIRE(drive.record(folder / "t.trace").problem.empty());
  const double bytes = static_cast<double>(std::filesystem::file_size(folder / "t.trace"));
  const double per_cycle = bytes / static_cast<double>(RecordedDrive::kCycles);
  INFO(per_cycle);
  CHECK(per_cycle < kSample / 4.0);
}

TEST_CASE("block codec: truncated data, or a wrong number of samples, is refused") {
  haptics::BlockCodec codec;
  Block back;
  std::mt19937_64 random(8);
  std::vector<haptics::TraceSample> calm(20);
  for (std::size_t i = 0; i < calm.size(); ++i)
    calm[i].reading.position.x = 1e-4 * std::sin(0.1 * static_cast<double>(i));
  for (const Block& samples : {encoded(any_samples(5)), encoded(calm)}) {
    const std::size_t count = samples.size() / kSample;
    const Block good = coded(samples);
    for (std::size_t size = 0; size < good.size(); ++size)
      REQUIRE_FALSE(codec.decode(std::span(good).first(size), count, back));
    for (std::size_t claimed = 0; claimed < 300; ++claimed)
      REQUIRE(codec.decode(good, claimed, back) == (claimed == count));
    REQUIRE_FALSE(codec.decode(good, ~std::size_t{0}, back));
  }
}

// libzstd may also decode the formats before 1.0 (zstd/lib/legacy). In that of 0.7, the first byte of a block header
// contains its kind: 0x80 repeats the byte that follows the header, 0xC0 ends the frame.
TEST_CASE("block codec: a frame of a format before zstd 1.0 is refused, although libzstd may decode it") {
  constexpr int kSize = 2 * kSample;
  const Block frame = text({0x27, 0xB5, 0x2F, 0xFD,                // magic of 0.7; that of 1.0 is 28 B5 2F FD
                            0xA0, kSize & 0xFF, kSize >> 8, 0, 0,  // one segment, size in 4 bytes
                            0x80, kSize >> 8, kSize & 0xFF, 0, 0xC0, 0, 0});  // zeros, end
  haptics::BlockCodec codec;
  Block back;
  CHECK_FALSE(codec.decode(frame, 2, back));
}

TEST_CASE("block codec: random bytes and corrupted blocks are either decoded to samples or refused") {
  haptics::BlockCodec codec;
  Block back;
  std::mt19937_64 random(9);
  int accepted = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const std::size_t count = 1 + random() % 4;
    Block bytes = trial % 2 == 0 ? any_bytes(random() % 40, random) : coded(Block(count * kSample));
    for (std::byte& byte : bytes)
      if (random() % 4 == 0) byte = static_cast<std::byte>(random() % 8 == 0 ? random() : random() % 4);
    if (!codec.decode(bytes, count, back)) continue;
    ++accepted;
    REQUIRE(back.size() == count * kSample);
    check_comes_back(back);  // compares samples, because the encoder may choose other bytes for them
  }
  CHECK(accepted > 10);
}

}  // namespace gearshift::test
