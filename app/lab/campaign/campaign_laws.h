// Laws that must hold in every cycle of every admitted case, one function per law.
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
  finite,         // all output values are finite
  free_space,     // the drawn lever is in the gate's free space
  no_wall,        // the drawn lever moves only through free space, no further per cycle than a proxy may
  lockout,        // the drawn lever never passes a closed lockout
  force,          // the command is within the device's force
  slew,           // the command changes no faster than the guard allows
  energy,         // with energy bounding, the motors never generate more than the device's damping dissipated
  guard,          // the guard detects no fault
  quiet,          // a lever that is held still does not move
  fades,          // while the lever is held, a swing decays, with every hand and even if quiet is not promised
  gear_holds,     // while the lever is held, the gear changes once at most; it re-engages only after really leaving
  reached,        // a gear that was cleanly aimed at is engaged
  no_lost_events  // no event is lost; called "told" in files
};
inline constexpr std::size_t kCampaignLaws = 13;

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
  // Keeps the worst value: NaN first, then the furthest beyond its bound, else the nearest to it.
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
  double ramp = 0.0;              // [1] per cycle, step of the guard's ramp
  bool can_drop_at_once = false;  // with energy bounding the force may fall faster than the slew limit
  bool energy_bounded = false;    // the guard bounds energy; needs no delay, no device walls, and enough damping
  glm::dvec2 damping{0.0};        // [N s/m] of the bare handle, as known to the loop
  glm::dvec2 min_damping{0.0};    // [N s/m] lower bound for the true handle
  double max_period = 0.001;      // [s] longest period
  double count = 0.0;             // [m] size of an encoder count; 0: no encoder
  double ripple = 0.0;            // [m] largest peak-to-peak motion allowed while held still
  double small_swing = 0.0;       // [m] peak-to-peak width of a hand's tremor or the encoder's resolution
  double remaining_swing = 1.0;   // [1] fraction of a wider swing that may remain after kFading
  double frame = 0.1;             // [s] between polls of the events, as in a slow frame of the window
};
LawLimits law_limits(const haptics::HapticConfig& config, const haptics::SimulatedLeverConfig& lever,
                     const haptics::DeviceSpec& spec) noexcept;

// A cycle and its predecessor.
struct CyclePair {
  const haptics::HapticSnapshot& now;
  const haptics::HapticSnapshot& before;
  bool pressed_down = false, lifted = false;  // state of the hand when this cycle read the lever
};

void finite_law(const CyclePair& cycle, LawRecord& record) noexcept;
void free_space_law(const CyclePair& cycle, const haptics::Gate& gate, LawRecord& record) noexcept;
void no_wall_law(const CyclePair& cycle, const haptics::Gate& gate, const LawLimits& limits,
                 LawRecord& record) noexcept;
void force_law(const CyclePair& cycle, const LawLimits& limits, LawRecord& record) noexcept;
void slew_law(const CyclePair& cycle, const LawLimits& limits, LawRecord& record) noexcept;
void guard_law(const CyclePair& cycle, LawRecord& record) noexcept;

// Tracks which lockouts the last gear or the road speed has closed.
class LockoutLaw {
 public:
  void update(const CyclePair& cycle, const haptics::Gate& gate, LawRecord& record) noexcept;

 private:
  std::uint32_t closed_ = 0;  // bit per lockout
};

// Passivity of the whole device, computed from the true motion. Over any interval the delivered force generates no more
// energy than was stored at its start, S = sum F^2 / (2 c) over both axes with c = b / T (Kim & Ryu 2010), plus the
// dissipation of the handle, at least b dx^2 / T per period (Cauchy-Schwarz: a steady speed dissipates least). With an
// encoder count q, the loop can misjudge the travel by up to q at each end; summed by parts this allows another
// (q / 2) (|dF| + c |d dx|) per period and q c / 2 times the path itself, true or measured.
class EnergyLaw {
 public:
  void update(const CyclePair& cycle, glm::dvec2 true_travel, const LawLimits& limits, LawRecord& record) noexcept;

 private:
  void reset() noexcept;

  double surplus_ = 0.0, allowed_ = 0.0;  // [J] surplus since it was last zero
  glm::dvec2 last_travel_{0.0};           // [m]
};

// A gear may re-engage only after the lever has moved out by at least the distance between engage and release depth.
class GearLaw {
 public:
  void update(const CyclePair& cycle, const haptics::Gate& gate, bool held_still, LawRecord& record) noexcept;

 private:
  int changes_ = 0;                   // while held still
  int last_ = haptics::kNeutralGear;  // last engaged gear
  double nearest_ = 0.0;              // [m] smallest depth in its slot since the release; 0: the lever left the slot
};

// Back-and-forth motion of the true lever while held still. Sliding in one direction does not count.
class HeldSwing {
 public:
  void update(glm::dvec2 lever) noexcept;
  double span() const noexcept;  // [m] peak-to-peak, the larger of both axes

 private:
  glm::dvec2 low_{1.0}, high_{-1.0};  // [m]
  glm::dvec2 rise_{0.0}, fall_{0.0};  // [m] largest rise above the lowest and fall below the highest position so far
};
void quiet_law(double span, const LawLimits& limits, double time, LawRecord& record) noexcept;

// On any spring, handle and hand damp a swing by exp(-b t / (2 m)) with their total b and m. The law requires half of
// that decay rate, because a wall gets stiffer with depth and is not perfectly passive. A swing that persists or grows
// must be receiving energy.
inline constexpr double kFading = 1.0;  // [s] between the ends of the two compared windows
void fades_law(double before, double after, const LawLimits& limits, double time, LawRecord& record) noexcept;

}  // namespace gearshift::lab
