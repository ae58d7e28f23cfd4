// What the picture, the sound and the instruments need to know of the car.
#pragma once

namespace gearshift {

struct VehicleState {
  double engine_speed = 0.0;  // [rad/s] >= 0
  double engine_load = 0.0;   // [1] 0 to 1: share of the torque that the engine could give now
  double road_speed = 0.0;    // [m/s] forward +
  double distance = 0.0;      // [m] driven, forward +
  double throttle = 0.0, brake = 0.0, clutch = 0.0, hand_brake = 0.0;  // [1] 0 to 1, as the pedals stand
  double steering = 0.0;                                               // [rad] of the wheel, left +
  int gear = 0;          // engaged: kReverseGear, kNeutralGear or 1, 2, ...
  bool ignition = true;  // lamps lit while the engine stands
  bool stalled = false;
  bool grinding = false;                       // dogs rattle
  bool turn_left = false, turn_right = false;  // indicators asked for
};

}  // namespace gearshift
