// Where a noisy hand ends up: the gear that it meant?
#include <cstdio>
#include <random>

#include "tests/bench/bench.h"
#include "tests/bench/touring.h"

namespace gearshift {
namespace {

constexpr double kAimNoise = 0.003;  // [m] standard deviation of every aim, per axis

struct Aim {
  int from, to;
  HandImpedance hand;
  std::uint64_t seed;
};

Aim random_aim(const Gate& gate, std::mt19937_64& random) {
  const std::vector<int> gears = tour_order(gate);
  const HandImpedance hands[] = {kLightHand, kGripHand, kArmHand};
  Aim aim{kNeutralGear, kNeutralGear, hands[random() % 3], random()};
  const std::size_t from = random() % (gears.size() + 1);
  aim.from = from < gears.size() ? gears[from] : kNeutralGear;
  do aim.to = gears[random() % gears.size()];
  while (aim.to == aim.from);
  return aim;
}

// Aims at the gear's rest itself: whatever goes wide is the noise.
ShiftStyle aimed_style() {
  ShiftStyle style;
  style.leans = false;
  return style;
}

int outcome(const Gate& gate, const Aim& aim) {
  SimulatedRunConfig config = touring_config(gate);
  config.lever.hand = aim.hand;
  config.haptics.guard.ramp_time = 0.01;
  config.start = rest_position(gate, aim.from);
  ScriptedHandConfig hand = touring_hand(config.start);
  hand.aim_noise = kAimNoise;
  hand.seed = aim.seed;
  const int gears[] = {aim.from, aim.to};
  const std::span<const int> way = aim.from == kNeutralGear ? std::span(gears).subspan(1) : std::span(gears);
  std::vector<HandStroke> strokes = shift_strokes(gate, config.start, way, aimed_style());
  if (aim.from != kNeutralGear) strokes.erase(strokes.begin());  // it is already there
  ScriptedHand driver(hand, std::move(strokes), 0.001);
  SimulatedRun run(config, driver);
  while (run.time() < driver.duration()) run.step();
  return run.loop().snapshot().gear;
}

}  // namespace

std::vector<BenchRow> bench_intent(const BenchOptions& options) {
  static constexpr const char* kGates[] = {"paper",
                                           "five_speed_r_left_up",
                                           "five_speed_r_right_down",
                                           "six_speed_r_left_up",
                                           "six_speed_r_left_down",
                                           "six_speed_r_right_down",
                                           "dog_leg_five",
                                           "four_speed"};
  const int aims = options.quick ? 500 : 10000;
  std::vector<BenchRow> rows;
  for (const char* name : kGates) {
    if (options.progress) options.progress("intent", static_cast<double>(rows.size()) / 8.0);
    const Gate gate = bench_gate(options.gate_folder, name);
    std::mt19937_64 random(1);
    int hits = 0, listed = 0;
    std::string misses;
    for (int i = 0; i < aims; ++i) {
      const Aim aim = random_aim(gate, random);
      const int got = outcome(gate, aim);
      hits += got == aim.to;
      if (got == aim.to || ++listed > 12) continue;
      misses += std::string(misses.empty() ? "" : " ") + gear_name(aim.from) + ">" + gear_name(aim.to) + ":" +
                gear_name(got);
    }
    rows.push_back({"intent", name, 100.0 * hits / aims, "% as meant", 99.0, true,
                    std::to_string(aims) +
                        " aims, 3 mm noise, misses (from>meant:got): " + (misses.empty() ? "none" : misses)});
  }
  return rows;
}

}  // namespace gearshift
