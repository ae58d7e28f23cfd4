// gearshift identify: measures a lever's frequency response, mass, damping, stiffness and force sensor.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/base/output_folder.h"
#include "app/base/progress_bar.h"
#include "app/lab/identify/identify.h"
#include "app/verbs/number_between.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"

namespace gearshift::verbs {
namespace {

struct IdentifyArguments {
  std::string preset = "default";
  std::string axis = "both";
  std::optional<double> rate;
  std::optional<std::uint64_t> seed;
  std::string folder;
  bool json = false;
};

haptics::Preset make_preset(const IdentifyArguments& arguments) {
  haptics::Preset preset = haptics::read_preset(base::find_asset("presets", arguments.preset).string());
  preset.haptics.rate = arguments.rate.value_or(preset.haptics.rate);
  preset.lever.seed = arguments.seed.value_or(preset.lever.seed);
  return preset;
}

std::vector<haptics::LeverAxis> axes_of(const std::string& word) {
  if (word == "both") return {haptics::LeverAxis::x, haptics::LeverAxis::y};
  return {word == "x" ? haptics::LeverAxis::x : haptics::LeverAxis::y};
}

void draw(const std::string& folder, const lab::Identification& found, const lab::IdentifyProgress& progress) {
  for (const lab::AxisIdentification& axis : found.axes)
    lab::draw_bode(folder, axis, "nominal", [&] { progress("figures", 0.0); });
}

int run_identify(const IdentifyArguments& arguments) {
  const haptics::Preset preset = make_preset(arguments);
  if (!arguments.folder.empty()) base::make_folder(arguments.folder);
  base::ProgressBar bar;
  const lab::IdentifyProgress progress = [&](std::string_view part, double fraction) { bar.show(part, fraction); };
  const lab::Identification found = lab::identify_lever(preset, axes_of(arguments.axis), progress);
  if (!arguments.folder.empty()) draw(arguments.folder, found, progress);
  bar.clear();
  if (arguments.json) {
    base::print_out("{}", lab::identification_json(found));
    return 0;
  }
  base::print_out("{}: sine sweep sampled at {:g} Hz, without a hand on the lever\n\n{}", preset.name, found.rate,
                  lab::identification_table(found));
  if (!arguments.folder.empty())
    base::print_out("\nPlots: {0}/bode_*.png (also .svg); test points: {0}/bode_*.csv\n", arguments.folder);
  return 0;
}

}  // namespace

void add_identify_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* verb = app.add_subcommand(
      "identify", "Measure a lever's mass, damping, stiffness and bandwidth from its frequency response");
  verb->footer(
      "Examples:\n"
      "  gearshift identify\n"
      "  gearshift identify --axis x --out lever\n");
  verb->add_option("--preset", arguments->preset, "shipped preset or preset file with the lever and the rate")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  verb->add_option("--axis", arguments->axis, "x (select), y (shift) or both")
      ->check(CLI::IsMember({"x", "y", "both"}))
      ->capture_default_str();
  verb->add_option("--rate", arguments->rate, "cycle rate [Hz]; default: the preset's")
      ->check(within_range_of(&haptics::HapticConfig::rate));
  verb->add_option("--seed", arguments->seed,
                   "seed of the sensor noise and of the lever's model errors; default: the preset's")
      ->check(whole_number());
  verb->add_option("--out", arguments->folder, "folder for the Bode plots and test points; created if missing")
      ->type_name("DIR");
  verb->add_flag("--json", arguments->json, "print JSON to stdout");
  verb->callback([arguments, &action] { action = [arguments] { return run_identify(*arguments); }; });
}

}  // namespace gearshift::verbs
