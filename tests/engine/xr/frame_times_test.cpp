// Statistics of headset frames, compared with values counted by hand.
#include "engine/xr/frame_times.h"

#include <doctest/doctest.h>

using namespace gearshift::engine;

namespace {

constexpr double kPeriod = 0.010;  // [s]

HeadsetFrame frame_at(double display_ms, double woken_ms) {
  return {static_cast<std::int64_t>(1e6 * display_ms), static_cast<std::int64_t>(1e6 * woken_ms), kPeriod, true};
}

}  // namespace

TEST_CASE("a frame's CPU and GPU time, its spare time, and its delay") {
  FrameTimes times;
  times.add(frame_at(130.0, 100.0), 104'000'000, 6.0);  // [ms] the frame is ready at 110 and displayed at 130
  CHECK(times.timing().cpu_ms == doctest::Approx(4.0));
  CHECK(times.timing().spare_ms == doctest::Approx(20.0));
  CHECK(times.timing().late_ms == 0.0);
  times.add(frame_at(140.0, 110.0), 131'000'000, 12.0);  // [ms] ready at 143: displayed at 150 instead of 140
  CHECK(times.timing().spare_ms == doctest::Approx(-3.0));
  CHECK(times.timing().late_ms == doctest::Approx(10.0));
  CHECK(times.timing().late == 1);
  CHECK(times.timing().frames == 2);
  CHECK(times.timing().dropped == 0);
}

TEST_CASE("display periods without a frame count as dropped, except during a pause") {
  FrameTimes times;
  times.add(frame_at(100.0, 80.0), 85'000'000, 1.0);
  times.add(frame_at(110.1, 90.0), 95'000'000, 1.0);  // predicted display times may jitter
  CHECK(times.timing().dropped == 0);
  times.add(frame_at(140.0, 120.0), 125'000'000, 1.0);  // [ms] no frame is displayed at 120 and 130
  CHECK(times.timing().dropped == 2);
  times.pause();
  times.add(frame_at(900.0, 880.0), 885'000'000, 1.0);
  CHECK(times.timing().dropped == 2);
}

TEST_CASE("a runtime without a clock gives only counts") {
  FrameTimes times;
  times.add(frame_at(100.0, 0.0), 0, 2.0);
  CHECK(times.timing().frames == 1);
  CHECK(times.timing().gpu_ms == 2.0);
  CHECK(times.timing().late == 0);
  CHECK(times.timing().cpu_ms == 0.0);
}
