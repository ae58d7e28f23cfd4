#include "app/verbs/tour_arguments.h"

#include <stdexcept>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/verbs/number_between.h"
#include "app/verbs/whole_number.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/preset.h"

namespace gearshift::verbs {
namespace {

// Checks the hand by constructing a lever with it. The constructor throws if the hand cannot be simulated.
void check_on_lever(const haptics::HandImpedance& hand) {
  constexpr std::int64_t kAnyPeriod = 1'000'000;  // [ns] any value; the check does not depend on the period
  haptics::SimulatedLeverConfig config;
  config.hand = hand;
  haptics::IdleHand idle_hand;
  const haptics::SimulatedLever lever(config, kAnyPeriod, idle_hand);
}

}  // namespace

haptics::HandImpedance driving_hand(const std::string& text) {
  const std::optional<haptics::HandImpedance> hand = haptics::parse_hand(text);
  if (!hand)
    throw CLI::ValidationError(fmt::format("--hand {}: must be light, grip, arm or M,B,K [kg, N s/m, N/m]", text));
  if (hand->stiffness < haptics::kMinLeadingStiffness) {
    throw CLI::ValidationError(
        fmt::format("--hand {}: a stiffness of {} N/m is too low to move the lever; it must be at least {:g} N/m", text,
                    hand->stiffness, haptics::kMinLeadingStiffness));
  }
  try {
    check_on_lever(*hand);
  } catch (const std::invalid_argument& refused) {
    throw CLI::ValidationError(fmt::format("--hand {}: {}", text, refused.what()));
  }
  return *hand;
}

lab::TourSetup make_tour_setup(const TourArguments& arguments) {
  lab::TourSetup setup;
  const haptics::Preset preset = haptics::read_preset(base::find_asset("presets", arguments.preset).string());
  setup.haptics = preset.haptics;
  setup.lever = preset.lever;
  setup.lever.hand = arguments.hand.empty() ? haptics::leading_hand(preset.lever.hand) : driving_hand(arguments.hand);
  if (arguments.rate) setup.haptics.rate = *arguments.rate;
  setup.layout = haptics::read_gate_layout(base::find_asset("gates", arguments.gate));
  setup.gate =
      haptics::compile_gate(setup.layout, haptics::workspace_half_extent(setup.lever.yoke), setup.lever.yoke.radius);
  setup.seed = arguments.seed;
  setup.folder = arguments.folder;
  return setup;
}

void add_tour_options(CLI::App& verb, TourArguments& arguments) {
  verb.add_option("--out", arguments.folder, "folder for the trace and plots; created if missing")
      ->type_name("DIR")
      ->required();
  verb.add_option("--gate", arguments.gate, "shipped gate or layout file")->capture_default_str();
  verb.add_option("--preset", arguments.preset,
                  "shipped preset or preset file: sets the device and the haptic parameters")
      ->capture_default_str();
  verb.add_option("--hand", arguments.hand,
                  "simulated hand: light, grip or arm; or its mass, damping and stiffness as M,B,K [kg, N s/m, N/m]; "
                  "default: the preset's hand, or grip if the preset's is too soft to move the lever");
  verb.add_option("--rate", arguments.rate, "rate of the haptic cycle [Hz]; default: the preset's")
      ->check(within_range_of(&haptics::HapticConfig::rate));
  verb.add_option("--seed", arguments.seed, "seed of the random errors in the hand's aim")
      ->check(whole_number())
      ->capture_default_str();
}

}  // namespace gearshift::verbs
