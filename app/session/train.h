// The trainer, in a window or off screen with frames in memory.
#pragma once

#include <filesystem>
#include <optional>

#include "app/cabin/view/cabin_view.h"
#include "app/session/learner_headset.h"
#include "app/session/session.h"
#include "app/ui/input/bindings.h"

namespace gearshift::session {

struct TrainSetup {
  SessionChoice choice;
  cabin::ViewConfig view;
  ui::Bindings bindings;
  bool panel = true;
  std::optional<HeadsetSetup> headset;  // empty: desktop only
  std::filesystem::path replay;         // recording to replay; empty: none
  std::optional<std::size_t> shift;     // one shift of it, counted from 0; empty: all of it
  double from = 0.0;                    // [s] start position in it
};

// Runs until the window is closed. Prints a line for each gear. Returns the exit code: 1 if the last recording failed.
int train_in_window(const TrainSetup& setup);

// Renders in memory on the virtual clock, at 30 frames per simulated second. Writes the last frame as train.png into
// the folder.
struct OffscreenSetup {
  std::filesystem::path folder;
  double seconds = 5.0;  // [s] > 0; upper limit: a lesson or a replay may end earlier
};
int train_offscreen(const TrainSetup& setup, const OffscreenSetup& offscreen);

}  // namespace gearshift::session
