#include "haptics/usb/usb_hid.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "haptics/usb/libusb_owned.h"
#include "haptics/usb/usb_interface.h"
#include "haptics/usb/usb_port.h"

namespace gearshift::haptics {
namespace {

// Reads the report descriptor of an interface without a kernel driver. Afterwards the interface is released and offered
// to the kernel drivers again, because a driver that tried to bind in the meantime was refused.
std::vector<std::uint8_t> read_unbound_descriptor(libusb_device_handle& handle, const UsbInterface& interface) {
  const int code = libusb_claim_interface(&handle, interface.number);
  if (code != LIBUSB_SUCCESS) throw_usb_failure(code, interface.identity, "claiming its interface");
  struct Release {
    libusb_device_handle& handle;
    int number;
    ~Release() {
      libusb_release_interface(&handle, number);
      libusb_attach_kernel_driver(&handle, number);
    }
  } const release{handle, interface.number};
  return read_report_descriptor(handle, interface);
}

UsbHidDevice inspect(libusb_device& device, const UsbInterface& interface) {
  UsbHidDevice found;
  found.identity = interface.identity;
  found.interface = interface.number;
  found.report_descriptor = bound_report_descriptor(interface);
  try {
    const UsbHandle handle = open_usb(device, interface.identity);
    if (found.report_descriptor.empty()) found.report_descriptor = read_unbound_descriptor(*handle, interface);
  } catch (const HidError& error) {
    found.problem = error.what();
  }
  return found;
}

bool matches(const UsbInterface& interface, const HidIdentity& wanted, int number) {
  const HidIdentity& identity = interface.identity;
  return identity.vendor == wanted.vendor && identity.product == wanted.product &&
         (wanted.serial.empty() || identity.serial == wanted.serial) &&
         (wanted.place.empty() || identity.place == wanted.place) &&
         (number == kFirstInterface || interface.number == number);
}

std::pair<UsbHandle, UsbInterface> open_matching(libusb_context& context, const HidIdentity& wanted, int number) {
  for (const UsbDevice& device : usb_devices(context)) {
    for (const UsbInterface& interface : hid_interfaces(*device)) {
      if (matches(interface, wanted, number)) return {open_usb(*device, interface.identity), interface};
    }
  }
  throw HidDisconnected(usb_name(wanted) + " is not plugged in");
}

}  // namespace

std::vector<UsbHidDevice> usb_hid_devices() {
  const UsbContext context = new_usb_context();
  std::vector<UsbHidDevice> found;
  for (const UsbDevice& device : usb_devices(*context)) {
    for (const UsbInterface& interface : hid_interfaces(*device)) found.push_back(inspect(*device, interface));
  }
  std::sort(found.begin(), found.end(), [](const UsbHidDevice& a, const UsbHidDevice& b) {
    return std::tie(a.identity.place, a.interface) < std::tie(b.identity.place, b.interface);
  });
  return found;
}

std::unique_ptr<HidPort> open_usb_hid(const HidIdentity& wanted, int interface) {
  UsbContext context = new_usb_context();
  auto [handle, found] = open_matching(*context, wanted, interface);
  return std::make_unique<UsbPort>(std::move(context), std::move(handle), found);
}

}  // namespace gearshift::haptics
