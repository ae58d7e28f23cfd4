// Decides how long a warning is audible: while its cause lasts, but long enough to be noticed, and without on-off
// flutter.
#pragma once

namespace gearshift::cabin {

class WarningHold {
 public:
  // `length`: minimum duration of the warning [s]. `hold`: time for which the warning continues after its cause has
  // gone [s]. A cause that returns within this time does not restart the warning.
  WarningHold(double length, double hold) : length_(length), hold_(hold) {}

  void begin() { has_begun_ = true; }  // call when the cause has occurred, even if only for a moment

  struct Now {
    bool is_audible = false;
    bool starts = false;
  };
  Now update(bool lasts, double time);  // time [s]; a clock that is set back does not prolong the warning

 private:
  double length_, hold_;
  bool has_begun_ = false, is_audible_ = false;
  double until_ = 0.0;
};

}  // namespace gearshift::cabin
