// gearshift contact: measures what a wall feels like on a device.
#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/base/progress_bar.h"
#include "app/base/user_folders.h"
#include "app/lab/contact/contact_study.h"
#include "app/runtime/devices/open_stick.h"
#include "app/verbs/number_between.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"
#include "haptics/files/atomic_file.h"
#include "haptics/files/parameter_file.h"
#include "haptics/loop/preset.h"
#include "haptics/usb/usb_hid.h"

namespace gearshift::verbs {
namespace {

constexpr const char* kContactHelp =
    "Measure what a wall feels like on a device: ripple under a push, energy of impacts, stiffness in motion. The "
    "device is simulated with the complete haptic cycle.";
constexpr const char* kContactExamples =
    "\nExamples:\n"
    "  gearshift contact                                 the paper's lever at 1 kHz\n"
    "  gearshift contact --delay 2 --hand random         forces act two cycles late, 100 random hands\n"
    "  gearshift contact --rate 200 --push 20 --json     one push, as JSON\n"
    "  gearshift contact --stick FFBoard --svg wall.svg  a calibrated stick, with a plot\n";

constexpr double kHeavyHand = 0.8;  // [kg] heavier hands swing longer

struct ContactArguments {
  std::string preset = "default";
  std::string stick;
  std::optional<double> rate, wall_stiffness, wall_damping;
  std::optional<int> delay;
  std::string hold;
  std::string hand = "all";
  std::vector<double> push, speed{0.1, 1.0};
  std::optional<double> place;
  double jitter = 0.1, plant_error = 0.05;
  int runs = 100;
  std::uint64_t seed = 1;
  bool json = false;
  std::string svg_file;
};

// A simulated lever with the measured properties of a calibrated stick. The dead band of its springs needs no model: the
// driver commands a narrower one by the measured ratio (PidLever), so a spring begins where its wall is.
haptics::SimulatedLeverConfig lever_like(const haptics::DeviceCalibration& calibration, double period) {
  const haptics::DeviceSpec spec = haptics::spec_of(calibration, period);
  if (spec.delay > haptics::kMaxSimulatedDelay)
    throw std::runtime_error(
        fmt::format("this stick answers {} cycles late, and at most {} can be simulated; choose a "
                    "lower --rate",
                    spec.delay, haptics::kMaxSimulatedDelay));
  haptics::SimulatedLeverConfig lever;
  lever.axis_x = spec.axis_x;
  lever.axis_y = spec.axis_y;
  lever.coulomb_friction = std::min(calibration.select.friction, calibration.shift.friction);
  lever.delay = spec.delay;
  lever.actuator.peak_force = lever.actuator.continuous_force = std::max(spec.max_force.x, spec.max_force.y);
  lever.encoder_counts = lever.yoke.radius * std::numbers::pi / 180.0 / spec.position_step;
  lever.device_wall_stiffness = std::min(spec.device_wall_stiffness.x, spec.device_wall_stiffness.y);
  return lever;
}

void take_stick(const std::string& wanted, lab::ContactQuestion& question) {
  const std::filesystem::path folder = base::user_config_folder() / "devices";
  const runtime::ResolvedStick stick =
      runtime::resolve_stick(wanted, runtime::list_sticks(haptics::usb_hid_devices(), folder), folder);
  lab::ContactCase& contact = question.campaign.contact;
  contact.lever = lever_like(stick.known.calibration, haptics::period_s(contact.haptics));
  question.device = runtime::stick_name(stick.identity);
}

std::vector<lab::ContactHand> hands_of(const ContactArguments& arguments) {
  if (arguments.hand == "all") return lab::named_hands();
  if (arguments.hand == "random") return lab::random_hands(arguments.runs, arguments.seed);
  const std::optional<haptics::HandImpedance> hand = haptics::parse_hand(arguments.hand);
  if (!hand)
    throw CLI::ValidationError(fmt::format(
        "--hand {}: must be bare, light, grip, arm, elastic, pinch, all, random or M,B,K [kg, N s/m, N/m], followed by "
        "the fingers' mass and the grip's damping and stiffness for an elastic hand",
        arguments.hand));
  return {{arguments.hand, *hand}};
}

void take_wall(const ContactArguments& arguments, haptics::HapticConfig& config) {
  if (arguments.rate) config.rate = *arguments.rate;
  if (arguments.wall_stiffness) config.tuning.wall_stiffness = *arguments.wall_stiffness;
  if (arguments.wall_damping) config.tuning.wall_damping = *arguments.wall_damping;
  const std::vector<std::string> holds = haptics::file_keys<haptics::ContactHold>();
  const auto hold = std::find(holds.begin(), holds.end(), arguments.hold);
  if (hold != holds.end()) config.contact.hold = static_cast<haptics::ContactHold>(hold - holds.begin());
}

// The chosen pushes, or the usual ones as far as the motors can hold them.
std::pair<double, double> push_of(const ContactArguments& arguments, const lab::Campaign& usual) {
  constexpr double kHeld = 0.95;  // [1] of the motors' force
  if (!arguments.push.empty()) return std::minmax(arguments.push.front(), arguments.push.back());
  const double max = std::min(usual.max_push, kHeld * usual.contact.lever.actuator.peak_force);
  return {usual.min_push / usual.max_push * max, max};
}

lab::ContactQuestion question_of(const ContactArguments& arguments) {
  const haptics::Preset preset = haptics::read_preset(base::find_asset("presets", arguments.preset).string());
  lab::ContactQuestion question;
  question.device = preset.name;
  lab::Campaign& campaign = question.campaign;
  campaign.contact.haptics = preset.haptics;
  campaign.contact.lever = preset.lever;
  take_wall(arguments, campaign.contact.haptics);
  if (!arguments.stick.empty()) take_stick(arguments.stick, question);
  if (arguments.delay) campaign.contact.lever.delay = *arguments.delay;
  std::tie(campaign.min_push, campaign.max_push) = push_of(arguments, campaign);
  std::tie(campaign.slowest, campaign.fastest) = std::minmax(arguments.speed.front(), arguments.speed.back());
  campaign.place = arguments.place;
  campaign.period_jitter = arguments.jitter;
  campaign.model_error = arguments.plant_error;
  campaign.seed = arguments.seed;
  campaign.hands = hands_of(arguments);
  const auto is_heavy = [](const lab::ContactHand& hand) { return hand.hand.mass > kHeavyHand; };
  const bool is_slow = std::any_of(campaign.hands.begin(), campaign.hands.end(), is_heavy);
  campaign.contact.duration = is_slow ? 3.0 : campaign.contact.haptics.rate < 500.0 ? 2.0 : 1.2;
  campaign.runs = arguments.hand == "random" ? 1 : arguments.runs;
  return question;
}

int run_contact_verb(const ContactArguments& arguments) {
  const lab::ContactQuestion question = question_of(arguments);
  std::optional<haptics::AtomicFile> svg;
  if (!arguments.svg_file.empty()) svg.emplace(arguments.svg_file).prepare();
  base::ProgressBar bar;
  const lab::ContactAnswer answer =
      lab::measure_contact(question, [&](double fraction) { bar.show("contacts", fraction); });
  bar.clear();
  if (svg) {
    svg->write(lab::contact_svg(question, answer));
    svg->commit();
    base::print_message("wrote {}", arguments.svg_file);
  }
  base::print_out("{}", arguments.json ? lab::contact_json(question, answer) : lab::contact_text(question, answer));
  return 0;
}

void add_device_options(CLI::App& verb, ContactArguments& arguments) {
  CLI::Option* preset = verb.add_option("--preset", arguments.preset,
                                        "shipped preset or preset file: sets the device and the haptic parameters");
  preset->capture_default_str();
  verb.add_option(
      "--stick", arguments.stick,
      "a calibrated stick, in place of the preset's device: part of its name, VENDOR:PRODUCT, serial number "
      "or port");
  verb.add_option("--rate", arguments.rate, "rate of the haptic cycle [Hz]; default: the preset's")
      ->check(within_range_of(&haptics::HapticConfig::rate));
  verb.add_option("--delay", arguments.delay, "delay until a command takes effect [cycles]; default: the device's")
      ->check(whole_number(0, haptics::kMaxSimulatedDelay));
  verb.add_option("--jitter", arguments.jitter, "largest relative error of each period, in the contacts with a hand")
      ->check(number_between(0.0, 0.5))
      ->capture_default_str();
  verb.add_option("--plant-error", arguments.plant_error,
                  "largest relative error of the handle's mass, damping and stiffness, in the contacts with a hand")
      ->check(number_between(0.0, 0.5))
      ->capture_default_str();
}

void add_wall_options(CLI::App& verb, ContactArguments& arguments) {
  verb.add_option("--wall-stiffness", arguments.wall_stiffness, "wanted stiffness [N/m]; default: the preset's")
      ->check(number_between(1.0, haptics::parameter_of(&haptics::HapticTuning::wall_stiffness).range.max));
  verb.add_option("--wall-damping", arguments.wall_damping, "wanted damping [N s/m]; default: the preset's")
      ->check(within_range_of(&haptics::HapticTuning::wall_damping));
  verb.add_option("--hold", arguments.hold, "automatic, zero_order, half_sample or observer; default: the preset's")
      ->check(CLI::IsMember(haptics::file_keys<haptics::ContactHold>()));
}

void add_contact_options(CLI::App& verb, ContactArguments& arguments) {
  verb.add_option(
          "--hand", arguments.hand,
          "bare, light, grip, arm, elastic, pinch, all, random (hands of 0.02 to 2.5 kg, a third of them elastic, "
          "one for each run), M,B,K [kg, N s/m, N/m], or M,B,K,M,B,K with the mass of the fingers and the "
          "grip's damping and stiffness")
      ->capture_default_str();
  verb.add_option("--push", arguments.push,
                  "push of the hand after the impact [N]: one value, or the lowest and highest; default: 4 to 30, or "
                  "what the motors can hold")
      ->expected(1, 2)
      ->check(number_between(0.1, 1000.0));
  verb.add_option("--speed", arguments.speed, "impact speed [m/s]: one value, or the lowest and highest")
      ->expected(1, 2)
      ->check(number_between(0.01, 2.0))
      ->capture_default_str();
  verb.add_option("--place", arguments.place,
                  "place of the wall within an encoder count, 0 to 1; default: another one in each run")
      ->check(number_between(0.0, 1.0));
  verb.add_option("--runs", arguments.runs, "number of runs for each hand")
      ->check(whole_number(1, 100000))
      ->capture_default_str();
  verb.add_option("--seed", arguments.seed, "seed of all random values")->check(whole_number())->capture_default_str();
}

}  // namespace

void add_contact_verb(CLI::App& app, VerbAction& action) {
  const auto arguments = std::make_shared<ContactArguments>();
  CLI::App* verb = app.add_subcommand("contact", kContactHelp);
  verb->footer(kContactExamples);
  add_device_options(*verb, *arguments);
  add_wall_options(*verb, *arguments);
  add_contact_options(*verb, *arguments);
  verb->add_flag("--json", arguments->json, "print JSON to stdout");
  verb->add_option("--svg", arguments->svg_file, "draw the stiffness in motion to this file")->type_name("FILE");
  verb->callback([arguments, &action] { action = [arguments] { return run_contact_verb(*arguments); }; });
}

}  // namespace gearshift::verbs
