#include "haptics/rt/cycle_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <doctest/doctest.h>

namespace gearshift::test {
namespace {

// The smallest sample such that at least the fraction q of all samples is not larger.
std::int64_t exact_quantile(std::vector<std::int64_t> samples, double q) {
  std::sort(samples.begin(), samples.end());
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(samples.size())));
  return samples[std::max<std::size_t>(rank, 1) - 1];
}

haptics::DurationHistogram histogram_of(const std::vector<std::int64_t>& samples) {
  haptics::DurationHistogram histogram;
  for (const std::int64_t sample : samples) histogram.add(sample);
  return histogram;
}

void check_quantiles(const std::vector<std::int64_t>& samples) {
  const haptics::DurationHistogram histogram = histogram_of(samples);
  for (const double q : {0.0, 0.001, 0.01, 0.25, 0.5, 0.75, 0.9, 0.99, 0.999, 0.9999, 1.0}) {
    const auto exact = static_cast<double>(exact_quantile(samples, q));
    const auto quantile = static_cast<double>(histogram.quantile(q));
    CAPTURE(q);
    CHECK(quantile >= exact);
    CHECK(quantile <= 1.02 * exact);
  }
}

}  // namespace

TEST_CASE("histogram: every quantile matches the sorted samples, at most 2 % above") {
  std::mt19937_64 random(1);
  SUBCASE("durations spread evenly over all magnitudes from 1 ns to 10 s") {
    std::uniform_real_distribution<double> exponent(0.0, 10.0);
    std::vector<std::int64_t> samples(100'000);
    for (auto& sample : samples) sample = static_cast<std::int64_t>(std::pow(10.0, exponent(random)));
    check_quantiles(samples);
  }
  SUBCASE("a narrow peak with a long tail, as of a wake-up") {
    std::exponential_distribution<double> tail(1.0 / 40'000.0);
    std::vector<std::int64_t> samples(100'000);
    for (auto& sample : samples) sample = 90 + static_cast<std::int64_t>(random() % 50 == 0 ? tail(random) : 0.0);
    check_quantiles(samples);
  }
  SUBCASE("few samples") {
    check_quantiles({5'000'000, 17, 340, 17, 1'000'003});
  }
}

TEST_CASE("histogram: any single duration is reported at most 2 % above its value") {
  for (std::int64_t ns = 0; ns < 10'000'000'000; ns += 1 + ns / 37) {
    haptics::DurationHistogram histogram;
    histogram.add(ns);
    histogram.add(20'000'000'000);  // without this sample, quantile() would return the maximum, i.e. `ns`
    const std::int64_t quantile = histogram.quantile(0.5);
    REQUIRE(quantile >= ns);
    REQUIRE(static_cast<double>(quantile) <= 1.02 * static_cast<double>(ns));
  }
}

TEST_CASE("histogram: empty is zero, negative counts as zero, the longest is exact") {
  haptics::DurationHistogram histogram;
  CHECK(histogram.quantile(0.5) == 0);
  CHECK(histogram.max() == 0);
  histogram.add(-5);
  CHECK(histogram.count() == 1);
  CHECK(histogram.quantile(1.0) == 0);
  histogram.add(123'456'789'012);  // longer than the last bin's limit
  CHECK(histogram.max() == 123'456'789'012);
  CHECK(histogram.quantile(0.99) == 123'456'789'012);
}

}  // namespace gearshift::test
