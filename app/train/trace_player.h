// A recorded drive, looked at again at its own pace.
#pragma once

#include <filesystem>

#include "haptics/loop/trace_reader.h"

namespace gearshift {

class TracePlayer {
 public:
  // Throws FileError.
  explicit TracePlayer(const std::filesystem::path& file);

  // Moves on by `seconds`; false at the end. Throws FileError where the trace is damaged.
  bool advance(double seconds);
  const HapticSnapshot& snapshot() const { return sample_.out; }
  const DriverControls& controls() const { return sample_.controls; }
  const TraceHeader& header() const { return reader_.header(); }
  double time() const { return time_; }  // [s] since the first cycle

 private:
  TraceReader reader_;
  TraceSample sample_;
  std::int64_t first_ns_ = 0;  // [ns]
  double time_ = 0.0;
  bool begun_ = false;
};

}  // namespace gearshift
