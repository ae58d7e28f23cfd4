#include "app/train/trace_player.h"

namespace gearshift {

TracePlayer::TracePlayer(const std::filesystem::path& file) : reader_(file, TornTrace::salvage) {}

bool TracePlayer::advance(double seconds) {
  passed_.clear();
  if (!begun_) {
    begun_ = true;
    more_ = reader_.next(next_);
    first_ns_ = next_.deadline_ns;
  }
  time_ += seconds;
  while (more_ && 1e-9 * static_cast<double>(nanoseconds_between(first_ns_, next_.deadline_ns)) <= time_) {
    sample_ = next_;
    passed_.push_back(sample_.out);
    more_ = reader_.next(next_);
  }
  return more_ || !passed_.empty();
}

}  // namespace gearshift
