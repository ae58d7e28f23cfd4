#include "app/runtime/devices/known_stick.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "haptics/files/atomic_file.h"
#include "haptics/files/file_error.h"

namespace gearshift::runtime {
namespace {

namespace fs = std::filesystem;

fs::path descriptor_file(fs::path calibration) {
  return calibration.replace_extension(".hid");
}

// Reads the saved report descriptor, and returns an empty one on failure. Without the descriptor the program can neither
// wait for a stick that is not plugged in nor detect that the stick's reports have changed.
std::vector<std::uint8_t> read_descriptor(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::optional<KnownStick> read_file(const fs::path& file) {
  std::optional<haptics::DeviceCalibration> calibration = haptics::read_calibration(file);
  if (!calibration) return std::nullopt;
  return KnownStick{std::move(*calibration), read_descriptor(descriptor_file(file))};
}

}  // namespace

haptics::HidIdentity identity_of(const haptics::DeviceCalibration& calibration) {
  haptics::HidIdentity identity;
  identity.vendor = calibration.vendor;
  identity.product = calibration.product;
  identity.serial = calibration.serial;
  identity.name = calibration.name;
  return identity;
}

std::string stick_id(const haptics::HidIdentity& identity) {
  return fmt::format("{:04x}:{:04x}", identity.vendor, identity.product);
}

std::string stick_name(const haptics::HidIdentity& identity) {
  return identity.name.empty() ? stick_id(identity) : identity.name;
}

std::string describe_missing(const haptics::DeviceCalibration& calibration) {
  std::string words;
  const auto add = [&words](bool is_there, const char* part) {
    if (!is_there) words += (words.empty() ? "" : ", ") + std::string(part);
  };
  add(calibration.has_stops(), "range");
  add(calibration.has_travel() && calibration.has_force(), "travel and force");
  add(calibration.has_timing(), "delay");
  add(calibration.has_polarity(), "force direction");
  return words;
}

std::optional<KnownStick> read_known_stick(const fs::path& folder, const haptics::HidIdentity& device) {
  const fs::path file = haptics::calibration_file(folder, device);
  std::optional<KnownStick> known = read_file(file);
  if (!known) return std::nullopt;
  const haptics::DeviceCalibration& found = known->calibration;
  const bool is_its = found.vendor == device.vendor && found.product == device.product && found.serial == device.serial;
  if (!is_its)
    throw haptics::FileError(
        file.string(), 0,
        fmt::format("this file is the calibration of {}, not of {}; delete the file and calibrate the stick again",
                    stick_id(identity_of(found)), stick_id(device)));
  return known;
}

KnownSticks known_sticks(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  KnownSticks known;
  for (const fs::path& file : files) {
    try {
      if (std::optional<KnownStick> stick = read_file(file)) known.sticks.push_back(std::move(*stick));
    } catch (const haptics::FileError& damaged) {
      known.problems.emplace_back(damaged.what());
    }
  }
  return known;
}

fs::path save_known_stick(const KnownStick& stick, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw haptics::FileError(folder.string(), 0, "cannot be created (" + error.message() + ")");
  fs::path file = haptics::calibration_file(folder, identity_of(stick.calibration));
  const auto* bytes = reinterpret_cast<const char*>(stick.report_descriptor.data());
  haptics::write_text_file(descriptor_file(file), {bytes, stick.report_descriptor.size()});
  haptics::write_calibration(stick.calibration, file);
  return file;
}

}  // namespace gearshift::runtime
