// Extent of a test campaign: complete under `./test --full`, which sets GEARSHIFT_FULL, otherwise a sample.
#pragma once

#include <cstdlib>

namespace gearshift::test {

inline bool is_whole_campaign() {
  return std::getenv("GEARSHIFT_FULL") != nullptr;
}

}  // namespace gearshift::test
