// gearshift identify: frequency response, mass, damping and stiffness of a lever, and its force sensor.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/assets_path.h"
#include "app/identify/identify.h"
#include "app/output_folder.h"
#include "app/print_out.h"
#include "app/verbs/number_between.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"

namespace gearshift {
namespace {

struct IdentifyArguments {
  std::string preset = "default";
  std::string axis = "both";
  std::optional<double> rate;
  std::optional<std::uint64_t> seed;
  std::string folder;
  bool json = false;
};

Preset make_preset(const IdentifyArguments& arguments) {
  Preset preset = read_preset(find_asset("presets", arguments.preset).string());
  preset.haptics.rate = arguments.rate.value_or(preset.haptics.rate);
  preset.lever.seed = arguments.seed.value_or(preset.lever.seed);
  return preset;
}

std::vector<LeverAxis> axes_of(const std::string& word) {
  if (word == "both") return {LeverAxis::x, LeverAxis::y};
  return {word == "x" ? LeverAxis::x : LeverAxis::y};
}

void draw(const std::string& folder, const Identification& found, const IdentifyProgress& progress) {
  for (const AxisIdentification& axis : found.axes)
    draw_bode(folder, axis, "device says", [&] { progress("figures", 0.0); });
}

int run_identify(const IdentifyArguments& arguments) {
  const Preset preset = make_preset(arguments);
  if (!arguments.folder.empty()) make_folder(arguments.folder);
  ProgressBar bar;
  const IdentifyProgress progress = [&](std::string_view what, double share) { bar.show(what, share); };
  const Identification found = identify_lever(preset, axes_of(arguments.axis), progress);
  if (!arguments.folder.empty()) draw(arguments.folder, found, progress);
  bar.clear();
  if (arguments.json) {
    print_out("{}", identification_json(found));
    return 0;
  }
  print_out("{}: sinusoids on {:g} samples a second, hand off the lever\n\n{}", preset.name, found.rate,
            identification_table(found));
  if (!arguments.folder.empty()) print_out("\n{}/bode_*.png (also .svg), test points as .csv\n", arguments.folder);
  return 0;
}

}  // namespace

void add_identify_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* verb =
      app.add_subcommand("identify", "Mass, damping, stiffness and bandwidth of a lever by its frequency response");
  verb->footer(
      "Examples:\n"
      "  gearshift identify\n"
      "  gearshift identify --axis x --out lever\n");
  verb->add_option("--preset", arguments->preset, "shipped preset or file: which lever, at which rate")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  verb->add_option("--axis", arguments->axis, "x (select), y (shift) or both")
      ->check(CLI::IsMember({"x", "y", "both"}))
      ->capture_default_str();
  verb->add_option("--rate", arguments->rate, "rate of the cycle [Hz], else the preset's")
      ->check(number_between(100.0, 4000.0));
  verb->add_option("--seed", arguments->seed, "of the sensor's noise and the lever's errors, else the preset's")
      ->check(whole_number());
  verb->add_option("--out", arguments->folder, "folder for Bode plots and test points; made where missing")
      ->type_name("DIR");
  verb->add_flag("--json", arguments->json, "JSON on stdout");
  verb->callback([arguments, &action] { action = [arguments] { return run_identify(*arguments); }; });
}

}  // namespace gearshift
