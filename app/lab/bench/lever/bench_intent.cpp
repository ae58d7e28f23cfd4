// Counts how often a noisy hand reaches the intended gear.
#include <algorithm>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <utility>

#include "app/lab/bench/lever/touring.h"
#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

constexpr double kAimNoise = 0.003;  // [m] standard deviation of each aim, per axis

struct Aim {
  int from, to;
  haptics::HandImpedance hand;
  std::uint64_t seed;
};

Aim random_aim(const haptics::Gate& gate, std::mt19937_64& random) {
  const std::vector<int> gears = haptics::tour_order(gate);
  const haptics::HandImpedance hands[] = {haptics::kLightHand, haptics::kGripHand, haptics::kArmHand};
  Aim aim{haptics::kNeutralGear, haptics::kNeutralGear, hands[random() % 3], random()};
  const std::size_t from = random() % (gears.size() + 1);
  aim.from = from < gears.size() ? gears[from] : haptics::kNeutralGear;
  do aim.to = gears[random() % gears.size()];
  while (aim.to == aim.from);
  return aim;
}

// A shift style that aims exactly at the gear's rest position, so that only noise causes misses.
haptics::ShiftStyle aimed_style() {
  haptics::ShiftStyle style;
  style.leans = false;
  return style;
}

int reached(const haptics::Gate& gate, const Aim& aim) {
  haptics::SimulatedRunConfig config = touring_config(gate);
  config.lever.hand = aim.hand;
  config.haptics.guard.ramp_time = 0.01;
  config.start = haptics::rest_position(gate, aim.from);
  haptics::ScriptedHandConfig hand = haptics::touring_hand(config.start);
  hand.aim_noise = kAimNoise;
  hand.seed = aim.seed;
  const int gears[] = {aim.from, aim.to};
  haptics::ShiftStyle style = aimed_style();
  style.engaged = aim.from;
  const bool starts_in_slot = aim.from != haptics::kNeutralGear && !is_mechanism(gate);
  const std::span<const int> route = starts_in_slot ? std::span(gears) : std::span(gears).subspan(1);
  std::vector<haptics::HandStroke> strokes = haptics::shift_strokes(gate, config.start, route, style);
  if (starts_in_slot) strokes.erase(strokes.begin());  // the lever is already in the gear aim.from
  haptics::ScriptedHand driver(hand, std::move(strokes), 0.001);
  haptics::SimulatedRun run(config, driver);
  while (run.time() < driver.duration()) run.step();
  return run.loop().snapshot().gear;
}

std::vector<std::string> gates_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml" || is_sequential(bench_gate(folder, entry.path().stem().string())))
      continue;
    names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

constexpr int kMaxListedMisses = 12;  // the row's note lists the missed gears

BenchRow intent_row(const haptics::Gate& gate, const std::string& name, int aims) {
  std::mt19937_64 random(1);
  int misses = 0;
  std::string listed;
  for (int i = 0; i < aims; ++i) {
    const Aim aim = random_aim(gate, random);
    const int reached_gear = reached(gate, aim);
    if (reached_gear == aim.to || ++misses > kMaxListedMisses) continue;
    listed += std::string(" ") + gear_label(gate, aim.from) + ">" + gear_label(gate, aim.to) + ":" +
              gear_label(gate, reached_gear);
  }
  return answers_design(Design::intent,
                        {"intent", name, 100.0 * (aims - misses) / aims, "% as intended", 99.0, true,
                         std::to_string(aims) + " aims with 3 mm noise; misses (from>intended:reached):" +
                             (misses == 0 ? " none" : listed)});
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

}  // namespace gearshift::lab
