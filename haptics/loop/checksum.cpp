// This work is based on:
// M. E. Kounavis, F. L. Berry. Novel Table Lookup-Based Algorithms for High-Performance CRC Generation. 2008
// G. L. Steele, D. Lea, C. H. Flood. Fast Splittable Pseudorandom Number Generators. 2014 (the mixing steps)
#include "haptics/loop/checksum.h"

#include <array>

namespace gearshift::haptics {
namespace {

constexpr std::size_t kSlices = 8;  // bytes processed per step
using CrcTables = std::array<std::array<std::uint32_t, 256>, kSlices>;

// table[0] is the CRC of one byte, table[n] the CRC of that byte followed by n zero bytes.
constexpr CrcTables make_crc_tables() {
  CrcTables table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
    table[0][byte] = crc;
  }
  for (std::size_t n = 1; n < kSlices; ++n)
    for (std::size_t byte = 0; byte < 256; ++byte)
      table[n][byte] = (table[n - 1][byte] >> 8) ^ table[0][table[n - 1][byte] & 255u];
  return table;
}

constexpr CrcTables kCrc = make_crc_tables();

// Reads at most eight bytes as a little-endian number.
std::uint64_t load(std::span<const std::byte> bytes) noexcept {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) word |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  return word;
}

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t so_far) noexcept {
  std::uint32_t crc = ~so_far;
  for (; bytes.size() >= kSlices; bytes = bytes.subspan(kSlices)) {
    const std::uint64_t word = load(bytes.first<kSlices>()) ^ crc;
    crc = 0;
    for (std::size_t i = 0; i < kSlices; ++i) crc ^= kCrc[kSlices - 1 - i][(word >> (8 * i)) & 255u];
  }
  for (const std::byte byte : bytes) crc = (crc >> 8) ^ kCrc[0][(crc ^ static_cast<std::uint32_t>(byte)) & 255u];
  return ~crc;
}

// Every step is invertible, so two different words give two different states. Two multiplications are needed: after a
// single multiplication, a flipped top bit changes only one or two bits, which a later word could flip back.
void RunHash::mix(std::uint64_t word) noexcept {
  state_ = (state_ ^ word) * 0xBF58476D1CE4E5B9;
  state_ = (state_ ^ (state_ >> 32)) * 0x94D049BB133111EB;
  state_ ^= state_ >> 29;
}

// The length is hashed too, so that moving bytes from one call to the next changes the hash.
void RunHash::add(std::span<const std::byte> bytes) noexcept {
  mix(bytes.size());
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) mix(load(bytes.first<8>()));
  if (!bytes.empty()) mix(load(bytes));
}

}  // namespace gearshift::haptics
