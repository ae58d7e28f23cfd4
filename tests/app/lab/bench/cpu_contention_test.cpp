// CPU time used by other programs and by the host, computed from the line "cpu" of /proc/stat (see proc(5)).
#include "app/lab/bench/cpu_contention.h"

#include <ctime>

#include <doctest/doctest.h>

using namespace gearshift::lab;

namespace {

std::optional<ProcessorTime> at(const char* stat, double own) {
  std::optional<ProcessorTime> time = processor_time(stat, 100.0);
  if (time) time->own = own;
  return time;
}

}  // namespace

TEST_CASE("of a hundred seconds the host took twelve, and other programs the time that is neither idle nor ours") {
  // columns:                user nice system idle  iowait irq softirq steal guest guest_nice
  const auto begin = at("cpu  1000  500    300  9000    100  10      20   700    40          4\ncpu0 1 2 3\n", 5.0);
  const auto end = at("cpu  4000 1500   1200 11900    200  60      70  1900   940          4\ncpu0 1 2 3\n", 40.0);
  const auto contention = cpu_contention(begin, end);
  REQUIRE(contention);
  // Differences in ticks of 0.01 s: 3000 + 1000 + 900 + 50 + 50 = 5000 used, 2900 + 100 = 3000 idle, and 1200 stolen by
  // the host. In seconds: 50 + 30 + 12 = 92. This program used 40 s - 5 s = 35 s of the 50 s. The column "guest" is not
  // added, because the kernel already includes it in "user".
  CHECK(contention->by_host == doctest::Approx(12.0 / 92.0));
  CHECK(contention->by_programs == doctest::Approx((50.0 - 35.0) / 92.0));
  CHECK(format_contention(*contention) == "13 % by the host, 16 % by other programs");
}

TEST_CASE("no result if the kernel does not report it, or if no time passed") {
  const auto begin = at("cpu  1000 500 300 9000 100 10 20 700 0 0\n", 0.0);
  CHECK_FALSE(cpu_contention(begin, begin));
  CHECK_FALSE(cpu_contention(begin, std::nullopt));
  CHECK_FALSE(processor_time("", 100.0));
  CHECK_FALSE(processor_time("cpu 1 2 3\n", 100.0));
  CHECK_FALSE(processor_time("intr 1 2 3 4 5 6 7 8\n", 100.0));
}

TEST_CASE("this program's own time is not counted") {
  const auto begin = processor_time_now();
  REQUIRE(begin);
  const std::clock_t start = std::clock();
  while (std::clock() - start < CLOCKS_PER_SEC / 5) continue;
  const auto end = processor_time_now();
  REQUIRE(end);
  CHECK(end->own - begin->own >= 0.19);
  CHECK(end->all >= begin->all);
}
