// How an emulated device is plugged in, what goes wrong on its wire, and what was done to it.
#pragma once

#include <string>

namespace gearshift {

struct UsbPlug {
  std::string place = "1-1";  // bus and port
  bool driver_bound = true;   // the kernel's HID driver takes it
  bool taken = false;         // another program has it
  bool permitted = true;      // else nobody but root may open its node
};

// What goes wrong between controller and device.
struct UsbWireFaults {
  int input_stalls = 0;        // so often the input endpoint halts from now on
  int output_stalls = 0;       // the same of outputs
  bool output_stuck = false;   // output transfers end never
  bool control_stuck = false;  // control transfers end never
  bool garbled = false;        // input transfers end with a bus error
  int extra_bytes = 0;         // that follow each report; below 0: so many are missing
};

struct UsbNodeCounts {
  int opened = 0, closed = 0;         // files
  int claims = 0, releases = 0;       // of interfaces
  int detached = 0, attached = 0;     // the kernel's driver
  int submitted = 0, given_back = 0;  // transfers
  int misuses = 0;  // transfers to an interface that is not claimed, endpoints cleared while transfers wait in them
  bool operator==(const UsbNodeCounts&) const = default;
};

}  // namespace gearshift
