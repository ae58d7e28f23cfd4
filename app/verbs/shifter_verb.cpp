// gearshift shifter: the lever as the shifter of another program.
#include <unistd.h>

#include <memory>
#include <string>
#include <string_view>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/base/stop_signals.h"
#include "app/base/user_folders.h"
#include "app/runtime/devices/open_stick.h"
#include "app/shifter/shifter.h"
#include "app/verbs/verbs.h"

namespace gearshift::verbs {
namespace {

constexpr std::string_view kSimulatedHand = "simulated";

struct ShifterArguments {
  std::string device{kSimulatedHand}, gate, preset = "default", car = "hatchback", telemetry, pedals;
};

int run(const ShifterArguments& arguments) {
  shifter::ShifterConfig config;
  config.preset = haptics::read_preset(base::find_asset("presets", arguments.preset).string());
  config.car = vehicle::read_car(base::find_asset("cars", arguments.car));
  config.layout =
      haptics::read_gate_layout(base::find_asset("gates", arguments.gate.empty() ? config.car.gate : arguments.gate));
  config.telemetry = arguments.telemetry;
  config.pedals = arguments.pedals;
  const base::StopSignals signals;
  if (arguments.device != kSimulatedHand)
    config.stick = runtime::open_stick(arguments.device, base::user_config_folder() / "devices");
  base::LineReader answers(STDIN_FILENO);
  shifter::run_shifter(config, answers, [](const std::string& line) { base::print_line(line); });
  return 0;
}

}  // namespace

void add_shifter_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<ShifterArguments>();
  CLI::App* verb = app.add_subcommand("shifter", "Use the lever as the shifter of another simulator");
  verb->footer(
      "Each gear is a button of the virtual joystick \"gearshift shifter\", held while the gear is in.\n\n"
      "Examples:\n"
      "  gearshift shifter --device NAME --gate six_speed_r_left_up\n"
      "  gearshift shifter --device NAME --telemetry 127.0.0.1:4444\n");
  verb->add_option("--device", arguments->device,
                   "calibrated force-feedback stick, given by name, VENDOR:PRODUCT, serial or port; \"simulated\": a "
                   "simulated hand presses each button once, for binding them")
      ->type_name("NAME")
      ->capture_default_str();
  verb->add_option("--gate", arguments->gate, "shipped gate or layout file; default: the car's");
  verb->add_option("--car", arguments->car, "shipped car or car file: its synchronisers, and its ratios until measured")
      ->capture_default_str();
  verb->add_option("--preset", arguments->preset, "shipped preset or preset file")->capture_default_str();
  verb->add_option("--telemetry", arguments->telemetry, "receive OutGauge packets at this address of this machine")
      ->type_name("HOST:PORT");
  verb->add_option("--pedals", arguments->pedals, "pass on the axes of this device, /dev/input/event...")
      ->type_name("FILE");
  verb->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace gearshift::verbs
