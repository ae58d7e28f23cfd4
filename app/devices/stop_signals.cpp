#include "app/devices/stop_signals.h"

#include <atomic>
#include <csignal>

namespace gearshift {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

// Any thread may be the one that takes the signal: sig_atomic_t would hold within that one only.
std::atomic<bool> is_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // else no handler may write it

void ask(int) {
  is_asked = true;
}

}  // namespace

// Calls that wait are not taken up again: whoever waits for an answer learns of it.
StopSignals::StopSignals() {
  is_asked = false;
  struct sigaction once = {};
  once.sa_handler = ask;
  once.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : kSignals) sigaction(signal, &once, nullptr);
}

StopSignals::~StopSignals() {
  for (const int signal : kSignals) std::signal(signal, SIG_DFL);
}

bool StopSignals::asked() noexcept {
  return is_asked;
}

}  // namespace gearshift
