// A HID interface as its USB descriptors and the kernel describe it. Reading this needs no open device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/usb/libusb_owned.h"

namespace gearshift::haptics {

struct UsbInterface {
  HidIdentity identity;
  int configuration = 0;
  int number = 0;
  std::uint8_t in = 0, out = 0;         // addresses of the interrupt endpoints; 0: none
  std::size_t in_packet = 0;            // [bytes] maximum packet size of the IN endpoint
  std::uint16_t descriptor_length = 0;  // [bytes] declared size of the interface's report descriptor
};

// HID interfaces of the active configuration; empty if there are none or the device is not configured.
std::vector<UsbInterface> hid_interfaces(libusb_device& device);

// The report descriptor as read by the kernel driver; empty if no driver is bound.
std::vector<std::uint8_t> bound_report_descriptor(const UsbInterface& interface);

// Reads the report descriptor from the device; the interface must be claimed. Throws HidDisconnected, HidError.
std::vector<std::uint8_t> read_report_descriptor(libusb_device_handle& handle, const UsbInterface& interface);

std::string usb_name(const HidIdentity& identity);  // "Sidewinder Force Feedback 2 (045e:001b)"

}  // namespace gearshift::haptics
