// gearshift devices: lists the connected sticks and their capabilities, and calibrates them.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/base/user_folders.h"
#include "app/runtime/devices/calibrate_stick.h"
#include "app/runtime/devices/open_stick.h"
#include "app/runtime/devices/stick_list.h"
#include "app/session/bindings_file.h"
#include "app/ui/input/bound_controllers.h"
#include "app/ui/input/controls_dialog.h"
#include "app/ui/input/controls_setup.h"
#include "app/verbs/verbs.h"
#include "engine/window/controllers.h"
#include "haptics/files/printable.h"
#include "haptics/files/text_file.h"

namespace gearshift::verbs {
namespace {

using DeviceJson = nlohmann::ordered_json;

constexpr std::size_t kLeverAxes = 2;

struct DevicesArguments {
  bool json = false, again = false, controls = false;
  std::string calibrate;
};

std::filesystem::path calibrations_folder() {
  return base::user_config_folder() / "devices";
}

// The folder of the calibrations. Empty if the home folder is unknown, in which case there are no calibrations.
std::filesystem::path calibrations_to_read() {
  try {
    return calibrations_folder();
  } catch (const std::runtime_error&) {
    return {};
  }
}

// Returns the connected sticks. On a machine without USB, prints the problem and returns an empty list.
std::vector<runtime::ListedStick> plugged_sticks() {
  try {
    return runtime::list_sticks(haptics::usb_hid_devices(), calibrations_to_read());
  } catch (const haptics::HidError& no_usb) {
    base::print_message("{}", no_usb.what());
    return {};
  }
}

DeviceJson controller_json(const engine::Controller& one) {
  return {{"name", one.name},
          {"id", one.id},
          {"guid", one.guid},
          {"axes", one.axes.size()},
          {"buttons", one.buttons.size()},
          {"gamepad", ui::is_game_pad(one)},
          {"can_be_read", one.can_be_read}};
}

DeviceJson stick_json(const runtime::ListedStick& stick) {
  DeviceJson effects = DeviceJson::array();
  for (const haptics::PidEffect effect : stick.effects) effects.push_back(haptics::to_string(effect));
  return {
      {"name", runtime::stick_name(stick.identity)},
      {"id", runtime::stick_id(stick.identity)},
      {"serial", stick.identity.serial},
      {"maker", stick.identity.maker},
      {"place", stick.identity.place},
      {"axes", stick.axes},
      {"buttons", stick.buttons},
      {"force", stick.force == runtime::StickForce::force_feedback ? "pushes" : runtime::describe_forces(stick)},
      {"effects", effects},
      {"calibrated", stick.force == runtime::StickForce::force_feedback ? DeviceJson(stick.calibrated) : DeviceJson()},
      {"calibration_lacks", stick.missing},
      {"problem", stick.problem}};
}

using DevicesRow = std::vector<std::string>;

void print_rows(const std::vector<DevicesRow>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const DevicesRow& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  for (const DevicesRow& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("{:<{}}  ", row[i], widths[i]);
    base::print_out("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
}

void print_sticks(const std::vector<runtime::ListedStick>& sticks) {
  std::vector<DevicesRow> rows{{"stick", "id", "port", "axes", "buttons", "forces", "calibrated"}};
  for (const runtime::ListedStick& stick : sticks) {
    const bool is_known = stick.force != runtime::StickForce::unknown;
    rows.push_back({runtime::stick_name(stick.identity), runtime::stick_id(stick.identity), stick.identity.place,
                    is_known ? fmt::format("{}", stick.axes) : "?", is_known ? fmt::format("{}", stick.buttons) : "?",
                    runtime::describe_forces(stick), runtime::describe_calibration(stick)});
  }
  print_rows(rows);
  for (const runtime::ListedStick& stick : sticks)
    if (!stick.problem.empty()) base::print_out("  {}\n", stick.problem);
}

void print_controllers(const std::vector<engine::Controller>& controllers) {
  if (controllers.empty()) return;
  base::print_out("\nPads, wheels, pedals and shifters, usable for the lever and the pedals:\n");
  std::vector<DevicesRow> rows{{"name", "id", "axes", "buttons", "kind"}};
  for (const engine::Controller& one : controllers)
    rows.push_back({haptics::printable(one.name), one.id, one.can_be_read ? std::to_string(one.axes.size()) : "?",
                    one.can_be_read ? std::to_string(one.buttons.size()) : "?",
                    !one.can_be_read       ? "no permission"
                    : ui::is_game_pad(one) ? "game pad"
                                           : "set up by --controls"});
  print_rows(rows);
}

// If the user may not open one of the devices, prints once how to install the udev rule that grants access.
void print_rule(const std::vector<runtime::ListedStick>& sticks, const std::vector<engine::Controller>& controllers) {
  const bool forbidden =
      std::any_of(sticks.begin(), sticks.end(), [](const auto& stick) { return runtime::needs_permission(stick); }) ||
      std::any_of(controllers.begin(), controllers.end(), [](const auto& one) { return !one.can_be_read; });
  if (!forbidden) return;
  const std::string rule = (base::assets_folder() / "udev" / "70-gearshift.rules").string();
  base::print_out(
      "To let the logged-in user open these devices, run these commands once:\n"
      "  sudo cp \"{}\" /etc/udev/rules.d/\n"
      "  sudo udevadm control --reload\n"
      "Then unplug the device and plug it in again.\n",
      rule);
  const std::string listed = haptics::read_text_file(rule);
  for (const engine::Controller& one : controllers) {
    const std::string vendor = one.id.substr(0, 4), product = one.id.substr(one.id.size() - 4);
    const std::string line =
        fmt::format("ATTRS{{idVendor}}==\"{}\", ATTRS{{idProduct}}==\"{}\", TAG+=\"uaccess\"", vendor, product);
    if (!one.can_be_read && listed.find(line) == std::string::npos)
      base::print_out("Before that, add this line at the rule's end for {}:\n  SUBSYSTEM==\"input\", {}\n",
                      haptics::printable(one.name), line);
  }
}

int list_devices(bool as_json) {
  const std::vector<runtime::ListedStick> sticks = plugged_sticks();
  const std::vector<engine::Controller> controllers = engine::list_controllers();
  const std::vector<std::string> absent = runtime::absent_problems(sticks, calibrations_to_read());
  if (as_json) {
    DeviceJson all = DeviceJson::array();
    for (const runtime::ListedStick& stick : sticks) all.push_back(stick_json(stick));
    DeviceJson others = DeviceJson::array();
    for (const engine::Controller& one : controllers) others.push_back(controller_json(one));
    const DeviceJson listed{{"sticks", all}, {"controllers", others}, {"problems_of_absent", absent}};
    base::print_out("{}\n", listed.dump(2));
    return 0;
  }
  if (sticks.empty()) base::print_out("No USB joystick is plugged in. You can use the simulated lever without one.\n");
  if (!sticks.empty()) print_sticks(sticks);
  for (const std::string& problem : absent) base::print_out("  {}\n", problem);
  print_controllers(controllers);
  print_rule(sticks, controllers);
  return 0;
}

int set_up_controls(bool again) {
  if (ui::controllers_to_set_up(engine::list_controllers()).empty())
    throw std::runtime_error(
        "no wheel, pedals, lever or shifter that needs setting up is plugged in; game pads work without it");
  const std::filesystem::path file =
      ui::user_bindings_file(base::user_config_folder(), std::string(session::kOwnBindings));
  return ui::calibrate_controllers(file, base::find_asset("bindings", "default"), again, STDIN_FILENO);
}

// Calibrates the wanted device. Measures a force-feedback stick; for other controllers, asks the user to move each
// control.
int calibrate(const std::string& wanted, bool again) {
  const std::vector<runtime::ListedStick> plugged = plugged_sticks();
  const runtime::ListedStick* stick = runtime::find_plugged_stick(wanted, plugged);
  const bool may_lack_force =
      stick == nullptr || stick->force == runtime::StickForce::none || stick->force == runtime::StickForce::rumble;
  const std::vector<engine::Controller> controllers =
      may_lack_force ? engine::list_controllers() : std::vector<engine::Controller>{};
  const std::string name = stick == nullptr ? wanted : stick->identity.name;
  const bool is_controller = std::any_of(controllers.begin(), controllers.end(),
                                         [&](const auto& one) { return ui::matches_stick(one, name); });
  if (is_controller) return set_up_controls(again);
  if (stick != nullptr && stick->axes > kLeverAxes)
    base::print_line(fmt::format(
        "{} has {} axes. Two are calibrated here, as the lever with forces. To use the device without forces, "
        "for pedals and gears, stop and run: gearshift devices --controls",
        runtime::stick_name(stick->identity), stick->axes));
  return runtime::calibrate_stick(wanted, calibrations_folder(), again, STDIN_FILENO);
}

int run_devices(const DevicesArguments& arguments) {
  if (arguments.again && arguments.calibrate.empty() && !arguments.controls)
    throw CLI::ValidationError("--again requires --calibrate or --controls");
  if (arguments.controls) return set_up_controls(arguments.again);
  return arguments.calibrate.empty() ? list_devices(arguments.json) : calibrate(arguments.calibrate, arguments.again);
}

}  // namespace

void add_devices_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<DevicesArguments>();
  CLI::App* verb = app.add_subcommand("devices", "List the connected sticks and what they can do, or calibrate one");
  verb->footer(
      "Examples:\n"
      "  gearshift devices\n"
      "  gearshift devices --calibrate NAME    guides you step by step; NAME: any part of the stick's name\n"
      "  gearshift devices --controls          sets up pedals, levers and shifters, without forces\n");
  CLI::Option* json = verb->add_flag("--json", arguments->json, "print the list as JSON");
  CLI::Option* calibrate =
      verb->add_option(
              "--calibrate", arguments->calibrate,
              "calibrate this stick (name, VENDOR:PRODUCT, serial or port) step by step; each finished step is saved")
          ->type_name("NAME")
          ->check([](const std::string& name) { return name.empty() ? "the stick's name must not be empty" : ""; })
          ->excludes(json);
  verb->add_flag("--controls", arguments->controls, "set up pedals, levers and shifters, without forces, step by step")
      ->excludes(json)
      ->excludes(calibrate);
  verb->add_flag("--again", arguments->again, "start from scratch")->excludes(json);
  verb->callback([arguments, &action] { action = [arguments] { return run_devices(*arguments); }; });
}

}  // namespace gearshift::verbs
