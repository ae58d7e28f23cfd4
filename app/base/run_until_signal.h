// Runs long work with a progress bar. Ctrl-C, SIGTERM or closing the terminal stops the work the next time it reports
// progress.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "app/base/console.h"
#include "app/base/progress_bar.h"
#include "app/base/stop_signals.h"

namespace gearshift::base {

// Returns the result of the work; if a signal interrupted the work, prints a message and returns std::nullopt.
template <class Result>
std::optional<Result> run_until_signal(
    const std::function<Result(const std::function<void(std::string_view, double)>&)>& work) {
  struct Ended {  // not a std::exception, because the work would catch it and continue
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
