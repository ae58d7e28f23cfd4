// Nothing here asserts how fast anything was: only what must hold on the slowest and noisiest machine.
#include "haptics/rt/realtime_thread.h"

#include <linux/capability.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <future>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

namespace gearshift {
namespace {

constexpr std::int64_t kPeriod = 1'000'000;  // [ns]

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

struct Seen {
  CycleCall call;
  std::int64_t began, ended;  // [ns]
};

// Runs `cycles` cycles, doing `work` in each, and tells what was seen.
template <class Work>
std::vector<Seen> run_cycles(RealtimeThread& thread, std::size_t cycles, Work work, RealtimeConfig config = {}) {
  std::vector<Seen> seen;
  seen.reserve(cycles);
  std::promise<void> done;
  thread.start(config, [&](const CycleCall& call) {
    if (seen.size() == cycles) return;
    const std::int64_t began = now_ns();
    work(seen.size(), call);
    seen.push_back({call, began, now_ns()});
    if (seen.size() == cycles) done.set_value();
  });
  done.get_future().wait();
  thread.stop();
  return seen;
}

void busy_until(std::int64_t until_ns) {
  while (now_ns() < until_ns) continue;
}

// Runs `work` on a thread that may neither schedule in real time nor lock memory, whoever runs the test.
template <class Work>
void without_privileges(Work work) {
  munlockall();  // an earlier thread of this program may have locked all that is to come
  rlimit priority{}, memory{};
  getrlimit(RLIMIT_RTPRIO, &priority);
  getrlimit(RLIMIT_MEMLOCK, &memory);
  const rlimit no_priority{0, priority.rlim_max}, little_memory{65536, memory.rlim_max};
  setrlimit(RLIMIT_RTPRIO, &no_priority);
  setrlimit(RLIMIT_MEMLOCK, &little_memory);
  std::thread([&] {  // capabilities are a thread's own, and its children's
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3]{};
    syscall(SYS_capset, &header, none);
    work();
  })
      .join();
  setrlimit(RLIMIT_RTPRIO, &priority);
  setrlimit(RLIMIT_MEMLOCK, &memory);
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("real-time thread: every deadline lies on the grid of the first, and skipped says how far it moved") {
  RealtimeThread thread;
  const std::vector<Seen> seen = run_cycles(thread, 50, [](std::size_t, const CycleCall&) {});
  CHECK(seen[0].call.skipped >= 0);
  for (std::size_t i = 1; i < seen.size(); ++i) {
    const std::int64_t moved = seen[i].call.deadline_ns - seen[i - 1].call.deadline_ns;
    CHECK(moved == (1 + seen[i].call.skipped) * kPeriod);
  }
}

TEST_CASE("real-time thread: no cycle begins before its deadline, with and without spinning") {
  for (const std::int64_t spin : {0, 50'000, 5'000'000}) {
    RealtimeConfig config;
    config.spin_ns = spin;
    RealtimeThread thread;
    for (const Seen& seen : run_cycles(
             thread, 30, [](std::size_t, const CycleCall&) {}, config)) {
      CHECK(seen.began >= seen.call.deadline_ns);
    }
  }
}

TEST_CASE("real-time thread: a cycle that overruns skips the deadlines that it missed and never catches up") {
  RealtimeThread thread;
  const auto late_in_cycle_5 = [](std::size_t i, const CycleCall& call) {
    if (i == 5) busy_until(call.deadline_ns + 5 * kPeriod / 2);
  };
  const std::vector<Seen> seen = run_cycles(thread, 12, late_in_cycle_5);
  CHECK(seen[6].call.skipped >= 2);
  CHECK(seen[6].call.deadline_ns >= seen[5].call.deadline_ns + 3 * kPeriod);
  std::int64_t skipped = seen[0].call.skipped;
  for (std::size_t i = 1; i < seen.size(); ++i) {
    CHECK(seen[i].call.deadline_ns >= seen[i - 1].ended);  // what had passed by then is not run
    skipped += seen[i].call.skipped;
  }
  CHECK(thread.statistics().overruns >= 1);
  CHECK(thread.statistics().skipped >= static_cast<std::uint64_t>(skipped));
}

TEST_CASE("real-time thread: the statistics count every cycle and measure its work") {
  RealtimeThread thread;
  const auto work = [](std::size_t, const CycleCall&) { busy_until(now_ns() + 100'000); };
  const std::vector<Seen> seen = run_cycles(thread, 20, work);
  const CycleStatistics& statistics = thread.statistics();
  CHECK(statistics.cycles >= seen.size());
  CHECK(statistics.duration.count() == statistics.cycles);
  CHECK(statistics.wake_lateness.count() == statistics.cycles);
  CHECK(statistics.duration.max() >= 100'000);
}

TEST_CASE("real-time thread: after stop() no cycle runs, and it may be called twice and start again") {
  RealtimeThread thread;
  thread.stop();
  int after_stop = 0;
  for (int round = 0; round < 3; ++round) {
    bool stopped = false;
    std::promise<void> ran;
    bool told = false;
    thread.start({}, [&](const CycleCall&) {
      if (stopped) ++after_stop;  // a write after the join would also be a race for the sanitizer to see
      if (!told) ran.set_value();
      told = true;
    });
    ran.get_future().wait();
    thread.stop();
    stopped = true;
    thread.stop();
  }
  CHECK(after_stop == 0);
}

TEST_CASE("real-time thread: without rights `required` refuses in one sentence that says how to grant them") {
  without_privileges([] {
    RealtimeThread thread;
    RealtimeConfig config;
    config.policy = RealtimePolicy::required;
    bool ran = false;
    std::string reason;
    try {
      thread.start(config, [&](const CycleCall&) { ran = true; });
    } catch (const std::runtime_error& error) {
      reason = error.what();
    }
    CHECK_FALSE(ran);
    CHECK(contains(reason, "SCHED_FIFO"));
    CHECK(contains(reason, "rtprio 80"));
    CHECK(contains(reason, "memory lock"));
    CHECK(contains(reason, "memlock unlimited"));
    CHECK(contains(reason, "limits.conf"));
    CHECK_FALSE(contains(reason, "\n"));
  });
}

TEST_CASE("real-time thread: without rights `best_effort` runs all the same and says why it is not real-time") {
  without_privileges([] {
    RealtimeThread thread;
    const std::vector<Seen> seen = run_cycles(thread, 5, [](std::size_t, const CycleCall&) {});
    CHECK(seen.size() == 5);
    CHECK_FALSE(thread.is_realtime());
    CHECK(contains(thread.why_not(), "SCHED_FIFO"));
  });
}

TEST_CASE("real-time thread: a core that does not exist is told, not ignored") {
  RealtimeThread thread;
  RealtimeConfig config;
  config.core = 100'000;
  run_cycles(
      thread, 2, [](std::size_t, const CycleCall&) {}, config);
  CHECK(contains(thread.why_not(), "core 100000"));
  config.policy = RealtimePolicy::required;
  CHECK_THROWS_WITH_AS(thread.start(config, [](const CycleCall&) {}), doctest::Contains("core 100000"),
                       std::runtime_error);
}

TEST_CASE("real-time thread: a config out of its range is refused before anything starts") {
  const auto refuses = [](auto change) {
    RealtimeConfig config;
    change(config);
    RealtimeThread thread;
    CHECK_THROWS_AS(thread.start(config, [](const CycleCall&) {}), std::invalid_argument);
  };
  refuses([](RealtimeConfig& config) { config.period_ns = 0; });
  refuses([](RealtimeConfig& config) { config.spin_ns = -1; });
  refuses([](RealtimeConfig& config) { config.priority = 0; });
  refuses([](RealtimeConfig& config) { config.priority = 100; });
}

}  // namespace gearshift
