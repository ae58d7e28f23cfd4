#include "app/verbs/tour_arguments.h"

#include <stdexcept>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/verbs/number_between.h"
#include "app/verbs/whole_number.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/preset.h"

namespace gearshift {
namespace {

// The lever itself says which hands it can carry.
void check_on_lever(const HandImpedance& hand) {
  constexpr std::int64_t kAnyPeriod = 1'000'000;  // [ns]
  SimulatedLeverConfig config;
  config.hand = hand;
  RestingHand nobody;
  const SimulatedLever lever(config, kAnyPeriod, nobody);
}

}  // namespace

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

TourSetup make_tour_setup(const TourArguments& arguments) {
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

void add_tour_options(CLI::App& verb, TourArguments& arguments) {
  verb.add_option("--out", arguments.folder, "folder for trace and plots; made where missing")
      ->type_name("DIR")
      ->required();
  verb.add_option("--gate", arguments.gate, "shipped gate or layout file")->capture_default_str();
  verb.add_option("--preset", arguments.preset, "shipped preset or file: device and configuration")
      ->capture_default_str();
  verb.add_option("--hand", arguments.hand,
                  "light, grip, arm, or M,B,K in kg, N s/m, N/m; the preset's where none is given, a grip if that "
                  "cannot lead");
  verb.add_option("--rate", arguments.rate, "rate of the haptic cycle [Hz]; the preset's where none is given")
      ->check(number_between(100.0, 4000.0));
  verb.add_option("--seed", arguments.seed, "another seed, other aims of the same hand")
      ->check(whole_number())
      ->capture_default_str();
}

}  // namespace gearshift
