// What is told to a stick before it streams, and after.
//
//   prepare_stick  pool -> stop all -> reset -> actuators off -> gain 0 -> each effect: create, block load, set, values zero
//                  -> actuators off -> gain full
//   quiet_stick    stop all -> actuators off -> blocks freed -> reset -> actuators off
//
// A reset switches actuators on (PID 1.0 section 5.9), and so does an effect that is set, on some boards: hence off again.
// Effects: constant X, constant Y, spring, damper.
//
// This work is based on:
// USB Implementers' Forum. Device Class Definition for Physical Interface Devices (PID), version 1.0. 1999
#pragma once

#include <string>
#include <vector>

#include "haptics/hardware/pid_stream.h"
#include "haptics/hid/hid_port.h"

namespace gearshift {

// Of a device as a whole, once prepared.
struct PidAbility {
  bool spring = false, damper = false;
  bool finite = true;              // effects end by themselves; false: it refuses, and it is said
  int blocks = 0;                  // that it gave
  std::vector<std::string> notes;  // what it does not do, one sentence each
};

struct PreparedStick {
  StickBlocks blocks{};
  PidAbility ability;
};

// Throws HidGone, HidError: it has no constant force to give. Then it is left quiet.
PreparedStick prepare_stick(HidPort& port, const PidLayout& pid);

void quiet_stick(HidPort& port, const PidLayout& pid, const StickBlocks& blocks) noexcept;  // as much as it still takes

}  // namespace gearshift
