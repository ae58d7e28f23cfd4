// gearshift train: runs the trainer in a window, in a headset or off screen.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/base/user_folders.h"
#include "app/runtime/devices/open_stick.h"
#include "app/session/bindings_file.h"
#include "app/session/resolve_choice.h"
#include "app/session/train.h"
#include "app/verbs/history_choice.h"
#include "app/verbs/lesson_options.h"
#include "app/verbs/number_between.h"
#include "app/verbs/picture_size.h"
#include "app/verbs/tour_arguments.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"
#include "haptics/files/printable.h"

namespace gearshift::verbs {
namespace {

constexpr double kDefaultSeconds = 5.0, kMaxSeconds = 600.0;  // [s] default and maximum duration of an off-screen run

struct TrainArguments {
  session::SessionChoice choice;
  std::string device{session::kSimulatedDevice}, bindings, size = "1280x720", offscreen, or_demo;
  int samples = 0;  // samples per pixel; 0: 4 on a GPU, 1 with a software driver
  std::string database, replay;
  std::optional<std::size_t> shift;
  std::string view;  // of the panel: learner or engineer; empty: as chosen last
  bool stereo = false, no_panel = false, silent = false;
  bool xr = false;
  double xr_scale = 1.0;         // [1] see HeadsetViewConfig::scale
  std::string drive;             // driver's side, left or right; empty: as saved for the headset, otherwise left
  std::optional<double> height;  // [m] see SeatSettings::height
  std::vector<double> knob;      // [m] distances right, down, ahead, see KnobDistance
  bool no_help = false;
  double from = 0.0;              // [s] start of the replay
  std::optional<double> seconds;  // [s] duration; empty: kDefaultSeconds, or kMaxSeconds for a replay
};

// The user's configuration folder; empty if there is no home folder.
std::filesystem::path config_folder() {
  try {
    return base::user_config_folder();
  } catch (const std::runtime_error&) {
    return {};
  }
}

cabin::DriveSide drive_side(const TrainArguments& arguments, cabin::DriveSide fallback) {
  if (arguments.drive.empty()) return fallback;
  return arguments.drive == "right" ? cabin::DriveSide::right : cabin::DriveSide::left;
}

// Settings for the headset. Seat values given on the command line replace the saved values and are saved.
session::HeadsetSetup headset_setup(const TrainArguments& arguments) {
  session::HeadsetSetup setup;
  setup.view.scale = arguments.xr_scale;
  setup.view.samples = arguments.samples;
  const std::filesystem::path folder = config_folder();
  if (!folder.empty()) setup.seat_file = folder / "headset.toml";
  if (!setup.seat_file.empty()) setup.seat = cabin::read_seat(setup.seat_file);
  const cabin::DriveSide saved = setup.seat.drive;
  setup.seat.drive = drive_side(arguments, saved);
  // If the driver changes sides, discard the saved pose: it was measured with the lever on the other side of the
  // driver.
  if (setup.seat.drive != saved) setup.seat.touched.reset();
  if (arguments.height) setup.seat.height = *arguments.height;
  if (arguments.knob.size() == 3)
    setup.seat.knob = cabin::KnobDistance{arguments.knob[0], arguments.knob[1], arguments.knob[2]};
  if (setup.seat.knob) cabin::check_knob(*setup.seat.knob, setup.seat.drive);
  setup.is_new = !arguments.drive.empty() || arguments.height || !arguments.knob.empty();
  return setup;
}

session::TrainSetup make_setup(const TrainArguments& arguments) {
  const std::string& hand = arguments.choice.hand;
  if (!hand.empty() && hand != session::kAutomaticHand) (void)driving_hand(hand);  // throws if the hand is not valid
  session::TrainSetup setup;
  setup.choice = arguments.choice;
  setup.choice.help = !arguments.no_help;
  const HistoryChoice history = choose_history(arguments.database);
  setup.choice.history = history.place.file;
  setup.choice.no_history = history.place.problem;
  setup.choice.server = history.server;
  if (arguments.silent) setup.choice.sound = engine::SoundOutput::none;
  const PictureSize size = picture_size(arguments.size, arguments.stereo);
  setup.view.width = size.width;
  setup.view.height = size.height;
  setup.view.samples = arguments.samples;
  setup.view.stereo = arguments.stereo;
  const std::filesystem::path folder = config_folder();
  setup.bindings = ui::read_bindings(session::bindings_file(arguments.bindings, folder));
  setup.shipped_bindings = ui::read_bindings(base::find_asset("bindings", "default"));
  std::error_code ignored;
  if (std::filesystem::is_regular_file(arguments.bindings, ignored))
    setup.own_bindings = arguments.bindings;  // a file that the user has named
  else if (!folder.empty())
    setup.own_bindings = ui::user_bindings_file(folder, std::string(session::kOwnBindings));
  if (!folder.empty()) setup.declined_controllers = folder / "declined_controllers.txt";
  if (!folder.empty()) setup.view_file = folder / "view.txt";
  if (!arguments.view.empty())
    setup.panel_view = arguments.view == "learner" ? ui::PanelView::learner : ui::PanelView::engineer;
  setup.choice.pedal_timing = setup.bindings.pedal_timing;
  // In stereo each eye has only half of the picture's width. That is too narrow for the panel.
  setup.panel = !arguments.no_panel && !arguments.stereo;
  setup.replay = arguments.replay;
  const bool can_teach = setup.replay.empty() && session::resolve_car(setup.choice).layout.aisles.empty();
  if (!can_teach && setup.choice.lesson.empty()) setup.choice.lesson = session::kNoLesson;
  if (arguments.shift) setup.shift = *arguments.shift - 1;
  setup.from = arguments.from;
  setup.choice.drive = drive_side(arguments, cabin::DriveSide::left);
  if (arguments.xr) {
    setup.headset = headset_setup(arguments);
    setup.choice.drive = setup.headset->seat.drive;
  }
  return setup;
}

// Runs the demo, which needs neither a display nor a user, with the chosen gate and preset.
int run_demo_instead(const TrainArguments& arguments) {
  if (arguments.or_demo.empty())
    throw std::runtime_error(
        "no display found; use gearshift train --offscreen DIR, or gearshift demo --out DIR for a tour");
  base::print_out("No display found. Running the demo with a simulated hand instead.\n");
  std::fflush(stdout);  // show the message at once, because the demo takes a minute
  TourArguments tour;
  tour.folder = arguments.or_demo;
  if (!arguments.choice.gate.empty()) tour.gate = arguments.choice.gate;
  tour.preset = arguments.choice.preset;
  return run_demo(tour);
}

// If the user named a learner, warns that runs by the simulated driver are not saved.
void warn_nothing_is_saved(const session::SessionChoice& choice) {
  if (choice.learner.empty() || !session::learner_of(choice).empty()) return;
  base::print_message("the simulated driver is driving, so nothing is saved for {}",
                      haptics::printable(choice.learner));
}

// Opens the stick given with --device. Returns null for the simulated lever. The user moves the stick in real time, so
// --device cannot be combined with a simulated hand or off-screen frames.
std::shared_ptr<runtime::StickLever> held_stick(const TrainArguments& arguments) {
  if (arguments.device == session::kSimulatedDevice) return nullptr;
  if (!arguments.offscreen.empty())
    throw CLI::ValidationError("--device cannot be used with --offscreen, which has only the simulated lever");
  if (!arguments.choice.hand.empty())
    throw CLI::ValidationError("--hand cannot be used with --device, because your own hand holds the stick");
  if (!engine::has_display())
    throw std::runtime_error("no display found; use gearshift tour --device NAME, which needs no display");
  return runtime::open_stick(arguments.device, base::user_config_folder() / "devices");
}

int run_train(const TrainArguments& arguments) {
  session::TrainSetup setup = make_setup(arguments);
  setup.choice.stick = held_stick(arguments);
  if (setup.choice.stick) setup.stick_id = setup.choice.stick->id();
  if (!arguments.offscreen.empty()) {
    setup.choice.clock = runtime::RuntimeClock::virtual_time;
    setup.choice.sound = engine::SoundOutput::none;
    if (setup.choice.hand.empty()) setup.choice.hand = session::kAutomaticHand;
    warn_nothing_is_saved(setup.choice);
    const double usual = arguments.replay.empty() ? kDefaultSeconds : kMaxSeconds;
    return session::train_offscreen(setup, {arguments.offscreen, arguments.seconds.value_or(usual)});
  }
  if (!engine::has_display()) return run_demo_instead(arguments);
  warn_nothing_is_saved(setup.choice);
  return session::train_in_window(setup);
}

}  // namespace

void add_train_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<TrainArguments>();
  CLI::App* verb =
      app.add_subcommand("train", "Start the trainer: drive with a stick, mouse, keys or pad, or watch a drive");
  verb->footer(
      "Examples:\n"
      "  gearshift train --learner Ada\n"
      "  gearshift train --learner Ada --lesson hill_start\n"
      "  gearshift train --offscreen pictures    a few seconds without a display\n");
  verb->add_option("--lesson", arguments->choice.lesson,
                   "shipped lesson, lesson file, or none; default: the suggested one");
  verb->add_option("--learner", arguments->choice.learner,
                   "save results under this name (ignored with --hand \"by itself\")")
      ->type_name("NAME")
      ->check(validate_learner_name);
  verb->add_option("--database", arguments->database,
                   "history file to use instead of your own, or postgresql:// URL of a school's server")
      ->type_name("FILE");
  add_mode_option(*verb, arguments->choice.mode);
  verb->add_flag("--no-help", arguments->no_help, "never guide the lever, so that every attempt is graded");
  verb->add_option("--car", arguments->choice.car,
                   "shipped car, car file, or none; default: the lesson's, or hatchback");
  verb->add_option("--gate", arguments->choice.gate, "shipped gate or layout file; default: the lesson's or the car's");
  verb->add_option("--preset", arguments->choice.preset, "shipped or saved preset, or preset file")
      ->capture_default_str();
  verb->add_option("--device", arguments->device,
                   "calibrated force-feedback stick to use as the lever: name, VENDOR:PRODUCT, serial or port (see "
                   "gearshift devices)")
      ->type_name("NAME")
      ->capture_default_str();
  verb->add_option("--hand", arguments->choice.hand,
                   "simulated hand: light, grip or arm; its mass, damping and stiffness as M,B,K [kg, N s/m, N/m]; or "
                   "\"by itself\" for a simulated driver");
  verb->add_option(
      "--bindings", arguments->bindings,
      "bindings of keys, mouse and pad: a shipped name or a file. If omitted: your own bindings (see gearshift "
      "devices), or the shipped ones if you have none");
  verb->add_option("--size", arguments->size, "window size [px]")->type_name("WxH")->capture_default_str();
  verb->add_option("--samples", arguments->samples,
                   "samples per pixel: 1 or 4; default: 4, or 1 with a software renderer")
      ->check(CLI::IsMember({1, 4}));
  CLI::Option* replay = verb->add_option("--replay", arguments->replay, "replay this recorded drive instead of driving")
                            ->type_name("TRACE");
  CLI::Option* shift =
      verb->add_option("--shift", arguments->shift,
                       "start the recorded drive at this shift, numbered as in gearshift replay --shifts")
          ->check(whole_number(1, 1'000'000))
          ->needs(replay);
  verb->add_option("--from", arguments->from, "start the recorded drive at this time [s]")
      ->check(number_between(0.0, 1e6))
      ->needs(replay)
      ->excludes(shift);
  verb->add_option("--camera", arguments->choice.camera,
                   "camera to start with: driver, ahead, lever, gate, cluster or gearbox")
      ->check(CLI::IsMember({"driver", "ahead", "lever", "gate", "cluster", "gearbox"}))
      ->capture_default_str();
  CLI::Option* stereo = verb->add_flag("--stereo", arguments->stereo, "draw both eyes, side by side");
  verb->add_option("--drive", arguments->drive,
                   "side of the car on which the driver sits: left or right; saved with --xr")
      ->check(CLI::IsMember({"left", "right"}));
  CLI::Option* xr =
      verb->add_flag("--xr", arguments->xr, "use a headset through OpenXR; the window mirrors the headset");
  verb->add_option("--xr-scale", arguments->xr_scale,
                   "resolution scale of the headset; higher values are sharper and slower")
      ->needs(xr)
      ->check(number_between(0.3, 2.0))
      ->capture_default_str();
  verb->add_option("--seat-height", arguments->height, "raise the seat by this much [m]; saved for later sessions")
      ->needs(xr)
      ->check(number_between(-0.3, 0.3));
  verb->add_option("--knob", arguments->knob,
                   "position of the real knob relative to your eyes [m]; saved for later sessions")
      ->type_name("RIGHT,DOWN,AHEAD")
      ->delimiter(',')
      ->expected(3)
      ->needs(xr)
      ->check(number_between(-1.5, 1.5));
  verb->add_option("--view", arguments->view,
                   "view to start with: learner or engineer; if omitted: the one chosen last, at first the learner's")
      ->check(CLI::IsMember({"learner", "engineer"}));
  verb->add_flag("--no-panel", arguments->no_panel, "start without the panel; press F2 to show it");
  verb->add_flag("--silent", arguments->silent, "turn the sound off");
  CLI::Option* offscreen =
      verb->add_option("--offscreen", arguments->offscreen,
                       "run without a window: write the last picture to this folder and print the gears")
          ->type_name("DIR");
  xr->excludes(stereo)->excludes(offscreen);
  verb->add_option("--or-demo", arguments->or_demo,
                   "if there is no display, run the demo and write its files to this folder")
      ->type_name("DIR");
  verb->add_option("--seconds", arguments->seconds,
                   "simulated time to run with --offscreen [s]; default: 5, or the whole replay")
      ->check(number_between(0.1, kMaxSeconds));
  verb->callback([arguments, &action] { action = [arguments] { return run_train(*arguments); }; });
}

}  // namespace gearshift::verbs
