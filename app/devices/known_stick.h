// What is kept of a stick that was calibrated: its calibration, and beside it the report descriptor that it had then. With
// these a stick that is not plugged in can be waited for, and one that has become another is noticed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "haptics/hardware/device_calibration.h"

namespace gearshift {

struct KnownStick {
  DeviceCalibration calibration;
  std::vector<std::uint8_t> report_descriptor;
};

HidIdentity identity_of(const DeviceCalibration& calibration);  // its place is empty: anywhere

// As it calls itself, or by its numbers: "045e:001b".
std::string stick_name(const HidIdentity& identity);
std::string stick_id(const HidIdentity& identity);  // "045e:001b"

// What is still to be measured before it may push, in words; empty: nothing.
std::string missing_words(const DeviceCalibration& calibration);

// Nothing where it was never calibrated. Throws FileError.
std::optional<KnownStick> read_known(const std::filesystem::path& folder, const HidIdentity& device);

// All that can be read in the folder; none where it is not there.
struct KnownSticks {
  std::vector<KnownStick> sticks;
  std::vector<std::string> problems;  // of files that are damaged, one sentence each
};
KnownSticks known_sticks(const std::filesystem::path& folder);

// Makes the folder. Returns the calibration's file. Throws FileError.
std::filesystem::path keep_known(const KnownStick& stick, const std::filesystem::path& folder);

}  // namespace gearshift
