// Simulates a full disk: the test program overrides the C library's pwrite64(), with which SQLite writes.
#pragma once

namespace gearshift::test {

extern bool disk_is_full;  // while set, every call of pwrite64() fails

}  // namespace gearshift::test
