// Commanded force along a slot against the layout's numbers.
#include <algorithm>
#include <cmath>

#include "haptics/gate/gate_layout.h"
#include "tests/bench/bench.h"
#include "tests/bench/tape_device.h"
#include "tests/bench/touring.h"

namespace gearshift {
namespace {

constexpr int kWarmUp = 600;      // [cycles] at neutral: the guard's ramp
constexpr double kSpeed = 0.005;  // [m/s] slow enough that damping is known and small

// Readings of a lever that glides at constant speed from neutral to the rest of a gear.
std::vector<LeverReading> glide(const Gate& gate, int gear) {
  const glm::dvec2 to = rest_position(gate, gear);
  std::vector<LeverReading> tape;
  const int steps = static_cast<int>(std::abs(to.y) / (kSpeed * 0.001));
  for (int i = 0; i < kWarmUp + steps; ++i) {
    LeverReading reading;
    reading.sequence = static_cast<std::uint64_t>(i) + 1;
    reading.time_ns = i * std::int64_t{1'000'000};
    reading.position = {to.x, to.y * std::max(0, i - kWarmUp) / steps};
    tape.push_back(reading);
  }
  return tape;
}

// Largest error of the commanded force, in shares of the slot's strongest force. The reference is the
// compiled curve's own definition at the lever's depth plus the stated damping: it shows what estimator,
// proxy, coupling and guard add on the way to the motor.
double worst_error(const Gate& gate, const Slot& slot) {
  HapticConfig config;
  DeviceSpec spec;
  spec.workspace = workspace_half_extent(YokeGeometry{});
  TapeDevice device(spec, glide(gate, slot.gear));
  NullWorld world;
  LoopChannels channels;
  HapticLoop loop(config, gate, device, world, channels);
  loop.arm();
  double worst = 0.0, strongest = 0.0;
  const int side = static_cast<int>(slot.side);
  const int cycles = static_cast<int>(kWarmUp + slot.rest / (kSpeed * 0.001));
  for (int i = 0; i < cycles; ++i) {
    loop.cycle(i * 1'000'000LL, 0);
    const double depth = side * loop.snapshot().lever.y;
    if (depth < gate.half_aisle) continue;  // in the aisle buffers add to the curve
    const double wanted = feel_force(slot.feel, depth) - config.tuning.aisle_damping * kSpeed;
    strongest = std::max(strongest, std::abs(wanted));
    worst = std::max(worst, std::abs(side * device.written().y - wanted));
  }
  return worst / strongest;
}

}  // namespace

std::vector<BenchRow> bench_feel(const BenchOptions& options) {
  const Gate gate = bench_gate(options.gate_folder, "paper");
  double worst = 0.0;
  for (int i = 0; i < gate.slot_count; ++i)
    worst = std::max(worst, worst_error(gate, gate.slot[static_cast<std::size_t>(i)]));
  return {answering(Design::delivered,
                    {"feel", "commanded force along a slot, worst error", 100.0 * worst, "% of the slot's peak", 3.0,
                     false, "every slot of the paper's gate at 5 mm/s, against the curve plus damping"})};
}

}  // namespace gearshift
