// Parses a HID report descriptor: the meaning of each bit of each report.
//
// This work is based on:
// USB Implementers' Forum. Device Class Definition for Human Interface Devices (HID), version
// 1.11, sections 5 and 6.2.2. 2001
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gearshift::haptics {

enum class ReportKind : std::uint8_t { input, output, feature };

struct HidUsage {
  std::uint16_t page = 0, id = 0;
  bool operator==(const HidUsage&) const = default;
};

struct HidCollection {
  HidUsage usage;         // 0, 0: no usage
  std::uint8_t type = 0;  // 0 physical, 1 application, 2 logical, ...
  int parent = -1;        // -1: top level
};

// One main item of the descriptor: `count` consecutive elements of equal size.
struct HidField {
  ReportKind kind = ReportKind::input;
  std::uint8_t report_id = 0;  // 0: the device uses no report IDs
  int offset = 0;              // [bits] from the first bit after the ID to the first element
  int bits = 0;                // [bits] per element, > 0; more than 32 are not supported
  int count = 0;               // elements, > 0
  bool constant = false;       // padding
  bool array = false;          // true: an element holds the number of a usage, not a value
  bool relative = false;
  std::int64_t logical_min = 0, logical_max = 0;    // a maximum of 0xFF means 255 unless the minimum is negative
  std::int64_t physical_min = 0, physical_max = 0;  // 0, 0: same as the logical range
  std::uint32_t unit = 0;
  int unit_exponent = 0;  // -8 to 7
  // For variables: the usage of each element; the last usage applies to all remaining elements. More usages than
  // elements mean a choice that the device's author forgot to flag as an array. For arrays: the usages of the values
  // from logical_min upwards.
  std::vector<HidUsage> usages;
  int collection = -1;  // innermost collection

  bool is_signed() const noexcept { return logical_min < 0; }
  HidUsage usage(int element) const noexcept;  // usage of a variable; 0, 0 if it has none
};

struct ReportDescriptor {
  std::vector<HidCollection> collections;
  std::vector<HidField> fields;  // in descriptor order
  bool numbered = false;         // reports begin with an ID

  // Size of the report [bytes], including one byte for the ID even if the device uses none; 0: no such report.
  std::size_t report_size(ReportKind kind, std::uint8_t id) const noexcept;

  // True if the field is inside a collection with the given usage, at any depth.
  bool is_within(const HidField& field, HidUsage collection) const noexcept;
};

// Accepts any bytes. Known mistakes in devices' descriptors (README.md) are read as intended; trailing zeros are
// ignored. Throws HidError with one sentence and the byte offset if the descriptor is truncated, has an unbalanced
// collection, a report longer than 65535 bytes, or more than 4096 fields or collections.
ReportDescriptor parse_report_descriptor(std::span<const std::uint8_t> bytes);

}  // namespace gearshift::haptics
