// Runs a recorded drive again, from its inputs alone, and compares every output of every cycle, bit by bit.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "haptics/loop/lever_world.h"
#include "haptics/loop/trace_format.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift {

// The world of that name behind that gate, or nothing when the name is not known.
using WorldFactory = std::function<std::unique_ptr<LeverWorld>(const std::string& name, const Gate& gate)>;
std::unique_ptr<LeverWorld> make_null_world(const std::string& name, const Gate& gate);

// The first thing that came out differently.
struct Difference {
  std::uint64_t cycle = 0;
  std::string field;               // "out.commanded.x"
  std::string recorded, replayed;  // as text, doubles with all their digits
};

struct ReplayResult {
  std::uint64_t cycles = 0;         // that were run again, the differing one included
  double seconds = 0.0;             // [s] on the loop's clock
  std::uint64_t recorded_hash = 0;  // of parameters and outputs
  std::uint64_t replayed_hash = 0;
  std::optional<Difference> first;
  bool bit_for_bit() const noexcept { return !first && recorded_hash == replayed_hash; }
};

class Replayer {
 public:
  // Throws FileError (with `file` as its name) where the header describes nothing that can be run: an unknown
  // world, a parameter out of its range, a layout that does not compile.
  Replayer(const TraceHeader& header, const std::string& file, const WorldFactory& make_world = make_null_world);
  ~Replayer();

  // One cycle again. False at the first difference: then finish. Throws FileError when the recording began in
  // the middle of a run.
  bool step(const TraceSample& recorded);

  // recorded_hash: of the whole recording (TraceReader::hash after its last cycle).
  ReplayResult finish(std::uint64_t recorded_hash) const;

 private:
  struct Rig;  // device, world, gate, channels and loop of the second run

  std::string file_;
  double period_;  // [s]
  std::unique_ptr<Rig> rig_;
  TraceSample last_;  // recorded in the cycle before
  RunHash hash_;
  ReplayResult result_;
  std::int64_t first_ns_ = 0;  // [ns]
};

ReplayResult replay(const Trace& trace, const WorldFactory& make_world = make_null_world);

}  // namespace gearshift
