#include "app/lab/tour/tour.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

#include "app/base/program_name.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_csv.h"
#include "haptics/loop/trace_reader.h"
#include "haptics/loop/trace_recorder.h"

namespace gearshift::lab {
namespace {

constexpr double kAimNoise = 0.002;   // [m] standard deviation of the hand's aims
constexpr int kProgressEvery = 1000;  // [cycles]

haptics::TraceHeader header_of(const TourSetup& setup, const haptics::DeviceSpec& spec) {
  haptics::TraceHeader header;
  header.program = base::program_name();
  header.config = setup.haptics;
  header.device = spec;
  header.gate_file = setup.layout.file;
  header.gate_text = setup.layout.text;
  header.armed = true;
  return header;
}

void note_engaged(std::span<const haptics::HapticEvent> events, TourResult& result) {
  for (const haptics::HapticEvent& event : events) {
    if (event.kind != haptics::EventKind::gear_engaged) continue;
    result.engaged.push_back({static_cast<int>(event.value), 1e-9 * static_cast<double>(event.time_ns)});
  }
}

haptics::SimulatedRunConfig run_config(const TourSetup& setup) {
  haptics::SimulatedRunConfig config;
  config.haptics = setup.haptics;
  config.lever = setup.lever;
  config.gate = setup.gate;
  config.start = haptics::rest_position(setup.gate, haptics::kNeutralGear);
  return config;
}

haptics::ScriptedHand hand_through(const std::vector<int>& gears, const TourSetup& setup, glm::dvec2 start) {
  haptics::ScriptedHandConfig config = haptics::touring_hand(start);
  config.aim_noise = kAimNoise;
  config.seed = setup.seed;
  return {config, haptics::shift_strokes(setup.gate, start, gears, setup.style), haptics::period_s(setup.haptics)};
}

// Counts each fault when it begins. `before`: the fault in the previous cycle. Arming clears a fault, so a fault that
// occurs again counts again.
void count_force_loss(const haptics::HapticSnapshot& now, haptics::GuardFault before, double time, LostForces& lost) {
  if (now.fault == haptics::GuardFault::none || now.fault == before) return;
  if (lost.times++ == 0) lost.fault = now.fault, lost.time = time;
}

void drive(haptics::SimulatedRun& run, double duration, haptics::TraceRecorder& recorder, const TourProgress& progress,
           const TourWatch& watch, TourResult& result) {
  double next_watch = 0.0;
  haptics::GuardFault fault = haptics::GuardFault::none;
  haptics::EventDetector detector;
  std::vector<haptics::HapticEvent> events;
  while (run.time() < duration) {
    const haptics::HapticSnapshot& now = run.step();
    measure(now, result);
    recorder.add(run.loop().published());
    detector.update(run.loop().published(), events);
    count_force_loss(now, std::exchange(fault, now.fault), run.time(), result.lost);
    if (run.time() >= next_watch) {
      next_watch += kWatchPeriod;
      note_engaged(events, result);
      if (watch) watch(now, events);
      events.clear();
    }
    if (result.cycles % kProgressEvery == 0) progress("drive", run.time() / duration);
  }
  note_engaged(events, result);
  result.duration = run.time();
}

// Returns the recording's hash.
std::uint64_t finish(haptics::TraceRecorder& recorder, const std::filesystem::path& trace) {
  const haptics::RecordingResult recording = recorder.finish();
  if (!recording.problem.empty()) throw haptics::FileError(trace.string(), 0, recording.problem);
  return recording.hash;
}

}  // namespace

void measure(const haptics::HapticSnapshot& now, TourResult& result) {
  result.deepest = std::max(result.deepest, glm::distance(now.lever, now.proxy));
  result.strongest = std::max(result.strongest, glm::length(now.f_h));
  result.softest = std::min(result.softest, now.wall_stiffness);
  result.contacts += (now.flags & haptics::kFlagContact) != 0 ? 1u : 0u;
  ++result.cycles;
}

std::uint64_t write_tour_table(const std::filesystem::path& folder, const TourProgress& progress) {
  haptics::TraceReader reader(folder / "tour.trace");
  haptics::TraceCsvFile out(folder / "tour.csv");
  std::uint64_t rows = 0;
  for (haptics::TraceSample sample; reader.next(sample);) {
    out.add(sample);
    progress("table", static_cast<double>(++rows) / static_cast<double>(reader.cycles()));
  }
  out.finish();
  return reader.hash();
}

bool TourResult::complete() const {
  return std::equal(wanted.begin(), wanted.end(), engaged.begin(), engaged.end(),
                    [](int gear, const GearTime& time) { return gear == time.gear; });
}

bool TourResult::visited_in_order() const {
  auto next = wanted.begin();
  for (const GearTime& gear : engaged)
    if (next != wanted.end() && *next == gear.gear) ++next;
  return next == wanted.end();
}

double TourResult::contact_fraction() const {
  return cycles == 0 ? 0.0 : static_cast<double>(contacts) / static_cast<double>(cycles);
}

TourResult drive_tour(const TourSetup& setup, const TourProgress& progress, const TourWatch& watch) {
  TourResult result;
  result.wanted = haptics::tour_order(setup.gate);
  const haptics::SimulatedRunConfig config = run_config(setup);
  haptics::ScriptedHand hand = hand_through(result.wanted, setup, config.start);
  haptics::SimulatedRun run(config, hand);
  result.limits = run.loop().admitted().limits;
  result.admitted = result.softest = run.loop().admitted().tuning.wall_stiffness;

  const std::filesystem::path trace = setup.folder / "tour.trace";
  haptics::TraceRecorder recorder(trace, header_of(setup, run.lever().spec()));
  drive(run, hand.duration(), recorder, progress, watch, result);
  result.hash = finish(recorder, trace);
  (void)write_tour_table(setup.folder, progress);
  return result;
}

}  // namespace gearshift::lab
