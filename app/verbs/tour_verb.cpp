// gearshift tour: the simulated hand, or who holds a stick, through every gear of a layout, no graphics: trace and plots.
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "app/devices/open_stick.h"
#include "app/devices/stop_signals.h"
#include "app/output_folder.h"
#include "app/print_out.h"
#include "app/tour/held_tour.h"
#include "app/tour/tour.h"
#include "app/trainer/user_folder.h"
#include "app/verbs/number_between.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/tour_arguments.h"
#include "app/verbs/tour_words.h"
#include "app/verbs/verbs.h"

namespace gearshift {
namespace {

constexpr std::string_view kNoStick = "simulated";

struct TourVerbArguments {
  TourArguments tour;
  std::string device{kNoStick};
  double seconds = 300.0;  // [s] for a person at most
};

void print_files(const TourSetup& setup) {
  print_out("{0}/trajectory.png and {0}/force.png (also .svg), trace {0}/tour.trace, table {0}/tour.csv\n",
            setup.folder.string());
}

// People and scripts that hold the stick wait for these lines.
void tell_person(const std::string& line) {
  print_out("{}\n", line);
  std::fflush(stdout);
}

// The stick is given back before the plots are drawn.
TourResult drive_by_person(TourSetup& setup, const TourVerbArguments& arguments, const TourProgress& progress) {
  const StopSignals signals;
  const std::shared_ptr<StickLever> stick = open_stick(arguments.device, user_config_folder() / "devices");
  make_folder(setup.folder);
  Answers answers(STDIN_FILENO);
  tell_person(fmt::format("{} answers after {:.1f} ms.", stick->name(), 1e3 * stick->answer_time()));
  return drive_held_tour(setup, *stick, arguments.seconds, answers, tell_person, progress);
}

int run_held_tour(const TourVerbArguments& arguments) {
  if (!arguments.tour.hand.empty()) throw CLI::ValidationError("--hand: a person's own hand holds the stick");
  TourSetup setup = make_tour_setup(arguments.tour);
  ProgressBar bar;
  const TourProgress progress = [&](std::string_view what, double share) { bar.show(what, share); };
  const TourResult result = drive_by_person(setup, arguments, progress);
  bar.clear();
  print_tour(setup, result);
  draw_tour(setup, result, progress);
  bar.clear();
  print_files(setup);
  if (result.came_in_order()) return 0;
  print_problem("not every gear was engaged in order");
  return 1;
}

// All that can be refused is refused before the folder is made.
int run_tour(const TourArguments& arguments) {
  const TourSetup setup = make_tour_setup(arguments);
  make_folder(setup.folder);
  ProgressBar bar;
  const TourProgress progress = [&](std::string_view what, double share) { bar.show(what, share); };
  const TourResult result = drive_tour(setup, progress);
  bar.clear();
  print_tour(setup, result);
  draw_tour(setup, result, progress);
  bar.clear();
  print_files(setup);
  if (!result.complete()) print_problem("the hand did not engage every gear in order");
  return result.complete() && result.lost.times == 0 ? 0 : 1;
}

}  // namespace

void add_tour_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<TourVerbArguments>();
  CLI::App* verb =
      app.add_subcommand("tour", "A hand, simulated or on a stick, through every gear of a gate: trace and plots");
  verb->footer(
      "Examples:\n"
      "  gearshift tour --out drive\n"
      "  gearshift tour --gate dog_leg_five --out dog_leg\n"
      "  gearshift tour --device NAME --out drive    whoever holds that stick shifts\n");
  add_tour_options(*verb, arguments->tour);
  CLI::Option* device =
      verb->add_option("--device", arguments->device,
                       "a calibrated force-feedback stick by name, VENDOR:PRODUCT, serial or place: whoever holds it "
                       "shifts")
          ->type_name("NAME")
          ->capture_default_str();
  verb->add_option("--seconds", arguments->seconds, "after which a tour with a stick ends [s]")
      ->check(number_between(1.0, 3600.0))
      ->needs(device)
      ->capture_default_str();
  verb->callback([arguments, &action] {
    action = [arguments] {
      return arguments->device == kNoStick ? run_tour(arguments->tour) : run_held_tour(*arguments);
    };
  });
}

}  // namespace gearshift
