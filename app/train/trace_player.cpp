#include "app/train/trace_player.h"

namespace gearshift {

TracePlayer::TracePlayer(const std::filesystem::path& file) : reader_(file, TornTrace::salvage) {}

bool TracePlayer::advance(double seconds) {
  if (!begun_) {
    begun_ = true;
    if (!reader_.next(sample_)) return false;
    first_ns_ = sample_.deadline_ns;
  }
  time_ += seconds;
  while (1e-9 * static_cast<double>(nanoseconds_between(first_ns_, sample_.deadline_ns)) < time_) {
    if (!reader_.next(sample_)) return false;
  }
  return true;
}

}  // namespace gearshift
