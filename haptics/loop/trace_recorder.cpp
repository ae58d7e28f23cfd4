#include "haptics/loop/trace_recorder.h"

#include <chrono>

namespace gearshift::haptics {
namespace {

// Pause between two reads of the trace queue. It is short enough, because the queue holds the cycles of two seconds at
// 4 kHz.
constexpr std::chrono::milliseconds kPumpInterval{20};

}  // namespace

TraceRecorder::TraceRecorder(const std::filesystem::path& file, const TraceHeader& header, LoopChannels& channels,
                             TracePump pump)
    : channels_(channels), writer_(file, header), lost_before_(channels.trace_lost.load()) {
  for (TraceSample left_over; channels_.trace.pop(left_over);) continue;
  channels_.recording.store(true);
  if (pump == TracePump::by_recorder) thread_ = std::thread([this] { run(); });
}

void TraceRecorder::pump() noexcept {
  drain();
}

void TraceRecorder::run() noexcept {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kPumpInterval, [this] { return stopping_; })) {
    lock.unlock();
    drain();
    lock.lock();
  }
}

void TraceRecorder::drain() noexcept {
  // Reads the loss counter before the queue. If a cycle is lost in between, the next call detects the loss.
  lost_ = lost_ || channels_.trace_lost.load() != lost_before_;
  for (TraceSample sample; channels_.trace.pop(sample);) take(sample);
  if (lost_ || !writer_.problem().empty()) stop_recording();
}

// Writes the cycles before the first gap and drops all later cycles, because a replay needs every input.
void TraceRecorder::take(const TraceSample& sample) noexcept {
  if (last_cycle_ && sample.out.cycle != *last_cycle_ + 1) lost_ = gap_ = true;
  last_cycle_ = sample.out.cycle;
  if (!gap_) writer_.add(sample);
}

void TraceRecorder::stop_recording() noexcept {
  channels_.recording.store(false);
  const std::lock_guard lock(mutex_);
  if (!problem_.empty()) return;
  problem_ = writer_.problem();
  if (problem_.empty()) problem_ = "the recording is incomplete, because the recorder could not keep up";
}

std::optional<std::string> TraceRecorder::take_problem() {
  const std::lock_guard lock(mutex_);
  if (problem_.empty() || problem_reported_) return std::nullopt;
  problem_reported_ = true;
  return problem_;
}

RecordingResult TraceRecorder::finish() noexcept {
  if (!finished_) {
    finished_ = true;
    channels_.recording.store(false);
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
    drain();
    writer_.finish(lost_);
    if (problem_.empty()) problem_ = writer_.problem();
  }
  return {writer_.cycles(), writer_.hash(), lost_, problem_};
}

}  // namespace gearshift::haptics
