// HID devices by libusb: which are plugged in, and a port to one of them. No other room sees libusb.
//
// Threads: a port is used by one thread at a time. Nothing is shared: each look and each port has a libusb context of its
// own, so that a port streams on its thread while another one lists. A context that no udev tells (containers, guests)
// never sees a new device: who waits for one looks again.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "haptics/hid/hid_port.h"

namespace gearshift {

// A HID interface of a device that is plugged in.
struct UsbHidDevice {
  HidIdentity identity;  // as the kernel read it when it was plugged in: it takes no permission
  int interface = 0;
  std::string problem;  // why it cannot be opened, one sentence: "... may not be used by this user: ..."; empty: it can
  std::vector<std::uint8_t> report_descriptor;  // empty where it cannot be read
};

inline constexpr int kFirstInterface = -1;

// In the order of their places. Opens each for a moment, detaches nothing. Throws HidError: no USB here.
std::vector<UsbHidDevice> usb_hid_devices();

// Takes the interface: the kernel's driver is detached, and given back when the port goes. Throws HidGone where no such
// device is plugged in, HidError where it may not be used (the sentence names the udev rule), is used by another program
// or tells no report descriptor. Serial empty: the first of that vendor and product. place, where not empty, must be the
// same, too. interface: as usb_hid_devices() says; kFirstInterface: the first HID interface of the device.
std::unique_ptr<HidPort> open_usb_hid(const HidIdentity& wanted, int interface = kFirstInterface);

}  // namespace gearshift
