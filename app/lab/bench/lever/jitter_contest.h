// Compares the wake-up lateness of the loop's thread with cyclictest's in alternating blocks, under a load given by the
// caller. Both use equal policy, priority, core and period.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {

// A load that runs during the measurement, from start() until the returned object is destroyed.
struct JitterLoad {
  std::string where;  // suffix of the rows' names, such as ", alone"
  std::function<std::shared_ptr<void>()> start;
};

// Returns one row "not measurable" if cyclictest is missing or has no real-time rights. `family`: the rows' family.
// Progress is reported from `progress_begin` to `progress_end`.
std::vector<BenchRow> jitter_rows(const BenchOptions& options, const std::string& family, const JitterLoad& load,
                                  double progress_begin, double progress_end);

}  // namespace gearshift::lab
