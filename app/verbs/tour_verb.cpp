// gearshift tour: the simulated hand through every gear of a layout, no graphics: trace and plots.
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/limited_words.h"
#include "app/output_folder.h"
#include "app/tour/tour.h"
#include "app/verbs/number_between.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/verbs.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/preset.h"

namespace gearshift {
namespace {

struct TourArguments {
  std::string folder;
  std::string gate = "paper";
  std::string preset = "default";
  std::string hand;            // empty: the preset's, or a grip where that cannot lead
  std::optional<double> rate;  // [Hz] none: the preset's
  std::uint64_t seed = 1;
};

// The lever itself says which hands it can carry.
void check_on_lever(const HandImpedance& hand) {
  constexpr std::int64_t kAnyPeriod = 1'000'000;  // [ns]
  SimulatedLeverConfig config;
  config.hand = hand;
  RestingHand nobody;
  const SimulatedLever lever(config, kAnyPeriod, nobody);
}

HandImpedance driving_hand(const std::string& text) {
  const std::optional<HandImpedance> hand = hand_from_text(text);
  if (!hand)
    throw CLI::ValidationError(fmt::format("--hand {}: must be light, grip, arm or M,B,K in kg, N s/m, N/m", text));
  if (hand->stiffness < kLeastLeadingStiffness) {
    throw CLI::ValidationError(fmt::format("--hand {}: a hand of {} N/m cannot lead a lever, at least {:g} is needed",
                                           text, hand->stiffness, kLeastLeadingStiffness));
  }
  try {
    check_on_lever(*hand);
  } catch (const std::invalid_argument& refused) {
    throw CLI::ValidationError(fmt::format("--hand {}: {}", text, refused.what()));
  }
  return *hand;
}

// CLI alone takes -1, as 2^64 - 1.
std::string refuse_no_seed(const std::string& text) {
  const bool whole = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  return whole ? std::string{} : fmt::format("\"{}\" is not a whole number from 0", text);
}

void print_result(const TourSetup& setup, const TourResult& result) {
  for (const Limited& limited : result.limited) {
    fmt::print(stderr, "gearshift: {}\n", limited_words(limited));
  }
  fmt::print("{}: {:.2f} s at {:g} Hz\n", setup.layout.name, result.duration, setup.haptics.rate);
  for (const GearTime& gear : result.engaged)
    fmt::print("  {:>2} engaged at {:6.3f} s\n", gear_name(gear.gear), gear.time);
  if (result.softest < result.admitted) {
    fmt::print(stderr, "gearshift: the lever chattered on a wall: its stiffness was lowered from {:g} to {:g} N/m\n",
               result.admitted, result.softest);
  }
  fmt::print(
      "in contact {:.0f} % of the cycles, deepest {:.2f} mm beyond a wall, strongest push {:.1f} N, hash "
      "{:016x}\n",
      100.0 * result.contact_share(), 1e3 * result.deepest, result.strongest, result.hash);
}

TourSetup make_setup(const TourArguments& arguments) {
  TourSetup setup;
  const Preset preset = read_preset(find_asset("presets", arguments.preset).string());
  setup.haptics = preset.haptics;
  setup.lever = preset.lever;
  setup.lever.hand = arguments.hand.empty() ? leading_hand(preset.lever.hand) : driving_hand(arguments.hand);
  if (arguments.rate) setup.haptics.rate = *arguments.rate;
  setup.layout = read_gate_layout(find_asset("gates", arguments.gate));
  setup.gate = compile_gate(setup.layout, workspace_half_extent(setup.lever.yoke), setup.lever.yoke.radius);
  setup.seed = arguments.seed;
  setup.folder = arguments.folder;
  return setup;
}

// All that can be refused is refused before the folder is made.
int run_tour(const TourArguments& arguments) {
  const TourSetup setup = make_setup(arguments);
  make_folder(setup.folder);
  ProgressBar bar;
  const TourProgress progress = [&](std::string_view what, double share) { bar.show(what, share); };
  const TourResult result = drive_tour(setup, progress);
  bar.clear();
  print_result(setup, result);
  draw_tour(setup, result, progress);
  bar.clear();
  fmt::print("{0}/trajectory.png and {0}/force.png (also .svg), trace {0}/tour.trace, table {0}/tour.csv\n",
             setup.folder.string());
  if (result.complete()) return 0;
  fmt::print(stderr, "gearshift: the hand did not engage every gear in order\n");
  return 1;
}

}  // namespace

void add_tour_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<TourArguments>();
  CLI::App* verb = app.add_subcommand("tour", "A simulated hand shifts through every gear of a gate: trace and plots");
  verb->add_option("--out", arguments->folder, "folder for trace and plots; made where missing")
      ->type_name("DIR")
      ->required();
  verb->add_option("--gate", arguments->gate, "shipped gate or layout file")->capture_default_str();
  verb->add_option("--preset", arguments->preset, "shipped preset or file: device and configuration")
      ->capture_default_str();
  verb->add_option("--hand", arguments->hand,
                   "light, grip, arm, or M,B,K in kg, N s/m, N/m; the preset's where none is given, a grip if that "
                   "cannot lead");
  verb->add_option("--rate", arguments->rate, "rate of the haptic cycle [Hz]; the preset's where none is given")
      ->check(number_between(100.0, 4000.0));
  verb->add_option("--seed", arguments->seed, "another seed, other aims of the same hand")
      ->check(refuse_no_seed)
      ->capture_default_str();
  verb->callback([arguments, &action] { action = [arguments] { return run_tour(*arguments); }; });
}

}  // namespace gearshift
