// Memory that was allocated through malloc and not freed. Leaks are visible in this figure more precisely than in the
// process size that the system reports, which includes fragmentation and caches.
#pragma once

#include <malloc.h>

#include <cstddef>

namespace gearshift::test {

// [bytes] allocated and not freed, in all arenas. Meaningless under a sanitizer, which has its own allocator.
inline std::size_t memory_in_use() {
  const struct mallinfo2 all = mallinfo2();
  return all.uordblks + all.hblkhd;
}

}  // namespace gearshift::test
