#include "haptics/usb/usb_port.h"

#include <algorithm>
#include <string>
#include <utility>

#include "haptics/usb/hid_request.h"
#include "haptics/usb/usb_stream.h"

namespace gearshift::haptics {
namespace {

std::string feature_report(const char* verb, std::uint8_t id) {
  return std::string(verb) + " feature report " + std::to_string(id);
}

ReportDescriptor parse_or_throw(const std::vector<std::uint8_t>& descriptor, const HidIdentity& identity) {
  try {
    return parse_report_descriptor(descriptor);
  } catch (const HidError& error) {
    throw HidError(usb_name(identity) + " cannot be used, because " + error.what());
  }
}

}  // namespace

UsbClaim::UsbClaim(libusb_device_handle& handle, const UsbInterface& interface)
    : handle_(handle), number_(interface.number) {
  libusb_set_auto_detach_kernel_driver(&handle_, 1);
  const int code = libusb_claim_interface(&handle_, number_);
  if (code != LIBUSB_SUCCESS) throw_usb_failure(code, interface.identity, "claiming its interface");
}

UsbClaim::~UsbClaim() {
  libusb_release_interface(&handle_, number_);
}

UsbPort::UsbPort(UsbContext context, UsbHandle handle, const UsbInterface& interface)
    : context_(std::move(context)),
      handle_(std::move(handle)),
      interface_(interface),
      claim_(*handle_, interface_),
      descriptor_(read_report_descriptor(*handle_, interface_)),
      reports_(parse_or_throw(descriptor_, interface_.identity)) {}

HidBytes UsbPort::get_feature(std::uint8_t id, std::size_t size) {
  const std::size_t before = wire_offset(reports_);
  HidBytes report;
  size = std::min(size, HidBytes::kMaxSize);
  if (size <= before) return report;
  const HidRequest request = get_report(HidReportType::feature, id, interface_.number);
  const int length =
      libusb_control_transfer(handle_.get(), request.type, request.request, request.value, request.index,
                              report.bytes.data() + before, static_cast<std::uint16_t>(size - before), kUsbTimeout);
  if (length < 0) throw_usb_failure(length, interface_.identity, feature_report("getting", id));
  report.size = static_cast<std::size_t>(length) + before;
  return report;
}

void UsbPort::set_feature(const HidBytes& report) {
  HidBytes sent = report;  // libusb needs a writable buffer
  const std::span<std::uint8_t> wire = on_the_wire(sent, reports_);
  const HidRequest request = set_report(HidReportType::feature, report.id(), interface_.number);
  const int code = libusb_control_transfer(handle_.get(), request.type, request.request, request.value, request.index,
                                           wire.data(), static_cast<std::uint16_t>(wire.size()), kUsbTimeout);
  if (code < 0) throw_usb_failure(code, interface_.identity, feature_report("setting", report.id()));
}

void UsbPort::send(const HidBytes& report) {
  HidBytes sent = report;
  const std::span<std::uint8_t> wire = on_the_wire(sent, reports_);
  int code = LIBUSB_SUCCESS;
  if (interface_.out != 0) {
    code = libusb_interrupt_transfer(handle_.get(), interface_.out, wire.data(), static_cast<int>(wire.size()), nullptr,
                                     kUsbTimeout);
    if (code == LIBUSB_ERROR_PIPE)
      libusb_clear_halt(handle_.get(), interface_.out);  // clears the stall, so that the next report can be sent
  } else {
    const HidRequest request = set_report(HidReportType::output, report.id(), interface_.number);
    code = libusb_control_transfer(handle_.get(), request.type, request.request, request.value, request.index,
                                   wire.data(), static_cast<std::uint16_t>(wire.size()), kUsbTimeout);
  }
  if (code < 0) throw_usb_failure(code, interface_.identity, "sending output report " + std::to_string(report.id()));
}

void UsbPort::stream(const StreamConfig& config, HidStream& stream) {
  UsbStream(*context_, *handle_, interface_, reports_, config, stream).run();
}

}  // namespace gearshift::haptics
