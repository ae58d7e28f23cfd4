// Runs the trainer, in a window or off screen.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/cabin/view/cabin_view.h"
#include "app/session/learner_headset.h"
#include "app/session/session.h"
#include "app/ui/input/bindings.h"

namespace gearshift::session {

struct TrainSetup {
  SessionChoice choice;
  cabin::ViewConfig view;
  ui::Bindings bindings;
  ui::Bindings shipped_bindings;
  std::filesystem::path own_bindings;  // file written when controllers are set up; empty: the user has no folder
  std::filesystem::path declined_controllers;  // file with the controllers not to offer for setting up; empty: none
  std::string stick_id;                        // USB id of the force-feedback stick, as Controller::id; empty: none
  bool panel = true;
  std::optional<ui::PanelView> panel_view;  // empty: as in `view_file`, and the learner's if there is no such file
  std::filesystem::path view_file;          // keeps the user's choice of the view; empty: it is not kept
  std::optional<HeadsetSetup> headset;      // empty: desktop only
  std::filesystem::path replay;             // recording to replay; empty: none
  std::optional<std::size_t> shift;         // shift to replay, counted from 0; empty: the whole recording
  double from = 0.0;                        // [s] start position in the recording
};

// Runs until the user quits. Prints a line for each engaged gear. Returns the exit code, which is 1 if the last
// recording failed.
int train_in_window(const TrainSetup& setup);

// Settings for train_offscreen(), which runs on the virtual clock at 30 frames per simulated second and writes the last
// frame to train.png in the folder.
struct OffscreenSetup {
  std::filesystem::path folder;
  double seconds = 5.0;  // [s] > 0; maximum duration; the end of a lesson or replay also ends the run
};
int train_offscreen(const TrainSetup& setup, const OffscreenSetup& offscreen);

}  // namespace gearshift::session
