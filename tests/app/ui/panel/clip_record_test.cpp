#include "app/ui/panel/clip_record.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::ui;
using doctest::Approx;

TEST_CASE("fraction and peak cover all samples of the last ten seconds") {
  struct Sample {
    double time, wanted;
    bool clipped;
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> force(-60.0, 60.0);
  std::vector<Sample> samples;
  ClipRecord record;
  for (int i = 0; i < 30000; ++i) {
    const Sample s{1e-3 * i, force(random) * (i < 12000 ? 1.0 : 0.4), i % 7 == 0 && i < 25000};
    samples.push_back(s);
    record.push(s.time, s.wanted, s.clipped);
    if (i % 1111 != 0) continue;
    // The recorded span ends with the tenth of a second that contains the newest sample.
    const double end = (std::floor(s.time * 10.0 + 1e-9) + 1.0) / 10.0;
    double all = 0.0, clipped = 0.0, peak = 0.0;
    for (const Sample& old : samples) {
      if (old.time < end - ClipRecord::kSpan - 1e-9) continue;
      all += 1.0;
      clipped += old.clipped ? 1.0 : 0.0;
      peak = std::max(peak, std::abs(old.wanted));
    }
    CHECK(record.fraction() == Approx(clipped / all).epsilon(1e-3));
    CHECK(record.peak() == peak);
  }
}

TEST_CASE("nothing counts as clipped before the first sample, or ten seconds after the last clip") {
  ClipRecord record;
  CHECK(record.fraction() == 0.0);
  CHECK(record.peak() == 0.0);
  record.push(1.0, 50.0, true);
  CHECK(record.fraction() == 1.0);
  record.push(30.0, 1.0, false);
  CHECK(record.fraction() == 0.0);
  CHECK(record.peak() == 1.0);
  record.push(2.0, -3.0, true);  // a time before the previous one begins a new run
  CHECK(record.fraction() == 1.0);
  CHECK(record.peak() == 3.0);
}
