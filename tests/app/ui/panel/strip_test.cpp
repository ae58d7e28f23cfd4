// The columns of a plot, compared with columns computed from all samples.
#include "app/ui/panel/strip.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::ui;

namespace {

struct Sample {
  double time, value;
};

// Samples at irregular times, with gaps of many columns, and with peaks that last one sample.
std::vector<Sample> uneven(std::uint32_t seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(0.0, 0.004), value(-1.0, 1.0);
  std::vector<Sample> samples;
  double time = 3.0;
  for (int i = 0; i < count; ++i) {
    time += step(random) + (i % 997 == 0 ? 0.7 : 0.0);
    samples.push_back({time, value(random) * (i % 131 == 0 ? 40.0 : 1.0)});
  }
  return samples;
}

// Checks that every column contains exactly the samples in its part of the time span. The columns' limits are multiples
// of the column width in absolute time.
void check_against_all(const Strip& strip, const std::vector<Sample>& samples, double newest_time) {
  const auto newest = static_cast<std::int64_t>(std::floor(newest_time / strip.span() * strip.columns()));
  for (int i = 0; i < strip.columns(); ++i) {
    const std::int64_t place = newest - strip.columns() + 1 + i;
    double min = std::numeric_limits<double>::infinity(), max = -min, first = 0.0, last = 0.0;
    std::uint32_t count = 0;
    for (const Sample& s : samples) {
      if (static_cast<std::int64_t>(std::floor(s.time / strip.span() * strip.columns())) != place) continue;
      if (count++ == 0) first = s.value;
      last = s.value;
      min = std::min(min, s.value);
      max = std::max(max, s.value);
    }
    const StripColumn& column = strip.column(i);
    REQUIRE(column.count == count);
    if (count == 0) continue;
    REQUIRE(column.min == min);
    REQUIRE(column.max == max);
    REQUIRE(column.first == first);
    REQUIRE(column.last == last);
  }
}

}  // namespace

TEST_CASE("the extremes of every column are those of all its samples, at any time") {
  const std::vector<Sample> samples = uneven(7, 6000);
  Strip strip(2.0, 173);
  std::vector<Sample> so_far;
  for (const Sample& s : samples) {
    strip.push(s.time, s.value);
    so_far.push_back(s);
    if (so_far.size() % 487 == 0) check_against_all(strip, so_far, s.time);
  }
}

TEST_CASE("a different number of columns shows the same samples") {
  const std::vector<Sample> samples = uneven(11, 3000);
  Strip strip(2.0, 50);
  for (const Sample& s : samples) strip.push(s.time, s.value);
  for (const int columns : {1, 7, 300, 2000}) {
    strip.set_columns(columns);
    std::vector<Sample> recent;  // only samples within the span, because the strip drops older ones
    for (const Sample& s : samples)
      if (s.time >= samples.back().time - strip.span()) recent.push_back(s);
    check_against_all(strip, recent, samples.back().time);
  }
}

TEST_CASE("a single-sample peak is visible at any width, and the extent covers all samples") {
  Strip strip(5.0, 100);
  for (int i = 0; i < 5000; ++i) strip.push(1e-3 * i, i == 2345 ? 99.0 : 0.0);
  CHECK(strip.extent().max == 99.0);
  strip.set_columns(3);
  CHECK(strip.extent().max == 99.0);
  for (int i = 5000; i < 12000; ++i) strip.push(1e-3 * i, 0.0);
  CHECK(strip.extent().max == 0.0);  // the peak is now older than the span
}

TEST_CASE("a time before the last one begins a new run; non-finite values are ignored") {
  Strip strip(1.0, 10);
  strip.push(5.0, 7.0);
  strip.push(5.1, std::numeric_limits<double>::quiet_NaN());
  strip.push(std::numeric_limits<double>::infinity(), 1.0);
  CHECK(strip.extent().count == 1);
  strip.push(0.2, -3.0);
  CHECK(strip.extent().count == 1);
  CHECK(strip.extent().max == -3.0);
}

TEST_CASE("the cost per sample hardly grows with their number: ten times as many take at most forty times as long") {
  const auto once = [](int samples) {
    Strip strip(5.0, 400);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < samples; ++i) strip.push(2.5e-4 * i, std::sin(0.01 * i));
    CHECK(strip.extent().count > 0);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const auto seconds = [&](int samples) {  // [s] the shortest of five runs, because other programs also use the CPU
    double best = once(samples);
    for (int i = 0; i < 4; ++i) best = std::min(best, once(samples));
    return best;
  };
  const double few = seconds(40000), many = seconds(400000);
  MESSAGE("one sample costs " << 1e9 * many / 400000 << " ns");
  CHECK(many < 40.0 * few);
}
