// One case of the stability campaign with everything drawn from its seed. Draws from all settings that a user could
// make, not only those known to work; the loop's checks limit or reject them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lab {

enum class CaseHand : int {
  bare,     // no hand: the lever is kicked, pushed and released
  light,    // a listed hand
  grip,     // a listed hand
  arm,      // a listed hand
  heavy,    // 1 to 3 kg
  stiff,    // 1000 to 3000 N/m
  nervous,  // a grip that trembles at 8 to 12 Hz
  hasty     // a grip that is fast, misses and overshoots
};
inline constexpr std::array<std::string_view, 8> kCaseHandNames{"bare",  "light", "grip",    "arm",
                                                                "heavy", "stiff", "nervous", "hasty"};

// How the hand moves.
struct CaseManner {
  double pace = 0.2;           // [m/s] mean speed of a stroke
  double aim_noise = 0.0;      // [m] standard deviation of every aim
  double overshoot = 0.0;      // [m] distance beyond the gear's end before returning
  double tremor = 0.0;         // [N] amplitude on both axes
  double tremor_rate = 10.0;   // [Hz]
  double wrong_aims = 0.0;     // [1] fraction of shifts that go somewhere else first, such as into a wall or lockout
  double side_pushes = 0.0;    // [1] fraction of gears in which the hand pushes sideways
  double hardest_push = 25.0;  // [N] largest sideways push
  double last_push = 20.0;     // [N] push in the last hold
  bool leans_aside = false;    // the last push is sideways instead of towards the gear's end stop
};

inline constexpr int kCaseShifts = 40;  // tried per case

struct CampaignCase {
  std::uint64_t number = 0, seed = 0;
  int shipped_gate = -1;  // index into the shipped layouts sorted by name; -1: the random layout of this seed
  CaseHand hand = CaseHand::grip;
  CaseManner manner;
  haptics::HapticConfig haptics;
  haptics::SimulatedLeverConfig lever;
  int shifts = kCaseShifts;  // shifts tried; 0 without a hand
  bool is_wide = false;      // gate, rate, delay, plant error and tuning are drawn from their whole ranges
  bool has_car = false;      // the load is random_car() of this seed
};

// Every seventh case is wide: 4, 11, ... The draws of all other cases are the same as before wide cases were added.
inline constexpr std::uint64_t kWideEvery = 7, kFirstWide = 4;

// The case's seed: output `number` of splitmix64 started with the campaign's seed.
std::uint64_t case_seed(std::uint64_t campaign_seed, std::uint64_t number) noexcept;

// Draws a case. The result is the same on every machine.
CampaignCase drawn_case(std::uint64_t campaign_seed, std::uint64_t number, int shipped_gates);

// Size of an encoder count at the tip; 0 without an encoder. [m]
double count_of(const CampaignCase& drawn) noexcept;

}  // namespace gearshift::lab
