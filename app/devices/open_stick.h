// From what a person calls a stick to the stick.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/devices/known_stick.h"
#include "app/devices/stick_lever.h"
#include "app/devices/stick_list.h"

namespace gearshift {

// Nothing where none is plugged in. Throws as chosen_stick() where it may be several.
const ListedStick* found_stick(const std::string& wanted, std::span<const ListedStick> plugged);

// Part of its name in any case, its VENDOR:PRODUCT, its serial or its place. The last three, whole, go before the first.
// Of those that are plugged in exactly one. Throws std::runtime_error with one sentence that lists what there is.
const ListedStick& chosen_stick(const std::string& wanted, std::span<const ListedStick> plugged);

// Throws std::runtime_error with one sentence: it may not be used, or has no forces.
void check_can_push(const ListedStick& stick);

struct WantedStick {
  HidIdentity identity;  // to be opened; where only its place tells it from another one, with that
  int interface = kFirstInterface;
  KnownStick known;
};

// The same among those that may be driven: one that is plugged in, else one that is known and waited for. Throws as above,
// too where it has no forces, may not be used or is not calibrated.
WantedStick wanted_stick(const std::string& wanted, std::span<const ListedStick> plugged,
                         const std::filesystem::path& folder);

// Looks, and opens it. folder: of the calibrations. Throws std::runtime_error (HidError and FileError are) with one
// sentence.
std::shared_ptr<StickLever> open_stick(const std::string& wanted, const std::filesystem::path& folder);

}  // namespace gearshift
