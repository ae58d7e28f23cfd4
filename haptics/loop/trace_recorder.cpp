#include "haptics/loop/trace_recorder.h"

namespace gearshift::haptics {

void TraceRecorder::add(const TraceSample& cycle) noexcept {
  if (is_torn_ || is_finished_) return;
  if (cycle.out.cycle != next_cycle_) {
    is_torn_ = true;
    report("the recording is incomplete, because the recorder could not keep up");
    return;
  }
  ++next_cycle_;
  writer_.add(cycle);
  if (!writer_.problem().empty()) report(writer_.problem());
}

void TraceRecorder::report(const std::string& problem) noexcept {
  const std::lock_guard lock(mutex_);
  if (problem_.empty()) problem_ = problem;
}

std::optional<std::string> TraceRecorder::take_problem() {
  const std::lock_guard lock(mutex_);
  if (problem_.empty() || is_problem_reported_) return std::nullopt;
  is_problem_reported_ = true;
  return problem_;
}

RecordingResult TraceRecorder::finish() noexcept {
  if (!is_finished_) {
    is_finished_ = true;
    writer_.finish(is_torn_);
    if (!writer_.problem().empty()) report(writer_.problem());
  }
  const std::lock_guard lock(mutex_);
  return {writer_.cycles(), writer_.hash(), is_torn_, problem_};
}

}  // namespace gearshift::haptics
