// The feet of who drives by keys: pedals that go on moving while the picture is drawn.
//
// The frame says which keys are held; who has the car's clock moves the feet, cycle by cycle. So a slow picture makes no
// pedal jump: a key counts up to a frame late, and from then on the pedal goes as at any other rate.
#pragma once

#include <mutex>

namespace gearshift {

struct FootKeys {  // held now
  bool throttle = false, throttle_light = false, brake = false, clutch = false, clutch_hold = false;
};

struct FootPace {
  double pedal_time = 0.25;                         // [s] from up to down
  double slip_time = 1.2;                           // [s] the clutch, on its way up, through where it takes hold ...
  double clutch_closed = 0.15, clutch_bite = 0.75;  // [1] ... of the pedal: 0 <= closed < bite
  bool operator==(const FootPace&) const = default;
};

struct Pedals {
  double throttle = 0.0, brake = 0.0, clutch = 0.0;  // [1] 0 up, 1 down
};

// throttle_light presses a fifth, and less where the engine turns freely and fast; the clutch comes up quickly, but
// slowly where it takes hold, and stays where it is while clutch_hold is down. Any thread.
class KeyFeet {
 public:
  void ask(const FootKeys& keys);
  void set_pace(const FootPace& pace);  // of another car

  // Where one lever takes over from another both run for a while: the feet are moved by that one alone.
  void give_to(int lever);

  // Of so much of the car's time [s]; less than none is none. engine_speed [rad/s]; coupled: to the wheels. lever: that
  // asks; while the feet are another one's it only learns where they are. 0 has them at first.
  Pedals move(double seconds, double engine_speed, bool coupled, int lever = 0);

 private:
  std::mutex mutex_;  // guards what stands below
  FootKeys keys_;
  FootPace pace_;
  Pedals pedals_;
  int lever_ = 0;  // whose they are
};

}  // namespace gearshift
