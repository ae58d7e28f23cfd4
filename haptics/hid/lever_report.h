// The input report with a stick's position and buttons.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "haptics/hid/report_descriptor.h"

namespace gearshift::haptics {

// Position of a value in a report, and the value's range.
struct BitField {
  int offset = 0;                 // [bits] position of the first bit after the report ID
  int bits = 0;                   // 0: the device has no such field; else 1 to 32
  std::int64_t min = 0, max = 0;  // logical range, limited to what `bits` can hold; signed if min < 0
  // Logical value that means zero. If the logical range is signed, it is 0. If only the physical range is signed, it is
  // the value at physical 0. Otherwise it is the minimum.
  std::int64_t zero = 0;
  bool exists() const noexcept { return bits > 0; }
};

// The bit field of one element; bits = 0 unless the field has 1 to 32 bits.
BitField bit_field(const HidField& field, int element) noexcept;

bool contains(std::span<const std::uint8_t> report, const BitField& field) noexcept;
// Returns 0 if the report is too short.
std::int64_t read_bits(std::span<const std::uint8_t> report, const BitField& field) noexcept;
// Writes the value, clamped to the logical range. Writes nothing if the report is too short.
void write_bits(std::span<std::uint8_t> report, const BitField& field, std::int64_t value) noexcept;

inline constexpr std::size_t kMaxAxes = 8, kMaxButtons = 64;
inline constexpr std::uint16_t kGenericDesktop = 0x01;  // usage page: HID Usage Tables 1.12, section 4
inline constexpr HidUsage kUsageX{kGenericDesktop, 0x30}, kUsageY{kGenericDesktop, 0x31};

// An axis of the Generic Desktop or Simulation page: 0x30 X, 0x31 Y, 0x32 Z, ...
struct HidAxis {
  HidUsage usage;
  BitField field;
};

struct LeverReport {
  std::uint8_t id = 0;
  std::size_t size = 0;           // [bytes] ID included
  std::vector<HidAxis> axes;      // in the order of the report, each usage once, at most kMaxAxes
  std::vector<BitField> buttons;  // usage page 9, button 1 first, at most kMaxButtons; bits 0: no such button
};

// The first input report with X and Y inside a joystick, game pad or multi-axis controller collection; empty if there
// is none.
std::optional<LeverReport> find_lever_report(const ReportDescriptor& descriptor);

// Decoded values of a report. Axes and buttons are in the order of LeverReport, button 1 in bit 0.
struct LeverCounts {
  std::array<std::int64_t, kMaxAxes> axis{};  // logical values
  std::uint64_t buttons = 0;
  bool operator==(const LeverCounts&) const = default;
};

// Empty if the report ID is wrong or the report ends before X or Y; what it lacks otherwise is 0. Real-time safe.
std::optional<LeverCounts> decode_lever(const LeverReport& layout, std::span<const std::uint8_t> report) noexcept;

}  // namespace gearshift::haptics
