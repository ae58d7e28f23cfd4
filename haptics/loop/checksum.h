// A CRC that detects disk errors, and a hash for comparing the results of two runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gearshift::haptics {

// CRC-32 as in IEEE 802.3 (reflected polynomial 0xEDB88320), as in zip and PNG. `so_far`: CRC of the preceding bytes.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t so_far = 0) noexcept;

// Order-dependent 64-bit hash of a run. It detects single differing bits; it is not cryptographic.
class RunHash {
 public:
  void add(std::span<const std::byte> bytes) noexcept;
  std::uint64_t value() const noexcept { return state_; }

 private:
  void mix(std::uint64_t word) noexcept;

  std::uint64_t state_ = 0x6765617273686966;
};

}  // namespace gearshift::haptics
