// Memory held through malloc: allocated minus freed. It reveals leaks more precisely than the system's figure, which
// includes fragmentation and caches.
#pragma once

#include <malloc.h>

#include <cstddef>

namespace gearshift::test {

// [bytes] allocated and not freed, over all arenas. Meaningless under a sanitizer, which has its own allocator.
inline std::size_t memory_in_use() {
  const struct mallinfo2 all = mallinfo2();
  return all.uordblks + all.hblkhd;
}

}  // namespace gearshift::test
