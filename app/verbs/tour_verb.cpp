// gearshift tour: the simulated hand through every gear of a layout, no graphics: trace and plots.
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/tour/tour.h"
#include "app/verbs/number_between.h"
#include "app/verbs/verbs.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift {
namespace {

struct TourArguments {
  std::string folder;
  std::string gate = "paper";
  std::string hand = "grip";
  double rate = HapticConfig{}.rate;
  std::uint64_t seed = 1;
};

HandImpedance driving_hand(const std::string& text) {
  const std::optional<HandImpedance> hand = hand_from_text(text);
  if (!hand)
    throw CLI::ValidationError(
        fmt::format("--hand {}: must be light, grip, arm or M,B,K in kg, N s/m, N/m", text));
  if (hand->stiffness < 50.0) {
    throw CLI::ValidationError(fmt::format(
        "--hand {}: a hand of {} N/m cannot lead a lever, at least 50 is needed", text, hand->stiffness));
  }
  return *hand;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error(fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
}

void print_result(const TourSetup& setup, const TourResult& result) {
  for (const Limited& limited : result.limited) {
    fmt::print(stderr, "gearshift: {} limited from {:g} to {:g} ({})\n", limited.what, limited.wanted,
               limited.used, limited.law);
  }
  fmt::print("{}: {:.2f} s at {:g} Hz\n", setup.layout.name, result.duration, setup.haptics.rate);
  for (const GearTime& gear : result.engaged)
    fmt::print("  {:>2} engaged at {:6.3f} s\n", gear_name(gear.gear), gear.time);
  fmt::print(
      "in contact {:.0f} % of the cycles, deepest {:.2f} mm beyond a wall, strongest push {:.1f} N, hash "
      "{:016x}\n",
      100.0 * result.contact_share, 1e3 * result.deepest, result.strongest, result.hash);
}

int run_tour(const TourArguments& arguments) {
  TourSetup setup;
  setup.layout = read_gate_layout(find_asset("gates", arguments.gate));
  setup.gate = compile_gate(setup.layout, workspace_half_extent(YokeGeometry{}));
  setup.hand = driving_hand(arguments.hand);
  setup.haptics.rate = arguments.rate;
  setup.seed = arguments.seed;
  setup.folder = arguments.folder;
  make_folder(setup.folder);
  const TourResult result = drive_tour(setup);
  print_result(setup, result);
  draw_tour(setup, result);
  fmt::print("{0}/trajectory.png and {0}/force.png (also .svg), trace {0}/tour.trace, table {0}/tour.csv\n",
             setup.folder.string());
  if (result.complete()) return 0;
  fmt::print(stderr, "gearshift: the hand did not engage every gear in order\n");
  return 1;
}

}  // namespace

void add_tour_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<TourArguments>();
  CLI::App* verb =
      app.add_subcommand("tour", "A simulated hand shifts through every gear of a gate: trace and plots");
  verb->add_option("--out", arguments->folder, "folder for trace and plots; made where missing")
      ->type_name("DIR")
      ->required();
  verb->add_option("--gate", arguments->gate, "shipped gate or layout file")->capture_default_str();
  verb->add_option("--hand", arguments->hand, "light, grip, arm, or M,B,K in kg, N s/m, N/m")
      ->capture_default_str();
  verb->add_option("--rate", arguments->rate, "rate of the haptic cycle [Hz]")
      ->check(number_between(100.0, 4000.0))
      ->capture_default_str();
  verb->add_option("--seed", arguments->seed, "another seed, other aims of the same hand")
      ->capture_default_str();
  verb->callback([arguments, &action] { action = [arguments] { return run_tour(*arguments); }; });
}

}  // namespace gearshift
