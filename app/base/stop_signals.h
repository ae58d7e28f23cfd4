// Lets a program that drives motors end cleanly on Ctrl-C, kill and a closed terminal: results are saved, motors are
// off, the device is released. A second signal ends the program at once. A signal that was ignored when the program
// started (nohup) stays ignored.
#pragma once

#include <array>
#include <csignal>

namespace gearshift::base {

class StopSignals {  // only one object may exist at a time
 public:
  StopSignals();
  ~StopSignals();  // restores the previous handlers
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static bool requested() noexcept;

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace gearshift::base
