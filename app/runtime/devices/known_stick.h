// Saved data of a calibrated stick: its calibration and the report descriptor it had then. With these the program can
// wait for a stick that is not plugged in and notice one whose reports have changed.
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

haptics::HidIdentity identity_of(
    const haptics::DeviceCalibration& calibration);  // without a port: matches the stick anywhere

// Its product name, or its ids: "045e:001b".
std::string stick_name(const haptics::HidIdentity& identity);
std::string stick_id(const haptics::HidIdentity& identity);  // "045e:001b"

// Lists what must still be measured before forces are allowed; empty: nothing.
std::string describe_missing(const haptics::DeviceCalibration& calibration);

// Empty if it was never calibrated. Throws FileError.
std::optional<KnownStick> read_known_stick(const std::filesystem::path& folder, const haptics::HidIdentity& device);

// All readable calibrations in the folder; empty if the folder does not exist.
struct KnownSticks {
  std::vector<KnownStick> sticks;
  std::vector<std::string> problems;  // one sentence per damaged file
};
KnownSticks known_sticks(const std::filesystem::path& folder);

// Creates the folder if needed. Returns the calibration file. Throws FileError.
std::filesystem::path save_known_stick(const KnownStick& stick, const std::filesystem::path& folder);

}  // namespace gearshift::runtime
