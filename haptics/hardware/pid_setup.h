// The reports that are sent to a stick before and after streaming.
//
//   prepare_stick  pool -> stop all -> reset -> stop all -> actuators off -> gain 0 -> each effect: create, block load,
//                  values, settings, values zero (EffectReports) -> actuators off -> gain full
//   silence_stick  stop effects -> stop all -> actuators off -> free blocks -> reset -> stop all -> actuators off
//
// A reset switches the actuators on (PID 1.0 section 5.9), and on some boards setting an effect does too, so the
// actuators are switched off again afterwards. A reset may also switch a centring spring on, or mute all effects, until
// they are all stopped. The effects are constant X, constant Y, spring and damper.
//
// This work is based on:
// USB Implementers' Forum. Device Class Definition for Physical Interface Devices (PID), version 1.0. 1999
#pragma once

#include <string>
#include <vector>

#include "haptics/hardware/report_scheduler.h"
#include "haptics/hid/hid_port.h"

namespace gearshift::haptics {

struct PidAbility {
  bool spring = false, damper = false;
  bool finite = true;              // effects end by themselves; false: the device refuses a duration (see `notes`)
  int blocks = 0;                  // effect blocks allocated
  std::vector<std::string> notes;  // missing capabilities, one sentence each
};

struct PreparedStick {
  StickBlocks blocks{};
  PidAbility ability;
};

// Throws HidDisconnected if the stick was unplugged, and HidError if the device cannot make a constant force. The
// motors are switched off before HidError is thrown.
PreparedStick prepare_stick(HidPort& port, const PidLayout& pid, StickStyle style = {});

// Repeats the reports that switch the motors off until the stick has accepted them, for about a second at most.
void silence_stick(HidPort& port, const PidLayout& pid, const StickBlocks& blocks) noexcept;

}  // namespace gearshift::haptics
