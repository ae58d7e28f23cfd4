// Measures the cost of the complete haptic cycle and of its stages.
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "app/lab/bench/lever/tape_device.h"
#include "app/lab/bench/lever/touring.h"
#include "app/lab/bench/rows/bench.h"
#include "app/lab/bench/rows/ticks.h"

namespace gearshift::lab {
namespace {

struct Tape {
  std::vector<haptics::LeverReading> readings;
  haptics::DeviceSpec spec;
  double contact_fraction = 0.0;
};

Tape record_tour(const haptics::Gate& gate) {
  haptics::ScriptedHand driver = touring_driver(gate, 0.001);
  haptics::SimulatedRun run(touring_config(gate), driver);
  Tape tape;
  tape.spec = run.lever().spec();
  double contacts = 0.0;
  while (run.time() < driver.duration()) {
    contacts += (run.step().flags & haptics::kFlagContact) != 0 ? 1.0 : 0.0;
    tape.readings.push_back(run.loop().published().reading);
  }
  tape.contact_fraction = contacts / static_cast<double>(tape.readings.size());
  return tape;
}

constexpr std::size_t kStages = 8;
constexpr const char* kStageNames[kStages] = {"read (tape)", "estimate", "move proxy", "contact force",
                                              "gate forces", "load",     "guard",      "write (tape)"};

struct CycleTimes {
  std::vector<double> cycle;                        // [ns] duration of each cycle
  std::array<std::vector<double>, kStages> stages;  // [ns] durations in every 64th cycle
};

void run_tape(const haptics::Gate& gate, TapeDevice& device, std::size_t cycles, CycleTimes& times) {
  device.rewind();
  haptics::LoopInputs inputs;
  haptics::NoLoad load;
  haptics::HapticConfig config;
  haptics::HapticLoop loop(config, gate, device, load, inputs);
  loop.arm();
  for (std::size_t i = 0; i < cycles; ++i) {
    const auto deadline = static_cast<std::int64_t>(i) * haptics::period_ns(config);
    const std::uint64_t before = ticks();
    loop.cycle(deadline, 0);
    times.cycle.push_back(static_cast<double>(ticks() - before));
    if (i % haptics::StageStamps::kEvery != 0) continue;
    for (std::size_t s = 0; s < kStages; ++s) {
      times.stages[s].push_back(static_cast<double>(loop.stamps().ns[s + 1] - loop.stamps().ns[s]));
    }
  }
}

struct Medians {
  std::vector<double> p50, p99;  // [ns] quantiles of the cycle's duration, one value per tour
  CycleTimes last;
};

void run_tour(const haptics::Gate& gate, const Tape& tape, Medians& medians) {
  TapeDevice device(tape.spec, tape.readings);
  medians.last.cycle.clear();
  run_tape(gate, device, tape.readings.size(), medians.last);
  for (double& t : medians.last.cycle) t /= ticks_per_ns();
  medians.p50.push_back(quantile(medians.last.cycle, 0.5));
  medians.p99.push_back(quantile(medians.last.cycle, 0.99));
}

// Runs one tour of each tape in turn, so that a busy machine slows all of them equally.
std::vector<Medians> run_tours(const haptics::Gate& gate, std::span<const Tape> tapes, int runs,
                               const BenchOptions& options) {
  std::vector<Medians> medians(tapes.size());
  for (int i = 0; i < runs; ++i) {
    if (options.progress) options.progress("cycle", static_cast<double>(i) / runs);
    for (std::size_t t = 0; t < tapes.size(); ++t) run_tour(gate, tapes[t], medians[t]);
  }
  return medians;
}

// Median and quartiles of above[i] / below[i].
Timed ratio_of(const std::vector<double>& above, const std::vector<double>& below) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < above.size(); ++i) ratios.push_back(above[i] / below[i]);
  return timed(ratios);
}

BenchRow timed_row(const std::string& name, const Timed& ns, std::optional<double> goal, const std::string& note) {
  return with_spread(ns.spread, {"cycle", name, ns.median, "ns", goal, false, note});
}

// A device that renders walls itself, so that each cycle also sends wall positions to it.
Tape with_device_walls(Tape tape) {
  tape.spec.device_wall_stiffness = {1000.0, 1000.0};
  return tape;
}

// An unplugged device, which repeats the first reading.
Tape silent(Tape tape) {
  std::fill(tape.readings.begin(), tape.readings.end(), tape.readings.front());
  return tape;
}

}  // namespace

std::vector<BenchRow> bench_cycle(const BenchOptions& options) {
  const haptics::Gate gate = bench_gate(options.gate_folder, "paper");
  const Tape tape = record_tour(gate), tapes[] = {tape, with_device_walls(tape), silent(tape)};
  const int runs = options.quick ? 5 : 50;
  std::vector<Medians> tours = run_tours(gate, tapes, runs, options);
  Medians &medians = tours[0], &walls = tours[1], &unplugged = tours[2];
  const Timed unplugged_ratio = ratio_of(unplugged.p50, medians.p50);
  const Timed p50 = timed(medians.p50), p99 = timed(medians.p99);
  const std::string note = "median of " + std::to_string(runs) + " tours; every 64th cycle includes nine clock reads";
  std::vector<BenchRow> rows{timed_row("whole cycle p50", p50, 150.0, note),
                             timed_row("whole cycle p99", p99, 400.0, note),
                             {"cycle", "cycles in contact", 100.0 * tape.contact_fraction, "%", 30.0, true,
                              "gripping hand, paper's gate, 1 kHz"}};
  for (BenchRow& row : rows) row.design = Design::cycle;
  rows.push_back(timed_row("whole cycle p50, with walls rendered by the device", timed(walls.p50), {}, note));
  rows.push_back(
      with_spread(unplugged_ratio.spread,
                  {"cycle", "cycle without fresh readings, relative to whole cycle p50", unplugged_ratio.median,
                   "ratio", 1.0, false, "must not take longer than a cycle with fresh readings"}));
  for (std::size_t s = 0; s < kStages; ++s) {
    const std::string stage = std::string("stage ") + kStageNames[s];
    rows.push_back(timed_row(stage, timed(medians.last.stages[s]), {}, "includes one clock read of about 25 ns"));
  }
  return rows;
}

}  // namespace gearshift::lab
