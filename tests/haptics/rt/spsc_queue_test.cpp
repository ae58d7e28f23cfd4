#include "haptics/rt/spsc_queue.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <random>
#include <thread>

#include <doctest/doctest.h>

namespace gearshift::test {
namespace {

struct Message {
  std::uint64_t number = 0;
  std::uint64_t copies[6] = {};
};

Message message(std::uint64_t number) {
  Message m{number, {}};
  for (std::uint64_t& copy : m.copies) copy = ~number;
  return m;
}

bool is_consistent(const Message& m) {
  for (const std::uint64_t copy : m.copies)
    if (copy != ~m.number) return false;
  return true;
}

constexpr std::uint64_t kMany = 500'000;

}  // namespace

TEST_CASE("queue: holds at least the requested number, then reports that it is full and keeps its content") {
  for (const std::size_t wanted : {1u, 2u, 3u, 16u, 1000u}) {
    haptics::SpscQueue<std::size_t> queue(wanted);
    REQUIRE(queue.capacity() >= wanted);
    for (std::size_t i = 0; i < queue.capacity(); ++i) REQUIRE(queue.push(i));
    CHECK_FALSE(queue.push(999));
    std::size_t value = 0;
    for (std::size_t i = 0; i < queue.capacity(); ++i) {
      REQUIRE(queue.pop(value));
      CHECK(value == i);
    }
    CHECK_FALSE(queue.pop(value));
  }
}

TEST_CASE("queue: behaves like a bounded deque under any order of pushes and pops") {
  std::mt19937 random(1);
  haptics::SpscQueue<unsigned> queue(8);
  std::deque<unsigned> model;
  for (unsigned i = 0; i < 100'000; ++i) {
    if (random() % 2 == 0) {
      const bool has_room = model.size() < queue.capacity();
      REQUIRE(queue.push(i) == has_room);
      if (has_room) model.push_back(i);
    } else {
      unsigned value = 0;
      REQUIRE(queue.pop(value) == !model.empty());
      if (model.empty()) continue;
      REQUIRE(value == model.front());
      model.pop_front();
    }
  }
}

TEST_CASE("queue: between two threads nothing is torn, lost, doubled or out of order") {
  haptics::SpscQueue<Message> queue(64);  // small, so that it is often full and often empty
  std::thread writer([&] {
    for (std::uint64_t number = 0; number < kMany; ++number)
      while (!queue.push(message(number))) std::this_thread::yield();
  });
  std::uint64_t wrong = 0;
  for (std::uint64_t expected = 0; expected < kMany; ++expected) {
    Message m;
    while (!queue.pop(m)) std::this_thread::yield();
    if (m.number != expected || !is_consistent(m)) ++wrong;
  }
  writer.join();
  CHECK(wrong == 0);
}

TEST_CASE("queue: a writer that never waits knows exactly what it lost") {
  haptics::SpscQueue<Message> queue(16);
  std::uint64_t refused = 0;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint64_t number = 0; number < kMany; ++number)
      if (!queue.push(message(number))) ++refused;
    done.store(true);
  });
  std::uint64_t popped = 0, wrong = 0, next = 0;
  while (true) {
    // `done` is read before the pop: if the writer was already done and the queue is empty, every message was popped.
    const bool was_done = done.load();
    Message m;
    if (!queue.pop(m)) {
      if (was_done) break;
      std::this_thread::yield();
      continue;
    }
    if (m.number < next || !is_consistent(m)) ++wrong;
    next = m.number + 1;
    ++popped;
  }
  writer.join();
  CHECK(wrong == 0);
  CHECK(popped + refused == kMany);
}

}  // namespace gearshift::test
