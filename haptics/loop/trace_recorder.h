// Records the cycles of one loop in a trace file, up to the first cycle that is missing, because a replay needs every
// input.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "haptics/loop/trace_writer.h"

namespace gearshift::haptics {

struct RecordingResult {
  std::uint64_t cycles = 0;
  std::uint64_t hash = 0;  // hash of parameters and outputs
  bool torn = false;       // cycles were lost; the file ends before the first lost cycle and is marked as torn
  std::string problem;     // empty, or one sentence: the disk is full, or the recorder could not keep up
};

class TraceRecorder {
 public:
  // Throws FileError if the file cannot be created.
  TraceRecorder(const std::filesystem::path& file, const TraceHeader& header) : writer_(file, header) {}
  ~TraceRecorder() { finish(); }
  TraceRecorder(const TraceRecorder&) = delete;
  TraceRecorder& operator=(const TraceRecorder&) = delete;

  // Adds the next cycle (HapticLoop::published), from the loop's first cycle on; not on the haptic thread, because it
  // writes to the file. After a problem, all later cycles are ignored.
  void add(const TraceSample& cycle) noexcept;

  // Returns the problem that stopped the recording, as one sentence, but only once. Any thread may call it.
  std::optional<std::string> take_problem();

  // Closes the file; no add() afterwards. May be called twice.
  RecordingResult finish() noexcept;

 private:
  void report(const std::string& problem) noexcept;

  TraceWriter writer_;
  std::uint64_t next_cycle_ = 0;
  bool is_torn_ = false;
  bool is_finished_ = false;

  std::mutex mutex_;  // guards the members below
  std::string problem_;
  bool is_problem_reported_ = false;
};

}  // namespace gearshift::haptics
