// Extent of a test campaign: complete under `./test --full`, which sets GEARSHIFT_FULL; otherwise only a sample.
#pragma once

#include <cstdlib>

namespace gearshift::test {

inline bool is_full_campaign() {
  return std::getenv("GEARSHIFT_FULL") != nullptr;
}

}  // namespace gearshift::test
