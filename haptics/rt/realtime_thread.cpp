#include "haptics/rt/realtime_thread.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <future>
#include <stdexcept>
#include <utility>

#include "haptics/rt/monotonic_clock.h"
#include "haptics/rt/realtime_scope.h"

namespace gearshift {
namespace {

constexpr std::size_t kStackBytes = std::size_t{256} * 1024;  // touched before the first cycle
constexpr std::size_t kPageBytes = 4096;

void sleep_until(std::int64_t wake_ns) noexcept {
  const timespec wake{wake_ns / kSecondNs, wake_ns % kSecondNs};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) continue;
}

void cpu_relax() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

// Faults in the pages below this frame, so that no cycle is the first to touch them.
[[gnu::noinline]] void prefault_stack() noexcept {
  unsigned char stack[kStackBytes];
  volatile unsigned char* page = stack;
  for (std::size_t at = 0; at < kStackBytes; at += kPageBytes) page[at] = 1;
}

bool may_lock_any_amount() noexcept {
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) return true;
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct held[_LINUX_CAPABILITY_U32S_3]{};
  if (syscall(SYS_capget, &header, held) != 0) return false;
  return (held[0].effective & (1u << CAP_IPC_LOCK)) != 0;
}

// What is locked stays in memory when it is freed, unless malloc gives it back. By itself it keeps ever larger blocks, a
// cabin's textures among them, in heaps with holes: a session grew by 65 MB with each change of the gate (tests/flow/SOAK.md).
constexpr int kGivenBack = 1 << 20;  // [bytes] of a block that gets, and gives back, pages of its own

// Each returns what was refused, or nothing.
std::string lock_memory() {
  mallopt(M_MMAP_THRESHOLD, kGivenBack);
  // Under a finite limit, a lock that succeeds now makes some later allocation fail: worse than none.
  if (!may_lock_any_amount()) return "the memory lock was refused (grant it with 'memlock unlimited')";
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return {};
  return std::string("the memory lock was refused: ") + std::strerror(errno) + " (grant it with 'memlock unlimited')";
}

std::string pin_to(int core) {
  if (core < 0) return {};
  cpu_set_t set;
  CPU_ZERO(&set);
  if (core < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(core), &set);
  if (sched_setaffinity(0, sizeof set, &set) == 0) return {};
  return "core " + std::to_string(core) + " was refused: " + std::strerror(errno);
}

// An idle core sleeps deeply and wakes late; while this file is held open with a 0 in it, no core does. cyclictest
// holds it, too. Best effort: without the right to open it the wake-ups are later, and that is all.
class AwakeCores {
 public:
  AwakeCores() noexcept : file_(open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC)) {
    const std::int32_t most_us = 0;
    if (file_ >= 0 && write(file_, &most_us, sizeof most_us) != sizeof most_us) let_sleep();
  }
  ~AwakeCores() { let_sleep(); }
  AwakeCores(const AwakeCores&) = delete;
  AwakeCores& operator=(const AwakeCores&) = delete;

 private:
  void let_sleep() noexcept {
    if (file_ >= 0) close(file_);
    file_ = -1;
  }
  int file_;
};

void append(std::string& sentence, const std::string& part) {
  if (part.empty()) return;
  sentence += sentence.empty() ? "not real-time: " : ", and ";
  sentence += part;
}

// Woken late by whole periods: the newest deadline that has passed is taken, those before it are skipped.
CycleCall newest_passed(const CycleCall& call, std::int64_t woke, std::int64_t period) noexcept {
  const std::int64_t missed = (woke - call.deadline_ns) / period;
  return {call.deadline_ns + missed * period, call.skipped + missed};
}

// Ended after the next deadline: that one and every other that has passed are skipped, never caught up.
CycleCall first_ahead(const CycleCall& call, std::int64_t done, std::int64_t period) noexcept {
  const std::int64_t next = call.deadline_ns + period;
  const std::int64_t missed = done > next ? (done - next + period - 1) / period : 0;
  return {next + missed * period, missed};
}

void check(const RealtimeConfig& config) {
  if (config.period_ns <= 0) throw std::invalid_argument("the period of a real-time thread must be above 0 ns");
  if (config.spin_ns < 0) throw std::invalid_argument("the spin of a real-time thread must not be below 0 ns");
  if (config.priority < 1 || config.priority > 99)
    throw std::invalid_argument("the priority of a real-time thread must be 1 to 99");
}

}  // namespace

void RealtimeThread::start(const RealtimeConfig& config, std::function<void(const CycleCall&)> cycle) {
  if (thread_.joinable()) throw std::logic_error("the real-time thread is already running");
  check(config);
  config_ = config;
  cycle_ = std::move(cycle);
  stop_.store(false, std::memory_order_relaxed);
  statistics_ = CycleStatistics{};

  std::promise<bool> prepared;
  std::future<bool> go = prepared.get_future();
  thread_ = std::thread([this, ready = std::move(prepared)]() mutable {
    prepare();
    const bool run_it = why_not_.empty() || config_.policy == RealtimePolicy::best_effort;
    ready.set_value(run_it);
    if (run_it) run();
  });
  if (go.get()) return;
  thread_.join();
  throw std::runtime_error(why_not_);
}

void RealtimeThread::stop() noexcept {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

// Memory first: a real-time thread must not be the one that waits for the pages of the whole process.
void RealtimeThread::prepare() {
  why_not_.clear();
  const std::string memory = lock_memory();
  const std::string scheduling = schedule_fifo(config_.priority);
  realtime_ = scheduling.empty();
  append(why_not_, scheduling);
  append(why_not_, memory);
  append(why_not_, pin_to(config_.core));
  if (!scheduling.empty() || !memory.empty()) why_not_ += "; limits are set in /etc/security/limits.conf";
  prctl(PR_SET_TIMERSLACK, 1UL);  // [ns] a normal thread's timers are otherwise put off by 50 us
  prefault_stack();
}

// Sleeps as long as it is safe to, then spins: the scheduler's wake-up latency falls into the spin.
std::int64_t RealtimeThread::wait_until(std::int64_t deadline) const noexcept {
  std::int64_t now = monotonic_ns();
  if (deadline - now > config_.spin_ns) {
    sleep_until(deadline - config_.spin_ns);
    now = monotonic_ns();
  }
  for (; now < deadline; now = monotonic_ns()) cpu_relax();
  return now;
}

void RealtimeThread::run() noexcept {
  const AwakeCores awake;
  const std::int64_t period = config_.period_ns;
  CycleCall next{monotonic_ns() + period, 0};
  while (true) {
    const std::int64_t woke = wait_until(next.deadline_ns);
    if (stop_.load(std::memory_order_relaxed)) return;
    statistics_.wake_lateness.add(woke - next.deadline_ns);
    next = newest_passed(next, woke, period);
    statistics_.skipped += static_cast<std::uint64_t>(next.skipped);

    cycle_(next);
    const std::int64_t done = monotonic_ns();
    statistics_.duration.add(done - woke);
    ++statistics_.cycles;
    next = first_ahead(next, done, period);
    statistics_.overruns += next.skipped > 0 ? 1 : 0;
  }
}

}  // namespace gearshift
