// Tests that a shift is found in a recording and drawn, with the recorded force and path.
#include "app/lessons/report/shift_recording.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <doctest/doctest.h>

#include "app/lessons/replay/recorded_drive.h"
#include "app/lessons/report/recorded_svg.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/trace_reader.h"
#include "tests/app/lessons/replay/lesson_trace.h"
#include "tests/app/lessons/report/constructed_history.h"
#include "tests/app/lessons/report/page_parts.h"
#include "tests/support/gates.h"
#include "tests/support/short_trace.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// Writes a recording of 10 s that starts at 100 s. The hand's force is a sawtooth that rises by 1 N/s, except for one
// cycle with 44 N; the lever moves forward at 1 mm/s.
void write_sawtooth(const std::filesystem::path& file) {
  TraceHeader header;
  const GateLayout layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/paper.toml");
  header.gate_file = "paper.toml";
  header.gate_text = layout.text;
  header.device.workspace = kPaperWorkspace;
  header.device.yoke_radius = kPaperYokeRadius;
  std::vector<TraceSample> samples(10000);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    TraceSample& s = samples[i];
    s.deadline_ns = s.out.time_ns = 100'000'000'000 + static_cast<std::int64_t>(i) * 1'000'000;
    s.out.cycle = i;
    s.out.f_h = {0.6 * std::fmod(t, 1.0), 0.8 * std::fmod(t, 1.0)};
    if (i == 4321) s.out.f_h = {0.0, -44.0};
    s.out.lever = s.out.proxy = {0.0, 1e-3 * t};
    s.controls.pedals.clutch = t > 4.1 && t < 4.6 ? 1.0 : 0.0;
  }
  write_trace(file, header, samples);
}

ShiftRecord shift_at(double begin) {
  ShiftRecord shift = good_shift(0, begin);
  return shift;
}

std::string refusal(const std::filesystem::path& file, const ShiftRecord& shift) {
  try {
    (void)read_shift(file, shift);
  } catch (const FileError& problem) {
    return problem.what();
  }
  return {};
}

}  // namespace

TEST_CASE("the cycles are those of the shift and of 0.3 s before and after it, with times from the shift's begin") {
  const TempFolder folder;
  write_sawtooth(folder / "a.trace");
  const ShiftRecording shift = read_shift(folder / "a.trace", shift_at(104.1));
  CHECK(shift.end == doctest::Approx(0.6));
  CHECK(shift.alarm == HapticConfig{}.over_push.warn_above);
  CHECK(shift.gate.slot_count == paper_gate().slot_count);
  REQUIRE(shift.cycles.size() > 1190);
  CHECK(shift.cycles.front().time == doctest::Approx(-0.3).epsilon(0.01));
  CHECK(shift.cycles.back().time == doctest::Approx(0.9).epsilon(0.01));
  for (const RecordedCycle& cycle : shift.cycles) {
    const double t = cycle.time + 4.1;
    if (cycle.force < 40.0) CHECK(std::abs(cycle.force - std::fmod(t, 1.0)) < 1e-6);
    CHECK(std::abs(cycle.lever.y - 1e-3 * t) < 1e-9);
  }
}

TEST_CASE("engine, shaft and gear equal the drive's in every cycle; the ideal path equals that of the whole drive") {
  const LessonTrace& trace = upshifts();
  const RecordedDrive drive(trace.file);
  REQUIRE(trace.result.shifts.size() == drive.shifts().size());
  for (std::size_t i = 0; i < drive.shifts().size(); ++i) {
    const ShiftRecord& record = trace.result.shifts[i];
    const ShiftRecording shift = read_shift(trace.file, record);
    CHECK(shift.has_car);
    CHECK(shift.ideal == drive.shifts()[i].ideal);
    std::size_t next = 0;
    for (const DriveSample& sample : trace.live) {
      const double time = sample.time() - record.begin;
      if (time < -kRecordingMargin || time > shift.end + kRecordingMargin) continue;
      REQUIRE(next < shift.cycles.size());
      const RecordedCycle& cycle = shift.cycles[next++];
      CHECK(cycle.time == time);
      CHECK(cycle.engine_speed == sample.car.engine_speed);
      CHECK(cycle.shaft_speed == std::abs(sample.car.shaft_speed));
      CHECK(cycle.gear == sample.car.gear);
      CHECK(cycle.lever == sample.lever.proxy);
      CHECK(cycle.clutch == sample.controls.pedals.clutch);
    }
    CHECK(next == shift.cycles.size());
  }
}

// Invariant: the total duration of the clutch presses found in the recording equals the clutch time that the meter
// measured in the lesson.
TEST_CASE("the clutch presses match the shift's record in number and total length") {
  const LessonTrace& trace = upshifts();
  for (const ShiftRecord& record : trace.result.shifts) {
    const std::vector<ClutchPress> presses = read_shift(trace.file, record).presses;
    CHECK(std::count(record.steps.begin(), record.steps.end(), ShiftStep::clutch_down) ==
          static_cast<std::ptrdiff_t>(presses.size()));
    double sum = 0.0;
    for (const ClutchPress& press : presses) sum += press.to - press.from;
    CHECK(sum == doctest::Approx(record.clutch_time).epsilon(0.01));
  }
  const TempFolder folder;
  write_sawtooth(folder / "a.trace");
  // Without a car there is no bite point, so clutch presses are unknown.
  CHECK(read_shift(folder / "a.trace", shift_at(104.1)).presses.empty());
}

TEST_CASE("with a car the drawing has speeds and a box for each gear; without a car it has none") {
  const LessonTrace& trace = upshifts();
  ShiftRecording shift = read_shift(trace.file, trace.result.shifts[1]);
  const std::string with = force_svg(shift);
  for (const char* words : {"engine [1/min]", "gearbox shaft [1/min]", ">1</text>", ">2</text>"})
    CHECK(with.find(words) != std::string::npos);
  CHECK(path_svg(shift).find("stroke-dasharray=\"1.6 1.4\"") != std::string::npos);
  const TempFolder folder;
  write_sawtooth(folder / "a.trace");
  const std::string without = force_svg(read_shift(folder / "a.trace", shift_at(104.1)));
  CHECK(without.find("engine") == std::string::npos);
  CHECK(without.find("clutch pedal") != std::string::npos);
}

TEST_CASE("the drawing keeps the single cycle with the hardest push") {
  const TempFolder folder;
  write_sawtooth(folder / "a.trace");
  ShiftRecording shift = read_shift(folder / "a.trace", shift_at(104.1));
  const auto highest = [&] {
    const std::string svg = force_svg(shift);
    const std::string_view line = between(svg, "<polyline points=\"", "\"");
    double top = 1e9;
    for (std::size_t at = 0; (at = line.find(',', at)) != std::string_view::npos; ++at)
      top = std::min(top, std::stod(std::string(line.substr(at + 1, 12))));
    return top;
  };
  const double with = highest();
  // The scale ends at 50 N, so a force of 44 N is drawn 12 % of the box's height below its top.
  CHECK(with == doctest::Approx(28.0 + 150.0 * 6.0 / 50.0).epsilon(1e-3));
  for (RecordedCycle& cycle : shift.cycles) cycle.force = std::min(cycle.force, 1.0);
  CHECK(highest() > with + 50.0);
  CHECK(path_svg(shift).find("</svg>") != std::string::npos);
}

TEST_CASE("a missing recording is reported in one sentence") {
  const TempFolder folder;
  write_sawtooth(folder / "a.trace");
  CHECK(refusal(folder / "a.trace", shift_at(104.0)).empty());
  CHECK(refusal(folder / "a.trace", shift_at(3.0)).find("does not contain this shift") != std::string::npos);
  CHECK(refusal(folder / "a.trace", shift_at(200.0)).find("does not contain this shift") != std::string::npos);
  CHECK(refusal(folder / "gone.trace", shift_at(104.0)).find("gone.trace") != std::string::npos);
}
