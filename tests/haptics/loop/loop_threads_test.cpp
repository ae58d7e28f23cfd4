// Tests the loop on its real-time thread, while a window's frames, a recorder and a user's commands use it.
// Run it under the thread sanitizer.
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <thread>

#include <doctest/doctest.h>

#include "haptics/device/simulated_lever.h"
#include "haptics/device/smoothed_hand.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "haptics/loop/trace_recorder.h"
#include "haptics/rt/broadcast.h"
#include "haptics/rt/realtime_thread.h"
#include "tests/support/gates.h"
#include "tests/support/short_trace.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

TEST_CASE("on its own thread: the loop is tuned and recorded while a user leads the lever, and the recording replays") {
  const std::int64_t period = 1'000'000;
  const GateLayout layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/paper.toml");
  const Gate gate = compile_gate(layout, kPaperWorkspace);
  LatestValue<HandTarget> person;
  SmoothedHand hand(person, 0.001);
  SimulatedLeverConfig lever_config;
  lever_config.hand = kGripHand;
  SimulatedLever lever(lever_config, period, hand);
  NoLoad load;
  LoopInputs inputs;
  HapticConfig config;
  HapticLoop loop(config, gate, lever, load, inputs);
  loop.arm();

  TraceHeader header;
  header.program = "test";
  header.config = config;
  header.device = lever.spec();
  header.gate_file = layout.file;
  header.gate_text = layout.text;
  header.armed = true;
  const TempFolder folder;
  const std::filesystem::path file = folder / "threads.trace";
  TraceRecorder recorder(file, header);
  Broadcast<TraceSample> published(8192);
  std::atomic<bool> is_over{false};
  std::thread recording_thread([&, reader = Broadcast<TraceSample>::Reader(published)]() mutable {
    for (TraceSample cycle; !is_over;)
      while (reader.pop(cycle)) recorder.add(cycle);
    for (TraceSample cycle; reader.pop(cycle);) recorder.add(cycle);
  });

  std::atomic<std::uint64_t> cycles{0};
  RealtimeThread thread;
  RealtimeConfig realtime;
  realtime.period_ns = period;
  thread.start(realtime, [&](const CycleCall& call) {
    loop.cycle(call.deadline_ns, call.skipped);
    published.push(loop.published());
    cycles.fetch_add(1, std::memory_order_relaxed);
  });

  // Simulates a window's frames, as fast as possible, until the loop has run 400 cycles.
  std::uint64_t newest = 0, frames = 0;
  HapticTuning tuning = config.tuning;
  DriverControls controls;
  while (cycles.load(std::memory_order_relaxed) < 400) {
    ++frames;
    person.write({{0.02 * (frames % 2 ? 1.0 : -1.0), 0.0}, {}, {}, false, false});
    if (cycles.load(std::memory_order_relaxed) > 50) {
      tuning.feel_scale = frames % 2 ? 0.5 : 1.0;
      CHECK(loop.change_tuning(tuning).limits.empty());
      controls.pedals.throttle = static_cast<double>(frames % 100) / 100.0;
      inputs.controls.write(controls);
    }
    if (const std::optional<TraceSample> cycle = published.newest()) {
      CHECK(cycle->out.cycle >= newest);
      newest = cycle->out.cycle;
    }
  }
  thread.stop();
  is_over = true;
  recording_thread.join();
  const RecordingResult recording = recorder.finish();
  CHECK(recording.problem.empty());
  CHECK_FALSE(recording.torn);
  CHECK(recording.cycles >= 400);
  CHECK(replay(read_trace(file)).bit_for_bit());
}
