// This work is based on:
// Universal Serial Bus Specification, revision 2.0, sections 9.6.1 to 9.6.7. 2000
// USB Implementers' Forum. Device Class Definition for Human Interface Devices (HID), version 1.11, section 6.2.1. 2001
#include "tests/support/stick/stick_plug.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace gearshift::test {
namespace {

constexpr std::uint8_t kPacket = 64;  // [bytes] maximum packet size at full speed

std::uint8_t low(std::size_t value) {
  return static_cast<std::uint8_t>(value);
}
std::uint8_t high(std::size_t value) {
  return static_cast<std::uint8_t>(value >> 8);
}

void append(std::vector<std::uint8_t>& to, const std::vector<std::uint8_t>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

std::vector<std::uint8_t> interrupt_endpoint(std::uint8_t address, std::uint8_t interval) {
  return {7, 5, address, 3, kPacket, 0, interval};
}

}  // namespace

std::vector<std::uint8_t> make_device_descriptor(const StickFamilyTable& family) {
  const auto serial = static_cast<std::uint8_t>(*family.serial != '\0' ? 3 : 0);
  return {18,
          1,
          low(family.usb_version),
          high(family.usb_version),
          0,
          0,
          0,
          kPacket,  //
          low(family.vendor),
          high(family.vendor),
          low(family.product),
          high(family.product),
          low(family.device_version),
          high(family.device_version),
          1,
          2,
          serial,
          1};
}

std::vector<std::uint8_t> make_configuration_descriptor(const StickFamilyTable& family, std::size_t report_descriptor,
                                                        double input_interval) {
  const auto interval = static_cast<std::uint8_t>(std::clamp(std::ceil(input_interval * 1e3 - 1e-6), 1.0, 255.0));
  const std::uint8_t endpoints = family.endpoint_out != 0 ? 2 : 1;
  std::vector<std::uint8_t> bytes{9, 2, 0, 0, 1, 1, 0, 0x80, 50};  // one interface, bus-powered, 50 x 2 mA
  append(bytes, {9, 4, 0, 0, endpoints, 3, 0, 0, 0});
  append(bytes, {9, 0x21, 0x11, 0x01, 0, 1, 0x22, low(report_descriptor), high(report_descriptor)});
  append(bytes, interrupt_endpoint(family.endpoint_in, interval));
  if (family.endpoint_out != 0) append(bytes, interrupt_endpoint(family.endpoint_out, 1));
  bytes[2] = low(bytes.size());
  bytes[3] = high(bytes.size());
  return bytes;
}

std::vector<std::uint8_t> make_string_descriptor(const StickFamilyTable& family, int index) {
  if (index == 0) return {4, 3, 0x09, 0x04};  // English (United States)
  if (index < 0 || index > 3) return {};
  const std::string_view text = index == 1 ? family.maker : index == 2 ? family.product_name : family.serial;
  if (text.empty()) return {};
  std::vector<std::uint8_t> bytes{low(2 + 2 * text.size()), 3};
  for (char letter : text) append(bytes, {static_cast<std::uint8_t>(letter), 0});
  return bytes;
}

}  // namespace gearshift::test
