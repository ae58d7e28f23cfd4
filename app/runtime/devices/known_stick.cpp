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

std::vector<std::string> calibration_table(const haptics::DeviceCalibration& calibration) {
  const haptics::LeverAxisCalibration &select = calibration.select, &shift = calibration.shift;
  std::vector<std::string> rows;
  const auto add = [&rows](const char* what, const std::string& left, const std::string& right) {
    rows.push_back(fmt::format("  {:<18}{:<36}{}", what, left, right));
  };
  const auto per_axis = [&](const char* what, const auto& text) { add(what, text(select), text(shift)); };
  const auto sign = [](int value, const char* positive, const char* negative) {
    return value > 0 ? positive : value < 0 ? negative : "not measured";
  };
  add("", "select", "shift");
  per_axis("full force", [](const auto& axis) { return fmt::format("{:.3g} N", axis.full_force); });
  add("positive force",
      calibration.select_by_position ? "not used" : sign(select.constant_sign, "pushes right", "pushes left"),
      sign(shift.constant_sign, "pushes forward", "pushes back"));
  per_axis("even forces", [](const auto& axis) {
    return axis.constant_limit == 0.0 ? std::string("not measured")
                                      : fmt::format("up to {:.0f} % of the magnitude", 100.0 * axis.constant_limit);
  });
  per_axis("largest force", [](const auto& axis) {
    return axis.constant_limit == 0.0 ? std::string("not measured")
                                      : fmt::format("{:.3g} N", axis.max_magnitude() * axis.force_per_magnitude());
  });
  per_axis("handle", [](const auto& axis) {
    return axis.handle.mass == 0.0 ? std::string("not measured")
                                   : fmt::format("{:.3f} kg, {:.1f} N s/m, {:.0f} N/m", axis.handle.mass,
                                                 axis.handle.damping, axis.handle.stiffness);
  });
  per_axis("dry friction", [](const auto& axis) {
    if (axis.handle.mass == 0.0) return std::string("not measured");  // is measured with the handle
    return axis.friction == 0.0 ? std::string("none") : fmt::format("{:.2f} N", axis.friction);
  });
  per_axis("own centring", [](const auto& axis) {
    if (axis.handle.mass == 0.0) return std::string("not measured");  // is measured with the handle
    return axis.own_spring == 0.0 ? std::string("none") : fmt::format("{:.0f} N/m", axis.own_spring);
  });
  if (!calibration.springs_refused.empty()) {
    rows.push_back("  springs           not used: " + calibration.springs_refused);
  } else {
    per_axis("springs", [](const auto& axis) {
      return axis.spring_dead_band == 0.0
                 ? std::string("not measured")
                 : fmt::format("{:.0f} N/m, {}", axis.spring_stiffness, axis.spring_sign > 0 ? "pulls" : "inverted");
    });
    per_axis("dead band", [](const auto& axis) {
      return axis.spring_dead_band == 0.0 ? std::string("not measured")
                                          : fmt::format("{:.0f} % of the commanded", 100.0 * axis.spring_dead_band);
    });
  }
  if (!calibration.dampers_refused.empty()) {
    rows.push_back("  dampers           not used: " + calibration.dampers_refused);
  } else {
    per_axis("dampers", [](const auto& axis) {
      return axis.damper_sign == 0
                 ? std::string("not measured")
                 : fmt::format("{:.1f} N s/m, {}", axis.damper_strength, axis.damper_sign > 0 ? "brakes" : "inverted");
    });
  }
  using Axis = haptics::LeverAxisCalibration;
  const auto add_cross_talk = [&](const char* what, double Axis::*cross_talk) {
    per_axis(what, [&](const auto& axis) {
      return axis.*cross_talk < 0.0 ? std::string("not measured") : fmt::format("{:.0f} %", 100.0 * axis.*cross_talk);
    });
  };
  if (select.constant_coupling != 0.0 || shift.constant_coupling != 0.0)
    per_axis("coupling",
             [](const auto& axis) { return fmt::format("{:.0f} %, cancelled", 100.0 * axis.constant_coupling); });
  add_cross_talk("cross-talk", &Axis::constant_cross_talk);
  if (calibration.springs_refused.empty()) add_cross_talk("  of springs", &Axis::spring_cross_talk);
  if (calibration.dampers_refused.empty()) add_cross_talk("  of dampers", &Axis::damper_cross_talk);
  rows.push_back(calibration.effects_at_once == 0 ? std::string("  effects at once   not measured")
                                                  : fmt::format("  effects at once   {}", calibration.effects_at_once));
  const haptics::DeviceTiming& timing = calibration.timing;
  if (!calibration.has_timing()) {
    rows.push_back("  timing            not measured");
  } else {
    rows.push_back(
        fmt::format("  timing            a reading every {:.2f} ms (jitter {:.2f} ms), a force every {:.2f} ms, "
                    "delay {:.2f} ms, {:.1f} ms of silence at a renewal",
                    1e3 * timing.input_interval, 1e3 * timing.jitter, 1e3 * timing.output_interval, 1e3 * timing.delay,
                    1e3 * timing.restart_gap));
  }
  return rows;
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
