// Extent of a test campaign: complete under `./test --full`, which sets GEARSHIFT_FULL; otherwise only a sample.
#pragma once

#include <algorithm>
#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define GEARSHIFT_TEST_IS_SLOW
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GEARSHIFT_TEST_IS_SLOW
#endif

namespace gearshift::test {

inline bool is_full_campaign() {
  return std::getenv("GEARSHIFT_FULL") != nullptr;
}

// Number of cases: `all` in a complete campaign, otherwise `sample`, or a quarter of it under a sanitizer, which is slow.
inline unsigned campaign_size(unsigned all, unsigned sample) {
#ifdef GEARSHIFT_TEST_IS_SLOW
  sample = std::max(sample / 4, 1U);
#endif
  return is_full_campaign() ? all : sample;
}

}  // namespace gearshift::test
