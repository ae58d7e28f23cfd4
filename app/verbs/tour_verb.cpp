// gearshift tour: the simulated hand through every gear of a layout, no graphics: trace and plots.
#include <memory>
#include <string_view>

#include <fmt/core.h>

#include "app/output_folder.h"
#include "app/tour/tour.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/tour_arguments.h"
#include "app/verbs/tour_words.h"
#include "app/verbs/verbs.h"

namespace gearshift {
namespace {

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
  add_tour_options(*verb, *arguments);
  verb->callback([arguments, &action] { action = [arguments] { return run_tour(*arguments); }; });
}

}  // namespace gearshift
