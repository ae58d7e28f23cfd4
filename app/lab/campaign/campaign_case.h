// One random case of the stability campaign, computed from its seed. A case may have any setting that a user could
// choose, even one that the loop must limit or reject.
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
  light,    // haptics::kLightHand
  grip,     // haptics::kGripHand
  arm,      // haptics::kArmHand
  heavy,    // a hand of 1 to 3 kg
  stiff,    // a hand of 1000 to 3000 N/m
  nervous,  // like `grip`, with a tremor of 8 to 12 Hz
  hasty,    // like `grip`, but fast, inaccurate and overshooting
  any       // a hand of 0.02 to 2.5 kg that moves like one of the others
};
inline constexpr std::array<std::string_view, 9> kCaseHandNames{"bare",  "light",   "grip",  "arm", "heavy",
                                                                "stiff", "nervous", "hasty", "any"};

// The hand's style of movement.
struct CaseManner {
  double pace = 0.2;           // [m/s] mean speed of a stroke
  double aim_noise = 0.0;      // [m] standard deviation of each aim
  double overshoot = 0.0;      // [m] distance beyond the gear's end position before returning
  double tremor = 0.0;         // [N] amplitude of the tremor on both axes
  double tremor_rate = 10.0;   // [Hz]
  double wrong_aims = 0.0;     // [1] fraction of shifts with a detour, such as into a wall or lockout
  double side_pushes = 0.0;    // [1] fraction of shifts after which the hand pushes sideways in gear
  double hardest_push = 25.0;  // [N] largest sideways push
  double last_push = 20.0;     // [N] push of the hand at the end of the case
  bool leans_aside = false;    // the last push is sideways instead of towards the gear's end stop
};

inline constexpr int kCaseShifts = 40;  // number of shifts tried per case

struct CampaignCase {
  std::uint64_t number = 0, seed = 0;
  int shipped_gate = -1;  // index into the shipped layouts sorted by name; -1: a random layout drawn from `seed`
  CaseHand hand = CaseHand::grip;
  CaseManner manner;
  haptics::HapticConfig haptics;
  haptics::SimulatedLeverConfig lever;
  int shifts = kCaseShifts;  // number of shifts that the hand tries; 0 without a hand
  bool is_wide = false;      // gate, rate, delay, plant error and tuning are drawn from their whole ranges
  bool has_car = false;      // the load is random_car(seed)
  bool is_elastic = false;   // the hand has an elastic grip
};

// Cases 4, 11, 18 and so on are wide (see CampaignCase::is_wide).
inline constexpr std::uint64_t kWideEvery = 7, kFirstWide = 4;
// Cases 1, 7, 13 and so on have `CaseHand::any`, unless they have no hand.
inline constexpr std::uint64_t kAnyHandEvery = 6, kFirstAnyHand = 1;

// Returns the case's seed: output `number` of a splitmix64 generator with the campaign's seed.
std::uint64_t case_seed(std::uint64_t campaign_seed, std::uint64_t number) noexcept;

// Draws a random case. The result is equal on every machine.
CampaignCase drawn_case(std::uint64_t campaign_seed, std::uint64_t number, int shipped_gates);

// True if the loop must reject the configuration: it needs allow_unstable, or its slew limit is too low.
bool is_forbidden(const CampaignCase& drawn) noexcept;

// Size of an encoder count at the tip; 0 without an encoder. [m]
double count_of(const CampaignCase& drawn) noexcept;

}  // namespace gearshift::lab
