// One synchroniser: everything between the lever in a slot and the dogs of that slot's gear.
//
//     index     block   out  dogs  home                engage   depth of the lever, see SleeveStations
//   ----+---------+------+----+-----+------------------+---->
//       | ring    |           | dogs engaged           | the gear counts as engaged
//       | indexes | the ring blocks while the speeds differ: a wall
//
// The synchroniser never sets the lever's position. It returns walls (limits of depth) and two small forces along the
// slot: the second bump on the way in, and the rattle of clashing dogs. Its inputs are the speeds from the
// car's previous step and the push from the previous cycle.
#pragma once

#include <cstdint>

#include "app/vehicle/car_spec.h"
#include "app/vehicle/vehicle_state.h"
#include "haptics/gate/gate.h"

namespace gearshift::vehicle {

// Largest push of a driver on a real lever [N]: the alarm level in Lin and Young's paper (haptics/EQUATIONS.md). A push
// this large corresponds to the device's largest force; all forces between lever and car are scaled by the same ratio.
inline constexpr double kMaxHandForce = 60.0;

// Depths in a slot [m], in increasing order.
struct SleeveStations {
  double index = 0.0;  // the ring begins to press on the cone
  double block = 0.0;  // the sleeve's teeth meet the ring's teeth
  double out = 0.0;    // on the way out, the dogs disengage here
  double dogs = 0.0;   // the sleeve's teeth meet the dogs: they engage or clash
  double home = 0.0;   // the second bump ends here
};
SleeveStations sleeve_stations(const haptics::Gate& gate, const haptics::Slot& slot) noexcept;

// Torque of the cone divided by the force on the sleeve [m].
double cone_gain(const SynchroSpec& synchro) noexcept;
// Torque with which the ring's teeth turn the ring aside, divided by the force on the sleeve [m].
double index_gain(const SynchroSpec& synchro) noexcept;

struct SleeveInput {
  int slot = haptics::kNoSlot;  // slot that the lever is in
  double depth = 0.0;           // [m]
  double push = 0.0;            // [N] force of the hand on the knob; into the slot is positive
  double feel = 0.0;            // [N] force of the gate's springs and detents on the knob; into the slot is positive
  double difference = 0.0;      // [rad/s] speed difference of the slot's dogs, measured at the gear
  double load = 0.0;            // [N m] load torque, measured at the gear; either sign
  bool clutch_open = false;     // the clutch transmits no torque
};

struct SleeveOutput {
  int meshed = haptics::kNeutralGear;     // gear whose dogs are engaged
  int cone_gear = haptics::kNeutralGear;  // gear whose cone rubs
  double cone_torque = 0.0;               // [N m] capacity of the cone, measured at the gear
  double depth_min = 0.0;                 // [m] lower limit of depth; 0: no limit
  double depth_max = 0.0;                 // [m] upper limit of depth; the largest double: no limit
  double force = 0.0;                     // [N] force on the knob; into the slot is positive
  double rattle = 0.0;  // [N] part of `force` from clashing dogs; oscillates even if the lever is still
  SyncPhase phase = SyncPhase::free;
  double grind_power = 0.0;    // [W]
  bool torque_locked = false;  // the load is too high for any hand to pull the gear out
};

class Synchroniser {
 public:
  // `force_scale`: device force divided by real force, > 0 and <= 1. `meshed`: the gear engaged at the start. It stays
  // engaged only if the lever is in its slot at the first step.
  Synchroniser(const SynchroSpec& synchro, const haptics::Gate& gate, double force_scale, int meshed,
               std::uint64_t seed);

  // Real-time safe.
  SleeveOutput step(const SleeveInput& in, double period) noexcept;

 private:
  void enter_slot(int slot) noexcept;
  void update_mesh(const SleeveInput& in) noexcept;
  void mesh(double depth) noexcept;
  void filter_push(const SleeveInput& in, double period) noexcept;
  bool is_meshed() const noexcept;
  bool speeds_match(const SleeveInput& in) const noexcept;
  bool ring_blocks(const SleeveInput& in) const noexcept;
  bool dogs_clash(const SleeveInput& in) const noexcept;
  SyncPhase phase(const SleeveInput& in) const noexcept;
  double sleeve_force(double push) const noexcept;
  double cone_torque(const SleeveInput& in) const noexcept;
  double rattle_torque(const SleeveInput& in) const noexcept;
  double lock_force(const SleeveInput& in) const noexcept;
  void hold_under_load(const SleeveInput& in, double period, SleeveOutput& out) noexcept;
  double bump_force(double depth) const noexcept;
  double rattle_force(const SleeveInput& in, double period) noexcept;

  SynchroSpec synchro_;
  haptics::Gate gate_;
  double scale_;
  double cone_gain_;
  bool ring_can_block_;  // cone friction is above the critical value
  std::uint64_t random_;

  bool has_started_ = false;
  int slot_ = haptics::kNoSlot;
  int meshed_;
  SleeveStations at_;             // stations of the current slot
  bool has_passed_ring_ = false;  // the sleeve has moved through the ring
  double push_ = 0.0;             // [N] filtered
  double peak_push_ = 0.0;        // [N] largest push since the lever reached the ring
  double bump_ = 0.0;             // [N] peak of the second bump; 0: already passed
  double period_ = 0.0;           // [s] duration of the current step
  double filter_gain_ = 0.0;      // [1] gain of the filters per step
  double held_depth_ = 0.0;       // [m] depth at which the load holds the sleeve
  double rattle_ = 0.0;           // [N] amplitude
  double rattle_phase_ = 0.0;     // [rad]
};

}  // namespace gearshift::vehicle
