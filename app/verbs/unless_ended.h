// Work that takes its time and makes files, with a bar of how far it is: Ctrl-C, kill and a closed terminal end it where it
// next tells that.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "app/devices/stop_signals.h"
#include "app/print_out.h"
#include "app/verbs/progress_bar.h"

namespace gearshift {

// What the work makes; nothing where it was ended, which is told.
template <class Made>
std::optional<Made> unless_ended(
    const std::function<Made(const std::function<void(std::string_view, double)>&)>& work) {
  struct Ended {  // no std::exception: what a part that fails costs no other, this does
    std::string part;
  };
  const StopSignals signals;
  ProgressBar bar;
  try {
    return work([&](std::string_view part, double share) {
      if (StopSignals::asked()) throw Ended{std::string(part)};
      bar.show(part, share);
    });
  } catch (const Ended& ended) {
    bar.clear();
    print_problem("ended in the part {}: what is whole stays, the page is not made", ended.part);
    return std::nullopt;
  }
}

}  // namespace gearshift
