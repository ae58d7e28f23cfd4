// gearshift demo: the tour and two lessons in the cabin, offscreen: pictures, sound, traces, plots, a page.
#include <memory>
#include <optional>
#include <string>

#include "app/demo/demo.h"
#include "app/output_folder.h"
#include "app/print_out.h"
#include "app/verbs/number_between.h"
#include "app/verbs/picture_size.h"
#include "app/verbs/tour_arguments.h"
#include "app/verbs/tour_words.h"
#include "app/verbs/unless_ended.h"
#include "app/verbs/verbs.h"

namespace gearshift {
namespace {

struct DemoArguments {
  TourArguments tour;
  std::string size = "1280x720";
  int samples = 4;
  bool stereo = false;
  double film_rate = 0.0;  // [1/s]
};

// All that can be refused is refused before the folder is made.
int run(const DemoArguments& arguments) {
  DemoSetup setup;
  setup.tour = make_tour_setup(arguments.tour);
  const PictureSize size = picture_size(arguments.size, arguments.stereo);
  setup.view.width = size.width;
  setup.view.height = size.height;
  setup.view.samples = arguments.samples;
  setup.view.stereo = arguments.stereo;
  setup.film_rate = arguments.film_rate;
  make_folder(setup.tour.folder);
  const std::optional<DemoResult> made =
      unless_ended<DemoResult>([&](const TourProgress& progress) { return run_demo(setup, progress); });
  if (!made) return 1;
  const DemoResult& result = *made;
  print_tour(setup.tour, result.tour);
  print_out("{} pictures of {} by {}, {:.0f} ms each\n", result.pictures(), arguments.size, result.device,
            result.picture_ms);
  print_out("{0}/index.html shows pictures, sound, traces and plots; {0}/contact_sheet.png all pictures on one\n",
            setup.tour.folder.string());
  for (const DemoChapter& chapter : result.chapters) {
    print_out("{}\n", chapter.title);
    for (const std::string& sentence : chapter.text) print_out("  {}\n", sentence);
  }
  if (result.has_report) print_out("{}/report.html is the learner's report\n", setup.tour.folder.string());
  if (!result.tour.complete()) print_problem("the hand did not engage every gear in order");
  if (!result.passed) print_problem("the simulated learner did not pass every lesson");
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
      "demo", "Simulated drives in the cabin, offscreen: every gear, two lessons; pictures, sound, report, page");
  verb->footer(
      "Examples:\n"
      "  gearshift demo --out demo\n"
      "  gearshift demo --gate dog_leg_five --out dog_leg\n");
  add_tour_options(*verb, arguments->tour);
  verb->get_option("--out")->description("folder for page, pictures, sound, traces and plots; made where missing");
  verb->add_option("--size", arguments->size, "of a picture [px]")->type_name("WxH")->capture_default_str();
  verb->add_option("--samples", arguments->samples, "a pixel: 1 or 4")
      ->check(CLI::IsMember({1, 4}))
      ->capture_default_str();
  verb->add_flag("--stereo", arguments->stereo, "both eyes, side by side");
  verb->add_option("--film", arguments->film_rate, "pictures a second of the whole drive, too [1/s]")
      ->check(number_between(0.1, 60.0));
  verb->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace gearshift
