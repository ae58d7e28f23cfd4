// libusb with owners, and its failures as sentences: for the files of this room, which alone include libusb.h, by this.
#pragma once

#include <libusb.h>

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "haptics/hid/hid_port.h"

namespace gearshift {

template <auto close>
struct UsbClose {
  template <class T>
  void operator()(T* owned) const noexcept {
    close(owned);
  }
};
// A context must outlive what was made with it.
using UsbContext = std::unique_ptr<libusb_context, UsbClose<libusb_exit>>;
using UsbDevice = std::unique_ptr<libusb_device, UsbClose<libusb_unref_device>>;
using UsbHandle = std::unique_ptr<libusb_device_handle, UsbClose<libusb_close>>;
using UsbTransfer = std::unique_ptr<libusb_transfer, UsbClose<libusb_free_transfer>>;

inline constexpr unsigned kUsbTimeout = 250;  // [ms] of every transfer that waits for the device

UsbContext new_usb_context();  // sees what is plugged in now. Throws HidError: no USB here
std::vector<UsbDevice> usb_devices(libusb_context& context);        // throws HidError
UsbHandle open_usb(libusb_device& device, const HidIdentity& who);  // throws HidGone, HidError with its sentence

// A failure of libusb while doing that with that device. Throws HidGone or HidError.
[[noreturn]] void throw_usb_failure(int code, const HidIdentity& who, std::string_view doing);

}  // namespace gearshift
