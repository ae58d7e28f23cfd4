// How an emulated device is plugged in, faults on its wire, and counts of what was done to it.
#pragma once

#include <string>

namespace gearshift::test {

struct UsbPlug {
  std::string place = "1-1";  // bus and port
  bool driver_bound = true;   // the kernel's HID driver is bound
  bool taken = false;         // another program uses it
  bool permitted = true;      // false: only root may open its node
};

// Faults between controller and device.
struct UsbWireFaults {
  int input_stalls = 0;        // number of times that the input endpoint halts from now on
  int output_stalls = 0;       // the same for the output endpoint
  bool output_stuck = false;   // output transfers never complete
  bool control_stuck = false;  // control transfers never complete
  bool garbled = false;        // input transfers end with a bus error
  int extra_bytes = 0;         // extra bytes after each report; negative: missing bytes
};

struct UsbNodeCounts {
  int opened = 0, closed = 0;       // files
  int claims = 0, releases = 0;     // of interfaces
  int detached = 0, attached = 0;   // kernel driver
  int submitted = 0, returned = 0;  // transfers
  int misuses = 0;  // transfers to an interface that is not claimed, endpoints cleared while transfers wait in them
  bool operator==(const UsbNodeCounts&) const = default;
};

}  // namespace gearshift::test
