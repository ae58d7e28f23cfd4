// One HID report as bytes, in place: no allocation on its way.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gearshift {

// The report's ID comes first, always: 0 where the device numbers none (then it is not sent).
struct HidBytes {
  static constexpr std::size_t kMost = 256;  // [bytes] no report used here comes near it; longer ones are passed over
  std::array<std::uint8_t, kMost> bytes{};
  std::size_t size = 0;  // [bytes] ID included; 0: there is none

  std::span<const std::uint8_t> view() const noexcept { return {bytes.data(), size}; }
  std::uint8_t id() const noexcept { return bytes[0]; }
  bool operator==(const HidBytes& other) const noexcept;  // of what is used of them
};

}  // namespace gearshift
