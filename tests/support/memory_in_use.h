// What a program holds of malloc: what is asked for, and for what it is given back. It sees a leak where the system's
// figure sees holes and caches, too.
#pragma once

#include <malloc.h>

#include <cstddef>

namespace gearshift {

// [bytes] asked for and not given back, in every arena. Meaningless under a sanitizer, which has an allocator of its own.
inline std::size_t memory_in_use() {
  const struct mallinfo2 all = mallinfo2();
  return all.uordblks + all.hblkhd;
}

}  // namespace gearshift
