// Lets a program that drives motors end cleanly on Ctrl-C, kill or a closed terminal: it can save results, switch the
// motors off and release the device. A second signal ends the program at once. A signal that was ignored when the
// program started (nohup) stays ignored.
#pragma once

#include <array>
#include <csignal>

namespace gearshift::base {

class StopSignals {  // only one object may exist at a time
 public:
  StopSignals();
  ~StopSignals();  // restores the previous signal handlers
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static bool requested() noexcept;

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace gearshift::base
