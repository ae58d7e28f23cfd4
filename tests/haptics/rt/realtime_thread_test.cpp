// These tests assert no speed, only properties that hold on the slowest and busiest machine.
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

namespace gearshift::test {
namespace {

constexpr std::int64_t kPeriod = 1'000'000;  // [ns]

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

struct RecordedCycle {
  haptics::CycleCall call;
  std::int64_t began, ended;  // [ns]
};

// Runs `work` in `cycles` cycles and returns the record of each cycle.
template <class Work>
std::vector<RecordedCycle> run_cycles(haptics::RealtimeThread& thread, std::size_t cycles, Work work,
                                      haptics::RealtimeConfig config = {}) {
  std::vector<RecordedCycle> cycles_run;
  cycles_run.reserve(cycles);
  std::promise<void> done;
  thread.start(config, [&](const haptics::CycleCall& call) {
    if (cycles_run.size() == cycles) return;
    const std::int64_t began = now_ns();
    work(cycles_run.size(), call);
    cycles_run.push_back({call, began, now_ns()});
    if (cycles_run.size() == cycles) done.set_value();
  });
  done.get_future().wait();
  thread.stop();
  return cycles_run;
}

void busy_until(std::int64_t until_ns) {
  while (now_ns() < until_ns) continue;
}

// Runs `work` on a thread that may neither use real-time scheduling nor lock memory, even if the tests run as root.
template <class Work>
void without_privileges(Work work) {
  munlockall();  // an earlier test may have locked all future memory of the process
  rlimit priority{}, memory{};
  getrlimit(RLIMIT_RTPRIO, &priority);
  getrlimit(RLIMIT_MEMLOCK, &memory);
  const rlimit no_priority{0, priority.rlim_max}, little_memory{65536, memory.rlim_max};
  setrlimit(RLIMIT_RTPRIO, &no_priority);
  setrlimit(RLIMIT_MEMLOCK, &little_memory);
  std::thread([&] {  // a new thread, because capabilities belong to a thread
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
  haptics::RealtimeThread thread;
  const std::vector<RecordedCycle> cycles_run = run_cycles(thread, 50, [](std::size_t, const haptics::CycleCall&) {});
  CHECK(cycles_run[0].call.skipped >= 0);
  for (std::size_t i = 1; i < cycles_run.size(); ++i) {
    const std::int64_t moved = cycles_run[i].call.deadline_ns - cycles_run[i - 1].call.deadline_ns;
    CHECK(moved == (1 + cycles_run[i].call.skipped) * kPeriod);
  }
}

TEST_CASE("real-time thread: a cycle is told how late it is, with the deadlines that its thread slept through") {
  haptics::RealtimeThread thread;
  for (const RecordedCycle& cycle : run_cycles(thread, 50, [](std::size_t, const haptics::CycleCall&) {})) {
    const std::int64_t late = cycle.call.late_ns;
    CHECK(late >= 0);
    CHECK(late / kPeriod <= cycle.call.skipped);
    CHECK(late % kPeriod <= cycle.began - cycle.call.deadline_ns);  // the cycle begins after the wake-up
  }
}

TEST_CASE("real-time thread: no cycle begins before its deadline, with and without spinning") {
  for (const std::int64_t spin : {0, 50'000, 5'000'000}) {
    haptics::RealtimeConfig config;
    config.spin_ns = spin;
    haptics::RealtimeThread thread;
    for (const RecordedCycle& cycles_run : run_cycles(
             thread, 30, [](std::size_t, const haptics::CycleCall&) {}, config)) {
      CHECK(cycles_run.began >= cycles_run.call.deadline_ns);
    }
  }
}

TEST_CASE("real-time thread: a cycle that overruns skips the deadlines that it missed and never catches up") {
  haptics::RealtimeThread thread;
  const auto late_in_cycle_5 = [](std::size_t i, const haptics::CycleCall& call) {
    if (i == 5) busy_until(call.deadline_ns + 5 * kPeriod / 2);
  };
  const std::vector<RecordedCycle> cycles_run = run_cycles(thread, 12, late_in_cycle_5);
  CHECK(cycles_run[6].call.skipped >= 2);
  CHECK(cycles_run[6].call.deadline_ns >= cycles_run[5].call.deadline_ns + 3 * kPeriod);
  std::int64_t skipped = cycles_run[0].call.skipped;
  for (std::size_t i = 1; i < cycles_run.size(); ++i) {
    CHECK(cycles_run[i].call.deadline_ns >= cycles_run[i - 1].ended);  // the deadlines during a long cycle are skipped
    skipped += cycles_run[i].call.skipped;
  }
  CHECK(thread.statistics().overruns >= 1);
  CHECK(thread.statistics().skipped >= static_cast<std::uint64_t>(skipped));
}

TEST_CASE("real-time thread: the statistics count every cycle and measure its work") {
  haptics::RealtimeThread thread;
  const auto work = [](std::size_t, const haptics::CycleCall&) { busy_until(now_ns() + 100'000); };
  const std::vector<RecordedCycle> cycles_run = run_cycles(thread, 20, work);
  const haptics::CycleStatistics& statistics = thread.statistics();
  CHECK(statistics.cycles >= cycles_run.size());
  CHECK(statistics.duration.count() == statistics.cycles);
  CHECK(statistics.wake_lateness.count() == statistics.cycles);
  CHECK(statistics.duration.max() >= 100'000);
}

TEST_CASE("real-time thread: after stop() no cycle runs, and it may be called twice and start again") {
  haptics::RealtimeThread thread;
  thread.stop();
  int after_stop = 0;
  for (int round = 0; round < 3; ++round) {
    bool stopped = false;
    std::promise<void> ran;
    bool has_run = false;
    thread.start({}, [&](const haptics::CycleCall&) {
      if (stopped) ++after_stop;  // a cycle after stop() is also a data race, which ThreadSanitizer reports
      if (!has_run) ran.set_value();
      has_run = true;
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
    haptics::RealtimeThread thread;
    haptics::RealtimeConfig config;
    config.policy = haptics::RealtimePolicy::required;
    bool ran = false;
    std::string reason;
    try {
      thread.start(config, [&](const haptics::CycleCall&) { ran = true; });
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

TEST_CASE("real-time thread: without rights `best_effort` runs anyway and says why it is not real-time") {
  without_privileges([] {
    haptics::RealtimeThread thread;
    const std::vector<RecordedCycle> cycles_run = run_cycles(thread, 5, [](std::size_t, const haptics::CycleCall&) {});
    CHECK(cycles_run.size() == 5);
    CHECK_FALSE(thread.is_realtime());
    CHECK(contains(thread.not_realtime_reason(), "SCHED_FIFO"));
  });
}

TEST_CASE("real-time thread: a core that does not exist is reported, not ignored") {
  haptics::RealtimeThread thread;
  haptics::RealtimeConfig config;
  config.core = 100'000;
  run_cycles(
      thread, 2, [](std::size_t, const haptics::CycleCall&) {}, config);
  CHECK(contains(thread.not_realtime_reason(), "core 100000"));
  config.policy = haptics::RealtimePolicy::required;
  CHECK_THROWS_WITH_AS(thread.start(config, [](const haptics::CycleCall&) {}), doctest::Contains("core 100000"),
                       std::runtime_error);
}

TEST_CASE("real-time thread: a config out of range is refused before anything starts") {
  const auto refuses = [](auto change) {
    haptics::RealtimeConfig config;
    change(config);
    haptics::RealtimeThread thread;
    CHECK_THROWS_AS(thread.start(config, [](const haptics::CycleCall&) {}), std::invalid_argument);
  };
  refuses([](haptics::RealtimeConfig& config) { config.period_ns = 0; });
  refuses([](haptics::RealtimeConfig& config) { config.spin_ns = -1; });
  refuses([](haptics::RealtimeConfig& config) { config.priority = 0; });
  refuses([](haptics::RealtimeConfig& config) { config.priority = 100; });
}

}  // namespace gearshift::test
