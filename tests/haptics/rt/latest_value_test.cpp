#include "haptics/rt/latest_value.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <thread>

#include <doctest/doctest.h>

namespace gearshift::test {
namespace {

// Larger than any atomic type and than a cache line, so a torn read shows as parts that differ.
using Wide = std::array<std::uint64_t, 40>;

Wide filled(std::uint64_t number) {
  Wide value;
  value.fill(number);
  return value;
}

bool is_consistent(const Wide& value) {
  return std::all_of(value.begin(), value.end(), [&](std::uint64_t part) { return part == value[0]; });
}

}  // namespace

TEST_CASE("latest value: holds the first value until something newer is written") {
  haptics::LatestValue<int> channel(7);
  CHECK_FALSE(channel.update());
  CHECK(channel.value() == 7);
}

TEST_CASE("latest value: the newest of several writes wins, and is new exactly once") {
  haptics::LatestValue<int> channel;
  for (int round = 1; round <= 100; ++round) {
    for (int i = 0; i < round % 5 + 1; ++i) channel.write(10 * round + i);
    CHECK(channel.update());
    CHECK(channel.value() == 10 * round + round % 5);
    CHECK_FALSE(channel.update());
    CHECK(channel.value() == 10 * round + round % 5);
  }
}

TEST_CASE("latest value: no torn value and none older than the last, whatever the two threads do") {
  constexpr std::uint64_t kLast = 300'000;
  haptics::LatestValue<Wide> channel(filled(0));
  std::thread writer([&] {
    for (std::uint64_t number = 1; number <= kLast; ++number) channel.write(filled(number));
  });

  std::uint64_t torn = 0, backward = 0, last = 0;
  while (last != kLast) {
    if (!channel.update()) {
      std::this_thread::yield();
      continue;
    }
    const Wide& value = channel.value();
    if (!is_consistent(value)) ++torn;
    if (value[0] <= last) ++backward;  // an updated value must be newer than the previous one
    last = value[0];
  }
  writer.join();
  CHECK(torn == 0);
  CHECK(backward == 0);
  CHECK_FALSE(channel.update());
}

TEST_CASE("latest value: the value that the reader holds does not change while the writer continues") {
  haptics::LatestValue<Wide> channel(filled(0));
  channel.write(filled(1));
  REQUIRE(channel.update());
  const Wide& held = channel.value();
  for (std::uint64_t number = 2; number < 50; ++number) {
    channel.write(filled(number));
    CHECK(held == filled(1));
  }
}

}  // namespace gearshift::test
