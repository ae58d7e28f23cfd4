// HidPort for an opened USB HID interface: synchronous control and interrupt transfers, and the stream.
#pragma once

#include "haptics/hid/report_descriptor.h"
#include "haptics/usb/usb_interface.h"

namespace gearshift::haptics {

// Claims an interface, detaching the kernel driver; the destructor releases it and attaches the driver again.
class UsbClaim {
 public:
  UsbClaim(libusb_device_handle& handle, const UsbInterface& interface);  // throws HidDisconnected, HidError
  ~UsbClaim();
  UsbClaim(const UsbClaim&) = delete;
  UsbClaim& operator=(const UsbClaim&) = delete;

 private:
  libusb_device_handle& handle_;
  int number_;
};

class UsbPort final : public HidPort {
 public:
  // Claims the interface and reads its report descriptor. Throws HidDisconnected, HidError.
  UsbPort(UsbContext context, UsbHandle handle, const UsbInterface& interface);

  const HidIdentity& identity() const noexcept override { return interface_.identity; }
  const std::vector<std::uint8_t>& report_descriptor() const noexcept override { return descriptor_; }
  HidBytes get_feature(std::uint8_t id, std::size_t size) override;
  void set_feature(const HidBytes& report) override;
  void send(const HidBytes& report) override;
  void stream(const StreamConfig& config, HidStream& stream) override;

 private:
  UsbContext context_;
  UsbHandle handle_;
  UsbInterface interface_;
  UsbClaim claim_;
  std::vector<std::uint8_t> descriptor_;
  ReportDescriptor reports_;
};

}  // namespace gearshift::haptics
