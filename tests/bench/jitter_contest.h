// Wake-up lateness of the loop's thread beside cyclictest's: alternating blocks, same policy, priority, core, period,
// under a load that the caller brings.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/bench/bench.h"

namespace gearshift {

// What runs beside both contestants, from start() until what it returned is gone.
struct JitterLoad {
  std::string where;  // ", alone": how a row's name ends
  std::function<std::shared_ptr<void>()> start;
};

// One row "not measurable" where cyclictest is missing or nobody has real-time rights. family: of the rows.
// The progress goes from share_from to share_to.
std::vector<BenchRow> jitter_rows(const BenchOptions& options, const std::string& family, const JitterLoad& load,
                                  double share_from, double share_to);

}  // namespace gearshift
