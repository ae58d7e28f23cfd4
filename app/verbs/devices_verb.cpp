// gearshift devices: which sticks are plugged in and what they can do; calibration.
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

#include "app/assets_path.h"
#include "app/devices/calibrate_stick.h"
#include "app/devices/open_stick.h"
#include "app/devices/pad_talk.h"
#include "app/devices/stick_list.h"
#include "app/print_out.h"
#include "app/train/own_bindings.h"
#include "app/trainer/user_folder.h"
#include "app/verbs/verbs.h"
#include "engine/window/window.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

using DeviceJson = nlohmann::ordered_json;

struct DevicesArguments {
  bool json = false, again = false;
  std::string calibrate;
};

std::filesystem::path calibrations_folder() {
  return user_config_folder() / "devices";
}

// Where no home folder is known nothing was calibrated.
std::filesystem::path calibrations_to_read() {
  try {
    return calibrations_folder();
  } catch (const std::runtime_error&) {
    return {};
  }
}

// What may be told of a machine without USB, too.
std::vector<ListedStick> plugged_sticks() {
  try {
    return list_sticks(usb_hid_devices(), calibrations_to_read());
  } catch (const HidError& no_usb) {
    print_problem("{}", no_usb.what());
    return {};
  }
}

// Where there is a display. A stick that pushes is among them, too.
std::vector<PadState> glfw_pads() {
  return has_display() ? glfw_sticks() : std::vector<PadState>{};
}

DeviceJson pad_json(const PadState& pad) {
  return {{"name", pad.name}, {"guid", pad.guid}, {"axes", pad.axes.size()}, {"buttons", pad.buttons.size()}};
}

DeviceJson stick_json(const ListedStick& stick) {
  DeviceJson effects = DeviceJson::array();
  for (const PidEffect effect : stick.effects) effects.push_back(pid_effect_name(effect));
  return {{"name", stick_name(stick.identity)},
          {"id", stick_id(stick.identity)},
          {"serial", stick.identity.serial},
          {"maker", stick.identity.maker},
          {"place", stick.identity.place},
          {"axes", stick.axes},
          {"buttons", stick.buttons},
          {"force", stick.force == StickForce::pushes ? "pushes" : force_words(stick)},
          {"effects", effects},
          {"calibrated", stick.force == StickForce::pushes ? DeviceJson(stick.calibrated) : DeviceJson()},
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
    print_out("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
}

void print_sticks(const std::vector<ListedStick>& sticks) {
  std::vector<DevicesRow> rows{{"stick", "id", "place", "axes", "buttons", "forces", "calibrated"}};
  for (const ListedStick& stick : sticks) {
    const bool seen = stick.force != StickForce::unknown;
    rows.push_back({stick_name(stick.identity), stick_id(stick.identity), stick.identity.place,
                    seen ? fmt::format("{}", stick.axes) : "?", seen ? fmt::format("{}", stick.buttons) : "?",
                    force_words(stick), calibration_words(stick)});
  }
  print_rows(rows);
  for (const ListedStick& stick : sticks)
    if (!stick.problem.empty()) print_out("  {}\n", stick.problem);
}

void print_pads(const std::vector<PadState>& pads) {
  if (pads.empty()) return;
  print_out("\nWithout force, for hand and feet:\n");
  std::vector<DevicesRow> rows{{"name", "axes", "buttons"}};
  for (const PadState& pad : pads)
    rows.push_back({printable(pad.name), std::to_string(pad.axes.size()), std::to_string(pad.buttons.size())});
  print_rows(rows);
}

// Once for all of them.
void print_rule(const std::vector<ListedStick>& sticks) {
  const bool forbidden =
      std::any_of(sticks.begin(), sticks.end(), [](const ListedStick& stick) { return is_forbidden(stick); });
  if (!forbidden) return;
  const std::string rule = (assets_folder() / "udev" / "70-gearshift.rules").string();
  print_out(
      "To let whoever sits at this machine use them, once:\n"
      "  sudo cp \"{}\" /etc/udev/rules.d/\n"
      "  sudo udevadm control --reload\n"
      "and plug the stick in again.\n",
      rule);
}

int list_devices(bool as_json) {
  const std::vector<ListedStick> sticks = plugged_sticks();
  const std::vector<PadState> pads = glfw_pads();
  const std::vector<std::string> absent = absent_problems(sticks, calibrations_to_read());
  if (as_json) {
    DeviceJson all = DeviceJson::array();
    for (const ListedStick& stick : sticks) all.push_back(stick_json(stick));
    DeviceJson seen = DeviceJson::array();
    for (const PadState& pad : pads) seen.push_back(pad_json(pad));
    const DeviceJson listed{{"sticks", all}, {"seen_by_glfw", seen}, {"problems_of_absent", absent}};
    print_out("{}\n", listed.dump(2));
    return 0;
  }
  if (sticks.empty()) print_out("No USB stick is plugged in: the simulated lever needs none.\n");
  if (!sticks.empty()) print_sticks(sticks);
  for (const std::string& problem : absent) print_out("  {}\n", problem);
  print_rule(sticks);
  print_pads(pads);
  return 0;
}

// A stick that pushes is measured; the axes of others are shown, where a display lets GLFW see them.
int calibrate(const std::string& wanted, bool again) {
  const std::vector<ListedStick> plugged = plugged_sticks();
  const ListedStick* stick = found_stick(wanted, plugged);
  const bool may_be_pad = stick == nullptr || stick->force == StickForce::none || stick->force == StickForce::rumble;
  const std::vector<PadState> pads = may_be_pad ? glfw_pads() : std::vector<PadState>{};
  const std::string name = stick == nullptr ? wanted : stick->identity.name;
  const bool is_pad = std::any_of(pads.begin(), pads.end(), [&](const PadState& pad) { return is_meant(pad, name); });
  if (!is_pad) return calibrate_stick(wanted, calibrations_folder(), again, STDIN_FILENO);
  const std::filesystem::path file = own_bindings_file(user_config_folder(), std::string(kOwnBindings));
  return calibrate_pads(file, find_asset("bindings", "default"), again, STDIN_FILENO);
}

int run_devices(const DevicesArguments& arguments) {
  return arguments.calibrate.empty() ? list_devices(arguments.json) : calibrate(arguments.calibrate, arguments.again);
}

}  // namespace

void add_devices_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<DevicesArguments>();
  CLI::App* verb = app.add_subcommand("devices", "Sticks that are plugged in, what they can do, and their calibration");
  verb->footer(
      "Examples:\n"
      "  gearshift devices\n"
      "  gearshift devices --calibrate NAME    any part of its name; asks step by step\n");
  CLI::Option* json = verb->add_flag("--json", arguments->json, "the list for a script");
  CLI::Option* calibrate =
      verb->add_option(
              "--calibrate", arguments->calibrate,
              "measure that stick (name, VENDOR:PRODUCT, serial or place): asks step by step, keeps every step")
          ->type_name("NAME")
          ->check([](const std::string& name) { return name.empty() ? "the name of a stick is empty" : ""; })
          ->excludes(json);
  verb->add_flag("--again", arguments->again, "measure all of it anew")->needs(calibrate);
  verb->callback([arguments, &action] { action = [arguments] { return run_devices(*arguments); }; });
}

}  // namespace gearshift
