// Runs long work with a progress bar. Ctrl-C, SIGTERM and a closed terminal stop it the next time it reports progress.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "app/base/console.h"
#include "app/base/progress_bar.h"
#include "app/base/stop_signals.h"

namespace gearshift::base {

// Returns the result of the work. If a signal interrupted it, prints a message and returns nothing.
template <class Made>
std::optional<Made> run_until_signal(
    const std::function<Made(const std::function<void(std::string_view, double)>&)>& work) {
  struct Ended {  // not a std::exception: the work catches those to continue with its next part
    std::string part;
  };
  const StopSignals signals;
  ProgressBar bar;
  try {
    return work([&](std::string_view part, double share) {
      if (StopSignals::requested()) throw Ended{std::string(part)};
      bar.show(part, share);
    });
  } catch (const Ended& ended) {
    bar.clear();
    print_message("interrupted during \"{}\"; finished files kept, no page written", ended.part);
    return std::nullopt;
  }
}

}  // namespace gearshift::base
