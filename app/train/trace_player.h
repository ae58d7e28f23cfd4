// A recorded drive, looked at again at its own pace.
#pragma once

#include <filesystem>
#include <vector>

#include "haptics/loop/trace_reader.h"

namespace gearshift {

class TracePlayer {
 public:
  // Throws FileError.
  explicit TracePlayer(const std::filesystem::path& file);

  // Moves on by `seconds`; false when all had passed before. Throws FileError where the trace is damaged.
  bool advance(double seconds);
  // Of the cycles that the last advance() went by.
  const std::vector<HapticSnapshot>& passed() const { return passed_; }
  const HapticSnapshot& snapshot() const { return sample_.out; }
  const DriverControls& controls() const { return sample_.controls; }
  const TraceHeader& header() const { return reader_.header(); }

 private:
  TraceReader reader_;
  TraceSample sample_, next_;
  std::vector<HapticSnapshot> passed_;
  std::int64_t first_ns_ = 0;          // [ns]
  double time_ = 0.0;                  // [s] since the first cycle
  bool begun_ = false, more_ = false;  // next_ is one
};

}  // namespace gearshift
