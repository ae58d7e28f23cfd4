// gearshift stability: shows whether a wall is stable at a given rate on a given device.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "app/base/console.h"
#include "app/base/progress_bar.h"
#include "app/lab/stability/stability.h"
#include "app/lab/stability/stability_report.h"
#include "app/lab/stability/stability_svg.h"
#include "app/verbs/distinct_outputs.h"
#include "app/verbs/number_between.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/files/atomic_file.h"

namespace gearshift::verbs {
namespace {

constexpr const char* kStabilityHelp =
    "Check whether a wall of stiffness K and damping B is stable on a device at a given rate: exact limit of the "
    "sampled "
    "loop, passivity limit, and a map of both.";
constexpr const char* kStabilityExamples =
    "\nExamples:\n"
    "  gearshift stability                                       5000 N/m at 1 kHz on the paper's X axis\n"
    "  gearshift stability --rate 100 --hand all                 the paper's rate, with each of the listed hands\n"
    "  gearshift stability --wall-damping 10 --delay 1 --svg map.svg\n"
    "  gearshift stability --hold half_sample --json             the shipped wall, as JSON\n";

struct StabilityArguments {
  std::string axis = "x";
  std::optional<double> mass, damping, stiffness;
  double rate = 1000.0;
  double wall_stiffness = 5000.0;
  double wall_damping = 0.0;
  int delay = 0;
  int window = 1;
  std::string hold = "zero_order";
  std::string hand = "bare";
  double encoder_step = 74.5;  // [um] the paper's 2250 counts over 80 deg
  bool json = false;
  std::string svg_file, csv_file;
};

haptics::AxisModel handle_of(const StabilityArguments& arguments) {
  const haptics::AxisModel& paper = arguments.axis == "x" ? haptics::kPaperAxisX : haptics::kPaperAxisY;
  return {arguments.mass.value_or(paper.mass), arguments.damping.value_or(paper.damping),
          arguments.stiffness.value_or(paper.stiffness)};
}

std::string device_name(const StabilityArguments& arguments) {
  const bool is_custom = arguments.mass || arguments.damping || arguments.stiffness;
  return is_custom ? "the given device" : arguments.axis == "x" ? "the paper's X axis" : "the paper's Y axis";
}

constexpr std::array kHolds = {haptics::ContactHold::zero_order, haptics::ContactHold::half_sample,
                               haptics::ContactHold::observer};

// `name` must be the key of a hold in kHolds. The validator of the command-line option guarantees this.
haptics::ContactHold hold_of(const std::string& name) {
  return *std::find_if(kHolds.begin(), kHolds.end(),
                       [&](haptics::ContactHold hold) { return name == haptics::file_key(hold); });
}

std::vector<std::string> hold_names() {
  return {haptics::file_key(kHolds[0]), haptics::file_key(kHolds[1]), haptics::file_key(kHolds[2])};
}

haptics::ContactLaw wall_of(const StabilityArguments& arguments) {
  haptics::ContactLaw wall;
  wall.hold = hold_of(arguments.hold);
  wall.stiffness = arguments.wall_stiffness;
  wall.damping = arguments.wall_damping;
  wall.window = arguments.window;
  wall.delay = arguments.delay;
  return wall;
}

std::vector<lab::JudgedHand> hands_of(const std::string& text) {
  std::vector<lab::JudgedHand> hands;
  for (const haptics::NamedHand& named : haptics::kNamedHands) {
    if (text == "all" || text == named.name) hands.push_back({std::string(named.name), named.hand});
  }
  if (!hands.empty()) return hands;
  const std::optional<haptics::HandImpedance> parsed = haptics::parse_hand(text);
  if (!parsed)
    throw CLI::ValidationError(
        fmt::format("--hand {}: must be bare, light, grip, arm, all or M,B,K [kg, N s/m, N/m]", text));
  return {{"given", *parsed}};
}

// Runs the analysis. If the analysis rejects its input, the error names the hand: all other options were checked when
// they were parsed.
lab::StabilityAnswer answer_or_reject(const lab::StabilityQuestion& question, const std::string& hand) {
  try {
    return lab::answer(question);
  } catch (const std::invalid_argument& refused) {
    throw CLI::ValidationError(fmt::format("--hand {}: {}", hand, refused.what()));
  }
}

void write(haptics::AtomicFile& out, const std::string& file, const std::string& text) {
  out.write(text);
  out.commit();
  base::print_message("wrote {}", file);
}

void write_map(const StabilityArguments& arguments, const lab::StabilityQuestion& question,
               const lab::StabilityAnswer& answer) {
  if (arguments.svg_file.empty() && arguments.csv_file.empty()) return;
  // prepare() reports an unusable path now, before the long computation of the map.
  std::optional<haptics::AtomicFile> svg, csv;
  if (!arguments.svg_file.empty()) svg.emplace(arguments.svg_file).prepare();
  if (!arguments.csv_file.empty()) csv.emplace(arguments.csv_file).prepare();
  base::ProgressBar bar;
  const lab::StabilityMap map = lab::stability_map(question, [&](double fraction) { bar.show("map", fraction); });
  bar.clear();
  if (svg) write(*svg, arguments.svg_file, lab::stability_svg(question, answer, map));
  if (csv) write(*csv, arguments.csv_file, lab::stability_csv(question, map));
}

int run_stability(const StabilityArguments& arguments) {
  check_distinct_outputs("--csv", "the drawing and the table", arguments.csv_file, arguments.svg_file);
  const lab::StabilityQuestion question{device_name(arguments),   handle_of(arguments),
                                        arguments.rate,           wall_of(arguments),
                                        hands_of(arguments.hand), 1e-6 * arguments.encoder_step};
  const lab::StabilityAnswer answer = answer_or_reject(question, arguments.hand);
  write_map(arguments, question, answer);
  const lab::RuntimeAnswer runtime = lab::query_runtime(question);
  base::print_out("{}", arguments.json ? lab::stability_json(question, answer, runtime)
                                       : lab::stability_text(question, answer, runtime));
  return 0;
}

void add_device_options(CLI::App& verb, StabilityArguments& arguments) {
  verb.add_option("--axis", arguments.axis, "use the mass, damping and stiffness of this axis of the paper's device")
      ->check(CLI::IsMember({"x", "y"}))
      ->capture_default_str();
  verb.add_option("--mass", arguments.mass, "mass of the handle [kg]")
      ->check(within_range_of(&haptics::AxisModel::mass));
  verb.add_option("--damping", arguments.damping, "damping of the handle [N s/m]")
      ->check(within_range_of(&haptics::AxisModel::damping));
  verb.add_option("--stiffness", arguments.stiffness, "stiffness of the handle [N/m]")
      ->check(within_range_of(&haptics::AxisModel::stiffness));
  verb.add_option("--rate", arguments.rate, "rate of the haptic cycle [Hz]")
      ->check(number_between(50.0, 20000.0))
      ->capture_default_str();
  verb.add_option("--delay", arguments.delay, "delay until a command takes effect [samples]")
      ->check(whole_number(0, haptics::kMaxSimulatedDelay))
      ->capture_default_str();
  verb.add_option("--encoder-step", arguments.encoder_step,
                  "motion of the handle per encoder count [um], for the laws of the trainer; 0: none")
      ->check(number_between(0.0, 1e4))
      ->capture_default_str();
  verb.add_option("--hand", arguments.hand,
                  "hand on the handle: bare, light, grip, arm or all; or its mass, damping and stiffness as M,B,K [kg, "
                  "N s/m, N/m]")
      ->capture_default_str();
}

void add_wall_options(CLI::App& verb, StabilityArguments& arguments) {
  verb.add_option("--wall-stiffness", arguments.wall_stiffness, "stiffness K of the wall [N/m]")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
  verb.add_option("--wall-damping", arguments.wall_damping, "damping B of the wall [N s/m]")
      ->check(number_between(0.0, 1e5))
      ->capture_default_str();
  verb.add_option("--window", arguments.window, "number of samples from which the velocity is estimated")
      ->check(whole_number(1, haptics::kMaxWindow))
      ->capture_default_str();
  verb.add_option(
          "--hold", arguments.hold,
          "how the wall's force is held between samples: zero_order (a textbook spring), half_sample or observer")
      ->check(CLI::IsMember(hold_names()))
      ->capture_default_str();
}

}  // namespace

void add_stability_verb(CLI::App& app, VerbAction& action) {
  const auto arguments = std::make_shared<StabilityArguments>();
  CLI::App* verb = app.add_subcommand("stability", kStabilityHelp);
  verb->footer(kStabilityExamples);
  add_device_options(*verb, *arguments);
  add_wall_options(*verb, *arguments);
  verb->add_flag("--json", arguments->json, "print JSON to stdout, with null for an infinite limit");
  verb->add_option("--svg", arguments->svg_file, "draw a map of the stable K and B values to this file")
      ->type_name("FILE");
  verb->add_option("--csv", arguments->csv_file, "write the map of the stable K and B values to this file as CSV")
      ->type_name("FILE");
  verb->callback([arguments, &action] { action = [arguments] { return run_stability(*arguments); }; });
}

}  // namespace gearshift::verbs
