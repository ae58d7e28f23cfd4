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

// Returns the result of the work, or prints a message and returns nothing if a signal has interrupted the work.
template <class Result>
std::optional<Result> run_until_signal(
    const std::function<Result(const std::function<void(std::string_view, double)>&)>& work) {
  struct Ended {  // not a std::exception, because the work catches those and continues with its next part
    std::string part;
  };
  const StopSignals signals;
  ProgressBar bar;
  try {
    return work([&](std::string_view part, double fraction) {
      if (StopSignals::requested()) throw Ended{std::string(part)};
      bar.show(part, fraction);
    });
  } catch (const Ended& ended) {
    bar.clear();
    print_message("interrupted during \"{}\"; finished files were kept, but no page was written", ended.part);
    return std::nullopt;
  }
}

}  // namespace gearshift::base
