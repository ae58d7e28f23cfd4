// The input report that says where a stick stands.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "haptics/hid/report_descriptor.h"

namespace gearshift {

// Where a value lies in a report, and how it is meant.
struct BitField {
  int offset = 0;                 // [bits] after the ID
  int bits = 0;                   // 0: the device has no such field; else 1 to 32
  std::int64_t min = 0, max = 0;  // logical, and what so many bits can hold; with a sign where min < 0
  std::int64_t zero = 0;  // logical, that stands for none: 0, or where the physical range has its 0 if that alone
                          // has a sign; the least where neither has
  bool exists() const noexcept { return bits > 0; }
};

// Of one element; nothing where it is no field of 1 to 32 bits.
BitField bit_field(const HidField& field, int element) noexcept;

std::int64_t read_bits(std::span<const std::uint8_t> report, const BitField& field) noexcept;  // 0 beyond the report
// Clamped to the logical range. Nothing where the report is too short.
void write_bits(std::span<std::uint8_t> report, const BitField& field, std::int64_t value) noexcept;

inline constexpr std::size_t kMostAxes = 8, kMostButtons = 64;
inline constexpr std::uint16_t kGenericDesktop = 0x01;  // usage page: HID Usage Tables 1.12, 4
inline constexpr HidUsage kUsageX{kGenericDesktop, 0x30}, kUsageY{kGenericDesktop, 0x31};

// An axis of the Generic Desktop or Simulation page: 0x30 X, 0x31 Y, 0x32 Z, ...
struct HidAxis {
  HidUsage usage;
  BitField field;
};

struct LeverReport {
  std::uint8_t id = 0;
  std::size_t size = 0;           // [bytes] ID included
  std::vector<HidAxis> axes;      // in the order of the report, each usage once, at most kMostAxes
  std::vector<BitField> buttons;  // usage page 9, button 1 first, at most kMostButtons; bits 0: it has no such button
};

// The report of the joystick that is in there, or nothing: one with X and Y in an application collection of joystick,
// game pad or multi-axis controller.
std::optional<LeverReport> find_lever_report(const ReportDescriptor& descriptor);

// What a report says. Axes and buttons in the order of LeverReport, button 1 in bit 0.
struct LeverCounts {
  std::array<std::int64_t, kMostAxes> axis{};  // logical, as read
  std::uint64_t buttons = 0;
  bool operator==(const LeverCounts&) const = default;
};

// Nothing where ID or length are not those of the report. Real-time safe.
std::optional<LeverCounts> decode_lever(const LeverReport& layout, std::span<const std::uint8_t> report) noexcept;

}  // namespace gearshift
