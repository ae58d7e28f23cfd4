// A USB bus with emulated devices beneath the real libusb: umockdev's sysfs, udev events and system calls. The program must
// run under umockdev-wrapper. Handlers run in threads of this process; whoever uses libusb may be a child of it.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "tests/support/usb/usb_gadget.h"
#include "tests/support/usb/usb_plug.h"

namespace gearshift {

class MockUsb {
 public:
  MockUsb();   // throws std::runtime_error: no umockdev beneath this program
  ~MockUsb();  // every port must be closed by then. NOLINT(bugprone-exception-escape): it ends the test
  MockUsb(const MockUsb&) = delete;
  MockUsb& operator=(const MockUsb&) = delete;

  // The gadget must outlive the bus. udev tells of it. A device that is plugged in again has a new number.
  void plug(UsbGadget& gadget, const UsbPlug& plug = {});
  void unplug(UsbGadget& gadget);

  // What of it was plugged in last.
  UsbNodeCounts counts(UsbGadget& gadget) const;
  bool driver_bound(UsbGadget& gadget) const;
  void set_faults(UsbGadget& gadget, const UsbWireFaults& faults);

  // Held while a gadget is called: from two threads of the bus.
  std::mutex& mutex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
