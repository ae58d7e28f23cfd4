// A USB bus with emulated devices below the real libusb; umockdev emulates sysfs, udev events and system calls. The
// program must run under umockdev-wrapper. The ioctl handlers run in threads of this process; libusb may run in this
// process or in a child process.
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
  ~MockUsb();  // close every HidPort of the bus first. NOLINT(bugprone-exception-escape): an exception ends the test
  MockUsb(const MockUsb&) = delete;
  MockUsb& operator=(const MockUsb&) = delete;

  // Plugs the gadget in and sends a udev event. A gadget that is plugged in again gets a new device number. The gadget
  // must outlive the bus.
  void plug(UsbGadget& gadget, const UsbPlug& plug = {});
  void unplug(UsbGadget& gadget);

  // These functions refer to the gadget's latest connection.
  UsbNodeCounts counts(UsbGadget& gadget) const;
  bool driver_bound(UsbGadget& gadget) const;
  void set_faults(UsbGadget& gadget, const UsbWireFaults& faults);

  // The bus holds this mutex whenever it calls a gadget, which it does from two threads.
  std::mutex& mutex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::test
