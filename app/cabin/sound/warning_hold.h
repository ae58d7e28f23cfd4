// Decides how long a warning is heard: while its cause lasts, long enough to be understood, and without flutter.
#pragma once

namespace gearshift::cabin {

class WarningHold {
 public:
  // length: minimum time the warning is heard. hold: time it continues after the cause has gone; a cause that returns
  // within it does not restart the warning. [s]
  WarningHold(double length, double hold) : length_(length), hold_(hold) {}

  void begin() { has_begun_ = true; }  // the cause occurred, perhaps only for a moment

  struct Now {
    bool is_audible = false;
    bool starts = false;
  };
  Now update(bool lasts, double time);  // time in [s]; a clock set back cannot prolong it

 private:
  double length_, hold_;
  bool has_begun_ = false, is_audible_ = false;
  double until_ = 0.0;
};

}  // namespace gearshift::cabin
