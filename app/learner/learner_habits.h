// How a practised person drives: numbers of hand and feet. All [engineering value]s.
#pragma once

namespace gearshift {

inline constexpr double kPressRate = 5.0;       // [1/s] of the clutch on its way down: 0.2 s
inline constexpr double kLiftRate = 8.0;        // [1/s] of the throttle on its way up
inline constexpr double kThrottleRate = 2.5;    // [1/s] and down
inline constexpr double kBrakeRate = 4.0;       // [1/s]
inline constexpr double kHandBrakeRate = 3.0;   // [1/s]
inline constexpr double kToBite = 2.5;          // [1/s] clutch up where it carries nothing
inline constexpr double kThroughBite = 0.95;    // [1/s] through what carries, rolling: 0.6 s
inline constexpr double kLaunchRate = 0.25;     // [1/s] the same at a launch, until the clutch holds
inline constexpr double kAfterLaunch = 1.2;     // [1/s] once it does
inline constexpr double kDumpSlip = 160.0;      // [rad/s] between engine and shaft, where the clutch is dumped rolling
inline constexpr double kFits = 8.0;            // [rad/s] an ear's tolerance of revs
inline constexpr double kFitsFor = 0.12;        // [s] in which they do not run away
inline constexpr double kBlipMost = 1.5;        // [s] that a blip is tried
inline constexpr double kHardlyBites = 0.03;    // [1] of the pedal above the bite point: it carries next to nothing
inline constexpr double kCreepRate = 0.12;      // [1/s] to find the bite point without throttle
inline constexpr double kLaunchSpeed = 167.6;   // [rad/s] 1600 rpm
inline constexpr double kGasAfterStall = 1.15;  // [1] of the launch before
inline constexpr double kSaves = 0.75;          // [1] of idle: the clutch goes down again before the engine dies
inline constexpr double kHoldGain = 0.015;      // [s] throttle per rad/s that the engine is too slow
inline constexpr double kHoldBase = 0.06;       // [1] throttle that turns a free engine
inline constexpr double kBiteDrop = 22.0;       // [rad/s] the engine falls by so much where the clutch has taken hold
inline constexpr double kIdleDrop = 6.0;        // [rad/s] the same at idle
inline constexpr double kAccelerate = 0.45;     // [1] throttle
inline constexpr double kCruise = 0.15;         // [1]
inline constexpr double kSlowBrake = 0.2;       // [1]
inline constexpr double kStandBrake = 0.3;      // [1]
inline constexpr double kHandLead = 0.06;       // [s] lever after the clutch
inline constexpr double kClutchLag = 0.06;      // [s] clutch after the gear
inline constexpr double kFeelsRing = 0.06;      // [s] clutch before the gear: the hand still keeps the foot from it
inline constexpr double kHandLeaves = 0.15;     // [s] the knob after the gear is in
inline constexpr double kShaftRest = 2.0;       // [s] with the clutch down before reverse
inline constexpr double kStuck = 1.2;           // [s] pushed in vain, before it is tried anew
inline constexpr double kBeside = 0.2;          // [s] and a reaction: pushed beside a slot
inline constexpr double kSyncPatience = 4.0;    // [s] against a ring that blocks
inline constexpr double kGivesUp = 45.0;        // [s] without a step done
inline constexpr double kRestsAfterMiss = 3.8;  // [s]
inline constexpr double kClutchDown = 0.8;      // [1] what lessons call down
inline constexpr double kHill = 0.02;           // [rad]
inline constexpr double kStill = 0.3;           // [m/s]
inline constexpr double kRolls = 1.0;           // [m/s]
inline constexpr double kDriving = 4.5;         // [m/s] above what the teacher calls driving
inline constexpr double kCoasts = 5.0;        // [m/s] from here it still drives after some seconds with the clutch down
inline constexpr double kAtRing = 0.12;       // [1] of the way from the detent to the gear: not through the ring
inline constexpr double kStrokeBegin = 0.06;  // [s] of each stroke, beside its way over its pace
inline constexpr double kBehindMouth = 0.006;  // [m] into a wrong slot
inline constexpr double kPeep = 0.2;           // [s] of that stroke

// And of one who means to do wrong.
inline constexpr double kFootOff = 25.0;          // [1/s] the foot leaves the clutch
inline constexpr double kAbrupt = 3.8;            // [1/s] or is in a hurry: 0.26 s for the whole way
inline constexpr double kSoundsNear = 60.0;       // [rad/s] revs so near seem to need no care
inline constexpr double kDumpSpeed = 419.0;       // [rad/s] 4000 rpm, at a launch
inline constexpr double kHowl = 1.7;              // [1] more than the speed that a launch needs, times the amount
inline constexpr double kJerkSpeed = 272.0;       // [rad/s] 2600 rpm
inline constexpr double kHurry = 0.6;             // [1] throttle
inline constexpr double kPushLeast = 55.0;        // [N] of an impatient hand
inline constexpr double kPushMore = 35.0;         // [N] times the amount
inline constexpr double kFootWeighs = 0.09;       // [1] pedal under a foot that rests on it
inline constexpr double kFootWeighsMore = 0.03;   // [1] times the amount
inline constexpr double kDawdles = 4.0;           // [s] with the clutch down, times the amount
inline constexpr double kRollsOn = 5.5;           // [s] with the clutch open, driving, times the amount
inline constexpr double kHardlyOpen = 0.02;       // [1] of the pedal beyond the bite point
inline constexpr double kLate = 1.5;              // [1] of a step's time, times the amount
inline constexpr double kThrottleTooSoon = 0.15;  // [1] before the clutch is up
inline constexpr double kThrottleLead = 0.6;      // [s] so long before, times the amount
inline constexpr double kRevsSettle = 5.0;        // [s] after a howl, until the clutch comes up
inline constexpr double kFarBefore = 0.8;         // [1] of the speed at which it is to be shifted
inline constexpr double kFarBeyond = 4.2;         // [m/s] and beyond it

}  // namespace gearshift
