// A USB bus with emulated devices below the real libusb, using umockdev's sysfs, udev events and system calls. The
// program must run under umockdev-wrapper. The handlers run in threads of this process; libusb may be used by a child
// process.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "tests/support/usb/usb_gadget.h"
#include "tests/support/usb/usb_plug.h"

namespace gearshift::test {

class MockUsb {
 public:
  MockUsb();   // throws std::runtime_error if umockdev is not preloaded
  ~MockUsb();  // close every port first. NOLINT(bugprone-exception-escape): it ends the test
  MockUsb(const MockUsb&) = delete;
  MockUsb& operator=(const MockUsb&) = delete;

  // The gadget must outlive the bus. Sends a udev event. A device that is plugged in again gets a new number.
  void plug(UsbGadget& gadget, const UsbPlug& plug = {});
  void unplug(UsbGadget& gadget);

  // State of that gadget's latest connection.
  UsbNodeCounts counts(UsbGadget& gadget) const;
  bool driver_bound(UsbGadget& gadget) const;
  void set_faults(UsbGadget& gadget, const UsbWireFaults& faults);

  // Held while a gadget is called, from two threads of the bus.
  std::mutex& mutex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::test
