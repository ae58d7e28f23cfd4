// gearshift drive: drives a script headless and prints car, lever, events, shifts and driving errors.
#include <filesystem>
#include <memory>
#include <string>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/lab/drive/drive_output.h"
#include "app/verbs/distinct_outputs.h"
#include "app/verbs/number_between.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"
#include "haptics/files/atomic_file.h"

namespace gearshift::verbs {
namespace {

constexpr const char* kDriveHelp =
    "Drive a script headless: pedals, handbrake, slope and gear over time. Prints what happened; with --csv or --json, "
    "car and lever over time, too.";

struct DriveArguments {
  std::string script, car = "hatchback", gate, start, csv, json, trace;
  double interval = 0.01;
  std::uint64_t seed = 1;
};

std::string help_footer() {
  return "\nA script is a CSV file with these columns, or a TOML file with a [[row]] of them each: " +
         lab::script_columns() +
         ".\n"
         "Only time_s is needed. Pedals go from 0 to 1, clutch 1 is pressed; numbers are linear between rows. The gear "
         "is\n"
         "named as the gate does (R, N, 1), and a hand shifts into it from this time on; lever_x_mm and lever_y_mm "
         "lead\n"
         "the hand instead. A value left out is that of the row before: at first 0, ignition 1.\n"
         "\n  time_s,throttle,clutch,gear\n  0,0,1,1\n  1,0.2,1,1\n  3,0.2,0,1\n\n"
         "--start is a list such as gear=2,speed_km_per_h=50,engine=off; by default the car stands in the gear of the\n"
         "first row, with the engine running. Without a file name, --csv and --json print to stdout.\n"
         "\nExit code: 0 if driven; 1 if a file is invalid or cannot be written; 2 if the command line is invalid.\n";
}

lab::ScriptedDriveConfig config_of(const DriveArguments& arguments) {
  lab::ScriptedDriveConfig config;
  config.car = vehicle::read_car(base::find_asset("cars", arguments.car));
  config.gate = haptics::read_gearbox_layout(
      base::find_asset("gates", arguments.gate.empty() ? config.car.gate : arguments.gate));
  config.script = lab::read_drive_script(arguments.script);
  const int first_gear = config.script.rows.front().gear.value_or(haptics::kNeutralGear);
  try {
    config.start = lab::parse_drive_start(arguments.start, first_gear);
  } catch (const std::invalid_argument& problem) {
    throw CLI::ValidationError("--start", problem.what());
  }
  config.seed = arguments.seed;
  config.interval = arguments.interval;
  config.trace = arguments.trace;
  return config;
}

void write(const std::string& file, const std::string& text) {
  if (file == "-") return base::print_out("{}", text);
  haptics::write_text_file(file, text);
  base::print_message("wrote {}", file);
}

int run_drive(const DriveArguments& arguments) {
  const lab::ScriptedDriveConfig config = config_of(arguments);
  for (const std::string& output : {arguments.csv, arguments.json, arguments.trace}) {
    check_distinct_outputs("--csv, --json or --trace", "the output and the script", output, arguments.script);
    check_distinct_outputs("--csv, --json or --trace", "the output and the car", output, config.car.file);
    check_distinct_outputs("--csv, --json or --trace", "the output and the gate", output, config.gate.file);
  }
  check_distinct_outputs("--csv", "CSV and JSON", arguments.csv, arguments.json);
  const lab::DriveNames names{config.car.name, config.gate.name, arguments.script};
  const lab::ScriptedDrive drive = lab::drive_script(config);
  if (!arguments.csv.empty()) write(arguments.csv, lab::drive_csv(drive));
  if (!arguments.json.empty()) write(arguments.json, lab::drive_json(drive, names));
  if (arguments.csv != "-" && arguments.json != "-") base::print_out("{}", lab::drive_text(drive, names));
  return 0;
}

}  // namespace

void add_drive_verb(CLI::App& app, VerbAction& action) {
  const auto arguments = std::make_shared<DriveArguments>();
  CLI::App* verb = app.add_subcommand("drive", kDriveHelp);
  verb->footer(help_footer());
  verb->add_option("script", arguments->script, "script file, CSV or TOML")->required()->type_name("FILE");
  verb->add_option("--car", arguments->car, "shipped car or car file")->capture_default_str();
  verb->add_option("--gate", arguments->gate, "shipped gate or layout file; default: the car's");
  verb->add_option("--start", arguments->start, "state of the car at time 0")->type_name("LIST");
  const auto add_output = [&](const char* name, std::string& file, const char* description) {
    verb->add_option_function<std::vector<std::string>>(
            name,
            [&file](const std::vector<std::string>& files) {
              file = files.empty() || files.front().empty() ? "-" : files.front();
            },
            description)
        ->expected(0, 1)
        ->type_name("[FILE]");
  };
  add_output("--csv", arguments->csv, "samples and events as CSV");
  add_output("--json", arguments->json, "samples, events, shifts and errors as JSON");
  verb->add_option("--trace", arguments->trace, "record the drive for gearshift replay")->type_name("FILE");
  verb->add_option("--interval", arguments->interval, "time between two samples [s]")
      ->check(number_between(0.001, 10.0))
      ->capture_default_str();
  verb->add_option("--seed", arguments->seed, "seed of the tooth positions")
      ->check(whole_number())
      ->capture_default_str();
  verb->callback([arguments, &action] { action = [arguments] { return run_drive(*arguments); }; });
}

}  // namespace gearshift::verbs
