// Ctrl-C, kill and a closed terminal let a program that drives motors end as it should: what was measured or recorded is
// kept, the motors are off, the device is given back. Asked a second time it ends at once. A signal that was ignored when
// the program began (nohup) stays so.
#pragma once

#include <array>
#include <csignal>

namespace gearshift {

class StopSignals {  // one at a time
 public:
  StopSignals();
  ~StopSignals();  // as they were
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static bool asked() noexcept;

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace gearshift
