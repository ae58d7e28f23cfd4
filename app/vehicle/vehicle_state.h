// What picture, sound, instruments and teacher need to know of the car. One whole value a haptic cycle.
#pragma once

#include <cstdint>

namespace gearshift {

// Where the sleeve is on its way into a gear. Lovas, Savage, Magi: Dynamics of Gear Selector Mechanisms and
// Synchronisers, 2006, has eight phases; these are the ones that a hand can tell apart.
enum class SyncPhase : std::uint8_t {
  free,           // no ring touched
  indexing,       // the detent has given way, the ring turns into its blocking place
  synchronising,  // the cone rubs and the ring blocks the sleeve
  passing,        // the speeds are equal, the sleeve turns the ring aside and goes on
  second_bump,    // tooth meets tooth: the sleeve turns the gear aside
  clashing,       // dogs on dogs at unequal speeds: they rattle and do not go in
  meshed          // the dogs are in
};

struct VehicleState {
  // Engine
  double engine_speed = 0.0;   // [rad/s] >= 0
  double engine_load = 0.0;    // [1] 0 to 1: share of the torque that the engine could give now
  double engine_torque = 0.0;  // [N m] at the flywheel, friction taken off
  bool running = true;         // it fires
  bool stalled = false;        // it ran, died with the ignition on, and has not run by itself since
  double red_line = 0.0;       // [rad/s] of the car; 0: there is none
  bool over_revved = false;    // above it
  bool fuel_cut = false;       // by the limiter
  bool cranking = false;       // the starter turns it
  double shudder = 0.0;        // [1] 0 to 1: it labours or dies, and shakes the car
  int shift_advice = 0;        // +1: the next gear up would do with less fuel; -1: it labours, one down; 0: as it is

  // Clutch and gearbox
  double clutch_bite = 0.0;      // [1] pedal: it begins to carry as it comes up through here
  double clutch_closed = 0.0;    // [1] pedal: it carries all from here up. Both 0: there is no car
  double clutch_capacity = 0.0;  // [N m] the most that it can carry now
  double clutch_torque = 0.0;    // [N m] that it carries, from engine to gearbox +
  double shaft_speed = 0.0;      // [rad/s] gearbox input shaft = clutch disc, backwards -
  double slip_power = 0.0;       // [W] heat of the clutch, >= 0
  double slip_energy = 0.0;      // [J] of it since the start
  bool clutch_locked = false;
  int gear = 0;                      // engaged: kReverseGear, kNeutralGear or 1, 2, ...
  SyncPhase sync = SyncPhase::free;  // of the slot that the lever is in
  double dog_difference = 0.0;       // [rad/s] of the dogs that would mesh, at the gear's shaft; 0 in neutral
  double grind_power = 0.0;          // [W] of dogs that rattle, >= 0
  bool grinding = false;             // they do
  bool torque_locked = false;        // the gear cannot be drawn out under this load

  // Car
  double road_speed = 0.0;                                             // [m/s] forward +
  double acceleration = 0.0;                                           // [m/s^2] forward +
  double distance = 0.0;                                               // [m] driven, forward +
  double drive_torque = 0.0;                                           // [N m] of the gearbox at the wheels, forward +
  double slope = 0.0;                                                  // [rad] of the road, uphill +
  double throttle = 0.0, brake = 0.0, clutch = 0.0, hand_brake = 0.0;  // [1] 0 to 1, as the pedals stand
  double steering = 0.0;                                               // [rad] of the wheel, left +
  bool ignition = true;                                                // lamps lit while the engine stands
  bool turn_left = false, turn_right = false;                          // indicators asked for

  // Lever
  double force_scale = 1.0;  // [1] of the real forces, that the device can give; at most 1
};

}  // namespace gearshift
