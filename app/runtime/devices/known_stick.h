// Saved data of a calibrated stick: its calibration, and its report descriptor when it was calibrated. With these data
// the program can wait for a stick that is not plugged in, and detect that a stick's reports have changed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "haptics/hardware/device_calibration.h"

namespace gearshift::runtime {

struct KnownStick {
  haptics::DeviceCalibration calibration;
  std::vector<std::uint8_t> report_descriptor;
};

// The stick's identity without a USB port, so that it matches the stick at any port.
haptics::HidIdentity identity_of(const haptics::DeviceCalibration& calibration);

// Returns the stick's product name, or stick_id() if the product name is empty.
std::string stick_name(const haptics::HidIdentity& identity);
std::string stick_id(const haptics::HidIdentity& identity);  // vendor and product id, e.g. "045e:001b"

// Lists what must still be measured before the stick may render forces; empty if nothing is missing.
std::string describe_missing(const haptics::DeviceCalibration& calibration);

// A table of what was measured, one line per row: per axis, or for the whole stick. What is not used says why.
std::vector<std::string> calibration_table(const haptics::DeviceCalibration& calibration);

// Returns the device's saved data; empty if it was never calibrated. Throws FileError.
std::optional<KnownStick> read_known_stick(const std::filesystem::path& folder, const haptics::HidIdentity& device);

// All calibrated sticks in a folder; empty if the folder does not exist.
struct KnownSticks {
  std::vector<KnownStick> sticks;
  std::vector<std::string> problems;  // one sentence per damaged file
};
KnownSticks known_sticks(const std::filesystem::path& folder);

// Creates the folder if needed. Returns the path of the calibration file. Throws FileError.
std::filesystem::path save_known_stick(const KnownStick& stick, const std::filesystem::path& folder);

}  // namespace gearshift::runtime
