// gearshift train: the trainer, in a window or offscreen.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/assets_path.h"
#include "app/devices/open_stick.h"
#include "app/print_out.h"
#include "app/train/own_bindings.h"
#include "app/train/train.h"
#include "app/trainer/user_folder.h"
#include "app/verbs/lesson_options.h"
#include "app/verbs/number_between.h"
#include "app/verbs/picture_size.h"
#include "app/verbs/tour_arguments.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

constexpr double kUsualSeconds = 5.0, kMostSeconds = 600.0;  // offscreen

struct TrainArguments {
  SessionChoice choice;
  std::string device{kSimulatedDevice}, bindings, size = "1280x720", offscreen, or_demo;
  int samples = 0;  // 0: 4 on a GPU, 1 on a software driver
  std::string database, replay;
  std::optional<std::size_t> shift;
  bool stereo = false, no_panel = false, silent = false;
  bool xr = false;
  double xr_scale = 1.0;         // [1]
  std::string drive;             // left, right; empty: as it was kept for the headset, else left
  std::optional<double> height;  // [m]
  std::vector<double> knob;      // [m] right, down, ahead
  bool no_help = false;
  double from = 0.0;              // [s]
  std::optional<double> seconds;  // [s] none: kUsualSeconds, or to the end of what is replayed
};

// Without a home folder there are no bindings of one's own.
std::filesystem::path config_folder() {
  try {
    return user_config_folder();
  } catch (const std::runtime_error&) {
    return {};
  }
}

DriveSide drive_side(const TrainArguments& arguments, DriveSide else_where) {
  if (arguments.drive.empty()) return else_where;
  return arguments.drive == "right" ? DriveSide::right : DriveSide::left;
}

// What is given counts from now on: it is kept with what was set before.
HeadsetSetup headset_setup(const TrainArguments& arguments) {
  HeadsetSetup setup;
  setup.view.scale = arguments.xr_scale;
  setup.view.samples = arguments.samples;
  const std::filesystem::path folder = config_folder();
  if (!folder.empty()) setup.seat_file = folder / "headset.toml";
  if (!setup.seat_file.empty()) setup.seat = read_seat(setup.seat_file);
  const DriveSide kept = setup.seat.drive;
  setup.seat.drive = drive_side(arguments, kept);
  if (setup.seat.drive != kept) setup.seat.touched.reset();  // the lever was at his other hand
  if (arguments.height) setup.seat.height = *arguments.height;
  if (arguments.knob.size() == 3)
    setup.seat.knob = KnobDistance{arguments.knob[0], arguments.knob[1], arguments.knob[2]};
  if (setup.seat.knob) check_knob(*setup.seat.knob, setup.seat.drive);
  setup.is_new = !arguments.drive.empty() || arguments.height || !arguments.knob.empty();
  return setup;
}

TrainSetup make_setup(const TrainArguments& arguments) {
  const std::string& hand = arguments.choice.hand;
  if (!hand.empty() && hand != kByItself) (void)driving_hand(hand);  // refuses
  TrainSetup setup;
  setup.choice = arguments.choice;
  setup.choice.help = !arguments.no_help;
  const HistoryPlace place = history_place(arguments.database);
  setup.choice.history = place.file;
  setup.choice.no_history = place.problem;
  if (arguments.silent) setup.choice.sound = SoundOutput::none;
  const PictureSize size = picture_size(arguments.size, arguments.stereo);
  setup.view.width = size.width;
  setup.view.height = size.height;
  setup.view.samples = arguments.samples;
  setup.view.stereo = arguments.stereo;
  setup.bindings = read_bindings(bindings_file(arguments.bindings, config_folder()));
  setup.panel = !arguments.no_panel && !arguments.stereo;  // an eye has little room: F2 shows it
  setup.replay = arguments.replay;
  if (!setup.replay.empty() && setup.choice.lesson.empty()) setup.choice.lesson = kNoLesson;
  if (arguments.shift) setup.shift = *arguments.shift - 1;
  setup.from = arguments.from;
  setup.choice.drive = drive_side(arguments, DriveSide::left);
  if (arguments.xr) {
    setup.headset = headset_setup(arguments);
    setup.choice.drive = setup.headset->seat.drive;
  }
  return setup;
}

// A hand that needs nobody drives the same gate.
int run_demo_instead(const TrainArguments& arguments) {
  if (arguments.or_demo.empty())
    throw std::runtime_error("there is no display: train --offscreen DIR needs none, and demo --out DIR shows a tour");
  print_out("No display: a simulated hand drives the gate in the cabin instead.\n");
  std::fflush(stdout);  // the demo takes a minute
  TourArguments tour;
  tour.folder = arguments.or_demo;
  if (!arguments.choice.gate.empty()) tour.gate = arguments.choice.gate;
  tour.preset = arguments.choice.preset;
  return run_demo(tour);
}

// A hand that drives by itself is nobody's, whoever is named.
void tell_nobody_learns(const SessionChoice& choice) {
  if (choice.learner.empty() || !learner_of(choice).empty()) return;
  print_problem("the hand drives by itself: nothing is remembered of {}", printable(choice.learner));
}

// A person holds it: nobody else leads it, and it has its own time.
std::shared_ptr<StickLever> held_stick(const TrainArguments& arguments) {
  if (arguments.device == kSimulatedDevice) return nullptr;
  if (!arguments.offscreen.empty())
    throw CLI::ValidationError("--device: frames in memory have the simulated lever alone");
  if (!arguments.choice.hand.empty()) throw CLI::ValidationError("--hand: a person's own hand holds the stick");
  if (!has_display()) throw std::runtime_error("there is no display: tour --device needs none");
  return open_stick(arguments.device, user_config_folder() / "devices");
}

int run_train(const TrainArguments& arguments) {
  TrainSetup setup = make_setup(arguments);
  setup.choice.stick = held_stick(arguments);
  if (!arguments.offscreen.empty()) {
    setup.choice.clock = TrainerClock::virtual_time;
    setup.choice.sound = SoundOutput::none;
    if (setup.choice.hand.empty()) setup.choice.hand = kByItself;
    tell_nobody_learns(setup.choice);
    const double usual = arguments.replay.empty() ? kUsualSeconds : kMostSeconds;
    return train_offscreen(setup, {arguments.offscreen, arguments.seconds.value_or(usual)});
  }
  if (!has_display()) return run_demo_instead(arguments);
  tell_nobody_learns(setup.choice);
  return train_in_window(setup);
}

}  // namespace

void add_train_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<TrainArguments>();
  CLI::App* verb = app.add_subcommand("train", "The trainer: a hand at mouse, keys or pad, or the simulated one");
  verb->footer(
      "Examples:\n"
      "  gearshift train --learner Ada\n"
      "  gearshift train --learner Ada --lesson hill_start\n"
      "  gearshift train --offscreen pictures    a few seconds, without a display\n");
  verb->add_option("--lesson", arguments->choice.lesson,
                   "shipped lesson or file, or none; else the one that is suggested");
  verb->add_option("--learner", arguments->choice.learner,
                   "who learns: remembered, but not of a hand by itself; else nothing is")
      ->type_name("NAME")
      ->check(learner_name);
  verb->add_option("--database", arguments->database, "another history than the user's own")->type_name("FILE");
  add_mode_option(*verb, arguments->choice.mode);
  verb->add_flag("--no-help", arguments->no_help, "no force leads the lever to a gear: each trial is graded");
  verb->add_option("--car", arguments->choice.car, "shipped car or file, or none; else the lesson's, or hatchback");
  verb->add_option("--gate", arguments->choice.gate, "shipped gate or layout file; else the lesson's or the car's");
  verb->add_option("--preset", arguments->choice.preset, "shipped or saved preset, or a file")->capture_default_str();
  verb->add_option(
          "--device", arguments->device,
          "the lever: a calibrated force-feedback stick by name, VENDOR:PRODUCT, serial or place (see devices)")
      ->type_name("NAME")
      ->capture_default_str();
  verb->add_option("--hand", arguments->choice.hand,
                   "light, grip, arm, M,B,K in kg, N s/m, N/m, or \"by itself\": drives without a person");
  verb->add_option("--bindings", arguments->bindings,
                   "shipped bindings of keys, mouse and pad, or a file; else your own (see devices), or default");
  verb->add_option("--size", arguments->size, "of the window [px]")->type_name("WxH")->capture_default_str();
  verb->add_option("--samples", arguments->samples, "a pixel: 1 or 4; 4 where the GPU is one")
      ->check(CLI::IsMember({1, 4}));
  CLI::Option* replay =
      verb->add_option("--replay", arguments->replay, "a recorded drive to be looked at")->type_name("TRACE");
  CLI::Option* shift =
      verb->add_option("--shift", arguments->shift, "of the recorded drive: from 1, as replay --shifts lists them")
          ->check(whole_number(1, 1'000'000))
          ->needs(replay);
  verb->add_option("--from", arguments->from, "of the recorded drive, where it begins [s]")
      ->check(number_between(0.0, 1e6))
      ->needs(replay)
      ->excludes(shift);
  verb->add_option("--camera", arguments->choice.camera, "driver, ahead, lever, gate, cluster or gearbox")
      ->check(CLI::IsMember({"driver", "ahead", "lever", "gate", "cluster", "gearbox"}))
      ->capture_default_str();
  CLI::Option* stereo = verb->add_flag("--stereo", arguments->stereo, "both eyes, side by side");
  verb->add_option("--drive", arguments->drive, "where the driver sits: left or right; in a headset it is kept")
      ->check(CLI::IsMember({"left", "right"}));
  CLI::Option* xr =
      verb->add_flag("--xr", arguments->xr, "in a headset, through OpenXR; the window shows it to others");
  verb->add_option("--xr-scale", arguments->xr_scale, "of the headset's picture: more is sharper and slower")
      ->needs(xr)
      ->check(number_between(0.3, 2.0))
      ->capture_default_str();
  verb->add_option("--seat-height", arguments->height, "the seat is raised by [m]; kept")
      ->needs(xr)
      ->check(number_between(-0.3, 0.3));
  verb->add_option("--knob", arguments->knob, "from the eyes of who sits to the real knob [m]; kept")
      ->type_name("RIGHT,DOWN,AHEAD")
      ->delimiter(',')
      ->expected(3)
      ->needs(xr)
      ->check(number_between(-1.5, 1.5));
  verb->add_flag("--no-panel", arguments->no_panel, "the cabin alone; F2 shows the panel");
  verb->add_flag("--silent", arguments->silent, "no sound");
  CLI::Option* offscreen = verb->add_option("--offscreen", arguments->offscreen,
                                            "no window: the last picture into this folder, the gears on stdout")
                               ->type_name("DIR");
  xr->excludes(stereo)->excludes(offscreen);
  verb->add_option("--or-demo", arguments->or_demo, "where there is no display: the demo into this folder")
      ->type_name("DIR");
  verb->add_option("--seconds", arguments->seconds,
                   "of simulated time offscreen [s]: else 5, or to the end of what is replayed")
      ->check(number_between(0.1, kMostSeconds));
  verb->callback([arguments, &action] { action = [arguments] { return run_train(*arguments); }; });
}

}  // namespace gearshift
