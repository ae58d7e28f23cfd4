// This work is based on:
// USB Implementers' Forum. Device Class Definition for Human Interface Devices (HID), version 1.11, section 6.2.1. 2001

#include "haptics/usb/usb_interface.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

#include "haptics/files/printable.h"
#include "haptics/usb/hid_request.h"

namespace gearshift::haptics {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDescriptorBytes = 4096;  // [bytes] longest descriptor that the Linux kernel accepts
constexpr std::uint8_t kHidDescriptor = 0x21, kReportDescriptor = 0x22;

using ConfigDescriptor = std::unique_ptr<libusb_config_descriptor, UsbClose<libusb_free_config_descriptor>>;

// Bus and port path in the kernel's notation, such as "1-1.2".
std::string port_path(libusb_device& device) {
  std::array<std::uint8_t, 8> ports{};
  const int depth = libusb_get_port_numbers(&device, ports.data(), static_cast<int>(ports.size()));
  std::string place = std::to_string(libusb_get_bus_number(&device));
  for (int i = 0; i < depth; ++i) place += (i == 0 ? "-" : ".") + std::to_string(ports[static_cast<std::size_t>(i)]);
  return place;
}

fs::path kernel_folder(const std::string& name) {
  return fs::path("/sys/bus/usb/devices") / name;
}

// A string descriptor of the device, as read by the kernel at plug-in.
std::string kernel_string(const std::string& place, const char* what) {
  std::ifstream file(kernel_folder(place) / what);
  std::string text;
  std::getline(file, text);
  return printable(text);
}

HidIdentity identity_of(libusb_device& device, const libusb_device_descriptor& descriptor) {
  HidIdentity identity;
  identity.vendor = descriptor.idVendor;
  identity.product = descriptor.idProduct;
  identity.place = port_path(device);
  identity.serial = kernel_string(identity.place, "serial");
  identity.maker = kernel_string(identity.place, "manufacturer");
  identity.name = kernel_string(identity.place, "product");
  return identity;
}

// Length of the report descriptor, from the HID descriptor's list of class descriptors.
std::uint16_t declared_length(std::span<const unsigned char> extra) {
  while (extra.size() >= 2 && extra[0] >= 2 && extra[0] <= extra.size()) {
    if (extra[1] == kHidDescriptor) {
      for (std::size_t at = 6; at + 3 <= extra[0]; at += 3) {
        if (extra[at] == kReportDescriptor) return static_cast<std::uint16_t>(extra[at + 1] | extra[at + 2] << 8);
      }
    }
    extra = extra.subspan(extra[0]);
  }
  return 0;
}

void add_endpoint(const libusb_endpoint_descriptor& endpoint, UsbInterface& interface) {
  if ((endpoint.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) != LIBUSB_TRANSFER_TYPE_INTERRUPT) return;
  const std::uint8_t address = endpoint.bEndpointAddress;
  if ((address & LIBUSB_ENDPOINT_DIR_MASK) == LIBUSB_ENDPOINT_OUT) {
    if (interface.out == 0) interface.out = address;
  } else if (interface.in == 0) {
    interface.in = address;
    interface.in_packet = endpoint.wMaxPacketSize & 0x7ffu;
  }
}

}  // namespace

std::vector<UsbInterface> hid_interfaces(libusb_device& device) {
  libusb_device_descriptor descriptor{};
  libusb_config_descriptor* active = nullptr;
  if (libusb_get_device_descriptor(&device, &descriptor) != LIBUSB_SUCCESS) return {};
  if (libusb_get_active_config_descriptor(&device, &active) != LIBUSB_SUCCESS) return {};
  const ConfigDescriptor owner(active);
  std::vector<UsbInterface> interfaces;
  for (const libusb_interface& each : std::span(active->interface, active->bNumInterfaces)) {
    if (each.num_altsetting < 1 || each.altsetting[0].bInterfaceClass != LIBUSB_CLASS_HID) continue;
    const libusb_interface_descriptor& first = each.altsetting[0];
    UsbInterface& interface = interfaces.emplace_back();
    interface.identity = identity_of(device, descriptor);
    interface.configuration = active->bConfigurationValue;
    interface.number = first.bInterfaceNumber;
    interface.descriptor_length = declared_length({first.extra, static_cast<std::size_t>(first.extra_length)});
    for (const libusb_endpoint_descriptor& endpoint : std::span(first.endpoint, first.bNumEndpoints)) {
      add_endpoint(endpoint, interface);
    }
  }
  return interfaces;
}

std::vector<std::uint8_t> bound_report_descriptor(const UsbInterface& interface) {
  const std::string name =
      interface.identity.place + ":" + std::to_string(interface.configuration) + "." + std::to_string(interface.number);
  std::error_code ignored;
  for (const fs::directory_entry& child : fs::directory_iterator(kernel_folder(name), ignored)) {
    std::ifstream file(child.path() / "report_descriptor", std::ios::binary);
    if (!file) continue;
    std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (!bytes.empty() && bytes.size() <= kMaxDescriptorBytes) return bytes;
  }
  return {};
}

std::vector<std::uint8_t> read_report_descriptor(libusb_device_handle& handle, const UsbInterface& interface) {
  if (interface.descriptor_length == 0 || interface.descriptor_length > kMaxDescriptorBytes) {
    throw HidError(usb_name(interface.identity) + " declares a report descriptor of " +
                   std::to_string(interface.descriptor_length) + " bytes, but 1 to " +
                   std::to_string(kMaxDescriptorBytes) + " bytes are allowed");
  }
  std::vector<std::uint8_t> bytes(interface.descriptor_length);
  const HidRequest request = get_report_descriptor(interface.number);
  const int length = libusb_control_transfer(&handle, request.type, request.request, request.value, request.index,
                                             bytes.data(), interface.descriptor_length, kUsbTimeout);
  if (length < 0) throw_usb_failure(length, interface.identity, "reading its report descriptor");
  bytes.resize(static_cast<std::size_t>(length));
  return bytes;
}

std::string usb_name(const HidIdentity& identity) {
  std::array<char, 16> numbers{};
  std::snprintf(numbers.data(), numbers.size(), "%04x:%04x", unsigned{identity.vendor}, unsigned{identity.product});
  if (identity.name.empty()) return "the USB device " + std::string(numbers.data());
  return identity.name + " (" + numbers.data() + ")";
}

}  // namespace gearshift::haptics
