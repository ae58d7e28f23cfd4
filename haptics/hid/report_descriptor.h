// A HID report descriptor, read: which bits of which report mean what.
//
// This work is based on:
// USB Implementers' Forum. Device Class Definition for Human Interface Devices (HID), version 1.11, sections 5 and 6.2.2. 2001
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gearshift {

enum class ReportKind : std::uint8_t { input, output, feature };

struct HidUsage {
  std::uint16_t page = 0, id = 0;
  bool operator==(const HidUsage&) const = default;
};

struct HidCollection {
  HidUsage usage;         // 0, 0 where it has none
  std::uint8_t type = 0;  // 0 physical, 1 application, 2 logical, ...
  int parent = -1;        // -1: top level
};

// What one main item declares: `count` equal elements in a row.
struct HidField {
  ReportKind kind = ReportKind::input;
  std::uint8_t report_id = 0;  // 0: the device numbers no reports of this kind
  int offset = 0;              // [bits] of the first element, from the first bit after the ID
  int bits = 0;                // [bits] of an element, > 0; beyond 32 it is nothing that this room reads
  int count = 0;               // elements, > 0
  bool constant = false;       // padding
  bool array = false;          // an element holds the number of a usage, not a value
  bool relative = false;
  std::int64_t logical_min = 0, logical_max = 0;    // as meant: 25 FF after 15 00 is 255
  std::int64_t physical_min = 0, physical_max = 0;  // 0, 0: as the logical ones
  std::uint32_t unit = 0;
  int unit_exponent = 0;  // -8 to 7
  // Variables: of each element; the last one counts for all that are left. There may be more of them than elements: a choice
  // whose author forgot to flag it as an array. Arrays: of the values from logical_min on.
  std::vector<HidUsage> usages;
  int collection = -1;  // the innermost

  bool is_signed() const noexcept { return logical_min < 0; }
  HidUsage usage(int element) const noexcept;  // of a variable; 0, 0 where it has none
};

struct ReportDescriptor {
  std::vector<HidCollection> collections;
  std::vector<HidField> fields;  // in their order
  bool numbered = false;         // reports begin with an ID

  // [bytes] of that report, ID included (one byte, 0 where the device numbers none); 0: there is no such report
  std::size_t report_size(ReportKind kind, std::uint8_t id) const noexcept;

  // Is the field in a collection of that usage, at any depth?
  bool is_within(const HidField& field, HidUsage collection) const noexcept;
};

// Any bytes. What devices are known to get wrong (README.md) is read as it is meant; zeros at the end are not looked at.
// Throws HidError with one sentence and the byte where a descriptor cannot be understood: truncated, a collection that
// never ends or never began, a report beyond 65535 bytes, more than 4096 fields or collections.
ReportDescriptor parse_report_descriptor(std::span<const std::uint8_t> bytes);

}  // namespace gearshift
