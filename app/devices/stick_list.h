// Which sticks are plugged in, and what each can do: told from its descriptor alone, nothing is moved.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "haptics/hid/pid_layout.h"
#include "haptics/usb/usb_hid.h"

namespace gearshift {

enum class StickForce : std::uint8_t {
  unknown,  // it cannot be looked into
  none,
  rumble,  // motors that shake: they push nowhere
  pushes
};

struct ListedStick {
  HidIdentity identity;
  int interface = 0;
  std::vector<std::uint8_t> report_descriptor;  // empty: not known
  std::size_t axes = 0, buttons = 0;
  StickForce force = StickForce::unknown;
  std::vector<PidEffect> effects;  // that it makes, where it pushes
  bool calibrated = false;         // all that is needed before it may push
  std::string missing;             // of its calibration, where it pushes
  std::string problem;             // one sentence; empty: none
};

// Sticks, pads and wheels among them, and what cannot be looked into. folder: of the calibrations.
std::vector<ListedStick> list_sticks(std::span<const UsbHidDevice> devices, const std::filesystem::path& folder);

// What is wrong with calibrations of sticks that are not plugged in, one sentence each.
std::vector<std::string> absent_problems(std::span<const ListedStick> plugged, const std::filesystem::path& folder);

bool is_forbidden(const ListedStick& stick);  // a rule of udev's would let this user have it

std::string force_words(
    const ListedStick& stick);  // "constant force, spring, damper, 8 others", "no force feedback", ...
std::string calibration_words(const ListedStick& stick);  // "yes", "no", "begun: ... missing", "-" where none is needed

}  // namespace gearshift
