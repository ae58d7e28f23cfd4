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
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"
#include "haptics/files/toml_text.h"
#include "haptics/files/verified_file.h"
#include "haptics/hardware/device_calibration.h"

namespace gearshift::haptics {
namespace {

constexpr Range kId{0.0, 65535.0}, kCounts{-2147483648.0, 4294967295.0}, kSign{-1.0, 1.0}, kButton{0.0, 64.0};
constexpr Range kTravel{0.0, 1.0}, kForce{0.0, 200.0}, kStiffness{0.0, 1e5}, kDamping{0.0, 1e3}, kTime{0.0, 1.0},
    kDeadBand{0.0, 10.0}, kMagnitude{0.0, 1.0}, kSlope{0.01, 10.0}, kCrossTalk{0.0, 10.0}, kCoupling{-0.9, 0.9},
    kEffects{1.0, 4.0};
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

template <class Integer>
void read_integer(const TomlTable& table, std::string_view key, Integer& value, Range range) {
  const double number = table.number(key, range);
  if (number != std::floor(number))
    table.fail(key, "must be a whole number between " + number_text(range.min) + " and " + number_text(range.max));
  value = static_cast<Integer>(number);
}

int read_axis_name(const TomlTable& table) {
  std::vector<std::string> names;
  for (const AxisName& name : kAxisNames) names.emplace_back(name.first);
  const std::string word = table.choice("axis", names);
  const auto found =
      std::find_if(kAxisNames.begin(), kAxisNames.end(), [&](const AxisName& name) { return name.first == word; });
  return found->second;
}

// Reads a value that is either 0 (not known) or at least `min`.
double read_known(const TomlTable& table, std::string_view key, Range range, double min) {
  const double value = table.number(key, range);
  if (value > 0.0 && value < min) {
    table.fail(key, "must be 0 (unknown) or between " + number_text(min) + " and " + number_text(range.max));
  }
  return value;
}

void read_handle(const TomlTable& table, AxisModel& handle) {
  handle.mass = table.number("mass_kg", {0.0, 1e3});
  if (handle.mass > 0.0 && handle.mass < 1e-3) table.fail("mass_kg", "must be 0 (not measured) or at least 0.001");
  handle.damping = table.number("damping_n_s_per_m", {0.0, 1e4});
  handle.stiffness = table.number("stiffness_n_per_m", {0.0, 1e6});
  table.reject_unknown_keys();
}

void read_lever_axis(const TomlTable& table, LeverAxisCalibration& axis) {
  axis.usage = read_axis_name(table);
  axis.low = table.number("low_counts", kCounts);
  axis.centre = table.number("centre_counts", kCounts);
  axis.high = table.number("high_counts", kCounts);
  const bool between = (axis.centre - axis.low) * (axis.high - axis.centre) > 0.0;
  if (axis.low != axis.high && !between) table.fail("centre_counts", "must lie between low_counts and high_counts");
  axis.travel = read_known(table, "travel_m", kTravel, kMinTravel);
  axis.full_force = read_known(table, "full_force_n", kForce, kMinForce);
  read_integer(table, "constant_sign", axis.constant_sign, kSign);
  read_integer(table, "spring_sign", axis.spring_sign, kSign);
  axis.spring_stiffness = table.number("spring_stiffness_n_per_m", kStiffness);
  if (table.has("damper_sign")) read_integer(table, "damper_sign", axis.damper_sign, kSign);
  if (table.has("damper_n_s_per_m")) axis.damper_strength = table.number("damper_n_s_per_m", kDamping);
  if (table.has("spring_dead_band")) axis.spring_dead_band = table.number("spring_dead_band", kDeadBand);
  if (table.has("own_spring_n_per_m")) axis.own_spring = table.number("own_spring_n_per_m", kStiffness);
  if (table.has("constant_limit")) {
    axis.constant_limit = table.number("constant_limit", kMagnitude);
    axis.constant_slope = table.number("constant_slope", kSlope);
  }
  if (table.has("constant_coupling")) axis.constant_coupling = table.number("constant_coupling", kCoupling);
  if (table.has("constant_cross_talk")) axis.constant_cross_talk = table.number("constant_cross_talk", kCrossTalk);
  if (table.has("spring_cross_talk")) axis.spring_cross_talk = table.number("spring_cross_talk", kCrossTalk);
  if (table.has("damper_cross_talk")) axis.damper_cross_talk = table.number("damper_cross_talk", kCrossTalk);
  read_handle(table.table("handle"), axis.handle);
  table.reject_unknown_keys();
}

void read_timing(const TomlTable& table, DeviceTiming& timing) {
  timing.input_interval = table.number("input_interval_s", kTime);
  timing.output_interval = table.number("output_interval_s", kTime);
  timing.delay = table.number("delay_s", kTime);
  timing.jitter = table.number("jitter_s", kTime);
  if (table.has("restart_gap_s")) timing.restart_gap = table.number("restart_gap_s", kTime);
  table.reject_unknown_keys();
}

constexpr std::array<std::pair<std::string_view, AxisStyle>, 3> kStyles{
    {{"direction", AxisStyle::direction}, {"both", AxisStyle::both}, {"bits", AxisStyle::bits}}};
constexpr std::array<std::pair<std::string_view, SignStyle>, 2> kSigns{
    {{"magnitude", SignStyle::magnitude}, {"direction", SignStyle::direction}}};

template <class Style, std::size_t N>
Style read_style(const TomlTable& table, std::string_view key,
                 const std::array<std::pair<std::string_view, Style>, N>& styles) {
  std::vector<std::string> names;
  for (const auto& style : styles) names.emplace_back(style.first);
  const std::string word = table.choice(key, names);
  return std::find_if(styles.begin(), styles.end(), [&](const auto& style) { return style.first == word; })->second;
}

template <class Style, std::size_t N>
std::string style_name(Style wanted, const std::array<std::pair<std::string_view, Style>, N>& styles) {
  for (const auto& [name, style] : styles)
    if (style == wanted) return std::string(name);
  return "unknown";
}

constexpr StickStyle kOldStyle{AxisStyle::both, AxisStyle::bits};  // of files from before the styles were measured

void read_effects(const TomlTable& table, DeviceCalibration& calibration) {
  calibration.style = {read_style(table, "constants_by", kStyles), read_style(table, "conditions_by", kStyles)};
  if (table.has("signs_by")) calibration.style.signs = read_style(table, "signs_by", kSigns);
  calibration.select_by_position = table.flag_or("select_by_position", false);
  calibration.holds_spring = table.flag_or("holds_spring", false);
  if (table.has("at_once")) read_integer(table, "at_once", calibration.effects_at_once, kEffects);
  if (table.has("springs_refused")) calibration.springs_refused = table.text("springs_refused");
  if (table.has("dampers_refused")) calibration.dampers_refused = table.text("dampers_refused");
  table.reject_unknown_keys();
}

void read_buttons(const TomlTable& table, DeviceCalibration& calibration) {
  read_integer(table, "press", calibration.press_button, kButton);
  read_integer(table, "lift", calibration.lift_button, kButton);
  read_integer(table, "stop", calibration.stop_button, kButton);
  table.reject_unknown_keys();
}

std::string hex_of(std::uint16_t value) {
  char digits[8] = "0000";
  const std::string_view all(digits,
                             static_cast<std::size_t>(std::to_chars(digits, digits + 8, value, 16).ptr - digits));
  return std::string(4 - all.size(), '0') + std::string(all);
}

// Builds TOML text with an explanatory comment at the end of each line.
class CommentedText {
 public:
  void comment(std::string_view comment_text) { text_ += "# " + std::string(comment_text) + '\n'; }
  void section(std::string_view name, std::string_view comment_text) {
    text_ += '\n';
    line("[" + std::string(name) + "]", comment_text);
  }
  void put(std::string_view key, const std::string& value, std::string_view comment_text) {
    line(std::string(key) + " = " + value, comment_text);
  }
  void put(std::string_view key, double value, std::string_view comment_text) {
    put(key, toml_number(value), comment_text);
  }
  std::string take() { return std::move(text_); }

 private:
  void line(std::string left, std::string_view comment_text) {
    constexpr std::size_t kColumn = 40;
    if (!comment_text.empty() && left.size() < kColumn) left.resize(kColumn, ' ');
    text_ += left + (comment_text.empty() ? "" : "  # " + std::string(comment_text)) + '\n';
  }

  std::string text_;
};

std::string axis_name(int usage) {
  for (const AxisName& name : kAxisNames)
    if (name.second == usage) return std::string(name.first);
  return "unknown";
}

// Comments that fit both axes are written at the first.
void put_axis(CommentedText& out, const std::string& section, const LeverAxisCalibration& axis, bool is_select) {
  const auto once = [&](std::string_view comment) { return is_select ? comment : std::string_view(); };
  out.section(section, is_select ? "lever to the right (+) and to the left (-)" : "lever forward (+) and back (-)");
  out.put("axis", toml_string(axis_name(axis.usage)), once("axis of the device; only x and y have motors"));
  out.put("low_counts", axis.low, is_select ? "at the left stop" : "at the back stop");
  out.put("centre_counts", axis.centre, once("at rest"));
  out.put("high_counts", axis.high, is_select ? "at the right stop" : "at the forward stop");
  out.put("travel_m", axis.travel, once("travel of the knob from stop to stop"));
  out.put("full_force_n", axis.full_force, once("force at the knob at full magnitude"));
  out.put("constant_sign", axis.constant_sign,
          is_select ? "1: a positive force pushes right; -1: left" : "1: a positive force pushes forward; -1: back");
  out.put("spring_sign", axis.spring_sign, once("1: a spring pulls to its centre; -1: pushes away from it"));
  out.put("spring_stiffness_n_per_m", axis.spring_stiffness, once("strongest spring; 0: not measured"));
  out.put("damper_sign", axis.damper_sign, once("1: a damper brakes the lever; -1: drives it"));
  out.put("damper_n_s_per_m", axis.damper_strength, once("strongest damper; 0: not measured"));
  out.put("spring_dead_band", axis.spring_dead_band, once("its measured over its commanded width; 0: unknown"));
  out.put("own_spring_n_per_m", axis.own_spring, once("centring by its motors; 0: none"));
  if (axis.constant_limit > 0.0) {
    out.put("constant_limit", axis.constant_limit, once("forces grow evenly up to this magnitude"));
    out.put("constant_slope", axis.constant_slope, once("force per magnitude, over full_force_n"));
  }
  if (axis.constant_coupling != 0.0)
    out.put("constant_coupling", axis.constant_coupling, once("motion of the other axis by a force, cancelled"));
  const auto put_cross_talk = [&](std::string_view key, double value, std::string_view comment) {
    if (value >= 0.0) out.put(key, value, once(comment));
  };
  put_cross_talk("constant_cross_talk", axis.constant_cross_talk, "motion of the other axis over this one's");
  put_cross_talk("spring_cross_talk", axis.spring_cross_talk, "");
  put_cross_talk("damper_cross_talk", axis.damper_cross_talk, "");
  out.section(section + ".handle", once("handle without a hand"));
  out.put("mass_kg", axis.handle.mass, once("0: not measured"));
  out.put("damping_n_s_per_m", axis.handle.damping, "");
  out.put("stiffness_n_per_m", axis.handle.stiffness, "");
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
  const TomlTable root = TomlTable::parse(read_text_file(file), file.string());
  DeviceCalibration calibration;
  if (root.has("name")) calibration.name = root.text("name");
  read_integer(root, "vendor", calibration.vendor, kId);
  read_integer(root, "product", calibration.product, kId);
  if (root.has("serial")) calibration.serial = root.text("serial");
  read_lever_axis(root.table("select"), calibration.select);
  read_lever_axis(root.table("shift"), calibration.shift);
  if (calibration.select.usage == calibration.shift.usage)
    root.table("shift").fail("axis", "must differ from the axis of select");
  read_timing(root.table("timing"), calibration.timing);
  calibration.style = kOldStyle;
  if (root.has("effects")) read_effects(root.table("effects"), calibration);
  read_buttons(root.table("buttons"), calibration);
  root.reject_unknown_keys();
  return calibration;
}

std::string calibration_text(const DeviceCalibration& calibration) {
  CommentedText out;
  out.comment("Calibration of this stick. Counts are the device's own units; metres and newtons are at the knob.");
  if (!calibration.name.empty()) out.put("name", toml_string(calibration.name), "as reported by the device");
  out.put("vendor", "0x" + hex_of(calibration.vendor), "");
  out.put("product", "0x" + hex_of(calibration.product), "");
  if (!calibration.serial.empty()) out.put("serial", toml_string(calibration.serial), "");
  put_axis(out, "select", calibration.select, true);
  put_axis(out, "shift", calibration.shift, false);
  const DeviceTiming& timing = calibration.timing;
  out.section("timing", "intervals and delay of the device");
  out.put("input_interval_s", timing.input_interval, "time between two readings; 0: not measured");
  out.put("output_interval_s", timing.output_interval, "time between two force commands");
  out.put("delay_s", timing.delay, "time from sending a force to its effect");
  out.put("jitter_s", timing.jitter, "99 % of the readings are at most this late");
  out.put("restart_gap_s", timing.restart_gap, "silence when an effect is renewed");
  out.section("effects", "how they name their axes: direction, both or bits");
  out.put("constants_by", toml_string(style_name(calibration.style.constants, kStyles)), "");
  out.put("conditions_by", toml_string(style_name(calibration.style.conditions, kStyles)), "");
  if (calibration.style.signs != SignStyle::magnitude)
    out.put("signs_by", toml_string(style_name(calibration.style.signs, kSigns)), "of constant forces");
  if (calibration.select_by_position) out.put("select_by_position", "true", "select has no motor");
  if (calibration.holds_spring)
    out.put("holds_spring", "true", "a spring without a force keeps the stick from centring by itself");
  if (calibration.effects_at_once > 0) out.put("at_once", calibration.effects_at_once, "so many act at the same time");
  if (!calibration.springs_refused.empty())
    out.put("springs_refused", toml_string(calibration.springs_refused), "so springs are not used");
  if (!calibration.dampers_refused.empty())
    out.put("dampers_refused", toml_string(calibration.dampers_refused), "so dampers are not used");
  out.section("buttons", "numbered from 1; 0: no button");
  out.put("press", calibration.press_button, "pushes the knob down");
  out.put("lift", calibration.lift_button, "lifts the ring");
  out.put("stop", calibration.stop_button, "switches the motors off");
  return out.take();
}

void write_calibration(const DeviceCalibration& calibration, const std::filesystem::path& file) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  if (error) throw FileError(file.string(), 0, "cannot be written (" + error.message() + ")");
  write_verified_file(file, calibration_text(calibration),
                      [](const auto& written_file) { (void)read_calibration(written_file); });
}

}  // namespace gearshift::haptics
