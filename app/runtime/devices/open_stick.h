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
// match.
const ListedStick* find_plugged_stick(const std::string& wanted, std::span<const ListedStick> plugged);

// `wanted` is a part of the name (upper or lower case), VENDOR:PRODUCT, the serial number or the port; full matches of
// the last three have priority over the name. Exactly one plugged-in stick must match. Throws std::runtime_error with
// one sentence that lists the candidates.
const ListedStick& select_stick(const std::string& wanted, std::span<const ListedStick> plugged);

// Throws std::runtime_error with one sentence if access to the stick is denied or it has no force feedback.
void check_has_forces(const ListedStick& stick);

struct ResolvedStick {
  // The identity to open. Contains the port only if the user named it or it is needed to tell identical sticks apart.
  haptics::HidIdentity identity;
  int interface = haptics::kFirstInterface;
  KnownStick known;
};

// Finds a calibrated stick: one that is plugged in, or else one that is known from its saved calibration and that the
// program will wait for. Throws like select_stick() and check_has_forces(), and if the stick is not calibrated.
ResolvedStick resolve_stick(const std::string& wanted, std::span<const ListedStick> plugged,
                            const std::filesystem::path& folder);

// Finds and opens the stick. folder: the folder of the calibrations. Throws std::runtime_error, HidError or FileError
// with one sentence.
std::shared_ptr<StickLever> open_stick(const std::string& wanted, const std::filesystem::path& folder);

}  // namespace gearshift::runtime
