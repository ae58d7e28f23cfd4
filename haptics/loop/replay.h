// Replays a recorded drive from its inputs and compares every output of every cycle bit by bit.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "haptics/loop/lever_load.h"
#include "haptics/loop/trace_format.h"

namespace gearshift::haptics {

// Makes the load identified by `name` for the given gate; null if the name is unknown.
using LoadFactory = std::function<std::unique_ptr<LeverLoad>(const std::string& name, const Gate& gate)>;
std::unique_ptr<LeverLoad> make_no_load(const std::string& name, const Gate& gate);

// The first field whose replayed value differs from the recorded one.
struct Difference {
  std::uint64_t cycle = 0;
  std::string field;               // "out.commanded.x"
  std::string recorded, replayed;  // values as text, doubles losslessly
};

struct ReplayResult {
  std::uint64_t cycles = 0;         // replayed cycles, including a cycle that differs
  double seconds = 0.0;             // [s] replayed time on the loop's clock
  std::uint64_t recorded_hash = 0;  // hash of parameters and outputs
  std::uint64_t replayed_hash = 0;
  std::optional<Difference> first;
  bool bit_for_bit() const noexcept { return !first && recorded_hash == replayed_hash; }
};

class Replayer {
 public:
  // Throws FileError (naming `file`) if the header cannot be replayed: an unknown load, a parameter out of range, or a
  // gate layout that does not compile.
  Replayer(const TraceHeader& header, const std::string& file, const LoadFactory& make_load = make_no_load);
  ~Replayer();

  // Replays one cycle. Returns false at the first difference; then call finish(). Throws FileError if the recording
  // began in the middle of a run.
  bool step(const TraceSample& recorded);

  // recorded_hash: hash of the whole recording (TraceReader::hash after the last cycle).
  ReplayResult finish(std::uint64_t recorded_hash) const;

 private:
  struct Rig;  // device, load, gate, inputs and loop of the replay

  std::string file_;
  double period_;  // [s]
  std::unique_ptr<Rig> rig_;
  TraceSample last_;  // recorded sample of the previous cycle
  RunHash hash_;
  ReplayResult result_;
  std::int64_t first_ns_ = 0;  // [ns]
};

}  // namespace gearshift::haptics
