// The lever as the shifter of another program: gears out as buttons of a virtual joystick, telemetry in.
//
// Sockets and the virtual joystick are served by the calling thread, every 2 ms; the haptic thread only reads the newest
// telemetry.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/base/line_reader.h"
#include "app/runtime/devices/stick_lever.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/preset.h"

namespace gearshift::shifter {

struct ShifterConfig {
  haptics::GateLayout layout;
  haptics::Preset preset;
  vehicle::CarSpec car;                        // synchronisers and the ratios to begin with
  std::shared_ptr<runtime::StickLever> stick;  // null: a simulated hand shifts through every gear, which ends the run
  std::string telemetry;                       // "HOST:PORT"; empty: none
  std::string pedals;                          // /dev/input/event... whose axes are passed on; empty: none
};

// Slots of the gate, in the order of the joystick's buttons: forward gears, reverse, then other positions in the order
// of the file. Neutral has no button. In a sequential gate: up, down.
std::vector<int> button_slots(const haptics::Gate& gate);

// Prints a line for the user.
using ShifterOutput = std::function<void(const std::string& line)>;

// Returns when the program is asked to end, or after the simulated hand's last gear. Throws std::runtime_error,
// FileError or std::invalid_argument with one sentence.
void run_shifter(const ShifterConfig& config, base::LineReader& answers, const ShifterOutput& output);

}  // namespace gearshift::shifter
