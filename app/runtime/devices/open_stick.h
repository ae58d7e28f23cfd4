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

// Null if no plugged-in stick matches. Throws like select_stick() if several match.
const ListedStick* find_plugged_stick(const std::string& wanted, std::span<const ListedStick> plugged);

// `wanted` is a part of the name in any case, VENDOR:PRODUCT, the serial or the port; whole matches of the last three
// have priority over the name. Exactly one plugged-in stick must match. Throws std::runtime_error with one sentence
// that lists the candidates.
const ListedStick& select_stick(const std::string& wanted, std::span<const ListedStick> plugged);

// Throws std::runtime_error with one sentence if access is denied or it has no force feedback.
void check_can_push(const ListedStick& stick);

struct ResolvedStick {
  haptics::HidIdentity
      identity;  // identity to open; includes the port only if nothing else tells it from another stick
  int interface = haptics::kFirstInterface;
  KnownStick known;
};

// Finds a calibrated stick: plugged in, or known from its saved calibration and waited for. Throws as above, and also
// if it has no force feedback, access is denied or it is not calibrated.
ResolvedStick resolve_stick(const std::string& wanted, std::span<const ListedStick> plugged,
                            const std::filesystem::path& folder);

// Finds and opens the stick. folder: of the calibrations. Throws std::runtime_error (or HidError, FileError) with one
// sentence.
std::shared_ptr<StickLever> open_stick(const std::string& wanted, const std::filesystem::path& folder);

}  // namespace gearshift::runtime
