// gearshift stability: may I use this wall at this rate on this device?
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "app/hold_words.h"
#include "app/print_out.h"
#include "app/stability/stability.h"
#include "app/stability/stability_report.h"
#include "app/stability/stability_svg.h"
#include "app/verbs/number_between.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/two_files.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/files/part_file.h"

namespace gearshift {
namespace {

constexpr const char* kStabilityHelp =
    "May a wall of K, B be used at this rate on this device? The exact limit of the sampled loop and the passive one, "
    "and the map of both.";
constexpr const char* kStabilityExamples =
    "\nExamples:\n"
    "  gearshift stability                                       5000 N/m at 1 kHz on the paper's X axis\n"
    "  gearshift stability --rate 100 --hand all                 as the paper has it, and in which hand\n"
    "  gearshift stability --wall-damping 10 --delay 1 --svg map.svg\n"
    "  gearshift stability --hold half_sample --json             the shipped wall, for programs\n";

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
  bool json = false;
  std::string svg_file, csv_file;
};

AxisModel handle_of(const StabilityArguments& arguments) {
  const AxisModel& paper = arguments.axis == "x" ? kPaperAxisX : kPaperAxisY;
  return {arguments.mass.value_or(paper.mass), arguments.damping.value_or(paper.damping),
          arguments.stiffness.value_or(paper.stiffness)};
}

std::string device_name(const StabilityArguments& arguments) {
  const bool own = arguments.mass || arguments.damping || arguments.stiffness;
  return own ? "the given device" : arguments.axis == "x" ? "the paper's X axis" : "the paper's Y axis";
}

constexpr std::array kHolds = {ContactHold::zero_order, ContactHold::half_sample, ContactHold::observer};

// One of those names: the option sees to it.
ContactHold hold_of(const std::string& name) {
  return *std::find_if(kHolds.begin(), kHolds.end(), [&](ContactHold hold) { return name == hold_name(hold); });
}

std::vector<std::string> hold_names() {
  return {hold_name(kHolds[0]), hold_name(kHolds[1]), hold_name(kHolds[2])};
}

ContactLaw wall_of(const StabilityArguments& arguments) {
  ContactLaw wall;
  wall.hold = hold_of(arguments.hold);
  wall.stiffness = arguments.wall_stiffness;
  wall.damping = arguments.wall_damping;
  wall.window = arguments.window;
  wall.delay = arguments.delay;
  return wall;
}

std::vector<JudgedHand> hands_of(const std::string& text) {
  std::vector<JudgedHand> hands;
  for (const NamedHand& named : kNamedHands) {
    if (text == "all" || text == named.name) hands.push_back({std::string(named.name), named.hand});
  }
  if (!hands.empty()) return hands;
  const std::optional<HandImpedance> given = hand_from_text(text);
  if (!given)
    throw CLI::ValidationError(
        fmt::format("--hand {}: must be bare, light, grip, arm, all or M,B,K in kg, N s/m, N/m", text));
  return {{"given", *given}};
}

// Every other option has its range at the option; the hand's three are the analysis' own.
StabilityAnswer answer_or_refuse(const StabilityQuestion& question, const std::string& hand) {
  try {
    return answer(question);
  } catch (const std::invalid_argument& refused) {
    throw CLI::ValidationError(fmt::format("--hand {}: {}", hand, refused.what()));
  }
}

void write(PartFile& out, const std::string& file, const std::string& text) {
  out.write(text);
  out.keep();
  print_problem("wrote {}", file);
}

void write_map(const StabilityArguments& arguments, const StabilityQuestion& question, const StabilityAnswer& answer) {
  if (arguments.svg_file.empty() && arguments.csv_file.empty()) return;
  // Before the map is made: a wrong path must not cost it.
  std::optional<PartFile> svg, csv;
  if (!arguments.svg_file.empty()) svg.emplace(arguments.svg_file).prepare();
  if (!arguments.csv_file.empty()) csv.emplace(arguments.csv_file).prepare();
  ProgressBar bar;
  const StabilityMap map = stability_map(question, [&](double share) { bar.show("map", share); });
  bar.clear();
  if (svg) write(*svg, arguments.svg_file, stability_svg(question, answer, map));
  if (csv) write(*csv, arguments.csv_file, stability_csv(question, map));
}

int run_stability(const StabilityArguments& arguments) {
  check_two_files("--csv", "drawing and table", arguments.csv_file, arguments.svg_file);
  const StabilityQuestion question{device_name(arguments), handle_of(arguments), arguments.rate, wall_of(arguments),
                                   hands_of(arguments.hand)};
  const StabilityAnswer answer = answer_or_refuse(question, arguments.hand);
  write_map(arguments, question, answer);
  const TrainerAnswer trainer = ask_trainer(question);
  print_out("{}",
            arguments.json ? stability_json(question, answer, trainer) : stability_text(question, answer, trainer));
  return 0;
}

void add_device_options(CLI::App& verb, StabilityArguments& arguments) {
  verb.add_option("--axis", arguments.axis, "the paper's axis whose handle is meant")
      ->check(CLI::IsMember({"x", "y"}))
      ->capture_default_str();
  verb.add_option("--mass", arguments.mass, "of another handle [kg]")->check(number_between(1e-3, 1e3));
  verb.add_option("--damping", arguments.damping, "of another handle [N s/m]")->check(number_between(0.0, 1e4));
  verb.add_option("--stiffness", arguments.stiffness, "of another handle [N/m]")->check(number_between(0.0, 1e6));
  verb.add_option("--rate", arguments.rate, "rate of the haptic cycle [Hz]")
      ->check(number_between(50.0, 20000.0))
      ->capture_default_str();
  verb.add_option("--delay", arguments.delay, "whole samples until a command acts")
      ->check(whole_number(0, kMaxDelay))
      ->capture_default_str();
  verb.add_option("--hand", arguments.hand, "bare, light, grip, arm, all, or M,B,K in kg, N s/m, N/m")
      ->capture_default_str();
}

void add_wall_options(CLI::App& verb, StabilityArguments& arguments) {
  verb.add_option("--wall-stiffness", arguments.wall_stiffness, "wanted K [N/m]")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
  verb.add_option("--wall-damping", arguments.wall_damping, "wanted B [N s/m]")
      ->check(number_between(0.0, 1e5))
      ->capture_default_str();
  verb.add_option("--window", arguments.window, "samples that the velocity is the difference over")
      ->check(whole_number(1, kMostWindow))
      ->capture_default_str();
  verb.add_option("--hold", arguments.hold, "zero_order (the textbook's spring), half_sample or observer")
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
  verb->add_flag("--json", arguments->json, "JSON on stdout; an infinite limit is null");
  verb->add_option("--svg", arguments->svg_file, "draw the K-B map into this file")->type_name("FILE");
  verb->add_option("--csv", arguments->csv_file, "write the K-B map into this file")->type_name("FILE");
  verb->callback([arguments, &action] { action = [arguments] { return run_stability(*arguments); }; });
}

}  // namespace gearshift
