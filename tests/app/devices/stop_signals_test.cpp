#include "app/devices/stop_signals.h"

#include <chrono>
#include <csignal>
#include <thread>

#include <doctest/doctest.h>

using gearshift::StopSignals;

// POSIX: a signal to the process is taken by any of its threads. The thread sanitizer judges how the others learn of it.
TEST_CASE("a signal that another thread takes is heard by the one that asks") {
  const StopSignals signals;
  CHECK_FALSE(StopSignals::asked());
  std::thread other([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // the first asks meanwhile
    std::raise(SIGTERM);                                         // of the calling thread
  });
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!StopSignals::asked() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  CHECK(StopSignals::asked());
  other.join();
}

// POSIX, nohup: what was ignored when a program began stays so in it. A closed terminal must not end a run of hours.
TEST_CASE("a signal that was ignored is not taken, and all are as they were in the end") {
  std::signal(SIGHUP, SIG_IGN);
  {
    const StopSignals signals;
    std::raise(SIGHUP);
    CHECK_FALSE(StopSignals::asked());
    std::raise(SIGTERM);
    CHECK(StopSignals::asked());
  }
  const bool is_ignored = std::signal(SIGHUP, SIG_DFL) == SIG_IGN;
  CHECK(is_ignored);
}

TEST_CASE("who begins anew was not asked, and a second signal ends the program at once") {
  {
    const StopSignals before;
    std::raise(SIGINT);
    CHECK(StopSignals::asked());
    struct sigaction action = {};
    REQUIRE(sigaction(SIGINT, nullptr, &action) == 0);
    const bool ends_program = action.sa_handler == SIG_DFL;
    CHECK(ends_program);
  }
  const StopSignals again;
  CHECK_FALSE(StopSignals::asked());
}
