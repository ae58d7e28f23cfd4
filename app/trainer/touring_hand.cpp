#include "app/trainer/touring_hand.h"

#include <cmath>
#include <vector>

#include "haptics/loop/shift_script.h"

namespace gearshift {
namespace {

constexpr double kAimNoise = 0.002;  // [m] a hand never aims twice at the same spot
constexpr double kReturn = 0.4;      // [s] to where the next lap starts
constexpr double kRest = 0.6;        // [s] there

ScriptedHand make_hand(const Gate& gate, std::uint64_t seed, double period) {
  const glm::dvec2 start = rest_position(gate, kNeutralGear);
  std::vector<int> gears = tour_order(gate);
  gears.push_back(kNeutralGear);
  std::vector<HandStroke> strokes = shift_strokes(gate, start, gears);
  HandStroke home;
  home.to = start;
  home.duration = kReturn;
  home.dwell = kRest;
  strokes.push_back(home);
  ScriptedHandConfig config = touring_hand(start);
  config.aim_noise = kAimNoise;
  config.seed = seed;
  return {config, std::move(strokes), period};
}

}  // namespace

TouringHand::TouringHand(const Gate& gate, std::uint64_t seed, double period) : hand_(make_hand(gate, seed, period)) {}

HandTarget TouringHand::next(double time, glm::dvec2 lever) noexcept {
  return hand_.next(std::fmod(time, lap()), lever);
}

}  // namespace gearshift
