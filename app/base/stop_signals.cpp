#include "app/base/stop_signals.h"

#include <atomic>
#include <cstddef>

namespace gearshift::base {
namespace {

// Atomic because the signal handler may run in any thread; a sig_atomic_t is safe only within a single thread.
std::atomic<bool> is_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may use only lock-free atomics

void request_stop(int) {
  is_requested = true;
}

}  // namespace

// The handlers are installed without SA_RESTART. So a signal ends blocking calls, and their callers notice the request.
StopSignals::StopSignals() {
  is_requested = false;
  struct sigaction once = {};
  once.sa_handler = request_stop;
  once.sa_flags = static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &once, nullptr);
  }
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool StopSignals::requested() noexcept {
  return is_requested;
}

}  // namespace gearshift::base
