#include "app/devices/stop_signals.h"

#include <atomic>
#include <cstddef>

namespace gearshift {
namespace {

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
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &once, nullptr);
  }
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool StopSignals::asked() noexcept {
  return is_asked;
}

}  // namespace gearshift
