// RAII types for libusb, and libusb's errors as sentences. Only files in this folder include libusb.h, through this
// header.
#pragma once

#include <libusb.h>

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "haptics/hid/hid_port.h"

namespace gearshift::haptics {

template <auto close>
struct UsbClose {
  template <class T>
  void operator()(T* owned) const noexcept {
    close(owned);
  }
};
// A context must outlive everything made with it.
using UsbContext = std::unique_ptr<libusb_context, UsbClose<libusb_exit>>;
using UsbDevice = std::unique_ptr<libusb_device, UsbClose<libusb_unref_device>>;
using UsbHandle = std::unique_ptr<libusb_device_handle, UsbClose<libusb_close>>;
using UsbTransfer = std::unique_ptr<libusb_transfer, UsbClose<libusb_free_transfer>>;

inline constexpr unsigned kUsbTimeout = 250;  // [ms] timeout of every synchronous transfer

UsbContext new_usb_context();  // sees only devices plugged in now. Throws HidError if USB is not available
std::vector<UsbDevice> usb_devices(libusb_context& context);             // throws HidError
UsbHandle open_usb(libusb_device& device, const HidIdentity& identity);  // throws HidDisconnected, HidError

// Throws HidDisconnected or HidError for a libusb error code; `action` names the failed operation.
[[noreturn]] void throw_usb_failure(int code, const HidIdentity& identity, std::string_view action);

}  // namespace gearshift::haptics
