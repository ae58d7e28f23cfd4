// A reference solution for the coupling of cone and lever. It treats hand, lever, ring and driveline as one set of
// ordinary differential equations in continuous time, and integrates them by fourth-order Runge-Kutta with steps of
// 2 us by default. Every force discontinuity is located to 1e-13 s. The reference was written from the laws in the
// READMEs. It shares only the car's curves and the paper's lever constants (kPaperAxisY) with the shipped code. It
// neither samples and holds signals nor filters the push, so any difference from the shipped code is the cost of
// sampling.
//
// A run begins with the lever at rest in the slot of a gear whose dogs are disengaged. It ends when the ring lets the
// sleeve pass. The lever moves on the arc of its yoke, in the middle of its slot. Motion across the slot is omitted.
#pragma once

#include <vector>

#include "app/vehicle/car_spec.h"
#include "haptics/device/hand.h"

namespace gearshift::test {

// A slot with a synchroniser ring. Depths are defined as in gate.h, and the forces are named as in layout files.
struct RingSlot {
  double mouth = 0.0, bump = 0.0, low = 0.0, crest = 0.0, lock = 0.0;  // [m] increasing
  double aisle = 0.0, resist = 0.0, detent = 0.0, pull = 0.0;  // [N] `pull` acts into the slot, the others out of it
  double block = 0.0;                                          // [m] depth at which the ring blocks
  double wall_stiffness = 5000.0, wall_damping = 10.0;         // [N/m], [N s/m]
  double aisle_damping = 2.0, speed_limit = 0.6, limit_damping = 15.0;  // [N s/m], [m/s] and [N s/m]
  // [s] The damping acts on the filtered velocity; this is the filter's time constant.
  double smoothing = 0.004;
  double max_motor_force = 31.7;  // [N]
};

// The path of the lever's tip: depth = width * sin(arc / radius). If `radius` is 0, the path is a straight line.
struct LeverArc {
  double radius = 0.0;             // [m] yoke radius
  double width = 0.0;              // [m] radius of the tip's circle in the slot's plane, at most `radius`
  double depth(double arc) const;  // [m]
  double arc(double depth) const;  // [m]
  double slope(double arc) const;  // [1] derivative of the depth along the arc
};

// A hand that pushes with constant force, or that holds the lever at a target. The target moves inwards and then stops.
struct SlotHand {
  haptics::HandImpedance grip = haptics::kGripHand;
  double push = 0.0;   // [N] constant force into the slot
  double speed = 0.0;  // [m/s] speed of the target; if 0, the hand pushes instead
  double from = 0.0;   // [m] depth of the target at the start
  double to = 0.0;     // [m] depth at which the target stops
  double place(double time) const;
};

struct ConeLeverStart {
  double depth = 0.0, speed = 0.0;               // [m], [m/s]: the lever's depth and speed
  double engine = 0.0, shaft = 0.0, road = 0.0;  // [rad/s], [rad/s], [m/s]
};

struct ConeLeverSample {
  double depth = 0.0, push = 0.0;  // [m] the lever's depth; [N] the hand's push on the knob
  double shaft = 0.0, road = 0.0;  // [rad/s], [m/s]
  double heat = 0.0;               // [J] energy that the cone has dissipated so far
};

struct ConeLeverOutcome {
  std::vector<ConeLeverSample> samples;  // one sample per millisecond, from the start on
  double touch = -1.0;                   // [s] when the lever first touches the ring; < 0: never
  double open = -1.0;                    // [s] when the ring lets the lever pass; < 0: not within max_time
  double heat = 0.0;                     // [J] energy that the cone dissipates until the ring opens
};

struct ConeLeverCase {
  const vehicle::CarSpec& car;
  RingSlot slot{};
  LeverArc lever{};
  SlotHand hand{};
  int gear = 1;
  double force_scale = 1.0;    // [1] force at the device's knob / force in the real car
  bool clutch_closed = false;  // if true, engine and shaft turn together and no pedal is pressed
  double max_time = 3.0;       // [s]
  double step = 2e-6;          // [s]
};

ConeLeverOutcome cone_lever_reference(const ConeLeverCase& reference_case, const ConeLeverStart& start);

}  // namespace gearshift::test
