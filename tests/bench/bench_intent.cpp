// Where a noisy hand ends up: the gear that it meant?
#include <algorithm>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <utility>

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

std::vector<std::string> gates_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

constexpr int kMostListed = 12;  // misses that a row names

BenchRow intent_row(const Gate& gate, const std::string& name, int aims) {
  std::mt19937_64 random(1);
  int misses = 0;
  std::string listed;
  for (int i = 0; i < aims; ++i) {
    const Aim aim = random_aim(gate, random);
    const int got = outcome(gate, aim);
    if (got == aim.to || ++misses > kMostListed) continue;
    listed += std::string(" ") + gear_name(aim.from) + ">" + gear_name(aim.to) + ":" + gear_name(got);
  }
  return answering(
      Design::intent,
      {"intent", name, 100.0 * (aims - misses) / aims, "% as meant", 99.0, true,
       std::to_string(aims) + " aims, 3 mm noise, misses (from>meant:got):" + (misses == 0 ? " none" : listed)});
}

}  // namespace

std::vector<BenchRow> bench_intent(const BenchOptions& options) {
  const int aims = options.quick ? 150 : 10000;
  const std::vector<std::string> names = gates_in(options.gate_folder);
  std::vector<BenchRow> rows;
  for (const std::string& name : names) {
    if (options.progress)
      options.progress("intent", static_cast<double>(rows.size()) / static_cast<double>(names.size()));
    rows.push_back(intent_row(bench_gate(options.gate_folder, name), name, aims));
  }
  return rows;
}

}  // namespace gearshift
