#include "haptics/rt/broadcast.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

using gearshift::haptics::Broadcast;

namespace {

// All parts have the same value, so that a reader notices a value that is half overwritten. 250 bytes: no whole number
// of 8-byte words.
struct Message {
  std::array<std::uint16_t, 125> part{};
  static Message numbered(std::uint64_t number) {
    Message message;
    message.part.fill(static_cast<std::uint16_t>(number));
    return message;
  }
  bool is_whole() const {
    for (const std::uint16_t one : part)
      if (one != part[0]) return false;
    return true;
  }
};

}  // namespace

TEST_CASE("every reader gets every value in order, from the moment it was created") {
  Broadcast<int> queue(16);
  CHECK(queue.capacity() == 16);
  CHECK_FALSE(queue.newest().has_value());
  Broadcast<int>::Reader first(queue);
  queue.push(1);
  Broadcast<int>::Reader second(queue);
  queue.push(2);
  CHECK(queue.newest() == 2);
  int value = 0;
  REQUIRE(first.pop(value));
  CHECK(value == 1);
  REQUIRE(first.pop(value));
  CHECK(value == 2);
  CHECK_FALSE(first.pop(value));
  REQUIRE(second.pop(value));
  CHECK(value == 2);
  CHECK_FALSE(second.pop(value));
}

TEST_CASE("a queue for a single value still delivers each value to a reader that keeps up") {
  Broadcast<int> queue(1);
  Broadcast<int>::Reader reader(queue);
  for (int i = 0; i < 5; ++i) {
    queue.push(i);
    int value = -1;
    REQUIRE(reader.pop(value));
    CHECK(value == i);
    CHECK_FALSE(reader.pop(value));
  }
  CHECK(reader.lost() == 0);
}

TEST_CASE("a reader that is too slow misses the oldest values, counts them, and goes on in order") {
  Broadcast<int> queue(8);
  Broadcast<int>::Reader reader(queue);
  for (int i = 0; i < 100; ++i) queue.push(i);
  std::vector<int> seen;
  for (int value = 0; reader.pop(value);) seen.push_back(value);
  REQUIRE(seen.size() >= 7);  // the slot that the writer would use next does not count
  CHECK(seen.back() == 99);
  for (std::size_t i = 1; i < seen.size(); ++i) CHECK(seen[i] == seen[i - 1] + 1);
  CHECK(reader.lost() + seen.size() == 100);
}

TEST_CASE("while one thread writes without waiting, readers of different speed see only whole values, in order") {
  constexpr std::uint64_t kValues = 40'000;
  Broadcast<Message> queue(64);  // small, so that slow readers are overtaken often
  std::atomic<bool> is_over{false};
  struct Seen {
    std::uint64_t values = 0, lost = 0;
    bool is_whole = true, is_ordered = true;
  };
  std::array<Seen, 3> seen;
  std::vector<std::thread> readers;
  for (std::size_t i = 0; i < seen.size(); ++i)
    readers.emplace_back([&, i, reader = Broadcast<Message>::Reader(queue)]() mutable {
      Seen& mine = seen[i];
      for (bool last = false; !last;) {
        last = is_over;
        for (Message message; reader.pop(message);) {
          mine.is_whole = mine.is_whole && message.is_whole();
          ++mine.values;
          mine.is_ordered =
              mine.is_ordered && message.part[0] == static_cast<std::uint16_t>(mine.values - 1 + reader.lost());
          for (std::size_t rest = 0; rest < i; ++rest) std::this_thread::yield();
        }
        const std::optional<Message> newest = queue.newest();
        mine.is_whole = mine.is_whole && (!newest || newest->is_whole());
      }
      mine.lost = reader.lost();
    });
  for (std::uint64_t i = 0; i < kValues; ++i) {
    queue.push(Message::numbered(i));
    if (i % 256 == 0) std::this_thread::yield();
  }
  is_over = true;
  for (std::thread& reader : readers) reader.join();
  for (const Seen& one : seen) {
    CHECK(one.is_whole);
    CHECK(one.is_ordered);
    CHECK(one.values + one.lost == kValues);
    CHECK(one.values > 0);
  }
}
