// What must hold in every cycle of every admitted case, each law a function of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

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
  energy,      // bounded: the motors never give what the device's own damping had not taken
  guard,       // no fault: nothing that was admitted has to be stopped
  quiet,       // held still, it is still
  gear_holds,  // held still, the gear does not toggle: a lever let go may slide out; one that comes again was really left
  reached,     // a gear that was cleanly aimed at is in
  told         // no event is lost
};
inline constexpr std::size_t kCampaignLaws = 12;

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
  // Keeps what is worst: furthest beyond its bound, or else the largest share of it.
  void note(CampaignLaw law, double value, double bound, double time) noexcept;
  const LawSeen& seen(CampaignLaw law) const noexcept { return seen_[static_cast<std::size_t>(law)]; }
  LawSeen& seen(CampaignLaw law) noexcept { return seen_[static_cast<std::size_t>(law)]; }
  bool any_broken() const noexcept;

 private:
  std::array<LawSeen, kCampaignLaws> seen_{};
};

// What is promised of a case.
struct LawLimits {
  double period = 0.001;        // [s]
  glm::dvec2 max_force{0.0};    // [N]
  double slew = 0.0;            // [N] a cycle
  double ramp = 0.0;            // [1] a cycle, of the guard's ramp
  bool falls_at_once = false;   // energy bounding does not wait for the slew
  bool energy_bounded = false;  // by the guard, of a device without delay and without walls of its own
  glm::dvec2 damping{0.0};      // [N s/m] of the bare handle
  double ripple = 0.0;          // [m] peak to peak, held still
};
LawLimits law_limits(const HapticConfig& config, const DeviceSpec& spec) noexcept;

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

// Remembers which lockouts the last gear has closed.
class LockoutLaw {
 public:
  void look(const SeenCycle& cycle, const Gate& gate, LawBook& book) noexcept;

 private:
  std::uint32_t after_gear_ = 0;  // bit per lockout
};

// With F held over the travel dx that the encoder tells, and S = F^2 / (2 c), c = b / T, the energy that a wall may still
// give back: what was given and what may still be, F dx + S, never exceeds (c / 2) dx^2, half of what the handle's own
// damping takes over that travel at least (Kim & Ryu 2010). The other half is for count, jitter and plant error.
class EnergyLaw {
 public:
  void look(const SeenCycle& cycle, const LawLimits& limits, LawBook& book) noexcept;

 private:
  glm::dvec2 surplus_{0.0};  // [J] per axis, since it was last none
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

}  // namespace gearshift
