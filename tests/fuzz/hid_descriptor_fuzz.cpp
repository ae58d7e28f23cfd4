// Whatever a device says of itself: parse_report_descriptor() refuses it or gives lawful fields, and what find_lever_report()
// and find_pid() make of these is encoded and decoded within the reports.
#include <cstdio>
#include <cstdlib>

#include "tests/haptics/hid/hid_laws.h"

using namespace gearshift;

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer gives the name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string broken = HidLaws({data, size}).broken_by({data, size});
  if (broken.empty()) return 0;
  std::fprintf(stderr, "%s\n", broken.c_str());
  std::abort();
}
