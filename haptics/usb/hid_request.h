// HID control requests, and the form of a report on the wire.
//
// This work is based on:
// USB Implementers' Forum. Device Class Definition for Human Interface Devices (HID), version
// 1.11, sections 7.1 and 7.2. 2001
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "haptics/hid/hid_bytes.h"
#include "haptics/hid/report_descriptor.h"

namespace gearshift::haptics {

enum class HidReportType : std::uint8_t { input = 1, output = 2, feature = 3 };

struct HidRequest {
  std::uint8_t type = 0, request = 0;
  std::uint16_t value = 0, index = 0;
};

inline HidRequest hid_request(bool in, std::uint8_t request, int high, int low, int interface) {
  return {static_cast<std::uint8_t>(in ? 0xa1 : 0x21), request, static_cast<std::uint16_t>(high << 8 | low),
          static_cast<std::uint16_t>(interface)};
}
inline HidRequest get_report(HidReportType type, std::uint8_t id, int interface) {
  return hid_request(true, 0x01, static_cast<int>(type), id, interface);
}
inline HidRequest set_report(HidReportType type, std::uint8_t id, int interface) {
  return hid_request(false, 0x09, static_cast<int>(type), id, interface);
}
// Sets the idle rate to 0: the device reports only changes, without periodic repeats.
inline HidRequest set_idle(int interface) {
  return hid_request(false, 0x0a, 0, 0, interface);
}

inline HidRequest get_report_descriptor(int interface) {
  return {0x81, 0x06, 0x2200, static_cast<std::uint16_t>(interface)};
}

// Number of leading bytes of a report that are not sent: 1 (the ID byte) if the device uses no report IDs, otherwise 0.
inline std::size_t wire_offset(const ReportDescriptor& reports) {
  return reports.numbered ? 0 : 1;
}

inline std::span<std::uint8_t> on_the_wire(HidBytes& report, const ReportDescriptor& reports) {
  const std::span<std::uint8_t> bytes(report.bytes.data(), report.size);
  return bytes.empty() ? bytes : bytes.subspan(wire_offset(reports));
}

}  // namespace gearshift::haptics
