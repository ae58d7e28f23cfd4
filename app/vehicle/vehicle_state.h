// State of the car for graphics, sound, instruments and lesson assessment. One consistent value per haptic cycle.
#pragma once

#include <cstdint>

#include "app/vehicle/speed_unit.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::vehicle {

// Progress of the sleeve into a gear. Lovas, Savage, Magi: Dynamics of Gear Selector Mechanisms and Synchronisers,
// 2006, distinguish eight phases; a hand can tell only the phases below apart.
enum class SyncPhase : std::uint8_t {
  free,           // ring not touched
  indexing,       // past the detent, the ring turns into its blocking position
  synchronising,  // the cone rubs and the ring blocks the sleeve
  passing,        // speeds are equal, the sleeve turns the ring aside and moves on
  second_bump,    // the sleeve's teeth meet the dogs and turn the gear aside
  clashing,       // dogs meet at unequal speeds: they rattle and do not engage
  meshed          // dogs engaged
};

struct VehicleState {
  // Engine
  double engine_speed = 0.0;   // [rad/s] backwards is negative
  double engine_load = 0.0;    // [1] 0 to 1: fraction of the available torque
  bool running = true;         // the engine fires
  bool stalled = false;        // the engine died with the ignition on and has not run by itself since
  double red_line = 0.0;       // [rad/s] 0: no car
  bool over_revved = false;    // the engine turns faster than its red line
  bool fuel_cut = false;       // the rev limiter has cut the fuel
  bool cranking = false;       // the starter turns the engine
  double idle_integral = 0.0;  // [1] EngineState::integral
  double idle_lift = 0.0;      // [rad/s] EngineState::lift
  double cranked = 0.0;        // [rad] EngineState::cranked
  double shudder = 0.0;        // [1] 0 to 1: vibration of a labouring or dying engine
  int shift_advice = 0;        // +1: shift up; -1: shift down, because the engine labours; 0: stay

  // Clutch and gearbox
  double clutch_bite = 0.0;      // [1] pedal position at which a clutch coming up starts to transmit torque; 0: no car
  double clutch_closed = 0.0;    // [1] pedal position at which a clutch coming up has full capacity; 0: no car
  double clutch_capacity = 0.0;  // [N m] largest torque that the clutch can transmit now
  double clutch_torque = 0.0;    // [N m] torque transmitted; from engine to gearbox is positive
  double shaft_speed = 0.0;      // [rad/s] speed of gearbox input shaft and clutch disc; backwards is negative
  double slip_power = 0.0;       // [W] heating power in the clutch, >= 0
  double slip_energy = 0.0;      // [J] heat in the clutch since the start
  double clutch_temperature = 0.0;  // [C]
  bool clutch_smells = false;       // it is so hot that it smells
  bool clutch_fades = false;        // it is so hot that it slips
  bool clutch_locked = false;
  int gear = 0;                      // engaged gear: kReverseGear, kNeutralGear or 1, 2, ...
  SyncPhase sync = SyncPhase::free;  // phase in the slot that the lever is in
  // [rad/s] speed difference of the dogs in the lever's slot, measured at the gear. It is 0 if the lever is in no slot
  // or a gear is engaged.
  double dog_difference = 0.0;
  double grind_power = 0.0;    // [W] power lost in rattling dogs, >= 0
  bool grinding = false;       // dogs are rattling
  bool torque_locked = false;  // the load is too high to pull the gear out

  // Car
  double road_speed = 0.0;    // [m/s] forward is positive
  double acceleration = 0.0;  // [m/s^2] forward is positive
  double distance = 0.0;      // [m] distance driven; forward is positive
  double drive_torque = 0.0;  // [N m] torque of the gearbox at the wheels; forward is positive
  double slope = 0.0;         // [rad] slope of the road; uphill is positive
  double top_speed = 0.0;     // [m/s] 0: no car
  SpeedUnit speed_unit = SpeedUnit::km_per_h;
  haptics::Pedals pedals;
  bool ignition = true;  // lights the warning lamps if the engine is off

  // Lever
  double force_scale = 1.0;  // [1] device force divided by real force, at most 1
};

}  // namespace gearshift::vehicle
