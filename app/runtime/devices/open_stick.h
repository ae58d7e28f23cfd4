// Finds and opens the stick that the user has named.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/runtime/devices/known_stick.h"
#include "app/runtime/devices/stick_lever.h"
#include "app/runtime/devices/stick_list.h"

namespace gearshift::runtime {

// Returns the plugged-in stick that matches `wanted`, or null if none does. Throws like select_stick() if several
// sticks match.
const ListedStick* find_plugged_stick(const std::string& wanted, std::span<const ListedStick> plugged);

// Returns the only plugged-in stick that matches `wanted`. `wanted` is a part of the name (upper or lower case),
// VENDOR:PRODUCT, the serial number or the port. A match with one of the last three has priority over the name. If no
// stick or several sticks match, throws std::runtime_error with a one-sentence message that lists the candidates.
const ListedStick& select_stick(const std::string& wanted, std::span<const ListedStick> plugged);

// Throws std::runtime_error with a one-sentence message if access to the stick is denied or the stick has no force
// feedback.
void check_has_forces(const ListedStick& stick);

struct ResolvedStick {
  // The identity to open. It contains the port only if the user named the stick by its port, or if an identical stick
  // is plugged in.
  haptics::HidIdentity identity;
  int interface = haptics::kFirstInterface;
  KnownStick known;
};

// Finds a calibrated stick: one that is plugged in, or else one with a saved calibration, for which the program will
// wait. Throws like select_stick() and check_has_forces(), and also if the stick is not calibrated.
ResolvedStick resolve_stick(const std::string& wanted, std::span<const ListedStick> plugged,
                            const std::filesystem::path& folder);

// Finds and opens the stick. `folder` contains the calibrations. Throws std::runtime_error, HidError or FileError with
// a one-sentence message.
std::shared_ptr<StickLever> open_stick(const std::string& wanted, const std::filesystem::path& folder);

}  // namespace gearshift::runtime
