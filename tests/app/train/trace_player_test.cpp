// A drive looked at again keeps the time that it took.
#include "app/train/trace_player.h"

#include <cstdint>
#include <filesystem>
#include <vector>

#include <doctest/doctest.h>

#include "tests/haptics/loop/trace_bench.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

// Cycles at those times of a clock that began long ago. [s]
std::filesystem::path put_drive(const TempFolder& folder, const std::vector<double>& times) {
  std::vector<TraceSample> samples;
  for (const double time : times) {
    TraceSample sample;
    sample.deadline_ns = sample.out.time_ns = 987'654'321'000 + static_cast<std::int64_t>(1e9 * time);
    sample.out.cycle = samples.size();
    sample.controls.throttle = time;  // tells the cycle
    samples.push_back(sample);
  }
  write_trace(folder / "drive.gstrace", paper_header(), samples);
  return folder / "drive.gstrace";
}

std::vector<double> every_millisecond(double from, double to) {
  std::vector<double> times;
  for (int i = 0; from + 1e-3 * i < to; ++i) times.push_back(from + 1e-3 * i);
  return times;
}

}  // namespace

TEST_CASE("after t seconds of frames, however long each is, the cycle of t seconds is shown") {
  const TempFolder folder;
  TracePlayer player(put_drive(folder, every_millisecond(0.0, 3.0)));
  double time = 0.0;
  for (int i = 0; time < 2.7; ++i) {
    const double frame = i % 3 == 0 ? 0.004 : i % 3 == 1 ? 1.0 / 60.0 : 0.1;
    REQUIRE(player.advance(frame));
    time += frame;
    CHECK(time - player.controls().throttle > -1e-9);
    CHECK(time - player.controls().throttle < 0.001 + 1e-9);
    CHECK(player.passed().back().cycle == player.snapshot().cycle);
  }
}

TEST_CASE("where the loop missed deadlines the cycle before them is shown until they are past") {
  const TempFolder folder;
  std::vector<double> times = every_millisecond(0.0, 0.5);
  const std::vector<double> later = every_millisecond(1.5, 2.0);  // a second is missing
  times.insert(times.end(), later.begin(), later.end());
  TracePlayer player(put_drive(folder, times));
  for (int i = 0; i < 60; ++i) REQUIRE(player.advance(0.01));
  CHECK(player.controls().throttle == doctest::Approx(0.499));
  for (int i = 0; i < 85; ++i) REQUIRE(player.advance(0.01));
  CHECK(player.controls().throttle == doctest::Approx(0.499));
  for (int i = 0; i < 25; ++i) REQUIRE(player.advance(0.01));
  CHECK(player.controls().throttle == doctest::Approx(1.7).epsilon(0.001));
}

TEST_CASE("every cycle passes once, and the drive ends when it has lasted as long as it did") {
  const TempFolder folder;
  TracePlayer player(put_drive(folder, every_millisecond(0.0, 2.0)));
  std::uint64_t next = 0;
  double time = 0.0;
  for (bool goes_on = true; goes_on;) {
    goes_on = player.advance(1.0 / 60.0);
    time += 1.0 / 60.0;
    for (const HapticSnapshot& snapshot : player.passed()) CHECK(snapshot.cycle == next++);
    REQUIRE(time < 10.0);
  }
  CHECK(next == 2000);
  CHECK(time >= 1.999);
  CHECK(time < 1.999 + 2.0 / 60.0);
}
