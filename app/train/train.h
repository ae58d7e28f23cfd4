// The trainer: a window where there is a display, or frames in memory.
#pragma once

#include <filesystem>
#include <optional>

#include "app/input/bindings.h"
#include "app/train/session.h"
#include "app/train/worn_headset.h"
#include "app/view/cabin_view.h"

namespace gearshift {

struct TrainSetup {
  SessionChoice choice;
  ViewConfig view;
  Bindings bindings;
  bool panel = true;
  std::optional<HeadsetSetup> headset;  // none: the desktop alone
  std::filesystem::path replay;         // a recorded drive to be looked at; empty: none
  std::optional<std::size_t> shift;     // of it, from 0; none: all of it
  double from = 0.0;                    // [s] of it, where it begins
};

// Until the window is closed. Prints a line for each gear. Returns the exit code: 1 where the last recording failed.
int train_in_window(const TrainSetup& setup);

// Frames in memory, on the virtual clock: 30 a second of it. Writes train.png, the last one, into the folder.
struct OffscreenSetup {
  std::filesystem::path folder;
  double seconds = 5.0;  // [s] > 0, at most: a lesson or a recorded drive may end before
};
int train_offscreen(const TrainSetup& setup, const OffscreenSetup& offscreen);

}  // namespace gearshift
