// Lists the plugged-in sticks and their abilities. Reads only their descriptors, so that no stick moves.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "haptics/hid/pid_layout.h"
#include "haptics/usb/usb_hid.h"

namespace gearshift::runtime {

enum class StickForce : std::uint8_t {
  unknown,  // the stick's descriptor cannot be read
  none,
  rumble,  // has vibration motors, which push in no direction
  force_feedback
};

struct ListedStick {
  haptics::HidIdentity identity;
  int interface = 0;
  std::vector<std::uint8_t> report_descriptor;  // empty: unknown
  std::size_t axes = 0, buttons = 0;
  StickForce force = StickForce::unknown;
  std::vector<haptics::PidEffect> effects;  // supported effects, if the stick has force feedback
  bool calibrated = false;                  // true if the calibration is complete enough for forces
  std::string missing;                      // missing parts of the calibration, if the stick has force feedback
  std::string problem;                      // one sentence; empty: no problem
};

// Returns all sticks, pads and wheels among the devices, and the devices whose descriptor cannot be read. `folder`
// contains the calibrations.
std::vector<ListedStick> list_sticks(std::span<const haptics::UsbHidDevice> devices,
                                     const std::filesystem::path& folder);

// Describes damaged calibration files of sticks that are not plugged in, one sentence for each.
std::vector<std::string> absent_problems(std::span<const ListedStick> plugged, const std::filesystem::path& folder);

bool needs_permission(const ListedStick& stick);  // true if access is denied and a udev rule would grant it

// Returns a text like "constant force, spring, damper, 8 others" or "no force feedback".
std::string describe_forces(const ListedStick& stick);
// Returns "yes", "no", "incomplete: ... missing", or "-" for a stick that needs no calibration.
std::string describe_calibration(const ListedStick& stick);

}  // namespace gearshift::runtime
