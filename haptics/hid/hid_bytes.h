// One HID report in a fixed-size buffer, without allocation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gearshift::haptics {

// The first byte is always the report ID. If the device uses no report IDs, the byte is 0 and is not sent.
struct HidBytes {
  static constexpr std::size_t kMaxSize = 256;  // [bytes] longer reports are ignored
  std::array<std::uint8_t, kMaxSize> bytes{};
  std::size_t size = 0;  // [bytes] ID included; 0: no report

  std::span<const std::uint8_t> view() const noexcept { return {bytes.data(), size}; }
  std::uint8_t id() const noexcept { return bytes[0]; }
  bool operator==(const HidBytes& other) const noexcept;  // compares only the used bytes
};

}  // namespace gearshift::haptics
