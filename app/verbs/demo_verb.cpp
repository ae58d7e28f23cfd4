// gearshift demo: renders a tour through all gears and two lessons off screen: pictures, sound, traces, plots and a
// page.
#include <memory>
#include <optional>
#include <string>

#include "app/base/console.h"
#include "app/base/output_folder.h"
#include "app/base/run_until_signal.h"
#include "app/demo/demo.h"
#include "app/verbs/number_between.h"
#include "app/verbs/picture_size.h"
#include "app/verbs/print_tour.h"
#include "app/verbs/tour_arguments.h"
#include "app/verbs/verbs.h"

namespace gearshift::verbs {
namespace {

struct DemoArguments {
  TourArguments tour;
  std::string size = "1280x720";
  int samples = 4;
  bool stereo = false;
  double film_rate = 0.0;  // [1/s] see DemoSetup::film_rate
};

// Runs the demo. Checks all arguments before it creates the folder.
int run(const DemoArguments& arguments) {
  demo::DemoSetup setup;
  setup.tour = make_tour_setup(arguments.tour);
  const PictureSize size = picture_size(arguments.size, arguments.stereo);
  setup.view.width = size.width;
  setup.view.height = size.height;
  setup.view.samples = arguments.samples;
  setup.view.stereo = arguments.stereo;
  setup.film_rate = arguments.film_rate;
  base::make_folder(setup.tour.folder);
  const std::optional<demo::DemoResult> finished = base::run_until_signal<demo::DemoResult>(
      [&](const lab::TourProgress& progress) { return demo::run_demo(setup, progress); });
  if (!finished) return 1;
  const demo::DemoResult& result = *finished;
  print_tour(setup.tour, result.tour);
  base::print_out("{} pictures of {} pixels, rendered by {} in {:.0f} ms each\n", result.pictures(), arguments.size,
                  result.device, result.picture_ms);
  base::print_out(
      "{0}/index.html: pictures, sound, traces and plots; {0}/contact_sheet.png: all pictures on one sheet\n",
      setup.tour.folder.string());
  for (const demo::DemoChapter& chapter : result.chapters) {
    base::print_out("{}\n", chapter.title);
    for (const std::string& sentence : chapter.text) base::print_out("  {}\n", sentence);
  }
  if (result.has_report) base::print_out("{}/report.html: the lesson report\n", setup.tour.folder.string());
  if (!result.tour.complete()) base::print_message("the simulated hand did not engage every gear in order");
  if (!result.passed) base::print_message("the simulated driver did not pass every lesson");
  return result.tour.complete() && result.tour.lost.times == 0 && result.passed ? 0 : 1;
}

}  // namespace

int run_demo(const TourArguments& tour) {
  DemoArguments arguments;
  arguments.tour = tour;
  return run(arguments);
}

void add_demo_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<DemoArguments>();
  CLI::App* verb = app.add_subcommand(
      "demo", "Render a tour of every gear and two lessons offscreen: pictures, sound, report and web page");
  verb->footer(
      "Examples:\n"
      "  gearshift demo --out demo\n"
      "  gearshift demo --gate dog_leg_five --out dog_leg\n");
  add_tour_options(*verb, arguments->tour);
  verb->get_option("--out")->description("folder for the page, pictures, sound, traces and plots; created if missing");
  verb->add_option("--size", arguments->size, "picture size [px]")->type_name("WxH")->capture_default_str();
  verb->add_option("--samples", arguments->samples, "samples per pixel: 1 or 4")
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  verb->add_flag("--stereo", arguments->stereo, "render both eyes, side by side");
  verb->add_option("--film", arguments->film_rate,
                   "also save the whole drive as a series of pictures, at this rate [pictures per second]")
      ->check(number_between(0.1, 60.0));
  verb->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace gearshift::verbs
