#include "haptics/usb/libusb_owned.h"

#include <span>
#include <string>

#include "haptics/usb/usb_interface.h"

namespace gearshift::haptics {

UsbContext new_usb_context() {
  libusb_context* context = nullptr;
  const int code = libusb_init(&context);
  if (code != LIBUSB_SUCCESS) throw HidError(std::string("USB is not available (") + libusb_strerror(code) + ")");
  return UsbContext(context);
}

std::vector<UsbDevice> usb_devices(libusb_context& context) {
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(&context, &list);
  if (count < 0) throw HidError(std::string("USB is not available (") + libusb_strerror(static_cast<int>(count)) + ")");
  std::vector<UsbDevice> devices;
  for (libusb_device* device : std::span(list, static_cast<std::size_t>(count))) devices.emplace_back(device);
  libusb_free_device_list(list, 0);
  return devices;
}

UsbHandle open_usb(libusb_device& device, const HidIdentity& identity) {
  libusb_device_handle* handle = nullptr;
  const int code = libusb_open(&device, &handle);
  if (code != LIBUSB_SUCCESS) throw_usb_failure(code, identity, "opening the device");
  return UsbHandle(handle);
}

void throw_usb_failure(int code, const HidIdentity& identity, std::string_view action) {
  const std::string name = usb_name(identity);
  switch (code) {
    case LIBUSB_ERROR_NO_DEVICE:
      throw HidDisconnected(name + " was unplugged");
    case LIBUSB_ERROR_ACCESS:
      throw HidError(name +
                     " may not be used by this user; install the udev rule assets/udev/70-gearshift.rules as described "
                     "in its first lines, and plug the device in again");
    case LIBUSB_ERROR_BUSY:
      throw HidError(name + " is used by another program; close that program");
    case LIBUSB_ERROR_TIMEOUT:
      throw HidError(name + " did not answer within " + std::to_string(kUsbTimeout) + " ms when " +
                     std::string(action));
    case LIBUSB_ERROR_PIPE:
      throw HidError(name + " refused the request when " + std::string(action));
    default:
      throw HidError(name + " failed when " + std::string(action) + " (" + libusb_strerror(code) + ")");
  }
}

}  // namespace gearshift::haptics
