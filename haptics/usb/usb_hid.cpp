#include "haptics/usb/usb_hid.h"

#include <sys/time.h>

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

#include "haptics/usb/libusb_owned.h"
#include "haptics/usb/usb_interface.h"
#include "haptics/usb/usb_port.h"

namespace gearshift {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kLookEvery{500};

// Of an interface that no driver has. It is free again afterwards, and offered to the kernel's drivers: one that came to
// bind while it was taken would have been refused.
std::vector<std::uint8_t> ask_report_descriptor(libusb_device_handle& handle, const UsbInterface& interface) {
  const int code = libusb_claim_interface(&handle, interface.number);
  if (code != LIBUSB_SUCCESS) throw_usb_failure(code, interface.identity, "claim its interface");
  struct Release {
    libusb_device_handle& handle;
    int number;
    ~Release() {
      libusb_release_interface(&handle, number);
      libusb_attach_kernel_driver(&handle, number);
    }
  } const release{handle, interface.number};
  return told_report_descriptor(handle, interface);
}

UsbHidDevice look_at(libusb_device& device, const UsbInterface& interface) {
  UsbHidDevice seen;
  seen.identity = interface.identity;
  seen.interface = interface.number;
  seen.report_descriptor = bound_report_descriptor(interface);
  try {
    const UsbHandle handle = open_usb(device, interface.identity);
    if (seen.report_descriptor.empty()) seen.report_descriptor = ask_report_descriptor(*handle, interface);
  } catch (const HidError& error) {
    seen.problem = error.what();
  }
  return seen;
}

bool is_wanted(const UsbInterface& interface, const HidIdentity& wanted, int number) {
  const HidIdentity& is = interface.identity;
  return is.vendor == wanted.vendor && is.product == wanted.product &&
         (wanted.serial.empty() || is.serial == wanted.serial) && (wanted.place.empty() || is.place == wanted.place) &&
         (number == kFirstInterface || interface.number == number);
}

std::pair<UsbHandle, UsbInterface> open_wanted(libusb_context& context, const HidIdentity& wanted, int number) {
  for (const UsbDevice& device : usb_devices(context)) {
    for (const UsbInterface& interface : hid_interfaces(*device)) {
      if (is_wanted(interface, wanted, number)) return {open_usb(*device, interface.identity), interface};
    }
  }
  throw HidGone(usb_name(wanted) + " is not plugged in");
}

using Plugged = std::vector<std::pair<int, int>>;  // bus and number: a new number with every plug

Plugged plugged_in() {
  const UsbContext context = new_usb_context();
  Plugged plugged;
  for (const UsbDevice& device : usb_devices(*context)) {
    plugged.emplace_back(libusb_get_bus_number(device.get()), libusb_get_device_address(device.get()));
  }
  std::sort(plugged.begin(), plugged.end());
  return plugged;
}

int LIBUSB_CALL note_change(libusb_context*, libusb_device*, libusb_hotplug_event, void* changed) {
  *static_cast<int*>(changed) = 1;
  return 0;  // go on telling
}

}  // namespace

struct UsbBus::State {
  UsbContext context = new_usb_context();
  int changed = 0;
  Plugged plugged = plugged_in();
};

UsbBus::UsbBus() : state_(std::make_unique<State>()) {
  if (libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG) == 0) return;
  libusb_hotplug_register_callback(state_->context.get(),
                                   LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT, 0,
                                   LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY,
                                   note_change, &state_->changed, nullptr);
}

UsbBus::~UsbBus() = default;

std::vector<UsbHidDevice> UsbBus::hid_devices() const {
  const UsbContext context = new_usb_context();
  std::vector<UsbHidDevice> seen;
  for (const UsbDevice& device : usb_devices(*context)) {
    for (const UsbInterface& interface : hid_interfaces(*device)) seen.push_back(look_at(*device, interface));
  }
  std::sort(seen.begin(), seen.end(), [](const UsbHidDevice& a, const UsbHidDevice& b) {
    return std::tie(a.identity.place, a.interface) < std::tie(b.identity.place, b.interface);
  });
  return seen;
}

std::unique_ptr<HidPort> UsbBus::open(const HidIdentity& wanted, int interface) const {
  UsbContext context = new_usb_context();
  auto [handle, found] = open_wanted(*context, wanted, interface);
  return std::make_unique<UsbPort>(std::move(context), std::move(handle), found);
}

bool UsbBus::wait_for_change(int milliseconds) {
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(milliseconds);
  for (;;) {
    const auto left = std::max(Clock::duration::zero(), std::min<Clock::duration>(kLookEvery, end - Clock::now()));
    const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(left).count();
    timeval wait{whole / 1'000'000, whole % 1'000'000};
    libusb_handle_events_timeout_completed(state_->context.get(), &wait, &state_->changed);
    const bool told = std::exchange(state_->changed, 0) != 0;
    const Plugged before = std::exchange(state_->plugged, plugged_in());
    if (told || state_->plugged != before) return true;
    if (Clock::now() >= end) return false;
  }
}

}  // namespace gearshift
