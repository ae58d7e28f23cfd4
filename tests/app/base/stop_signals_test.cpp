#include "app/base/stop_signals.h"

#include <chrono>
#include <csignal>
#include <thread>

#include <doctest/doctest.h>

using gearshift::base::StopSignals;

// POSIX lets any thread receive a signal that is sent to the process. Under the thread sanitizer, this test also proves
// that the polling thread sees the signal without a data race.
TEST_CASE("a signal delivered to another thread is seen by the thread that polls") {
  const StopSignals signals;
  CHECK_FALSE(StopSignals::requested());
  std::thread other([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // lets the main thread start polling
    std::raise(SIGTERM);                                         // raise() delivers the signal to this thread
  });
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!StopSignals::requested() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  CHECK(StopSignals::requested());
  other.join();
}

// A signal that was ignored when the program started must stay ignored. nohup, for example, ignores SIGHUP, so that
// closing the terminal does not end a run that takes hours.
TEST_CASE("an ignored signal stays ignored, and all handlers are restored at the end") {
  std::signal(SIGHUP, SIG_IGN);
  {
    const StopSignals signals;
    std::raise(SIGHUP);
    CHECK_FALSE(StopSignals::requested());
    std::raise(SIGTERM);
    CHECK(StopSignals::requested());
  }
  const bool is_ignored = std::signal(SIGHUP, SIG_DFL) == SIG_IGN;
  CHECK(is_ignored);
}

TEST_CASE("a new object has no stop request, and a second signal ends the program at once") {
  {
    const StopSignals before;
    std::raise(SIGINT);
    CHECK(StopSignals::requested());
    struct sigaction action = {};
    REQUIRE(sigaction(SIGINT, nullptr, &action) == 0);
    const bool ends_program = action.sa_handler == SIG_DFL;
    CHECK(ends_program);
  }
  const StopSignals again;
  CHECK_FALSE(StopSignals::requested());
}
