// A disk that is full, on demand: the test program stands before the C library's writes.
#pragma once

namespace gearshift {

extern bool disk_is_full;  // while set, nothing can be written to any file

}  // namespace gearshift
