// Writes the loop's trace queue to a file, on any thread except the loop's.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/trace_writer.h"

namespace gearshift::haptics {

enum class TracePump {
  by_recorder,  // the recorder's own thread empties the queue; for a real-time loop
  by_caller     // the caller calls pump() at least once every 8000 cycles; for a headless run
};

struct RecordingResult {
  std::uint64_t cycles = 0;
  std::uint64_t hash = 0;  // hash of parameters and outputs
  bool torn = false;       // the queue overflowed; the file ends before the first lost cycle and is marked as torn
  std::string problem;     // empty, or one sentence: the disk is full, or the recorder could not keep up
};

class TraceRecorder {
 public:
  // Create the recorder before the loop's first cycle; otherwise the trace cannot be replayed. Throws FileError if the
  // file cannot be created. The channels must outlive the recorder.
  TraceRecorder(const std::filesystem::path& file, const TraceHeader& header, LoopChannels& channels, TracePump pump);
  ~TraceRecorder() { finish(); }
  TraceRecorder(const TraceRecorder&) = delete;
  TraceRecorder& operator=(const TraceRecorder&) = delete;

  void pump() noexcept;  // by_caller only

  // Returns the problem that stopped the recording, as one sentence, but only once.
  std::optional<std::string> take_problem();

  // Writes the rest of the queue and closes the file. Stop the loop first, or the last cycles will be missing (the
  // trace is still valid). May be called twice.
  RecordingResult finish() noexcept;

 private:
  void drain() noexcept;
  void take(const TraceSample& sample) noexcept;
  void stop_recording() noexcept;
  void run() noexcept;

  LoopChannels& channels_;
  TraceWriter writer_;
  const std::uint64_t lost_before_;
  std::optional<std::uint64_t> last_cycle_;
  bool lost_ = false;  // the loop could not push a cycle into the queue
  bool gap_ = false;   // cycles after the lost cycle have begun to arrive
  bool finished_ = false;

  std::mutex mutex_;  // guards stopping_, problem_ and problem_reported_
  std::condition_variable wake_;
  bool stopping_ = false;
  std::string problem_;
  bool problem_reported_ = false;
  std::thread thread_;
};

}  // namespace gearshift::haptics
