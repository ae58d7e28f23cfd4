// Simulated time per real time: lever, hand, gate and guard on one core.
#include <chrono>

#include "tests/bench/bench.h"
#include "tests/bench/touring.h"

namespace gearshift {

std::vector<BenchRow> bench_headless(const BenchOptions& options) {
  const Gate gate = bench_gate(options.gate_folder, "paper");
  const int runs = options.quick ? 5 : 41;
  std::vector<double> speed;
  for (int i = 0; i < runs; ++i) {
    if (options.progress) options.progress("headless", static_cast<double>(i) / runs);
    ScriptedHand driver = touring_driver(gate, 0.001);
    SimulatedRun run(touring_config(gate), driver);
    const auto start = std::chrono::steady_clock::now();
    while (run.time() < driver.duration()) run.step();
    speed.push_back(run.time() / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return {{"headless", "simulation at 1 kHz", quantile(speed, 0.5), "x real time", 1000.0, true,
           "lever, hand, gate, guard; median of " + std::to_string(runs) + " tours, spread " +
               std::to_string(static_cast<int>(quantile(speed, 0.1))) + " to " +
               std::to_string(static_cast<int>(quantile(speed, 0.9)))}};
}

}  // namespace gearshift
