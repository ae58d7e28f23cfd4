// Ctrl-C, kill and a closed terminal let a program that drives motors end as it should: what was measured or recorded is
// kept, the motors are off, the device is given back. Asked a second time it ends at once.
#pragma once

namespace gearshift {

class StopSignals {  // one at a time
 public:
  StopSignals();
  ~StopSignals();  // as they were
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  static bool asked() noexcept;
};

}  // namespace gearshift
