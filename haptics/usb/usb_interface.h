// A HID interface as its plug describes it, and what the kernel knows of it: nothing is opened for that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/usb/libusb_owned.h"

namespace gearshift {

struct UsbInterface {
  HidIdentity identity;
  int configuration = 0;
  int number = 0;
  std::uint8_t in = 0, out = 0;         // addresses of the interrupt endpoints; 0: none
  std::size_t in_packet = 0;            // [bytes] of the IN endpoint
  std::uint16_t descriptor_length = 0;  // [bytes] of its report descriptor, as declared
};

// Of the active configuration. None where the device has no HID interface, or is not configured.
std::vector<UsbInterface> hid_interfaces(libusb_device& device);

// As the kernel's driver of that interface read it; empty where no driver has it.
std::vector<std::uint8_t> bound_report_descriptor(const UsbInterface& interface);

// As the device tells it; the interface must be claimed. Throws HidGone, HidError.
std::vector<std::uint8_t> told_report_descriptor(libusb_device_handle& handle, const UsbInterface& interface);

std::string usb_name(const HidIdentity& identity);  // "Sidewinder Force Feedback 2 (045e:001b)"

}  // namespace gearshift
