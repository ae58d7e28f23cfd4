// USB devices with the report descriptors of real products, as the bus lists them.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "haptics/usb/usb_hid.h"

namespace gearshift::test {

inline std::vector<std::uint8_t> described_as(const std::string& name) {
  std::ifstream in(GEARSHIFT_TEST_DATA "/hid/" + name + ".hex");
  std::vector<std::uint8_t> bytes;
  for (std::string byte; in >> byte;) bytes.push_back(static_cast<std::uint8_t>(std::stoi(byte, nullptr, 16)));
  return bytes;
}

inline haptics::UsbHidDevice usb_device(const std::string& descriptor, std::uint16_t vendor, std::uint16_t product,
                                        const std::string& name, const std::string& place,
                                        const std::string& serial = {}) {
  haptics::UsbHidDevice device;
  device.identity = {vendor, product, serial, {}, name, place};
  if (!descriptor.empty()) device.report_descriptor = described_as(descriptor);
  return device;
}

inline haptics::UsbHidDevice sidewinder(const std::string& place = "1-1", const std::string& serial = {}) {
  return usb_device("microsoft-sidewinder-ff2", 0x045e, 0x001b, "SideWinder Force Feedback 2 Joystick", place, serial);
}
inline haptics::UsbHidDevice openffboard(const std::string& place = "1-2") {
  return usb_device("openffboard-2axis", 0x1209, 0xffb0, "FFBoard", place, "2A0030");
}

}  // namespace gearshift::test
