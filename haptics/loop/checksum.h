// Two small checks of bytes: did the disk keep them, and did the run give the same again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gearshift {

// CRC-32 of IEEE 802.3 (reflected polynomial 0xEDB88320), as in zip and PNG. `so_far`: of the bytes before.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t so_far = 0) noexcept;

// 64-bit hash of a run, in order. Not against an adversary: against a bit that came out differently.
class RunHash {
 public:
  void add(std::span<const std::byte> bytes) noexcept;
  std::uint64_t value() const noexcept { return state_; }

 private:
  void mix(std::uint64_t word) noexcept;

  std::uint64_t state_ = 0x6765617273686966;
};

}  // namespace gearshift
