// Simulates a full disk: the test program overrides the C library's write functions.
#pragma once

namespace gearshift::test {

extern bool disk_is_full;  // while set, writing to any file fails

}  // namespace gearshift::test
