// Compares the commanded force along a slot with the force curve of the gate layout.
#include <algorithm>
#include <cmath>

#include "app/lab/bench/lever/tape_device.h"
#include "app/lab/bench/lever/touring.h"
#include "app/lab/bench/rows/bench.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift::lab {
namespace {

constexpr int kWarmUp = 600;      // [cycles] the lever rests in neutral while the guard ramps the force up
constexpr double kSpeed = 0.005;  // [m/s] slow, to keep the damping force small

// Readings of a lever that moves at constant speed from neutral to the rest position of a gear.
std::vector<haptics::LeverReading> glide(const haptics::Gate& gate, int gear) {
  const glm::dvec2 to = haptics::rest_position(gate, gear);
  std::vector<haptics::LeverReading> tape;
  const int steps = static_cast<int>(std::abs(to.y) / (kSpeed * 0.001));
  for (int i = 0; i < kWarmUp + steps; ++i) {
    haptics::LeverReading reading;
    reading.sequence = static_cast<std::uint64_t>(i) + 1;
    reading.time_ns = i * std::int64_t{1'000'000};
    reading.position = {to.x, to.y * std::max(0, i - kWarmUp) / steps};
    tape.push_back(reading);
  }
  return tape;
}

// Largest error of the commanded force, as a fraction of the slot's largest force. The reference is the slot's force
// curve plus damping, so the error comes from estimator, proxy, coupling and guard.
double worst_error(const haptics::Gate& gate, const haptics::Slot& slot) {
  haptics::HapticConfig config;
  haptics::DeviceSpec spec;
  spec.workspace = haptics::workspace_half_extent(haptics::YokeGeometry{});
  TapeDevice device(spec, glide(gate, slot.gear));
  haptics::NoLoad load;
  haptics::LoopInputs inputs;
  haptics::HapticLoop loop(config, gate, device, load, inputs);
  loop.arm();
  double worst = 0.0, strongest = 0.0;
  const int side = static_cast<int>(slot.side);
  const int cycles = static_cast<int>(kWarmUp + slot.rest / (kSpeed * 0.001));
  for (int i = 0; i < cycles; ++i) {
    loop.cycle(i * 1'000'000LL, 0);
    const double depth = side * loop.snapshot().lever.y;
    if (depth < gate.half_aisle) continue;  // skips the aisle, where buffers also contribute
    const double wanted = haptics::feel_force(slot.feel, depth) - config.tuning.aisle_damping * kSpeed;
    strongest = std::max(strongest, std::abs(wanted));
    worst = std::max(worst, std::abs(side * device.written().y - wanted));
  }
  return worst / strongest;
}

}  // namespace

std::vector<BenchRow> bench_feel(const BenchOptions& options) {
  const haptics::Gate gate = bench_gate(options.gate_folder, "paper");
  double worst = 0.0;
  for (int i = 0; i < gate.slot_count; ++i)
    worst = std::max(worst, worst_error(gate, gate.slot[static_cast<std::size_t>(i)]));
  return {
      answers_design(Design::delivered,
                     {"feel", "commanded force along a slot, worst error", 100.0 * worst, "% of the slot's peak", 3.0,
                      false, "every slot of the paper's gate at 5 mm/s, compared with the force curve plus damping"})};
}

}  // namespace gearshift::lab
