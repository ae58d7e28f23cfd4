// Constants of a practised driver's hand and feet. All are engineering values.
#pragma once

namespace gearshift::lessons {

inline constexpr double kPressRate = 5.0;         // [1/s] pressing the clutch: 0.2 s for the whole travel
inline constexpr double kLiftRate = 8.0;          // [1/s] throttle released
inline constexpr double kThrottleRate = 2.5;      // [1/s] throttle pressed
inline constexpr double kBrakeRate = 4.0;         // [1/s]
inline constexpr double kHandBrakeRate = 3.0;     // [1/s]
inline constexpr double kClutchRateToBite = 2.5;  // [1/s] releasing the clutch before it transmits torque
// [1/s] releasing the clutch from the bite point to full capacity while the car rolls; takes 0.6 s
inline constexpr double kClutchRateThroughBite = 0.95;
inline constexpr double kClutchRateLaunch = 0.25;      // [1/s] releasing the clutch in a launch, from bite to lock
inline constexpr double kClutchRateAfterLaunch = 1.2;  // [1/s] releasing the clutch in a launch, after it has locked
inline constexpr double kDumpSlip = 160.0;    // [rad/s] engine minus shaft speed when dumping the clutch while rolling
inline constexpr double kRevTolerance = 8.0;  // [rad/s] accuracy of judging the engine speed by ear
inline constexpr double kRevSettleTime = 0.12;    // [s] the engine speed must stay within the tolerance this long
inline constexpr double kMaxBlipTime = 1.5;       // [s] a blip is given up after this time
inline constexpr double kLightBite = 0.03;        // [1] pedal travel past the bite point that hardly transmits torque
inline constexpr double kClutchRateCreep = 0.12;  // [1/s] releasing the clutch to find the bite point without throttle
inline constexpr double kLaunchSpeed = 167.6;     // [rad/s] engine speed at a launch: 1600 rpm
inline constexpr double kLaunchSpeedAfterStall =
    1.15;  // [1] engine speed of the next launch divided by that of the last
// [1] fraction of idle speed below which the driver presses the clutch to save the engine from stalling
inline constexpr double kStallRescueSpeed = 0.75;
inline constexpr double kRevHoldGain = 0.015;        // [s] throttle per rad/s of missing engine speed
inline constexpr double kBiteDrop = 22.0;            // [rad/s] drop of engine speed that signals the bite point
inline constexpr double kIdleDrop = 6.0;             // [rad/s] drop of idle speed that signals the bite point
inline constexpr double kAccelerateThrottle = 0.50;  // [1] throttle
inline constexpr double kCruiseThrottle = 0.20;      // [1]
inline constexpr double kSlowBrake = 0.2;            // [1]
inline constexpr double kHeelBrake = 0.12;           // [1] brake while the heel blips
inline constexpr double kStopBrake = 0.3;            // [1]
inline constexpr double kHandLead = 0.06;            // [s] from clutch down to the start of the hand's movement
inline constexpr double kClutchLag = 0.06;           // [s] from gear engaged to clutch up
// [s] A foot that would lift the clutch too early by at most this time waits, because the hand feels that the gear is
// not engaged yet.
inline constexpr double kMaxClutchLead = 0.06;
inline constexpr double kKnobReleaseTime = 0.15;  // [s] from gear engaged to the hand releasing the knob
inline constexpr double kShaftRestTime = 3.0;     // [s] wait with the clutch down before engaging reverse
inline constexpr double kStuckTime = 1.2;         // [s] time of pushing without effect before a new attempt
inline constexpr double kBesideSlotTime = 0.2;  // [s] time of pushing beside a slot before retrying, plus reaction time
inline constexpr double kSyncPatience = 4.0;    // [s] time of pushing on a blocking synchroniser before a new attempt
inline constexpr double kMaxStepTime = 45.0;    // [s] time without a completed step before giving up
inline constexpr double kPauseAfterMiss = 3.8;  // [s] time without a new attempt after a missed shift
inline constexpr double kMinHillSlope = 0.02;   // [rad]
inline constexpr double kMaxStandingSpeed = 0.3;  // [m/s]
inline constexpr double kMinBumpSpeed = 2.5;      // [m/s] a car that rolls faster in gear starts its engine
inline constexpr double kMinFeltSpeed = 0.02;     // [m/s] a slower creep on the clutch is not felt
inline constexpr double kCreepBrake = 0.12;       // [1] brake that slows a car which creeps down a hill
inline constexpr double kMinRollingSpeed = 1.0;   // [m/s]
inline constexpr double kMinDrivingSpeed = 4.5;   // [m/s] lowest speed for the deliberate error `blocked`
// [m/s] Lowest speed for the deliberate errors `coasting` and `too_slow`: the car still rolls after some seconds.
inline constexpr double kMinCoastingSpeed = 5.0;
inline constexpr double kStrokeDelay = 0.06;     // [s] duration of a stroke, in addition to distance divided by pace
inline constexpr double kMouthDepth = 0.006;     // [m] depth of a stroke into a wrong slot
inline constexpr double kMouthStrokeTime = 0.2;  // [s] duration of the last stroke into a wrong slot

// Constants of deliberate errors. "times the amount": multiplied by the entry of `DeliberateErrors::amount`.
inline constexpr double kHoverMargin = 0.025;       // [1] pedal travel above the bite point in a roll back
inline constexpr double kDumpRate = 25.0;           // [1/s] speed of the clutch pedal when the foot slips off
inline constexpr double kAbruptRate = 3.8;          // [1/s] releasing the clutch abruptly: 0.26 s for the whole travel
inline constexpr double kNearRevs = 60.0;           // [rad/s] with less rev difference, a jerk needs kDumpRate
inline constexpr double kDumpSpeed = 419.0;         // [rad/s] engine speed for a clutch dump at a launch: 4000 rpm
inline constexpr double kBurnSpeedGain = 1.7;       // [1] relative rise of engine speed at a launch, times the amount
inline constexpr double kJerkSpeed = 272.0;         // [rad/s] engine speed for a jerk at a launch: 2600 rpm
inline constexpr double kHurryThrottle = 0.6;       // [1]
inline constexpr double kBaseOverPush = 60.0;       // [N] hand force of an impatient driver
inline constexpr double kOverPushGain = 35.0;       // [N] additional hand force, times the amount
inline constexpr double kRestingPedal = 0.09;       // [1] position of a pedal with a resting foot
inline constexpr double kRestingPedalGain = 0.03;   // [1] additional pedal travel, times the amount
inline constexpr double kDawdleTime = 4.0;          // [s] time for which the clutch stays down, times the amount
inline constexpr double kCoastTime = 5.5;           // [s] time of driving with the clutch open, times the amount
inline constexpr double kOpenMargin = 0.02;         // [1] pedal travel past the bite point when coasting
inline constexpr double kLateStepFactor = 1.5;      // [1] delay relative to a step's allowed time, times the amount
inline constexpr double kEarlyThrottle = 0.15;      // [1] throttle that is pressed before the clutch is up
inline constexpr double kThrottleLead = 0.6;        // [s] from throttle pressed to clutch up, times the amount
inline constexpr double kSettleAfterOverRev = 5.0;  // [s] from over-revving until the clutch comes up
inline constexpr double kEarlyShiftFactor = 0.8;    // [1] early shifts happen below this fraction of the correct speed
inline constexpr double kLateShiftFactor = 1.5;     // [1] late shifts happen above this multiple of the prompted revs
inline constexpr double kLateShiftMargin = 4.2;     // [m/s] late shifts happen this far past the correct speed

}  // namespace gearshift::lessons
