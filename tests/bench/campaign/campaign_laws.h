// What must hold in every cycle of every admitted case, each law a function of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

enum class CampaignLaw : std::size_t {
  finite,      // every number that comes out is one
  free_space,  // the drawn lever is in the gate's free space
  no_wall,     // it came there through free space, no further than a proxy may go in a cycle
  lockout,     // it never passed a closed lockout
  force,       // the command is within the device
  slew,        // and grows no faster than the guard lets it
  energy,      // bounded: the motors never give what the device's own damping did not take
  guard,       // no fault: nothing that was admitted has to be stopped
  quiet,       // held still, it is still
  fades,       // held still, a swing dies away, whoever holds it and whatever was promised
  gear_holds,  // held still, the gear does not toggle: a lever let go may slide out; one that comes again was really left
  reached,     // a gear that was cleanly aimed at is in
  told         // no event is lost
};
inline constexpr std::size_t kCampaignLaws = 13;

struct LawWords {
  std::string_view name, says, unit;
};
const LawWords& law_words(CampaignLaw law) noexcept;

// The worst that was seen of a law. Kept where value <= bound.
struct LawSeen {
  std::uint64_t looks = 0;  // times that it was asked
  double value = 0.0, bound = 0.0;
  double time = 0.0;  // [s] of the worst
  bool broken() const noexcept { return looks > 0 && !(value <= bound); }
};

class LawBook {
 public:
  // Keeps what is worst: furthest beyond its bound, or nearest to it; a number that is none before all.
  void note(CampaignLaw law, double value, double bound, double time) noexcept;
  const LawSeen& seen(CampaignLaw law) const noexcept { return seen_[static_cast<std::size_t>(law)]; }
  LawSeen& seen(CampaignLaw law) noexcept { return seen_[static_cast<std::size_t>(law)]; }
  bool any_broken() const noexcept;

 private:
  std::array<LawSeen, kCampaignLaws> seen_{};
};

// What is promised of a case.
struct LawLimits {
  double period = 0.001;          // [s]
  glm::dvec2 max_force{0.0};      // [N]
  double slew = 0.0;              // [N] a cycle
  double ramp = 0.0;              // [1] a cycle, of the guard's ramp
  bool falls_at_once = false;     // energy bounding does not wait for the slew
  bool energy_bounded = false;    // by the guard: no delay, no walls of the device's own, damping enough for the proof
  glm::dvec2 damping{0.0};        // [N s/m] of the bare handle, as the loop believes it
  glm::dvec2 least_damping{0.0};  // [N s/m] that the true handle has at least
  double longest = 0.001;         // [s] that a period lasts at most
  double count = 0.0;             // [m] of the encoder, 0: none
  double ripple = 0.0;            // [m] peak to peak, held still
  double faint = 0.0;             // [m] peak to peak: no wider than a hand's own tremor, or what the encoder tells
  double kept = 1.0;              // [1] of a wider swing that may be left after kFading
  double frame = 0.1;             // [s] between two looks at the events: a slow frame of the window
};
LawLimits law_limits(const HapticConfig& config, const SimulatedLeverConfig& lever, const DeviceSpec& spec) noexcept;

// One cycle and the one before it.
struct SeenCycle {
  const HapticSnapshot& now;
  const HapticSnapshot& before;
  bool pressed_down = false, lifted = false;  // of the hand, as this cycle read it
};

void finite_law(const SeenCycle& cycle, LawBook& book) noexcept;
void free_space_law(const SeenCycle& cycle, const Gate& gate, LawBook& book) noexcept;
void no_wall_law(const SeenCycle& cycle, const Gate& gate, const LawLimits& limits, LawBook& book) noexcept;
void force_law(const SeenCycle& cycle, const LawLimits& limits, LawBook& book) noexcept;
void slew_law(const SeenCycle& cycle, const LawLimits& limits, LawBook& book) noexcept;
void guard_law(const SeenCycle& cycle, LawBook& book) noexcept;

// Remembers which lockouts the last gear or the road speed has closed.
class LockoutLaw {
 public:
  void look(const SeenCycle& cycle, const Gate& gate, LawBook& book) noexcept;

 private:
  std::uint32_t closed_ = 0;  // bit per lockout
};

// Passivity of the whole device, by the truth that no encoder tells: over any stretch of time the force that acted gives
// no more than what was stored at its beginning, S = sum F^2 / (2 c) of both axes with c = b / T (Kim & Ryu 2010), and
// what the handle's own damping took meanwhile, b dx^2 / T a period at least (Cauchy and Schwarz: a steady speed takes
// least). The encoder's count q lets the loop mistake the travel by up to q at either end of it: summed by parts that is
// (q / 2) (|dF| + c |d dx|) a period, and q c / 2 of the way itself, true or told.
class EnergyLaw {
 public:
  void look(const SeenCycle& cycle, glm::dvec2 true_travel, const LawLimits& limits, LawBook& book) noexcept;

 private:
  void begin_anew() noexcept;

  double surplus_ = 0.0, allowed_ = 0.0;  // [J] since there last was none
  glm::dvec2 last_travel_{0.0};           // [m]
};

// A gear that comes again was left by at least the way between its two depths.
class GearLaw {
 public:
  void look(const SeenCycle& cycle, const Gate& gate, bool held_still, LawBook& book) noexcept;

 private:
  int changes_ = 0;          // while it is held still
  int last_ = kNeutralGear;  // gear that was in last
  double nearest_ = 0.0;     // [m] least depth in its slot since then; 0: it left the slot
};

// How far the true lever goes back and forth while it is held still: a lever that slides one way does not buzz.
class HeldSwing {
 public:
  void look(glm::dvec2 lever) noexcept;
  double span() const noexcept;  // [m] of the worse axis

 private:
  glm::dvec2 low_{1.0}, high_{-1.0};  // [m]
  glm::dvec2 rise_{0.0}, fall_{0.0};  // [m] the most since it was lowest, highest
};
void quiet_law(double span, const LawLimits& limits, double time, LawBook& book) noexcept;

// On any spring handle and hand let a swing die away by exp(-b t / (2 m)), b and m of both together. Half of that decay is
// asked: a wall stiffens, and is not passive to the last. One that lasts, or grows, is fed.
inline constexpr double kFading = 1.0;  // [s] from the end of the span before to the end of the hold
void fades_law(double before, double after, const LawLimits& limits, double time, LawBook& book) noexcept;

}  // namespace gearshift
