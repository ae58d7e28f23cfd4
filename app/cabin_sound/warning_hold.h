// For how long a warning is heard: while its cause lasts, never shorter than can be understood, never fluttering.
#pragma once

namespace gearshift {

class WarningHold {
 public:
  // length: heard at least so long. hold: still heard so long after the cause has gone; a cause that comes back within
  // it does not begin anew. [s]
  WarningHold(double length, double hold) : length_(length), hold_(hold) {}

  void begin() { begun_ = true; }  // the cause came, and may be gone already

  struct Now {
    bool heard = false;
    bool starts = false;
  };
  Now update(bool lasts, double time);  // [s]; a clock set back cannot prolong it

 private:
  double length_, hold_;
  bool begun_ = false, heard_ = false;
  double until_ = 0.0;
};

}  // namespace gearshift
