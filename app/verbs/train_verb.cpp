// gearshift train: the trainer, in a window or offscreen.
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/train/train.h"
#include "app/verbs/number_between.h"
#include "app/verbs/picture_size.h"
#include "app/verbs/tour_arguments.h"
#include "app/verbs/verbs.h"

namespace gearshift {
namespace {

struct TrainArguments {
  SessionChoice choice;
  std::string bindings = "default", size = "1280x720", offscreen, or_demo;
  int samples = 0;  // 0: 4 on a GPU, 1 on a software driver
  bool stereo = false, no_panel = false, silent = false;
  double seconds = 5.0;  // [s]
};

TrainSetup make_setup(const TrainArguments& arguments) {
  const std::string& hand = arguments.choice.hand;
  if (!hand.empty() && hand != kTouringHand) (void)driving_hand(hand);  // refuses
  TrainSetup setup;
  setup.choice = arguments.choice;
  if (arguments.silent) setup.choice.sound = SoundOutput::none;
  const PictureSize size = picture_size(arguments.size, arguments.stereo);
  setup.view.width = size.width;
  setup.view.height = size.height;
  setup.view.samples = arguments.samples;
  setup.view.stereo = arguments.stereo;
  setup.bindings = read_bindings(find_asset("bindings", arguments.bindings));
  setup.panel = !arguments.no_panel;
  return setup;
}

// A hand that needs nobody drives the same gate.
int run_demo_instead(const TrainArguments& arguments) {
  if (arguments.or_demo.empty())
    throw std::runtime_error("there is no display: train --offscreen DIR needs none, and demo --out DIR shows a tour");
  fmt::print("No display: a simulated hand drives the gate in the cabin instead.\n");
  TourArguments tour;
  tour.folder = arguments.or_demo;
  tour.gate = arguments.choice.gate;
  tour.preset = arguments.choice.preset;
  return run_demo(tour);
}

int run_train(const TrainArguments& arguments) {
  TrainSetup setup = make_setup(arguments);
  if (!arguments.offscreen.empty()) {
    setup.choice.clock = TrainerClock::virtual_time;
    setup.choice.sound = SoundOutput::none;
    if (setup.choice.hand.empty()) setup.choice.hand = kTouringHand;
    return train_offscreen(setup, {arguments.offscreen, arguments.seconds});
  }
  if (!has_display()) return run_demo_instead(arguments);
  return train_in_window(setup);
}

}  // namespace

void add_train_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<TrainArguments>();
  CLI::App* verb = app.add_subcommand("train", "The trainer: a hand at mouse, keys or pad, or the simulated one");
  verb->add_option("--gate", arguments->choice.gate, "shipped gate or layout file")->capture_default_str();
  verb->add_option("--preset", arguments->choice.preset, "shipped or saved preset, or a file")->capture_default_str();
  verb->add_option("--hand", arguments->choice.hand,
                   "light, grip, arm, M,B,K in kg, N s/m, N/m, or \"by itself\": through every gear without a person");
  verb->add_option("--bindings", arguments->bindings, "shipped bindings of keys, mouse and pad, or a file")
      ->capture_default_str();
  verb->add_option("--size", arguments->size, "of the window [px]")->type_name("WxH")->capture_default_str();
  verb->add_option("--samples", arguments->samples, "a pixel: 1 or 4; 4 where the GPU is one")
      ->check(CLI::IsMember({1, 4}));
  verb->add_option("--camera", arguments->choice.camera, "driver, ahead, lever, gate, cluster or gearbox")
      ->check(CLI::IsMember({"driver", "ahead", "lever", "gate", "cluster", "gearbox"}))
      ->capture_default_str();
  verb->add_flag("--stereo", arguments->stereo, "both eyes, side by side");
  verb->add_flag("--no-panel", arguments->no_panel, "the cabin alone; F2 shows the panel");
  verb->add_flag("--silent", arguments->silent, "no sound");
  verb->add_option("--offscreen", arguments->offscreen,
                   "no window: the last picture into this folder, the gears on stdout")
      ->type_name("DIR");
  verb->add_option("--or-demo", arguments->or_demo, "where there is no display: the demo into this folder")
      ->type_name("DIR");
  verb->add_option("--seconds", arguments->seconds, "of simulated time offscreen [s]")
      ->check(number_between(0.1, 600.0))
      ->capture_default_str();
  verb->callback([arguments, &action] { action = [arguments] { return run_train(*arguments); }; });
}

}  // namespace gearshift
