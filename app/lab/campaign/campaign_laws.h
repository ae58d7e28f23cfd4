// Laws that must hold in every cycle of every admitted case, with one function per law.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift::lab {

enum class CampaignLaw : std::size_t {
  finite,      // all output values are finite
  free_space,  // the displayed lever (the proxy) is in the gate's free space
  no_wall,     // the displayed lever moves only through free space, and no further per cycle than a proxy may
  lockout,     // the displayed lever never passes a closed lockout
  force,       // the commanded force is within the device's maximum
  slew,        // the commanded force changes no faster than the guard allows
  energy,      // with energy bounding, the motors never generate more energy than the device's damping dissipated
  guard,       // the guard detects no fault
  quiet,       // while the hand keeps still, the lever does not move
  fades,       // while the hand keeps still, an oscillation decays, even in cases without the law `quiet`
  gear_holds,  // while the hand keeps still, the gear changes at most once; a gear re-engages only after its release
  reached      // the hand engages every gear at which it aims cleanly
};
inline constexpr std::size_t kCampaignLaws = 12;

struct LawText {
  std::string_view name, requirement, unit;
};
const LawText& law_text(CampaignLaw law) noexcept;

// The worst value of a law. The law holds if value <= bound.
struct LawResult {
  std::uint64_t checks = 0;  // number of checks
  double value = 0.0, bound = 0.0;
  double time = 0.0;  // [s] time of the worst value
  bool broken() const noexcept { return checks > 0 && !(value <= bound); }
};

class LawRecord {
 public:
  // Keeps the worst value: NaN if there was one, otherwise the value with the largest excess over its bound.
  void note(CampaignLaw law, double value, double bound, double time) noexcept;
  const LawResult& result(CampaignLaw law) const noexcept { return results_[static_cast<std::size_t>(law)]; }
  LawResult& result(CampaignLaw law) noexcept { return results_[static_cast<std::size_t>(law)]; }
  bool any_broken() const noexcept;

 private:
  std::array<LawResult, kCampaignLaws> results_{};
};

// Bounds of the laws for a case.
struct LawLimits {
  double period = 0.001;          // [s]
  glm::dvec2 max_force{0.0};      // [N]
  double slew = 0.0;              // [N] per cycle
  double ramp = 0.0;              // [1] step of the guard's force ramp per cycle
  bool can_drop_at_once = false;  // energy bounding is on, so the force may fall faster than the slew limit
  bool energy_bounded = false;    // the energy law applies: energy bounding, no delay, no device walls, enough damping
  glm::dvec2 damping{0.0};        // [N s/m] damping of the bare handle that the loop assumes
  glm::dvec2 min_damping{0.0};    // [N s/m] lower bound for the damping of the true handle
  double max_period = 0.001;      // [s] longest period
  double count = 0.0;             // [m] size of an encoder count; 0: no encoder
  double ripple = 0.0;            // [m] largest peak-to-peak motion allowed while the hand keeps still
  double small_swing = 0.0;       // [m] peak-to-peak motion that a tremor or the encoder's resolution may cause
  double settle_time = 1.0;       // [s] into a hold; from then on the gear must not change
  double remaining_swing = 1.0;   // [1] fraction of an oscillation above small_swing that may remain after kFading
};
LawLimits law_limits(const haptics::HapticConfig& config, const haptics::SimulatedLeverConfig& lever,
                     const haptics::DeviceSpec& spec) noexcept;

// A cycle and its predecessor.
struct CyclePair {
  const haptics::HapticSnapshot& now;
  const haptics::HapticSnapshot& before;
  bool pressed_down = false, lifted = false;  // whether the hand pressed down or lifted the knob
};

void finite_law(const CyclePair& cycle, LawRecord& record) noexcept;
void free_space_law(const CyclePair& cycle, const haptics::Gate& gate, LawRecord& record) noexcept;
void no_wall_law(const CyclePair& cycle, const haptics::Gate& gate, const LawLimits& limits,
                 LawRecord& record) noexcept;
void force_law(const CyclePair& cycle, const LawLimits& limits, LawRecord& record) noexcept;
void slew_law(const CyclePair& cycle, const LawLimits& limits, LawRecord& record) noexcept;
void guard_law(const CyclePair& cycle, LawRecord& record) noexcept;

// Checks that the displayed lever passes no closed lockout. Tracks which lockouts are closed by the previous gear or by
// the road speed.
class LockoutLaw {
 public:
  void update(const CyclePair& cycle, const haptics::Gate& gate, LawRecord& record) noexcept;

 private:
  std::uint32_t closed_ = 0;  // bit per lockout
};

// Checks the device's passivity with the true motion. In any interval, the motors may generate at most the energy
// stored at the start plus the energy that the handle dissipates.
// Stored energy: the sum of F^2 / (2 c) over both axes, with force F and c = damping b / period T (Kim & Ryu 2010).
// Dissipation: at least b dx^2 / T per period with travel dx (Cauchy-Schwarz: a steady speed dissipates least).
// Encoder: with count size q, a position is wrong by up to q / 2, so a sum of F times travel, by parts, is wrong by up to
// (q / 2) (|F| at the start + |F| at the end + the sum of |dF|). The spring c adds (q c / 2) (|d dx| + true travel +
// measured travel) per period. At the end at least the force of the start is assumed.
class EnergyLaw {
 public:
  void update(const CyclePair& cycle, glm::dvec2 true_travel, const LawLimits& limits, LawRecord& record) noexcept;

 private:
  void reset() noexcept;

  double surplus_ = 0.0, allowed_ = 0.0;  // [J] surplus: energy generated in excess since the surplus was last zero
  glm::dvec2 last_travel_{0.0};           // [m]
  glm::dvec2 start_force_{0.0};           // [N] when the surplus was last zero
};

// While the hand keeps still, the gear may change at most once. A gear may re-engage only after the lever's depth in
// the slot has fallen to `release_depth` or less.
class GearLaw {
 public:
  void update(const CyclePair& cycle, const haptics::Gate& gate, bool held_still, LawRecord& record) noexcept;

 private:
  int changes_ = 0;                   // number of gear changes while the hand keeps still
  int last_ = haptics::kNeutralGear;  // last engaged gear
  double nearest_ = 0.0;              // [m] smallest depth in the slot since the gear engaged; 0: lever left the slot
};

// Measures the true lever's back-and-forth motion while the hand keeps still. Sliding in one direction does not count.
class HeldSwing {
 public:
  void update(glm::dvec2 lever) noexcept;
  double span() const noexcept;  // [m] peak-to-peak motion, on the axis where it is larger

 private:
  glm::dvec2 low_{1.0}, high_{-1.0};  // [m]
  glm::dvec2 rise_{0.0}, fall_{0.0};  // [m] largest rise above the lowest and fall below the highest position so far
};
void quiet_law(double span, const LawLimits& limits, double time, LawRecord& record) noexcept;

// Checks that an oscillation decays while the hand keeps still. Against any spring, handle and hand damp an oscillation
// like exp(-b t / (2 m)), with total damping b and mass m. The law requires half of this decay rate, because a wall
// gets stiffer with depth and is not perfectly passive. An oscillation that persists or grows must be gaining energy.
inline constexpr double kFading = 1.0;  // [s] time between the ends of the two compared windows
void fades_law(double before, double after, const LawLimits& limits, double time, LawRecord& record) noexcept;

}  // namespace gearshift::lab
