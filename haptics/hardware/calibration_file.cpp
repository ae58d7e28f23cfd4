// Reads and writes a DeviceCalibration as a commented TOML file.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "haptics/files/file_error.h"
#include "haptics/files/number_text.h"
#include "haptics/files/parameter_file.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"
#include "haptics/files/toml_text.h"
#include "haptics/files/verified_file.h"
#include "haptics/hardware/device_calibration.h"

namespace gearshift::haptics {
namespace {

constexpr Range kId{0.0, 65535.0};
constexpr double kMinTravel = 0.01, kMinForce = 0.1;  // [m], [N] smallest valid values; 0 means not known

using AxisName = std::pair<std::string_view, int>;  // name and usage ID on the HID Generic Desktop page
constexpr std::array<AxisName, 9> kAxisNames{{{"x", 0x30},
                                              {"y", 0x31},
                                              {"z", 0x32},
                                              {"rx", 0x33},
                                              {"ry", 0x34},
                                              {"rz", 0x35},
                                              {"slider", 0x36},
                                              {"dial", 0x37},
                                              {"wheel", 0x38}}};

std::uint16_t read_id(const TomlTable& table, std::string_view key) {
  const double number = table.number(key, kId);
  if (number != std::floor(number)) table.fail(key, "must be a whole number");
  return static_cast<std::uint16_t>(number);
}

int read_axis_name(const TomlTable& table) {
  std::vector<std::string> names;
  for (const AxisName& name : kAxisNames) names.emplace_back(name.first);
  const std::string word = table.choice("axis", names);
  const auto found =
      std::find_if(kAxisNames.begin(), kAxisNames.end(), [&](const AxisName& name) { return name.first == word; });
  return found->second;
}

// Throws unless the value is 0 (not known) or at least `min`.
void check_known(const TomlTable& table, const LeverAxisCalibration& axis, double LeverAxisCalibration::*member,
                 double min) {
  const auto& parameter = parameter_of(member);
  if (axis.*member > 0.0 && axis.*member < min)
    table.fail(parameter.key,
               "must be 0 (unknown) or between " + number_text(min) + " and " + number_text(parameter.range.max));
}

// A mass of 0: the handle was not measured.
void read_handle(const TomlTable& table, AxisModel& handle) {
  const auto& mass = parameter_of(&AxisModel::mass);
  if (table.number(mass.key, {0.0, mass.range.max}) == 0.0) return;
  read_parameters(table, handle, Missing::error);
  table.reject_unknown_keys();
}

// Other keys than the counts may be missing: what a file does not have was not measured.
void read_lever_axis(const TomlTable& table, LeverAxisCalibration& axis) {
  axis.usage = read_axis_name(table);
  axis.low = axis.centre = axis.high = HUGE_VAL;  // no valid default
  read_parameters(table, axis);
  const bool between = (axis.centre - axis.low) * (axis.high - axis.centre) > 0.0;
  if (axis.low != axis.high && !between)
    table.fail(parameter_of(&LeverAxisCalibration::centre).key, "must lie between low_counts and high_counts");
  check_known(table, axis, &LeverAxisCalibration::travel, kMinTravel);
  check_known(table, axis, &LeverAxisCalibration::full_force, kMinForce);
  read_handle(table.table("handle"), axis.handle);
  table.reject_unknown_keys();
}

constexpr StickStyle kOldStyle{AxisStyle::both, AxisStyle::bits};  // of files from before the styles were measured

// Calls visit(key, text, description) for each text of the effects.
void each_text(auto& calibration, auto&& visit) {
  visit("springs_refused", calibration.springs_refused, "so springs are not used");
  visit("dampers_refused", calibration.dampers_refused, "so dampers are not used");
}

void read_effects(const TomlTable& table, DeviceCalibration& calibration) {
  read_parameters(table, calibration.style);
  read_parameters(table, calibration);
  each_text(calibration, [&](const char* key, std::string& text, const char*) {
    if (table.has(key)) text = table.text(key);
  });
  table.reject_unknown_keys();
}

// Reads a table whose keys may be missing.
template <class S>
void read_table(const TomlTable& table, S& object) {
  read_parameters(table, object);
  table.reject_unknown_keys();
}

std::string hex_of(std::uint16_t value) {
  char digits[8] = "0000";
  const std::string_view all(digits,
                             static_cast<std::size_t>(std::to_chars(digits, digits + 8, value, 16).ptr - digits));
  return std::string(4 - all.size(), '0') + std::string(all);
}

std::string section(const std::string& name, const std::string& comment) {
  return '\n' + commented('[' + name + ']', comment);
}

std::string entry(const std::string& key, const std::string& value, const std::string& comment = "") {
  return commented(key + " = " + value, comment);
}

template <class S>
std::string entries(const S& object, bool has_comments = true) {
  std::string text;
  each_parameter(object, [&](const auto& parameter, const auto& value) {
    text += entry(parameter.key, value_text(parameter, value), has_comments ? parameter.description : "");
  });
  return text;
}

std::string axis_name(int usage) {
  for (const AxisName& name : kAxisNames)
    if (name.second == usage) return std::string(name.first);
  return "unknown";
}

// The comments, which fit both axes, are written at the first.
std::string axis_text(const std::string& name, const LeverAxisCalibration& axis, bool is_first) {
  return entry("axis", toml_string(axis_name(axis.usage)), is_first ? "only x and y have motors" : "") +
         entries(axis, is_first) + section(name + ".handle", is_first ? "handle without a hand" : "") +
         entries(axis.handle, false);
}

}  // namespace

std::filesystem::path calibration_file(const std::filesystem::path& folder, const HidIdentity& device) {
  std::string name = hex_of(device.vendor) + '_' + hex_of(device.product);
  if (!device.serial.empty()) name += '_';
  for (const char c : device.serial.substr(0, 64)) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-';
    name += plain ? c : '_';
  }
  return folder / (name + ".toml");
}

std::optional<DeviceCalibration> read_calibration(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::symlink_status(file, ignored).type() == std::filesystem::file_type::not_found)
    return std::nullopt;
  return parse_calibration(read_text_file(file), file.string());
}

DeviceCalibration parse_calibration(std::string_view text, const std::string& file_name) {
  const TomlTable root = TomlTable::parse(text, file_name);
  DeviceCalibration calibration;
  if (root.has("name")) calibration.name = root.text("name");
  calibration.vendor = read_id(root, "vendor");
  calibration.product = read_id(root, "product");
  if (root.has("serial")) calibration.serial = root.text("serial");
  read_lever_axis(root.table("select"), calibration.select);
  read_lever_axis(root.table("shift"), calibration.shift);
  if (calibration.select.usage == calibration.shift.usage)
    root.table("shift").fail("axis", "must differ from the axis of select");
  read_table(root.table("timing"), calibration.timing);
  calibration.style = kOldStyle;
  if (root.has("effects")) read_effects(root.table("effects"), calibration);
  read_table(root.table("buttons"), calibration.buttons);
  root.reject_unknown_keys();
  return calibration;
}

std::string calibration_text(const DeviceCalibration& calibration) {
  std::string text =
      "# Calibration of this stick. Counts are the device's own units; metres and newtons are at the knob. 0 is "
      "unknown.\n";
  if (!calibration.name.empty()) text += entry("name", toml_string(calibration.name), "as reported by the device");
  text += entry("vendor", "0x" + hex_of(calibration.vendor)) + entry("product", "0x" + hex_of(calibration.product));
  if (!calibration.serial.empty()) text += entry("serial", toml_string(calibration.serial));
  text += section("select", "right (+), left (-)");
  text += axis_text("select", calibration.select, true);
  text += section("shift", "forward (+), back (-)");
  text += axis_text("shift", calibration.shift, false);
  text += section("timing", "intervals and delay of the device") + entries(calibration.timing);
  text += section("effects", "direction, both or bits") + entries(calibration.style) + entries(calibration);
  each_text(calibration, [&](const char* key, const std::string& refused, const char* comment) {
    if (!refused.empty()) text += entry(key, toml_string(refused), comment);
  });
  return text + section("buttons", "numbered from 1; 0: no button") + entries(calibration.buttons);
}

void write_calibration(const DeviceCalibration& calibration, const std::filesystem::path& file) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  if (error) throw FileError(file.string(), 0, "cannot be written (" + error.message() + ")");
  write_verified_file(file, calibration_text(calibration),
                      [](const auto& written_file) { (void)read_calibration(written_file); });
}

}  // namespace gearshift::haptics
