// Lists the plugged-in sticks and their abilities, from their descriptors only: moves nothing.
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
  unknown,  // its descriptor cannot be read
  none,
  rumble,  // vibration motors without a direction
  force_feedback
};

struct ListedStick {
  haptics::HidIdentity identity;
  int interface = 0;
  std::vector<std::uint8_t> report_descriptor;  // empty: unknown
  std::size_t axes = 0, buttons = 0;
  StickForce force = StickForce::unknown;
  std::vector<haptics::PidEffect> effects;  // supported effects, if it has force feedback
  bool calibrated = false;                  // has everything that forces require
  std::string missing;                      // missing parts of its calibration, if it has force feedback
  std::string problem;                      // one sentence; empty: none
};

// Sticks, pads and wheels, and devices whose descriptor cannot be read. folder: of the calibrations.
std::vector<ListedStick> list_sticks(std::span<const haptics::UsbHidDevice> devices,
                                     const std::filesystem::path& folder);

// Problems of calibrations of sticks that are not plugged in, one sentence each.
std::vector<std::string> absent_problems(std::span<const ListedStick> plugged, const std::filesystem::path& folder);

bool lacks_permission(const ListedStick& stick);  // a udev rule would give this user access

std::string describe_forces(
    const ListedStick& stick);  // "constant force, spring, damper, 8 others", "no force feedback", ...
std::string describe_calibration(
    const ListedStick& stick);  // "yes", "no", "incomplete: ... missing", "-" where none is needed

}  // namespace gearshift::runtime
