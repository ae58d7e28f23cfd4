#include "app/devices/stop_signals.h"

#include <csignal>

namespace gearshift {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t is_asked = 0;

void ask(int) {
  is_asked = 1;
}

}  // namespace

// Calls that wait are not taken up again: whoever waits for an answer learns of it.
StopSignals::StopSignals() {
  is_asked = 0;
  struct sigaction once = {};
  once.sa_handler = ask;
  once.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : kSignals) sigaction(signal, &once, nullptr);
}

StopSignals::~StopSignals() {
  for (const int signal : kSignals) std::signal(signal, SIG_DFL);
}

bool StopSignals::asked() noexcept {
  return is_asked != 0;
}

}  // namespace gearshift
