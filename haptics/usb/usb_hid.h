// HID devices through libusb: lists them and opens ports. No other folder uses libusb.
//
// Threads: a port is used by one thread at a time. Each listing and each port has its own libusb context, so that one
// thread can list devices while another thread streams. Without udev (containers, guests) an existing context never
// sees new devices, so waiting for a device means listing again with a new context.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "haptics/hid/hid_port.h"

namespace gearshift::haptics {

// A HID interface of a device that is plugged in.
struct UsbHidDevice {
  HidIdentity identity;  // as read by the kernel at plug-in, so no permission is needed
  int interface = 0;
  std::string problem;  // why the device cannot be opened ("... may not be used by this user; ..."); empty if it can
  std::vector<std::uint8_t> report_descriptor;  // empty if the descriptor cannot be read
};

inline constexpr int kFirstInterface = -1;

// Lists all HID interfaces, sorted by port path. Opens each device briefly but detaches no kernel driver. Throws
// HidError if USB is not available.
std::vector<UsbHidDevice> usb_hid_devices();

// Claims the interface: detaches the kernel driver, and attaches it again when the port is destroyed. Throws
// HidDisconnected if no such device is plugged in. Throws HidError if the device may not be used (the sentence names
// the udev rule), is in use by another program, or does not return its report descriptor. Vendor and product of the
// device must match `wanted`; so must serial and place, unless they are empty. The first such device is used.
// `interface`: from usb_hid_devices(), or kFirstInterface for the device's first HID interface.
std::unique_ptr<HidPort> open_usb_hid(const HidIdentity& wanted, int interface = kFirstInterface);

}  // namespace gearshift::haptics
