// How an emulated device is plugged in, which faults its connection has, and counts of the operations on its node.
#pragma once

#include <string>

namespace gearshift::test {

struct UsbPlug {
  std::string place = "1-1";  // bus number and port number
  bool driver_bound = true;   // the kernel's HID driver is bound
  bool in_use = false;        // a different program uses the device
  bool permitted = true;      // false: only root may open the device node
};

// Faults between the host controller and the device.
struct UsbWireFaults {
  int input_stalls = 0;        // the input endpoint halts at each of the next input_stalls transfers
  int output_stalls = 0;       // the output endpoint halts at each of the next output_stalls transfers
  bool output_stuck = false;   // output transfers never complete
  bool control_stuck = false;  // control transfers never complete
  bool garbled = false;        // input transfers end with a bus error
  int extra_bytes = 0;         // extra bytes after each input report; negative: missing bytes
};

struct UsbNodeCounts {
  int opened = 0, closed = 0;       // calls of open and close
  int claims = 0, releases = 0;     // claims and releases of interfaces
  int detached = 0, attached = 0;   // detachments and attachments of the kernel driver
  int submitted = 0, returned = 0;  // transfers submitted and returned
  // Number of transfers to an interface that is not claimed, plus number of times that an endpoint was cleared while a
  // transfer waited in it.
  int misuses = 0;
  bool operator==(const UsbNodeCounts&) const = default;
};

}  // namespace gearshift::test
