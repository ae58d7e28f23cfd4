// Tests of the real-time proof itself: it must detect allocations, locks and system calls, and accept the lock-free
// channels.
#include "tests/support/realtime_proof.h"

#include <malloc.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <mutex>
#include <shared_mutex>

#include <doctest/doctest.h>

#include "haptics/rt/cycle_statistics.h"
#include "haptics/rt/latest_value.h"
#include "haptics/rt/realtime_thread.h"
#include "haptics/rt/spsc_queue.h"

namespace gearshift::test {
namespace {

int* volatile allocated = nullptr;  // a global pointer, so that the compiler does not remove the allocation

long resident_bytes() {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

// Returns the number of bytes that stay resident after a block is freed while a newer block lies above it.
long retained_after_free(std::size_t bytes) {
  const long before = resident_bytes();
  void* const block = std::malloc(bytes);
  std::memset(block, 1, bytes);
  void* const above = std::malloc(100'000);
  std::free(block);
  const long retained = resident_bytes() - before;
  std::free(above);
  return retained;
}

struct Big {
  double value[64] = {};
};

}  // namespace

TEST_CASE("a large block is returned to the system when it is freed while a real-time thread exists") {
  constexpr long kBlock = 20 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 << 20);              // makes malloc keep the freed block, as malloc may do by itself
  CHECK(retained_after_free(kBlock) > kBlock / 2);  // negative control
  haptics::RealtimeThread thread;
  thread.start({}, [](const haptics::CycleCall&) {});
  thread.stop();
  CHECK(retained_after_free(kBlock) < kBlock / 10);
}

TEST_CASE("real-time proof: arithmetic is clean") {
  double sum = 0.0;
  const RealtimeProof proof = prove_realtime([&] {
    for (int i = 1; i < 1000; ++i) sum += 1.0 / i;
  });
  INFO(proof.verdict());
  CHECK(proof.clean());
  CHECK(sum == 0.0);  // unchanged, because the proof ran in a copy of the process
}

TEST_CASE("real-time proof: one allocation is caught") {
  delete new int;  // prepares the allocator, so that the next allocation needs no system call
  const RealtimeProof by_new = prove_realtime([] { allocated = new int(1); });
  CHECK(by_new.allocations == 1);
  CHECK_FALSE(by_new.clean());
  const RealtimeProof by_malloc = prove_realtime([] { allocated = static_cast<int*>(std::malloc(4)); });
  CHECK(by_malloc.allocations == 1);
  allocated = new int(1);
  const RealtimeProof by_delete = prove_realtime([] { delete allocated; });
  CHECK(by_delete.allocations == 1);
  delete allocated;
}

TEST_CASE("real-time proof: one lock is caught even if it is free") {
  std::mutex mutex;
  const RealtimeProof by_mutex = prove_realtime([&] { const std::lock_guard lock(mutex); });
  CHECK(by_mutex.ran);
  CHECK(by_mutex.locks == 1);
  CHECK_FALSE(by_mutex.clean());
  std::shared_mutex shared;
  const RealtimeProof by_reader = prove_realtime([&] { const std::shared_lock lock(shared); });
  CHECK(by_reader.locks == 1);
}

TEST_CASE("real-time proof: one system call is caught and named") {
  const RealtimeProof proof = prove_realtime([] { (void)getppid(); });
  CHECK(proof.ran);
  CHECK(proof.system_call == 110);  // getppid on x86-64
  CHECK_FALSE(proof.clean());
}

TEST_CASE("real-time proof: a crash is reported, not mistaken for success") {
  const RealtimeProof proof = prove_realtime([] { __builtin_trap(); });
  CHECK_FALSE(proof.ran);
  CHECK_FALSE(proof.clean());
  CHECK_FALSE(proof.problem.empty());
}

TEST_CASE("the channels and the statistics are real-time safe, full and empty") {
  auto channel = std::make_unique<haptics::LatestValue<Big>>();
  haptics::SpscQueue<Big> queue(16);
  auto histogram = std::make_unique<haptics::DurationHistogram>();
  const RealtimeProof proof = prove_realtime([&] {
    Big value;
    for (int i = 0; i < 100; ++i) {
      channel->write(value);
      channel->update();
      channel->update();
      (void)queue.push(value);
      histogram->add(std::int64_t{i} * i * i);
    }
    while (queue.pop(value)) continue;
    (void)histogram->quantile(0.99);
  });
  INFO(proof.verdict());
  CHECK(proof.clean());
}

}  // namespace gearshift::test
