#include "app/tour/tour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "haptics/device/scripted_hand.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/shift_script.h"
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
  header.program = GEARSHIFT_VERSION;
  header.config = setup.haptics;
  header.device = spec;
  header.gate_file = setup.layout.file;
  header.gate_text = setup.layout.text;
  header.armed = true;
  return header;
}

void collect_gears(LoopChannels& channels, TourResult& result) {
  for (HapticEvent event; channels.events.pop(event);) {
    if (event.kind != EventKind::gear_engaged) continue;
    result.engaged.push_back({static_cast<int>(event.value), 1e-9 * static_cast<double>(event.time_ns)});
  }
}

void export_csv(const std::filesystem::path& trace, const std::filesystem::path& csv) {
  TraceReader reader(trace);
  TraceCsvFile out(csv);
  for (TraceSample sample; reader.next(sample);) out.add(sample);
  out.finish();
}

}  // namespace

bool TourResult::complete() const {
  return std::equal(wanted.begin(), wanted.end(), engaged.begin(), engaged.end(),
                    [](int gear, const GearTime& time) { return gear == time.gear; });
}

TourResult drive_tour(const TourSetup& setup) {
  TourResult result;
  result.wanted = tour_order(setup.gate);
  SimulatedRunConfig config;
  config.haptics = setup.haptics;
  config.lever.hand = setup.hand;
  config.gate = setup.gate;
  config.start = rest_position(setup.gate, kNeutralGear);
  const double period = 1e-9 * static_cast<double>(period_ns(setup.haptics));
  ScriptedHandConfig hand = touring_hand(config.start);
  hand.aim_noise = kAimNoise;
  hand.seed = setup.seed;
  ScriptedHand driver(hand, shift_strokes(setup.gate, config.start, result.wanted), period);
  SimulatedRun run(config, driver);
  result.limited = run.loop().admitted().limited;

  const std::filesystem::path trace = setup.folder / "tour.trace";
  TraceRecorder recorder(trace, header_of(setup, run.lever().spec()), run.channels(), TracePump::by_caller);
  std::uint64_t cycles = 0, contacts = 0;
  while (run.time() < driver.duration()) {
    const HapticSnapshot& now = run.step();
    result.deepest = std::max(result.deepest, glm::distance(now.lever, now.proxy));
    result.strongest = std::max(result.strongest, glm::length(now.f_h));
    contacts += (now.flags & kFlagContact) != 0 ? 1u : 0u;
    if (++cycles % kPumpEvery != 0) continue;
    recorder.pump();
    collect_gears(run.channels(), result);
  }
  collect_gears(run.channels(), result);
  const RecordingResult recording = recorder.finish();
  if (!recording.problem.empty()) throw FileError(trace.string(), 0, recording.problem);
  result.hash = recording.hash;
  result.duration = run.time();
  result.contact_share = static_cast<double>(contacts) / static_cast<double>(cycles);
  export_csv(trace, setup.folder / "tour.csv");
  return result;
}

}  // namespace gearshift
