#include "haptics/rt/realtime_scope.h"

#include <sched.h>

#include <thread>

#include <doctest/doctest.h>

using namespace gearshift::haptics;

namespace {

int policy() {
  return sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
}

int priority() {
  sched_param now{};
  sched_getparam(0, &now);
  return now.sched_priority;
}

// Runs `work` on a new thread, so that the calling thread's scheduling stays unchanged.
template <class Work>
void run_on_new_thread(const Work& work) {
  std::thread(work).join();
}

}  // namespace

TEST_CASE("a thread is real-time while the scope exists, if permitted, and threads that it starts are not") {
  bool allowed = false;
  run_on_new_thread([&] { allowed = schedule_fifo(70).empty(); });
  if (!allowed) MESSAGE("no right to SCHED_FIFO here: the scope must change nothing");
  run_on_new_thread([&] {
    {
      const RealtimeScope realtime(70);
      CHECK(policy() == (allowed ? SCHED_FIFO : SCHED_OTHER));
      CHECK(priority() == (allowed ? 70 : 0));
      run_on_new_thread([] { CHECK(policy() == SCHED_OTHER); });
    }
    CHECK(policy() == SCHED_OTHER);
    CHECK(priority() == 0);
  });
}

TEST_CASE("an invalid priority is refused in one sentence and changes nothing") {
  run_on_new_thread([] {
    CHECK(schedule_fifo(0) == "SCHED_FIFO at priority 0 was refused (Invalid argument; allow it with 'rtprio 0')");
    const RealtimeScope realtime(100);
    CHECK(policy() == SCHED_OTHER);
  });
}
