// Pedals moved by keys. The pedals keep moving between frames.
//
// Each frame sets the held keys; the thread with the car's clock moves the pedals cycle by cycle. Therefore no pedal
// jumps at a low frame rate: a key takes effect up to one frame late, and the pedal then moves at its normal speed.
#pragma once

#include <mutex>

namespace gearshift::ui {

struct PedalKeys {  // held now
  bool throttle = false, throttle_light = false, brake = false, clutch = false, clutch_hold = false;
};

struct PedalTiming {
  double pedal_time = 0.25;                         // [s] time for the full pedal travel
  double slip_time = 1.2;                           // [s] time in which the rising clutch pedal passes the bite zone
  double clutch_closed = 0.15, clutch_bite = 0.75;  // [1] pedal positions that bound the bite zone: 0 <= closed < bite
  bool operator==(const PedalTiming&) const = default;
};

struct Pedals {
  double throttle = 0.0, brake = 0.0, clutch = 0.0;  // [1] 0: released, 1: fully pressed
};

// `throttle_light` presses the throttle by a fifth of the travel, or less while the engine turns fast and is not
// coupled to the wheels. The released clutch pedal rises fast, but slowly through the bite zone, and stops while
// `clutch_hold` is held. All functions may be called from any thread.
class KeyboardPedals {
 public:
  void set_keys(const PedalKeys& keys);
  void set_timing(const PedalTiming& pace);  // call when the car changes

  // Sets the number of the active lever. Only calls of move() with this number move the pedals. The number is needed
  // because both levers call move() for a while when one replaces the other.
  void set_active_lever(int lever);

  // Moves the pedals by `seconds` of the car's time (negative counts as 0). `engine_speed`: [rad/s]. `coupled`: the
  // engine drives the wheels. `lever`: number of the calling lever; unless it is the active lever's number (initially
  // 0), the call has no effect.
  Pedals move(double seconds, double engine_speed, bool coupled, int lever = 0);

 private:
  std::mutex mutex_;  // guards the members below
  PedalKeys keys_;
  PedalTiming timing_;
  Pedals pedals_;
  int active_lever_ = 0;  // number of the lever whose calls move the pedals
};

}  // namespace gearshift::ui
