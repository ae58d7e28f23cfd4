// One synchroniser: what stands between the lever in a slot and the dogs of that slot's gear.
//
//     crest     block   out  dogs            home engage      depth of the lever, see SleeveStations
//   ----+---------+------+----+----------------+----+---->
//       | ring    |           | dogs in          |    the gear counts
//       | indexes | the ring blocks while the speeds differ: a wall
//
// It gives no position to the lever, only walls (limits of depth) and two small forces along the slot: the second bump on
// the way in, and the rattle of dogs that clash. Speeds are those of the car's last step, the push is one cycle old.
#pragma once

#include <cstdint>

#include "app/vehicle/car_spec.h"
#include "app/vehicle/vehicle_state.h"
#include "haptics/gate/gate.h"

namespace gearshift {

// The most that a person pushes a lever with [N]: the paper's alarm. The device gives it as its own most, and all forces
// between lever and car in that proportion.
inline constexpr double kHandMost = 60.0;

// Depths in a slot, rising. [m]
struct SleeveStations {
  double crest = 0.0;  // the detent has given way
  double block = 0.0;  // teeth of the sleeve on the teeth of the ring
  double out = 0.0;    // drawn back behind this, the dogs are out
  double dogs = 0.0;   // teeth of the sleeve on the dogs: in, or a clash
  double home = 0.0;   // past the second bump
};
SleeveStations sleeve_stations(const Slot& slot) noexcept;

// Torque per force on the sleeve [m]: of the cone, and of the ring's teeth that the sleeve turns aside.
double cone_gain(const SynchroSpec& synchro) noexcept;
double index_gain(const SynchroSpec& synchro) noexcept;
// Friction of the cone below which the ring is turned aside before the speeds are equal. [1]
double critical_friction(const SynchroSpec& synchro) noexcept;

struct SleeveInput {
  int slot = kNoSlot;        // that the lever is in
  double depth = 0.0;        // [m]
  double push = 0.0;         // [N] of the hand at the knob, into the slot +
  double feel = 0.0;         // [N] of the gate there, the same way
  double difference = 0.0;   // [rad/s] between the dogs of that slot's gear, at the gear
  double load = 0.0;         // [N m] that the gear carries, at the gear; either sign
  bool clutch_open = false;  // carries nothing
};

struct SleeveOutput {
  int meshed = kNeutralGear;     // the gear whose dogs are in
  int cone_gear = kNeutralGear;  // the gear whose cone rubs
  double cone_torque = 0.0;      // [N m] the most that it carries, at the gear
  double depth_min = 0.0;        // [m] limits in the slot: 0 and the largest number where there is none
  double depth_max = 0.0;        // [m]
  double force = 0.0;            // [N] on the knob, into the slot +
  double rattle = 0.0;           // [N] of it the dogs' that clash: at their own rate, whatever the lever does
  SyncPhase phase = SyncPhase::free;
  double grind_power = 0.0;    // [W]
  bool torque_locked = false;  // no hand draws the gear out
};

class Synchroniser {
 public:
  // force_scale: of the real forces, that the device gives (0 to 1]. meshed: the gear that is in at the start; it stays
  // only if the lever is there at the first step.
  Synchroniser(const SynchroSpec& synchro, const Gate& gate, double force_scale, int meshed, std::uint64_t seed);

  // Real-time safe.
  SleeveOutput step(const SleeveInput& in, double period) noexcept;

 private:
  void enter(int slot) noexcept;
  void follow(const SleeveInput& in) noexcept;
  void mesh(double depth) noexcept;
  void filter(const SleeveInput& in, double period) noexcept;
  bool is_meshed() const noexcept;
  bool matches(const SleeveInput& in) const noexcept;
  bool ring_blocks(const SleeveInput& in) const noexcept;
  bool clashes(const SleeveInput& in) const noexcept;
  SyncPhase phase(const SleeveInput& in) const noexcept;
  double sleeve_force(double push) const noexcept;
  double cone_torque(const SleeveInput& in) const noexcept;
  double rattle_torque(const SleeveInput& in) const noexcept;
  double lock_force(const SleeveInput& in) const noexcept;
  void hold_under_load(const SleeveInput& in, double period, SleeveOutput& out) noexcept;
  double bump_force(double depth) const noexcept;
  double rattle_force(const SleeveInput& in, double period) noexcept;

  SynchroSpec synchro_;
  Gate gate_;
  double scale_;
  double cone_gain_;
  bool ring_holds_;  // its friction is above the critical value
  std::uint64_t chance_;

  bool started_ = false;
  int slot_ = kNoSlot;
  int meshed_;
  SleeveStations at_;          // of that slot
  bool passed_ = false;        // the sleeve is through the ring
  double push_ = 0.0;          // [N] filtered
  double effort_ = 0.0;        // [N] the most of it since the ring was touched
  double bump_ = 0.0;          // [N] peak of the second bump; 0: it is passed
  double period_ = 0.0;        // [s] of this step
  double follows_ = 0.0;       // [1] share of a change that the filters take in it
  double hold_ = 0.0;          // [m] depth that the load holds the sleeve at
  double rattle_ = 0.0;        // [N] its amplitude
  double rattle_phase_ = 0.0;  // [rad]
};

}  // namespace gearshift
