// How much of a campaign a test runs: all of it under `./test --full`, which sets GEARSHIFT_FULL, else a sample.
#pragma once

#include <cstdlib>

namespace gearshift {

inline bool is_whole_campaign() {
  return std::getenv("GEARSHIFT_FULL") != nullptr;
}

}  // namespace gearshift
