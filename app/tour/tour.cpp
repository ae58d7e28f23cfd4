#include "app/tour/tour.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "app/program_name.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_csv.h"
#include "haptics/loop/trace_reader.h"
#include "haptics/loop/trace_recorder.h"

namespace gearshift {
namespace {

constexpr double kAimNoise = 0.002;  // [m] a hand never aims twice at the same spot
constexpr int kPumpEvery = 1000;     // [cycles] between two drains of the trace queue

TraceHeader header_of(const TourSetup& setup, const DeviceSpec& spec) {
  TraceHeader header;
  header.program = program_name();
  header.config = setup.haptics;
  header.device = spec;
  header.gate_file = setup.layout.file;
  header.gate_text = setup.layout.text;
  header.armed = true;
  return header;
}

std::vector<HapticEvent> take_events(LoopChannels& channels, TourResult& result) {
  std::vector<HapticEvent> events;
  for (HapticEvent event; channels.events.pop(event);) {
    events.push_back(event);
    if (event.kind != EventKind::gear_engaged) continue;
    result.engaged.push_back({static_cast<int>(event.value), 1e-9 * static_cast<double>(event.time_ns)});
  }
  return events;
}

SimulatedRunConfig run_config(const TourSetup& setup) {
  SimulatedRunConfig config;
  config.haptics = setup.haptics;
  config.lever = setup.lever;
  config.gate = setup.gate;
  config.start = rest_position(setup.gate, kNeutralGear);
  return config;
}

ScriptedHand hand_through(const std::vector<int>& gears, const TourSetup& setup, glm::dvec2 start) {
  ScriptedHandConfig config = touring_hand(start);
  config.aim_noise = kAimNoise;
  config.seed = setup.seed;
  return {config, shift_strokes(setup.gate, start, gears, setup.style), period_s(setup.haptics)};
}

// before: the cycle before had that fault; a guard that is armed again has none.
void note_fall(const HapticSnapshot& now, GuardFault before, double time, LostForces& lost) {
  if (now.fault == GuardFault::none || now.fault == before) return;
  if (lost.times++ == 0) lost.fault = now.fault, lost.time = time;
}

void drive(SimulatedRun& run, double duration, TraceRecorder& recorder, const TourProgress& progress,
           const TourWatch& watch, TourResult& result) {
  double next_watch = 0.0;
  GuardFault fault = GuardFault::none;
  while (run.time() < duration) {
    const HapticSnapshot& now = run.step();
    measure(now, result);
    note_fall(now, std::exchange(fault, now.fault), run.time(), result.lost);
    if (run.time() >= next_watch) {
      next_watch += kWatchPeriod;
      const std::vector<HapticEvent> events = take_events(run.channels(), result);
      if (watch) watch(run.loop().snapshot(), events);
    }
    if (result.cycles % kPumpEvery != 0) continue;
    recorder.pump();
    progress("drive", run.time() / duration);
  }
  take_events(run.channels(), result);
  result.duration = run.time();
}

// Returns the hash of the run.
std::uint64_t finish(TraceRecorder& recorder, const std::filesystem::path& trace) {
  const RecordingResult recording = recorder.finish();
  if (!recording.problem.empty()) throw FileError(trace.string(), 0, recording.problem);
  return recording.hash;
}

}  // namespace

void measure(const HapticSnapshot& now, TourResult& result) {
  result.deepest = std::max(result.deepest, glm::distance(now.lever, now.proxy));
  result.strongest = std::max(result.strongest, glm::length(now.f_h));
  result.softest = std::min(result.softest, now.wall_stiffness);
  result.contacts += (now.flags & kFlagContact) != 0 ? 1u : 0u;
  ++result.cycles;
}

std::uint64_t write_tour_table(const std::filesystem::path& folder, const TourProgress& progress) {
  TraceReader reader(folder / "tour.trace");
  TraceCsvFile out(folder / "tour.csv");
  std::uint64_t rows = 0;
  for (TraceSample sample; reader.next(sample);) {
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

bool TourResult::came_in_order() const {
  auto next = wanted.begin();
  for (const GearTime& gear : engaged)
    if (next != wanted.end() && *next == gear.gear) ++next;
  return next == wanted.end();
}

double TourResult::contact_share() const {
  return cycles == 0 ? 0.0 : static_cast<double>(contacts) / static_cast<double>(cycles);
}

TourResult drive_tour(const TourSetup& setup, const TourProgress& progress, const TourWatch& watch) {
  TourResult result;
  result.wanted = tour_order(setup.gate);
  const SimulatedRunConfig config = run_config(setup);
  ScriptedHand hand = hand_through(result.wanted, setup, config.start);
  SimulatedRun run(config, hand);
  result.limited = run.loop().admitted().limited;
  result.admitted = result.softest = run.loop().admitted().tuning.wall_stiffness;

  const std::filesystem::path trace = setup.folder / "tour.trace";
  TraceRecorder recorder(trace, header_of(setup, run.lever().spec()), run.channels(), TracePump::by_caller);
  drive(run, hand.duration(), recorder, progress, watch, result);
  result.hash = finish(recorder, trace);
  (void)write_tour_table(setup.folder, progress);
  return result;
}

}  // namespace gearshift
