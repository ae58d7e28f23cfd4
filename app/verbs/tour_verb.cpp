// gearshift tour: a simulated hand, or the user with a stick, shifts through every gear without graphics. Writes a
// trace and plots.
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "app/base/console.h"
#include "app/base/output_folder.h"
#include "app/base/progress_bar.h"
#include "app/base/stop_signals.h"
#include "app/base/user_folders.h"
#include "app/lab/tour/held_tour.h"
#include "app/lab/tour/tour.h"
#include "app/runtime/devices/open_stick.h"
#include "app/verbs/number_between.h"
#include "app/verbs/print_tour.h"
#include "app/verbs/tour_arguments.h"
#include "app/verbs/verbs.h"

namespace gearshift::verbs {
namespace {

constexpr std::string_view kNoStick = "simulated";

struct TourVerbArguments {
  TourArguments tour;
  std::string device{kNoStick};
  double seconds = 300.0;  // [s] maximum duration of a tour with a stick
  bool json = false;
};

void print_files(const lab::TourSetup& setup) {
  base::print_out(
      "Plots: {0}/trajectory.png and {0}/force.png (also .svg); trace: {0}/tour.trace; table: {0}/tour.csv\n",
      setup.folder.string());
}

// Prints a line and flushes stdout, because the user at the stick, or a script, is waiting for the line.
void print_now(const std::string& line) {
  base::print_out("{}\n", line);
  std::fflush(stdout);
}

// Lets the user drive the tour with the stick. Closes the stick before it returns, so that other programs can use the
// stick while the plots are drawn.
lab::TourResult drive_by_person(lab::TourSetup& setup, const TourVerbArguments& arguments,
                                const lab::TourProgress& progress) {
  const base::StopSignals signals;
  const std::shared_ptr<runtime::StickLever> stick =
      runtime::open_stick(arguments.device, base::user_config_folder() / "devices");
  base::make_folder(setup.folder);
  base::LineReader answers(STDIN_FILENO);
  print_now(fmt::format("{} responds after {:.1f} ms.", stick->name(), 1e3 * stick->answer_time()));
  return lab::drive_held_tour(setup, *stick, arguments.seconds, answers, print_now, progress);
}

int run_held_tour(const TourVerbArguments& arguments) {
  if (!arguments.tour.hand.empty())
    throw CLI::ValidationError("--hand cannot be used with --device, because your own hand holds the stick");
  lab::TourSetup setup = make_tour_setup(arguments.tour);
  base::ProgressBar bar;
  const lab::TourProgress progress = [&](std::string_view part, double fraction) { bar.show(part, fraction); };
  const lab::TourResult result = drive_by_person(setup, arguments, progress);
  bar.clear();
  print_tour(setup, result);
  lab::draw_tour(setup, result, progress);
  bar.clear();
  print_files(setup);
  if (result.visited_in_order()) return 0;
  base::print_message("you did not engage every gear in order");
  return 1;
}

// Runs the tour with a simulated hand. Creates the output folder only after all arguments are checked.
int run_tour(const TourArguments& arguments, bool json) {
  const lab::TourSetup setup = make_tour_setup(arguments);
  base::make_folder(setup.folder);
  base::ProgressBar bar;
  const lab::TourProgress progress = [&](std::string_view part, double fraction) { bar.show(part, fraction); };
  const lab::TourResult result = lab::drive_tour(setup, progress);
  bar.clear();
  json ? print_tour_json(setup, result) : print_tour(setup, result);
  lab::draw_tour(setup, result, progress);
  bar.clear();
  if (!json) print_files(setup);
  if (!result.complete()) base::print_message("the simulated hand did not engage every gear in order");
  return result.complete() && result.lost.times == 0 ? 0 : 1;
}

}  // namespace

void add_tour_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<TourVerbArguments>();
  CLI::App* verb = app.add_subcommand(
      "tour", "Shift through every gear with a simulated hand or your stick, and save a trace and plots");
  verb->footer(
      "Examples:\n"
      "  gearshift tour --out drive\n"
      "  gearshift tour --gate dog_leg_five --out dog_leg\n"
      "  gearshift tour --device NAME --out drive    you shift with this stick\n");
  add_tour_options(*verb, arguments->tour);
  CLI::Option* device =
      verb->add_option("--device", arguments->device,
                       "shift with a calibrated force-feedback stick, given by name, VENDOR:PRODUCT, serial or port")
          ->type_name("NAME")
          ->capture_default_str();
  verb->add_option("--seconds", arguments->seconds, "time limit of a tour with a stick [s]")
      ->check(number_between(1.0, 3600.0))
      ->needs(device)
      ->capture_default_str();
  verb->add_flag("--json", arguments->json, "print JSON to stdout instead of text")->excludes(device);
  verb->callback([arguments, &action] {
    action = [arguments] {
      return arguments->device == kNoStick ? run_tour(arguments->tour, arguments->json) : run_held_tour(*arguments);
    };
  });
}

}  // namespace gearshift::verbs
