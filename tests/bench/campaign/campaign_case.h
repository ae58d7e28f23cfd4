// One case of the stability campaign: everything that its seed draws. What is drawn is what a person could set, not what
// is known to work: the loop's own checks limit or refuse it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift {

enum class CaseHand : int {
  bare,     // nobody: kicked, let go, leant upon
  light,    // a listed hand
  grip,     // a listed hand
  arm,      // a listed hand
  heavy,    // 1 to 3 kg
  stiff,    // 1000 to 3000 N/m
  nervous,  // a grip that trembles at 8 to 12 Hz
  hasty     // a grip that is fast, goes wide and overshoots
};
inline constexpr std::array<std::string_view, 8> kCaseHandNames{"bare",  "light", "grip",    "arm",
                                                                "heavy", "stiff", "nervous", "hasty"};

// How the hand goes about it.
struct CaseManner {
  double pace = 0.2;           // [m/s] mean of a stroke
  double aim_noise = 0.0;      // [m] of every aim
  double overshoot = 0.0;      // [m] beyond the gear's end, and back
  double tremor = 0.0;         // [N] amplitude, both axes
  double tremor_rate = 10.0;   // [Hz]
  double wrong_aims = 0.0;     // [1] share of the shifts that first go somewhere else: a wall, a lockout
  double side_pushes = 0.0;    // [1] share of the gears in which it pushes sideways
  double hardest_push = 25.0;  // [N] of these
  double last_push = 20.0;     // [N] that it leans with at the end
  bool leans_aside = false;    // at the end: sideways, else on into the gear's end
};

inline constexpr int kCaseShifts = 40;  // that a hand tries

struct CampaignCase {
  std::uint64_t number = 0, seed = 0;
  int shipped_gate = -1;  // index of the shipped layouts, sorted by name; -1: the random layout of this seed
  CaseHand hand = CaseHand::grip;
  CaseManner manner;
  HapticConfig haptics;
  SimulatedLeverConfig lever;
  int shifts = kCaseShifts;  // that are tried; 0 for nobody's hand
  bool is_wide = false;      // gate, rate, delay, plant error, configuration from within their whole ranges
  bool has_car = false;      // behind the lever: random_car() of this seed
};

// Each seventh case is wide: number 4, 11, ...; the others are what they were before there were any.
inline constexpr std::uint64_t kWideEvery = 7, kFirstWide = 4;

// The case's seed: the n-th output of splitmix64 that begins with the campaign's.
std::uint64_t case_seed(std::uint64_t campaign_seed, std::uint64_t number) noexcept;

// The same on every machine.
CampaignCase drawn_case(std::uint64_t campaign_seed, std::uint64_t number, int shipped_gates);

// [m] of the encoder at the tip; 0: none.
double count_of(const CampaignCase& drawn) noexcept;

}  // namespace gearshift
