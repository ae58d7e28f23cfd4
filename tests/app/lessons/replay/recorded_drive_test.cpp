// A replay equals the drive: lever and pedals are read from the file, the car equals the live car, and the shifts equal
// those that the lesson recorded.
#include "app/lessons/replay/recorded_drive.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/lessons/assessment/gate_path.h"
#include "app/lessons/replay/drive_reader.h"
#include "app/lessons/replay/lever_path.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_feel.h"
#include "tests/app/lessons/replay/lesson_trace.h"
#include "tests/support/gates.h"
#include "tests/support/short_trace.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;
using glm::dvec2;

namespace {

void check_same(const DriveSample& a, const DriveSample& b) {
  CHECK(a.lever.time_ns == b.lever.time_ns);
  CHECK(a.lever.proxy == b.lever.proxy);
  CHECK(a.lever.f_h == b.lever.f_h);
  CHECK(a.controls.pedals.clutch == b.controls.pedals.clutch);
  CHECK(a.car.pedals.clutch == b.car.pedals.clutch);
  CHECK(a.car.engine_speed == b.car.engine_speed);
  CHECK(a.car.shaft_speed == b.car.shaft_speed);
  CHECK(a.car.clutch_torque == b.car.clutch_torque);
  CHECK(a.car.slip_energy == b.car.slip_energy);
  CHECK(a.car.distance == b.car.distance);
  CHECK(a.car.gear == b.car.gear);
  CHECK(a.car.sync == b.car.sync);
}

void check_same(const ShiftRecord& a, const ShiftRecord& b) {
  CHECK(a.number == b.number);
  CHECK(a.begin == b.begin);
  CHECK(a.end == b.end);
  CHECK(a.from == b.from);
  CHECK(a.to == b.to);
  CHECK(a.guided == b.guided);
  CHECK(a.jerk_peak == b.jerk_peak);
  CHECK(a.slip_energy == b.slip_energy);
  CHECK(a.impulse == b.impulse);
  CHECK(a.path_length == b.path_length);
  CHECK(a.steps == b.steps);
}

double length_of(const std::vector<dvec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += glm::distance(path[i - 1], path[i]);
  return length;
}

const DriveSample& live_at(const LessonTrace& trace, double time) {
  const auto after = std::upper_bound(trace.live.begin(), trace.live.end(), time,
                                      [](double t, const DriveSample& sample) { return t < sample.time(); });
  return after == trace.live.begin() ? trace.live.front() : *(after - 1);
}

// Writes a drive of `count` cycles without a car. The lever rests, the gear changes after half of the cycles, and the
// clutch alternates from cycle to cycle.
void write_carless(const std::filesystem::path& file, std::size_t count, const std::string& load = "none",
                   std::uint64_t first_cycle = 0) {
  TraceHeader header;
  const GateLayout layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/paper.toml");
  header.gate_file = "paper.toml";
  header.gate_text = layout.text;
  header.device.workspace = kPaperWorkspace;
  header.device.yoke_radius = kPaperYokeRadius;
  header.load = load;
  std::vector<TraceSample> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    TraceSample& sample = samples[i];
    sample.deadline_ns = sample.out.time_ns = 5'000'000'000 + static_cast<std::int64_t>(i) * 1'000'000;
    sample.out.cycle = first_cycle + i;
    sample.out.gear = i < count / 2 ? 2 : 3;
    sample.out.road_speed = 1e-3 * static_cast<double>(i);
    sample.controls.pedals.clutch = i % 2 == 0 ? 0.25 : 0.75;
    sample.controls.slope = 0.1;
  }
  write_trace(file, header, samples);
}

std::string refusal(const std::filesystem::path& file) {
  try {
    const RecordedDrive drive(file);
  } catch (const FileError& problem) {
    return problem.what();
  }
  return {};
}

}  // namespace

TEST_CASE("the replayed car equals the live car exactly, in every sample") {
  const LessonTrace& trace = upshifts();
  const RecordedDrive drive(trace.file);
  CHECK(drive.has_car());
  CHECK_FALSE(drive.has_diverged());
  REQUIRE(drive.samples().size() > 1000);
  for (const DriveSample& sample : drive.samples()) check_same(sample, trace.live[sample.lever.cycle]);
  CHECK(drive.header().program == "lesson drive");
  CHECK(drive.gate().slot_count == shipped_gate("five_speed_r_right_down").slot_count);
}

TEST_CASE("the shifts equal the lesson's in every number, so cycles between the kept samples count too") {
  for (const double guidance : {0.0, 0.8}) {
    CAPTURE(guidance);
    const LessonTrace trace("up_through_the_gears", 0.9, guidance);
    const RecordedDrive drive(trace.file);
    REQUIRE(drive.shifts().size() == trace.result.shifts.size());
    REQUIRE(drive.shifts().size() >= 4);
    for (std::size_t i = 0; i < drive.shifts().size(); ++i)
      check_same(drive.shifts()[i].record, trace.result.shifts[i]);
  }
}

TEST_CASE("a shift's path leads from the old gear to the new one, and is at least as long as the ideal path") {
  const LessonTrace& trace = upshifts();
  const RecordedDrive drive(trace.file);
  REQUIRE(drive.shifts().size() >= 4);
  for (const RecordedShift& shift : drive.shifts()) {
    const ShiftRecord& record = shift.record;
    CAPTURE(record.number);
    const double left = record.from == kNeutralGear ? record.begin : record.begin + std::max(0.0, record.clutch_lead);
    const double in = record.begin + std::max(0.0, record.clutch_lead) + record.lever_time;
    REQUIRE(shift.driven.size() > 10);
    CHECK(glm::distance(shift.driven.front(), live_at(trace, left).lever.proxy) < LeverPath::kChord);
    CHECK(glm::distance(shift.driven.back(), live_at(trace, in).lever.proxy) < LeverPath::kChord);
    CHECK(slot_of(drive.gate(), slot_at(drive.gate(), shift.driven.back())).gear == record.to);
    for (std::size_t i = 1; i < shift.driven.size(); ++i)
      CHECK(glm::distance(shift.driven[i - 1], shift.driven[i]) >= LeverPath::kChord);
    CHECK(shift.ideal == shortest_path(drive.gate(), shift.driven.front(), shift.driven.back()));
    CHECK(length_of(shift.driven) > 0.99 * length_of(shift.ideal));
    // `path_length` is measured along the hand's path and starts a little earlier than `driven`, which is the displayed
    // lever's path. So the two lengths agree only roughly.
    CHECK(length_of(shift.driven) == doctest::Approx(record.path_length).epsilon(0.25));
  }
}

TEST_CASE(
    "the kept samples are the first cycle, the last, and others 4 ms apart; at() and between() equal a linear search") {
  const LessonTrace& trace = upshifts();
  const RecordedDrive drive(trace.file);
  const auto samples = drive.samples();
  CHECK(drive.begin() == trace.live.front().time());
  CHECK(drive.end() == trace.live.back().time());
  for (std::size_t i = 1; i + 1 < samples.size(); ++i)
    CHECK(samples[i].lever.time_ns - samples[i - 1].lever.time_ns == 4'000'000);
  for (double time = drive.begin() - 1.0; time < drive.end() + 1.0; time += 0.0917) {
    const DriveSample* last = &samples[0];
    std::size_t within = 0;
    for (const DriveSample& sample : samples) {
      if (sample.time() <= time) last = &sample;
      if (sample.time() > time && sample.time() <= time + 0.5) ++within;
    }
    CHECK(&drive.at(time) == last);
    CHECK(drive.between(time, time + 0.5).size() == within);
    CHECK(drive.between(time + 0.5, time).empty());
  }
  const DriveSample& third = samples[2];
  CHECK(&drive.at(third.time()) == &third);
  CHECK(drive.between(third.time(), samples[3].time()).size() == 1);
}

TEST_CASE("a drive of any length and rate keeps a limited number of samples, at least 4 ms apart") {
  for (const double rate : {100.0, 250.0, 333.0, 1000.0, 4000.0}) {
    for (const std::uint64_t cycles : {1ull, 4ull, 149'998ull, 150'000ull, 600'000ull, 599'997ull, 123'456'789ull}) {
      const std::uint64_t stride = RecordedDrive::stride(rate, cycles);
      CAPTURE(rate);
      CAPTURE(cycles);
      CHECK(stride >= 1);
      CHECK(static_cast<double>(stride) / rate >= 0.004 - 1e-9);
      CHECK((cycles + stride - 1) / stride + 1 <= RecordedDrive::kMaxSamples);
    }
  }
  CHECK(RecordedDrive::stride(1000.0, 500'000) == 4);
  CHECK(RecordedDrive::stride(1000.0, 0) == 4);
}

TEST_CASE("without a car, pedals, gear and speed come from the recording, and there are no shifts") {
  const TempFolder folder;
  write_carless(folder / "a.trace", 1000);
  const RecordedDrive drive(folder / "a.trace");
  CHECK_FALSE(drive.has_car());
  CHECK(drive.shifts().empty());
  CHECK(drive.begin() == doctest::Approx(5.0));
  CHECK(drive.at(5.2).car.gear == 2);
  CHECK(drive.at(5.8).car.gear == 3);
  CHECK(drive.at(5.8).car.road_speed == doctest::Approx(0.8).epsilon(0.01));
  CHECK(drive.at(5.8).car.pedals.clutch == 0.25);
  CHECK(drive.at(5.8).car.slope == 0.1);
  CHECK(drive.at(5.8).car.engine_speed == VehicleState{}.engine_speed);
}

TEST_CASE("where the second computation differs, this is reported, and the recording is shown from there on") {
  const LessonTrace& lesson = upshifts();
  const TempFolder folder;
  Trace trace = read_trace(lesson.file);
  const std::size_t differs_at = trace.samples.size() / 2;
  trace.samples[differs_at].out.commanded.x += 1e-9;
  write_trace(folder / "a.trace", trace.header, trace.samples);
  const RecordedDrive drive(folder / "a.trace"), complete(lesson.file);
  const double when = 1e-9 * static_cast<double>(trace.samples[differs_at].out.time_ns);
  CHECK(drive.has_diverged());
  CHECK(drive.has_car());
  REQUIRE(drive.samples().size() == complete.samples().size());
  for (std::size_t i = 0; i < drive.samples().size(); ++i) {
    const DriveSample& sample = drive.samples()[i];
    CHECK(sample.lever.proxy == complete.samples()[i].lever.proxy);
    CHECK(sample.car.pedals.clutch == complete.samples()[i].controls.pedals.clutch);
    if (sample.time() < when) check_same(sample, complete.samples()[i]);
    if (sample.time() >= when) CHECK(sample.car.road_speed == sample.lever.road_speed);
  }
  CHECK(drive.shifts().size() < complete.shifts().size());
  CHECK(drive.shifts().size() >= 1);
  for (const RecordedShift& shift : drive.shifts()) CHECK(shift.record.end < when);
}

TEST_CASE("if the time in a file runs backwards, the samples' times still increase") {
  const TempFolder folder;
  write_carless(folder / "a.trace", 2000);
  Trace trace = read_trace(folder / "a.trace");
  for (std::size_t i = 700; i < 1000; ++i) trace.samples[i].out.time_ns = 5'000'000'000 - static_cast<std::int64_t>(i);
  trace.samples[1999].out.time_ns = 0;
  write_trace(folder / "b.trace", trace.header, trace.samples);
  const RecordedDrive drive(folder / "b.trace");
  CHECK(drive.samples().size() > 400);
  for (std::size_t i = 1; i < drive.samples().size(); ++i)
    CHECK(drive.samples()[i].time() > drive.samples()[i - 1].time());
  CHECK(drive.end() == doctest::Approx(6.998));
}

TEST_CASE("the intact part of a damaged drive can be replayed") {
  const LessonTrace& lesson = upshifts();
  const TempFolder folder;
  std::filesystem::copy_file(lesson.file, folder / "torn.trace");
  std::filesystem::resize_file(folder / "torn.trace", std::filesystem::file_size(lesson.file) * 6 / 10);
  const RecordedDrive torn(folder / "torn.trace"), complete(lesson.file);
  CHECK_FALSE(torn.has_diverged());
  CHECK(torn.end() > complete.begin() + 0.3 * (complete.end() - complete.begin()));
  CHECK(torn.end() < complete.begin() + 0.9 * (complete.end() - complete.begin()));
  for (std::size_t i = 0; i + 1 < torn.samples().size(); ++i) check_same(torn.samples()[i], complete.samples()[i]);
  REQUIRE(torn.shifts().size() >= 1);
  for (std::size_t i = 0; i < torn.shifts().size(); ++i)
    check_same(torn.shifts()[i].record, complete.shifts()[i].record);
}

TEST_CASE("an unusable file is rejected in one sentence that names it") {
  const TempFolder folder;
  write_carless(folder / "other.trace", 10, "a spring\nof steel");
  write_carless(folder / "late.trace", 10, "none", 77);
  write_carless(folder / "car.trace", 10, "car-3 30 1 0 0 1 80 0 0 0 0 0 0 40\nbad.toml\nname = 3\n");
  for (const char* name : {"gone.trace", "other.trace", "late.trace", "car.trace"}) {
    CAPTURE(name);
    const std::string words = refusal(folder / name);
    CHECK(words.find(name) != std::string::npos);
    CHECK(words.find('\n') == std::string::npos);
  }
  CHECK(refusal(folder / "other.trace").find("\"a spring\" is not known") != std::string::npos);
  CHECK(refusal(folder / "car.trace").find("bad.toml") != std::string::npos);
}

// The loop writes only finite outputs and controls, so a non-finite one means that the file is damaged. Readings from a
// device may be NaN even in an intact file.
TEST_CASE("a non-finite output or pedal is reported as damage with its cycle; a non-finite reading is accepted") {
  const LessonTrace& lesson = upshifts();
  const TempFolder folder;
  const Trace complete = read_trace(lesson.file);
  const auto refusal_of = [&](const std::function<void(TraceSample&, double)>& spoil, double value) {
    Trace trace = complete;
    trace.samples.resize(600);
    spoil(trace.samples[500], value);
    write_trace(folder / "a.trace", trace.header, trace.samples);
    return refusal(folder / "a.trace");
  };
  const std::vector<std::function<void(TraceSample&, double)>> outputs{
      [](TraceSample& s, double v) { s.out.proxy.x = v; },
      [](TraceSample& s, double v) { s.out.lever.y = v; },
      [](TraceSample& s, double v) { s.out.f_h.x = v; },
      [](TraceSample& s, double v) { s.out.road_speed = v; },
      [](TraceSample& s, double v) { s.controls.slope = v; },
      [](TraceSample& s, double v) { s.controls.pedals.clutch = v; },
      [](TraceSample& s, double v) { s.out.wall_stiffness = v; }};
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& spoil : outputs) {
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, 1e300}) {
      const std::string words = refusal_of(spoil, value);
      CHECK(words.find("is damaged; cycle 500 ") != std::string::npos);
      CHECK(words.find('\n') == std::string::npos);
      CHECK(refusal_of([](TraceSample& s, double v) { s.reading.position.x = v; }, value).empty());
    }
  }
}

TEST_CASE("of a drive that has too many cycles, only the first are loaded") {
  const TempFolder folder;
  write_carless(folder / "a.trace", 1000);
  DriveSample sample;
  for (const std::uint64_t limit : {1u, 700u, 1000u, 2000u}) {
    DriveReader reader(folder / "a.trace", limit);
    CHECK(reader.cycles() == std::min<std::uint64_t>(limit, 1000));
    std::uint64_t count = 0;
    while (reader.next(sample)) ++count;
    CHECK(count == reader.cycles());
  }
}

TEST_CASE("the path of a lever that moves all the time has a limited size, and keeps its start and its end") {
  const Gate gate = shipped_gate("paper");
  LeverPath path;
  double angle = 0.0;
  dvec2 place;
  for (int i = 0; i < 1'000'000; ++i) {
    angle += 0.7;
    place = {0.02 * std::cos(angle), 0.005 * std::sin(angle)};
    path.add(1e-3 * i, place);
  }
  ShiftRecord record;
  record.end = 1000.0;
  const ShiftPaths paths = path.paths(record, gate);
  CHECK(paths.driven.size() < LeverPath::kMaxPoints);
  CHECK(paths.driven.size() > 10);
  CHECK(paths.driven.front() == dvec2{0.02 * std::cos(0.7), 0.005 * std::sin(0.7)});
  path.clear();
  CHECK(path.paths(record, gate).driven.empty());
  CHECK(path.paths(record, gate).ideal.empty());
}
