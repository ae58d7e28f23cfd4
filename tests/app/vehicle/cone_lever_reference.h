// Reference solution for the coupling of cone and lever: hand, lever, ring and driveline as one set of ordinary
// differential equations in continuous time. Fourth-order Runge-Kutta, 2 us; every force discontinuity is located to
// 1e-13 s. Written from the laws in the READMEs: it shares only the car's curves and the paper's axis with the product.
// It has no samples, no holds and no filter of the push, so any difference from the product is the cost of sampling.
//
// It runs from a resting lever in the slot of a gear with its dogs apart until the ring lets the sleeve pass. The lever
// moves on the arc of its yoke, held in the middle of its slot; the other axis is left out.
#pragma once

#include <vector>

#include "app/vehicle/car_spec.h"
#include "haptics/device/hand.h"

namespace gearshift::test {

// A slot with a ring. Depths as in gate.h [m]; the forces are named as in layout files [N].
struct RingSlot {
  double mouth = 0.0, bump = 0.0, low = 0.0, crest = 0.0, lock = 0.0;   // [m] increasing
  double aisle = 0.0, resist = 0.0, detent = 0.0, pull = 0.0;           // [N] out of the slot; pull: into it
  double block = 0.0;                                                   // [m] where the ring blocks
  double wall_stiffness = 5000.0, wall_damping = 10.0;                  // [N/m], [N s/m]
  double aisle_damping = 2.0, speed_limit = 0.6, limit_damping = 15.0;  // [N s/m], [m/s], [N s/m]
  // [s] time constant of the velocity that is damped
  double smoothing = 0.004;
  double max_motor_force = 31.7;  // [N]
};

// The tip on its arc: depth = width sin(arc / radius). Radius 0: a straight line.
struct LeverArc {
  double radius = 0.0;             // [m] of the yoke
  double width = 0.0;              // [m] radius of the circle in which the slot's plane cuts the yoke's sphere
  double depth(double arc) const;  // [m]
  double arc(double depth) const;  // [m]
  double slope(double arc) const;  // [1] derivative of depth
};

// A hand that pushes with constant force, or holds the lever towards a target that moves inwards and then stops.
struct SlotHand {
  haptics::HandImpedance grip = haptics::kGripHand;
  double push = 0.0;   // [N] into the slot
  double speed = 0.0;  // [m/s] of the target; 0: it pushes
  double from = 0.0;   // [m] the target at the start
  double to = 0.0;     // [m] where the target stops
  double place(double time) const;
};

struct ConeLeverStart {
  double depth = 0.0, speed = 0.0;               // [m], [m/s] of the lever
  double engine = 0.0, shaft = 0.0, road = 0.0;  // [rad/s], [rad/s], [m/s]
};

struct ConeLeverSample {
  double depth = 0.0, push = 0.0;  // [m], [N] of the hand on the knob
  double shaft = 0.0, road = 0.0;  // [rad/s], [m/s]
  double heat = 0.0;               // [J] of the cone
};

struct ConeLeverOutcome {
  std::vector<ConeLeverSample> samples;  // every millisecond, beginning with the start
  double touch = -1.0;                   // [s] when the lever first touches the ring; < 0: never
  double open = -1.0;                    // [s] when the ring lets it pass; < 0: not within the time
  double heat = 0.0;                     // [J] of the cone until then
};

struct ConeLeverCase {
  const vehicle::CarSpec& car;
  RingSlot slot{};
  LeverArc lever{};
  SlotHand hand{};
  int gear = 1;
  double force_scale = 1.0;    // [1] of the real forces at the knob
  bool clutch_closed = false;  // and locked: engine and shaft are one; pedals otherwise untouched
  double most = 3.0;           // [s]
  double step = 2e-6;          // [s]
};

ConeLeverOutcome cone_lever_reference(const ConeLeverCase& what, const ConeLeverStart& start);

}  // namespace gearshift::test
